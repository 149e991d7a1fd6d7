// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "base/constants.h"

/// What numbers of scenes and cameras may be, once: the files' tables and the library's own checks both read it. SI units, ends included.
/// They are wide: beyond them lies no camera, or what single precision cannot carry.
namespace tofray::base {

struct Range {
  double low, high;
  [[nodiscard]] constexpr bool contains(double value) const { return value >= low && value <= high; }  // NaN: no
};

namespace range {
inline constexpr double shortest_m = 1e-6;  ///< of a direction, a radius or a thickness: below, float could not tell it from zero

// scene
inline constexpr Range coordinate_m{-1e5, 1e5};  // float carries 8 mm at that distance
inline constexpr Range radius_m{shortest_m, 1e5};
inline constexpr Range component{-1e6, 1e6};  // of a direction
inline constexpr Range share{0, 1};
inline constexpr Range phong_exponent{1, 1e4};
inline constexpr Range rotation_rad{-100, 100};
inline constexpr Range velocity_m_per_s{-1e4, 1e4};
inline constexpr Range ambient_level{0, 100};
inline constexpr Range illuminance_lx{0, 1e7};
inline constexpr Range band_irradiance_w_per_m2{0, 1e5};
inline constexpr Range spectral_irradiance_w_per_m3{0, 1e13};

// sensor and lens
inline constexpr Range pixel_pitch_m{0.5e-6, 1e-3};
inline constexpr Range fill_factor{1e-3, 1};
inline constexpr Range focal_length_px{1, 1e6};
inline constexpr Range principal_point_px{-1e5, 1e5};
inline constexpr Range distortion{-10, 10};
inline constexpr Range f_number{0.3, 100};
inline constexpr Range vignetting_angle_rad{0, pi / 2};
inline constexpr Range vignetting_factor{0, 2};
inline constexpr Range wavelength_m{100e-9, 20e-6};
inline constexpr Range filter_half_width_m{0.1e-9, 10e-6};

// light
inline constexpr Range light_position_m{-100, 100};
inline constexpr Range illumination_wavelength_m{300e-9, 2e-6};
inline constexpr Range power_w{0, 1e4};
inline constexpr Range half_angle_rad{1e-3, pi};
inline constexpr Range width_rad{1e-3, 2 * pi};
inline constexpr Range lobe_exponent{0, 1e4};
inline constexpr Range pattern_cells{2, 4096};  // along one side: between two of them it is interpolated
inline constexpr Range pattern_sample{0, 1e12};
inline constexpr Range duty{1e-3, 0.999};
inline constexpr Range rise_time_s{0, 1e-3};
inline constexpr Range bandwidth_hz{0, 1e12};
inline constexpr Range jitter_s{0, 1e-6};
inline constexpr Range harmonics{1, 8};
inline constexpr Range correlation{-10, 10};
inline constexpr Range modulation_depth{1e-3, 1};

// pixel and ADC
inline constexpr Range charge_e{0, 1e12};
inline constexpr Range full_well_e{1, 1e30};
inline constexpr Range read_noise_e{0, 1e6};
inline constexpr Range dark_current_e_per_s{0, 1e12};
inline constexpr Range dsnu_dn{0, 1e4};
inline constexpr Range delay_s{0, 1e-6};
inline constexpr Range noise_factor{0, 100};
inline constexpr Range adc_bits{1, 16};
inline constexpr Range adc_step_e_per_dn{1e-6, 1e9};
inline constexpr Range code_dn{0, 65535};

// decoding, temperature, timing
inline constexpr Range flying_limit_m{0, 1e3};
inline constexpr Range flying_z_m{0, 1e4};
inline constexpr Range gaussian_sigma_px{0.1, 10};
inline constexpr Range median_radius_px{1, 4};
inline constexpr Range low_signal_noise_m{1e-6, 1e3};
inline constexpr Range inconsistent_range_m{0, 1e4};
inline constexpr Range celsius{-100, 200};
inline constexpr Range drift_m_per_kelvin{-1, 1};
inline constexpr Range warm_up_m{-1, 1};
inline constexpr Range warm_up_time_s{1e-3, 1e6};
inline constexpr Range since_start_s{0, 1e12};
inline constexpr Range modulation_frequency_hz{1e3, 1e10};
inline constexpr Range reference_phase_rad{-100, 100};
inline constexpr Range integration_time_s{1e-9, 1e3};
inline constexpr Range frame_rate_hz{1e-4, 1e5};
inline constexpr Range pause_s{0, 10};
inline constexpr Range refractive_index{1, 3};

// arrays that come from elsewhere
inline constexpr Range pixel_power_w{0, 1};
inline constexpr Range path_length_m{0, 1e6};
inline constexpr Range pixel_ambient_e_per_s{0, 1e20};
inline constexpr Range unit_length{0.999, 1.001};
}  // namespace range

}  // namespace tofray::base
