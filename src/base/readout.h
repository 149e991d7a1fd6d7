// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "tofray/camera.h"

namespace tofray::base {

/// The camera whose pixels are those of the image: region and binning are in its numbers, and nothing is left to be binned. A camera that
/// reads all of its pixels one by one is itself.                                                        [theory: eq. 4.24 to 4.26]
/// @param camera  was seen to be good
Camera as_read_out(const Camera& camera);

/// Start of each raw frame after the start of its frame [s]: an exposure begins when the one before has been read out.
std::vector<double> raw_frame_starts_s(const std::vector<double>& integration_time_s, double readout_time_s);

}  // namespace tofray::base
