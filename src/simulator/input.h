// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <vector>

#include "camera/readout/image_camera.h"
#include "pipeline/external_input.h"
#include "simulator/histogram.h"
#include "tofray/camera.h"
#include "tofray/frame.h"
#include "tofray/stages.h"

namespace tofray::simulator {

/// Where arrays of one's own are, and what was made for them.
struct OwnInput {
  pipeline::Input input{};
  std::vector<std::int32_t> light_of_path;
  HistogramSums sums;
};

/// Where the arrays of one's own are, once all of them are seen to be good.
/// @throws Error (bad_input) naming the first array or value that is not
OwnInput input_of(const Geometry& seen, const camera::ImageCamera& camera);
OwnInput input_of(const PixelLight& light, const camera::ImageCamera& camera);
/// @param setup  of the camera, with its phasors
OwnInput input_of(const Transient& light, const camera::ImageCamera& camera, const pipeline::Setup& setup);
/// Input of raw data, which process() has checked.
OwnInput input_of(const Raw& raw);

}  // namespace tofray::simulator
