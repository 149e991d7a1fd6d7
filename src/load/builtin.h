// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <string>
#include <string_view>
#include <vector>

/// Camera profiles and scenes that the library carries with it: the files of profiles/ and scenes/.
namespace tofray::load {

struct Builtin {
  std::string name;  ///< the file's stem, e.g. "pico-flexx"
  std::string_view text;
  std::string description;  ///< the comment in the file's first line
};

const std::vector<Builtin>& builtin_profiles();
const std::vector<Builtin>& builtin_scenes();

/// The one of that name, or none.
const Builtin* find_builtin(const std::vector<Builtin>& all, const std::string& name);

/// What the build put in (written by cmake/EmbedFiles.cmake into the build tree).
struct EmbeddedFile {
  const char* folder;  ///< "profiles", "scenes"
  const char* stem;
  std::string_view text;
};
extern const EmbeddedFile embedded_files[];
extern const std::size_t embedded_count;

}  // namespace tofray::load
