// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

#include "view/control.h"

/// A state as a picture carries it in a chunk of text, and as pages hand it in again.
namespace tofray::view {

/// What makes the picture's frame.
struct PictureState {
  std::string version;       ///< of tofray
  std::string scene;         ///< a built-in scene's name, or a file's without its folder
  std::string scene_sha256;  ///< of the file's text; empty for what is built in
  Overrides overrides;
  std::uint64_t seed = 0, frame = 0;
  std::string noise = "exact";  ///< as --noise has it
  int exposure_samples = 1, subpixel = 1;
};

/// Keyword of the chunk.
constexpr const char* picture_keyword = "tofray";
constexpr std::size_t most_picture_text = 49'152;

/// @throws Error (limit) where it is longer than most_picture_text
std::string picture_text(const PictureState& state);
/// Reads what picture_text() wrote, out of a stranger's picture, too. @throws Error (bad_input)
PictureState parse_picture_text(std::string_view text);

/// The PNG with an iTXt chunk before its end.
std::string png_with_text(std::string_view png, std::string_view keyword, std::string_view text);

}  // namespace tofray::view
