// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "tofray/load.h"

/// Files given to a command that takes others: what they are, and which command fits.
namespace tofray::run {

/// Refuses a file that is called like a mesh or a cloud of points of a format that is not read.
/// @throws Error (bad_input) that says what it is, which formats are read, and what makes one of them of it
void refuse_other_mesh(const std::string& path);

/// Refuses what is no text: archives of arrays, pictures, point clouds.
/// @throws Error (bad_input) that names the file's kind and the command that takes it
void refuse_data(std::string_view bytes, const std::string& path);

/// Refuses a document that is another kind than a scene: a camera profile, a manifest. To be called where reading it as a scene failed.
/// @throws as refuse_data; nothing where the text may be meant as a scene
void refuse_other_document(const std::string& text, const std::string& path);

/// Refuses a folder, and says what lies in it. @param usage  e.g. "render"
void refuse_folder(const std::string& path, const char* command);

/// A camera profile is told from a scene by what it has to have.
bool looks_like_a_profile(const std::string& text, const std::string& name);

/// The text of a scene or profile that was named: of a file, or of stdin where the name is "-".
struct NamedText {
  std::string text;
  std::string name;  ///< for messages and manifest.json: the file, or "<stdin>"
};
/// Stdin is read once, however often it is asked for.
/// @throws Error, with what is built in where there is no such file
NamedText named_text(const std::string& name);

/// Refuses a file that is not there, and says which of its kind lie beside the place.
/// @throws Error (io)
void refuse_missing(const std::string& path);

bool is_folder(const std::string& path);

/// Names in a folder that end so, in order; no more than `most` files are looked at.
std::vector<std::string> names_in(const std::string& folder, const std::vector<std::string>& endings, std::size_t most);

/// The file that `inspect` and others mean by a folder: frame.npz in it. The path itself where it is no folder.
/// @param command  for the message
/// @throws Error (bad_input) that lists what there is instead
std::string frame_in(const std::string& path, const char* command);

/// What a word names that may be a folder or file of frames, or a scene: these count more than a built-in scene of their name. The note says so.
NameChoice frame_or_scene(const std::string& typed, const char* command);

/// A note of choose_scene() and others as it is said; nothing where there is none.
std::string note_of(const NameChoice& choice);

}  // namespace tofray::run
