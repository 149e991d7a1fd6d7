// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "camera/views.h"
#include "flow/frame_view.h"
#include "scene/forms.h"

namespace tofray::pipeline {

/// Everything that a frame needs, frozen: plain numbers and pointers that any machine can read.
struct Setup {
  camera::LensView lens;
  scene::SceneView scene;
  camera::LightView lights[flow::max_lights];
  camera::PowerView power;
  camera::SensorView sensor;
  camera::DecoderView decoder;
  std::int32_t truth_slot;       ///< slot of the middle raw frame
  std::int32_t last_stage;       ///< 0 trace, 1 power, 2 raw, 3 depth: nothing is done after it
  std::int32_t culling;          ///< 0: every pixel tests every form
};

/// One frame: where its arrays are and its place in the random numbers.
struct Job {
  flow::FrameView out;
  std::uint32_t index_low, index_high;
  float* filtered;               ///< [height][width] scratch of the image filters
  std::int32_t filter;           ///< 0 none, 1 Gaussian, 2 median
  std::int32_t filter_radius;
  float filter_weights[33];      ///< Gaussian, [0] the middle
};

using flow::tile_height;
using flow::tile_width;

enum Stages : std::int32_t { stage_trace, stage_power, stage_raw, stage_depth };

TOFRAY_FN int tiles_across(const camera::LensView& lens) { return (lens.width + tile_width - 1) / tile_width; }
TOFRAY_FN int tile_count(const camera::LensView& lens) { return tiles_across(lens) * ((lens.height + tile_height - 1) / tile_height); }

}  // namespace tofray::pipeline
