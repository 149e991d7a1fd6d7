// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstdint>

namespace tofray::flow {

/// Where a frame's arrays are. A null pointer: not wanted. Shapes as in tofray/frame.h.
struct FrameView {
  float *tap_a, *tap_b;                     ///< [phase][height][width]
  std::uint16_t* raw;                       ///< [phase][height][width]
  float *z, *range, *points, *amplitude, *ambient, *noise;
  std::uint8_t* confidence;
  std::uint16_t* flags;
  float *gt_range, *gt_z, *gt_reflectivity, *gt_position, *gt_normal;
  std::int32_t* gt_object;
  float *gt_irradiance, *gt_radiance, *gt_power;
  float* gt_signal;                         ///< [phase][height][width]
};

}  // namespace tofray::flow
