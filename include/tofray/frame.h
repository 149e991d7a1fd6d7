// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstddef>
#include <cstdint>
#include <vector>

/// What a simulated camera delivers: plain contiguous arrays, row-major, [height][width] or [phase][height][width].
/// Invalid values: NaN in floats, 0 in integers.
namespace tofray {

/// Raw frames of one frame, as the sensor hands them out, and when and how each was exposed.
struct Raw {
  int width = 0, height = 0, phases = 0;
  std::vector<float> tap_a, tap_b;               ///< [phase][height][width] e⁻ after the charge model
  std::vector<std::uint16_t> raw;                ///< [phase][height][width] DN: ADC code of A−B
  std::vector<double> modulation_frequency_hz;   ///< [phase] 0 where unlit
  std::vector<double> reference_phase_rad;       ///< [phase] τ, 0 where unlit
  std::vector<double> integration_time_s;        ///< [phase]
  std::vector<double> start_time_s;              ///< [phase] t = 0: the scene as written
  std::vector<std::uint8_t> lit;                 ///< [phase] 1 or 0
};

/// Bits of Depth::flags. The first five make the depth invalid, the last two warn.
enum Flag : std::uint16_t {
  flag_saturated = 1, flag_low_signal = 2, flag_flying_pixel = 4, flag_no_return = 8, flag_outside_lens = 16,
  flag_inconsistent_phases = 32, flag_inconsistent_frequencies = 64,
};
inline constexpr std::uint16_t flags_invalid = 31;

/// Depth frame, camera frame (x right, y down, z forward).
struct Depth {
  int width = 0, height = 0;
  std::vector<float> z_m;                ///< [height][width] along the optical axis
  std::vector<float> range_m;            ///< [height][width] along the pixel's ray
  std::vector<float> points_m;           ///< [height][width][3] x, y, z
  std::vector<float> amplitude_e;        ///< [height][width] mean Â of the frequencies
  std::vector<float> ambient_e;          ///< [height][width] B̂, both taps, per lit exposure (none lit: of the mean exposure)
  std::vector<float> noise_m;            ///< [height][width] σ̂ of the range, 1 sigma
  std::vector<std::uint8_t> confidence;  ///< [height][width] 0…255
  std::vector<std::uint16_t> flags;      ///< [height][width] bits of Flag
};

/// Ground truth at the middle of the middle raw frame, and the power of the camera's own light.
struct Truth {
  int width = 0, height = 0, phases = 0;
  double time_s = 0;
  std::vector<float> range_m, z_m;            ///< [height][width]
  std::vector<float> reflectivity;            ///< [height][width] Phong: diffuse + specular
  std::vector<float> position_m;              ///< [height][width][3] camera frame
  std::vector<float> normal;                  ///< [height][width][3] unit, toward the camera
  std::vector<std::int32_t> object_id;        ///< [height][width] index in Scene::objects, −1 none
  std::vector<float> irradiance_w_m2;         ///< [height][width] on the surface
  std::vector<float> radiance_w_m2_sr;        ///< [height][width] toward the camera
  std::vector<float> power_w;                 ///< [height][width] on the pixel
  std::vector<float> signal_e;                ///< [phase][height][width] S of each raw frame, 0 where unlit
};

struct Frame {
  std::uint64_t index = 0;
  Raw raw;
  Depth depth;
  Truth truth;                  ///< empty arrays where not asked for
};

/// A frame of a batch, where it lies: arrays as in Raw, Depth and Truth. Null where a stage was not reached or the truth not asked for.
struct FrameArrays {
  std::uint64_t index = 0;
  int width = 0, height = 0, phases = 0;
  int device = -1;                       ///< −1: host memory; else the pointers are for this GPU
  const float *tap_a = nullptr, *tap_b = nullptr;
  const std::uint16_t* raw = nullptr;
  const float *z_m = nullptr, *range_m = nullptr, *points_m = nullptr, *amplitude_e = nullptr, *ambient_e = nullptr, *noise_m = nullptr;
  const std::uint8_t* confidence = nullptr;
  const std::uint16_t* flags = nullptr;
  const float *gt_range_m = nullptr, *gt_z_m = nullptr, *gt_reflectivity = nullptr, *gt_position_m = nullptr, *gt_normal = nullptr;
  const std::int32_t* gt_object_id = nullptr;
  const float *gt_irradiance_w_m2 = nullptr, *gt_radiance_w_m2_sr = nullptr, *gt_power_w = nullptr, *gt_signal_e = nullptr;
};

}  // namespace tofray
