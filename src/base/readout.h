// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "tofray/camera.h"

namespace tofray::base {

/// Pixels of the image, along a row and along a column: of the region that is read, binned.
struct ImageExtent {
  int width, height;
};
/// @param camera  was seen to be good
ImageExtent image_extent(const Camera& camera);

/// Start of each raw frame after the start of its frame [s]: an exposure begins when the one before has been read out.
std::vector<double> raw_frame_starts_s(const std::vector<double>& integration_time_s, double readout_time_s);

}  // namespace tofray::base
