// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstddef>
#include <cstdint>
#include <vector>

#include "tofray/array.h"
#include "tofray/flags.h"
#include "tofray/frame_arrays.h"

/// What a simulated camera delivers: plain contiguous arrays, row-major, [height][width] or [phase][height][width].
/// tofray/frame_arrays.h has a row for each array: type, shape, unit, and what it is. Invalid values: NaN in floats, 0 in integers.
namespace tofray {

#define TOFRAY_VECTOR(name, part, member, element, ...) std::vector<element> member;
#define TOFRAY_ALIGNED(name, part, member, element, ...) Array<element> member;

/// Raw frames of one frame, as the sensor hands them out, and when and how each was exposed.
struct Raw {
  int width = 0, height = 0, phases = 0;
  TOFRAY_RAW_ARRAYS(TOFRAY_ALIGNED)      // Array<float> tap_a; …
  TOFRAY_EXPOSURE_ARRAYS(TOFRAY_VECTOR)  // std::vector<double> modulation_frequency_hz; …
};

/// Depth frame, camera frame (x right, y down, z forward).
struct Depth {
  int width = 0, height = 0;
  int modulations = 0;                ///< modulation frequencies of the arrays by_frequency
  TOFRAY_DEPTH_ARRAYS(TOFRAY_VECTOR)  // std::vector<float> z_m; …
};

/// Ground truth at the middle of the middle raw frame, and the power of the camera's illumination.
struct Truth {
  int width = 0, height = 0, phases = 0;
  int bins = 0;  ///< bins of transient_e_per_s
  double time_s = 0;
  TOFRAY_TRUTH_ARRAYS(TOFRAY_VECTOR)  // std::vector<float> range_m; …
};

#undef TOFRAY_ALIGNED
#undef TOFRAY_VECTOR

/// What a camera delivers of one run through its sequence, and the truth about it.
struct Frame {
  std::uint64_t index = 0;
  Raw raw;
  Depth depth;
  Truth truth;  ///< empty arrays where not asked for
};

/// A frame of a batch, where it lies: arrays as in Raw, Depth and Truth, under their names in files (gt_range_m is Truth::range_m).
/// Null where a stage was not reached or the truth not asked for.
struct FrameArrays {
  std::uint64_t index = 0;
  int width = 0, height = 0, phases = 0, bins = 0, modulations = 0;
  int device = -1;  ///< −1: host memory; else the pointers are for this GPU
#define TOFRAY_POINTER(name, part, member, element, ...) const element* name = nullptr;
  TOFRAY_IMAGE_ARRAYS(TOFRAY_POINTER)  // const float* tap_a = nullptr; …
#undef TOFRAY_POINTER
};

}  // namespace tofray
