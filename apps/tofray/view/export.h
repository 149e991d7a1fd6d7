// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "view/state.h"

namespace tofray::view {

struct ExportRequest {
  std::uint64_t first = 0, frames = 1;
  std::string arrays;  ///< as --arrays has it; empty: those of all panes and the raw frames
  FrameProgress* progress = nullptr;
  std::function<void(std::uint64_t)> done = {};  ///< told how many frames are
};

/// The page as one file with these frames of the state in it, which needs no server. The same state gives the same bytes.
/// @throws Error where the build has no page, where the file would be too large for browsers, where a frame was stopped
std::string exported_page(const State& state, const ExportRequest& request);

/// The words of `tofray view` that make it.
std::vector<std::string> export_words(const State& state, const ExportRequest& request, const std::string& file);

}  // namespace tofray::view
