// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <vector>

#include "camera/lens/lens.h"

namespace tofray::camera {

/// A place within every pixel at which the scene is seen.
struct SubpixelSample {
  Point2 offset_px;  ///< from the pixel's middle
  double share;      ///< of the pixel's light; those of all samples are 1 together
};

/// n × n places, row by row: the middles of as many cells of the square of area fill_factor·pitch² in the pixel's middle, a share 1/n² each;
/// of a pixel with a mask, of cells of the whole pixel, whose shares are what the mask lets through there; none where that is nothing.
///                                                                                           [theory: subpixel-samples]
/// @throws Error (bad_input) where the mask lets nothing through
std::vector<SubpixelSample> subpixel_samples(const Sensor& sensor, int n);

}  // namespace tofray::camera
