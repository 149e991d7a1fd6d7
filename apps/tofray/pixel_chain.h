// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <array>
#include <string>
#include <vector>

#include "arrays.h"

/// One pixel's way from light to depth, put together from a file's arrays and its `meta`. What a file does not have is NaN or empty.
namespace tofray::app {

struct ChainRawFrame {
  bool lit = false;
  double modulation_frequency_hz = 0, reference_phase_rad = 0, integration_time_s = 0;
  double signal_e = 0;                  ///< ground truth S, both taps
  double direct_e = 0, indirect_e = 0;  ///< by one surface and by several, before the lens scatters them
  double multipath_m = 0;               ///< what that does to the half path                    [theory: eq. 7.8]
  double path_noise_m = 0;              ///< the standard error of that                         [theory: eq. 7.13]
  double tap_a_e = 0, tap_b_e = 0;
  double code_dn = 0;
  double difference_e = 0;  ///< D_k that depth comes from: out of the code, or unrounded where noise is off
};

struct ChainPhase {
  double modulation_frequency_hz = 0;
  double amplitude_e = 0;       ///< |Z|                                                  [theory: eq. 4.2]
  double measured_turns = 0;    ///< arg Z / 2 pi, with the wiggling in it
  double calibrated_turns = 0;  ///< with the wiggling and the pixel's delay taken out    [eq. 4.3]
  double half_wave_m = 0;       ///< R, the unambiguous half path                         [eq. 4.4]
  double cycles = 0;            ///< whole cycles that unwrapping added
  double half_path_m = 0;       ///< R (cycles + turns)
};

struct PixelChain {
  int u = 0, v = 0;
  // ground truth
  long object = -1;
  std::string object_name;  ///< its name, or its shape
  double true_range_m = 0, true_z_m = 0, reflectivity = 0, incidence_rad = 0;
  double object_share = 0, mixed = 0;  ///< of samples within the pixel
  std::array<double, 3> position_m{}, normal{};
  double irradiance_w_m2 = 0, radiance_w_m2_sr = 0, power_w = 0;
  // measured
  std::vector<ChainRawFrame> raw_frames;
  std::vector<ChainPhase> phases;  ///< one for each modulation frequency
  double range_m = 0, z_m = 0, noise_m = 0, noise_threshold_m = 0, amplitude_e = 0, ambient_e = 0, confidence = 0;
  std::array<double, 3> point_m{};
  std::vector<std::string> flags;
};

/// @throws Error (bad_input) where the pixel is outside the image
void refuse_outside(const Arrays& arrays, int u, int v);

/// @throws Error (bad_input) where the pixel is outside the image
PixelChain pixel_chain(const Arrays& arrays, int u, int v);

}  // namespace tofray::app
