// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <vector>

#include "pictures/picture_scale.h"
#include "tofray/frame.h"

/// The range of values that a picture of a frame shows, by what its values are: preview.png and the viewer have these alone.
namespace tofray::pictures {

/// The values of z that are not a cycle off, as far as truth says it; all where none is right.
std::vector<double> right_z(const Depth& depth, const Truth& truth, const Raw& raw);

/// Of lengths in metres: 1st to 99th percentile.
PictureScale length_scale(const std::vector<double>& metres);
/// Of strengths of light: 0 to the 99.5th percentile.
PictureScale strength_scale(const std::vector<double>& values);
/// Of noise in millimetres: 0 to the 98th percentile.
PictureScale noise_scale(const std::vector<double>& millimetres);

/// Of errors of either sign in millimetres, 0 in the middle: ± the 98th percentile of their magnitudes, or three times the 68th where that is less.
struct ErrorScale {
  PictureScale scale;
  bool of_most;  ///< the 98th percentile it is
};
ErrorScale error_scale(const std::vector<double>& millimetres);

}  // namespace tofray::pictures
