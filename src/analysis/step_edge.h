// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <vector>

/// A step between two surfaces, one near and one far, in an image of depth.
namespace tofray::analysis {

struct StepEdge {
  bool found = false;
  double near_m = 0, far_m = 0;  ///< medians of both sides
  bool by_rows = true;           ///< rows cross it; else columns do
  bool near_first = true;        ///< the near surface is at the small columns (or rows)
  std::vector<double> middle;    ///< of each line of the image: where z is half way, in pixels; NaN: it crosses not once
  double width_px = 0;           ///< from 10 % to 90 %, median of the lines
};

/// @param z  [height][width]; NaN: invalid
StepEdge step_edge(const std::vector<double>& z, int width, int height);

}  // namespace tofray::analysis
