// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <string>
#include <utility>
#include <vector>

#include "files/json.h"
#include "view/scales.h"
#include "view/state.h"

namespace tofray::view {

/// Panes, and the range of colours of each array.
struct Scales {
  std::vector<Pane> panes;
  std::vector<std::pair<std::string, files::Json>> ranges;  ///< one for each pane; null: none
};
/// Ranges of colours that a frame has and gives. @param frame  with all its arrays
Scales scales_of(const Frame& frame);

/// The message `hello`. @param other  side B, or none  @param build  SHA-256 of the page
files::Json greeting(const State& state, const State* other, const Scales& scales, const std::string& build);

}  // namespace tofray::view
