// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "files/json.h"
#include "tofray/frame.h"

/// Colours of values: what panes there are, their ranges by the rules of preview.png, palettes and reasons of invalid pixels out of src/pictures.
namespace tofray::view {

/// An image array that a pane can show.
struct Pane {
  const char* array;
  const char* title;
};
std::vector<Pane> all_panes();
/// Panes whose arrays the frame has.
std::vector<Pane> panes_of(const Frame& frame);

/// The range of an array's values in this frame, as messages have it; null for one that is shown by its bits; nothing where no pane shows it.
/// @param frame  with all its arrays
std::optional<files::Json> scale_json(const Frame& frame, std::string_view array);

files::Json palettes_json();
/// Reasons in the order in which the first bit that is set explains an invalid pixel.
files::Json invalid_json();
files::Json invalid_color_json();

}  // namespace tofray::view
