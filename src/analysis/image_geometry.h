// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <array>
#include <optional>

#include "tofray/camera.h"

/// Where the pixels of an image look, for who draws a camera or moves things with the cursor.
namespace tofray::analysis {

/// The camera whose pixels are those of the image: region and binning are in its numbers.
///                                                                         [theory: image-pixels, binned-charge, binned-patterns]
/// @param profile  was seen to be good
Camera image_camera(const Camera& profile);

/// Where a place of the image looks: x and y of the direction (x, y, 1) in the camera's frame; nothing outside of the lens model.
/// @param u, v  [px] of the image; the middle of its first pixel is (0, 0)
std::optional<std::array<double, 2>> direction_through(const Camera& profile, double u, double v);

}  // namespace tofray::analysis
