// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "tofray/camera.h"

namespace tofray::test {

/// Every effect of lens, pixel and decoding that is off unless asked for.
inline void turn_on_every_effect(Camera& camera) {
  Pixel& pixel = camera.pixel;
  pixel.prnu = 0.01, pixel.dsnu_dn = 1, pixel.delay_s = 1e-11, pixel.phase_offset_rad = 0.03;
  pixel.column_noise_e = 15, pixel.row_noise_e = 10;
  pixel.tap_gain_mismatch = 0.02, pixel.tap_offset_mismatch_e = 60;
  pixel.dark_current_doubling_k = 8;
  pixel.nonlinearity = {{0, 2e4, 1e5}, {0, 1.9e4, 8e4}};
  pixel.suppression_threshold_e = 2000, pixel.suppression_budget_e = 20000;
  camera.lens.k4 = 0.05, camera.lens.k5 = -0.01, camera.lens.k6 = 0.002;
  camera.decoding.amplitude_threshold_e = 5, camera.decoding.asymmetry_reject = camera.decoding.multipath_reject = true;
  pixel.reset_noise_e = 25, pixel.blooming_share = 0.1, pixel.blooming_limit_e = 50;
  camera.adc.gains = {1, 1.25}, camera.mode.gain = 1.25;
  camera.spread_spectrum = {0.01, SpreadSpectrum::Kind::down};
  camera.interference = {0.1, 40, 0.8, {}};
  camera.temperature.drift_m_per_kelvin = 1e-4, camera.temperature.celsius = 41;
}

}  // namespace tofray::test
