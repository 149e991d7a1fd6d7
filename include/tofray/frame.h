// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstddef>
#include <cstdint>
#include <vector>

#include "tofray/array.h"
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

/// Bits of Depth::flags. The first five make the depth invalid, the next two warn, the one after them says that the camera was
/// told to reject what they warn of, and the last one that a filter, or a mean over frames, changed the range.
enum Flag : std::uint16_t {
  flag_saturated = 1,
  flag_low_signal = 2,
  flag_flying_pixel = 4,
  flag_no_return = 8,
  flag_outside_lens = 16,
  flag_inconsistent_phases = 32,
  flag_inconsistent_frequencies = 64,
  flag_rejected = 128,
  flag_filtered = 256,
};
inline constexpr std::uint16_t flags_invalid = 31 + 128;

/// Depth frame, camera frame (x right, y down, z forward).
struct Depth {
  int width = 0, height = 0;
  TOFRAY_DEPTH_ARRAYS(TOFRAY_VECTOR)  // std::vector<float> z_m; …
};

/// Ground truth at the middle of the middle raw frame, and the power of the camera's own light.
struct Truth {
  int width = 0, height = 0, phases = 0;
  int bins = 0;  ///< of transient_e_per_s
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
  int width = 0, height = 0, phases = 0, bins = 0;
  int device = -1;  ///< −1: host memory; else the pointers are for this GPU
#define TOFRAY_POINTER(name, part, member, element, ...) const element* name = nullptr;
  TOFRAY_IMAGE_ARRAYS(TOFRAY_POINTER)  // const float* tap_a = nullptr; …
#undef TOFRAY_POINTER
};

}  // namespace tofray
