// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
// The amplifier before the ADC: a mode's gain, s = step/gain.                                                   [theory: gain-steps]
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "support/bench.h"
#include "support/pixels.h"

using namespace tofray;
using namespace tofray::test;

namespace {

Camera amplified(double gain) {
  Camera camera = bench_camera();
  camera.adc = {12, 20, 2048, 0, 4095, {1, 4, 8}};
  camera.mode.gain = gain;
  return camera;
}

constexpr double gained_signal = 9000, gained_half_path = 1.1;
double gained_difference(std::size_t k) {
  return gained_signal * 0.7 * std::cos(two_pi * (2 * gained_half_path * 60.24e6 / c + static_cast<double>(k) / 4));
}

}  // namespace

// Codes are (A−B)·gain/step off the middle, to the nearest; beyond the last code a larger gain clips sooner [theory: adc].
TEST(gain, multiplies_codes_and_leaves_electrons) {
  for (const double gain : {1.0, 4.0, 8.0}) {
    const auto taps = Bench(amplified(gain)).expose({gained_signal, gained_half_path, 0});
    for (std::size_t k = 0; k < 4; ++k) {
      const double level = 2048 + gained_difference(k) * gain / 20;
      EXPECT_NEAR(static_cast<double>(taps[k].code), std::min(std::max(level, 0.0), 4095.0), 0.51) << gain << " " << k;
      const double lowest = -2048 * 20 / gain, highest = 2047 * 20 / gain;
      EXPECT_NEAR(static_cast<double>(taps[k].difference), std::min(std::max(gained_difference(k), lowest), highest), 0.01) << gain;
    }
  }
  bool clipped = false;
  (void)Bench(amplified(8)).expose({gained_signal, gained_half_path, 0}, 0, 0, &clipped);
  EXPECT_TRUE(clipped);  // 6300·|cos| over 2.5 e⁻ is more than 2047 codes
  (void)Bench(amplified(4)).expose({gained_signal, gained_half_path, 0}, 0, 0, &clipped);
  EXPECT_FALSE(clipped);
}

// s²/12 of V̂ [theory: phase-noise] shrinks with the square of the gain: 5 e⁻ of 20 e⁻ beside a signal of 30.
TEST(gain, makes_rounding_finer) {
  const auto said = [](double gain) { return static_cast<double>(Bench(amplified(gain)).measure({30, 1.1, 0}).depth.noise); };
  EXPECT_NEAR(said(4) / said(1), std::sqrt((30 + 25 / 12.0) / (30 + 400 / 12.0)), 1e-4);
}

// Column noise is electrons of A−B, whatever the gain.
TEST(gain, leaves_the_noise_of_columns_what_it_is) {
  Camera camera = amplified(8);
  camera.pixel.column_noise_e = 40;
  EXPECT_FLOAT_EQ(Bench(camera).sensor().column_noise, 16.0f);  // 40 e⁻ of 2.5 e⁻ a code
}

// Codes of a recording become electrons by the mode's gain.
TEST(gain, is_that_of_the_recording_that_is_processed) {
  Camera camera = lit_camera(3, 2);
  camera.adc = {16, 400, 32768, 0, 65535, {2, 4}};
  for (const double gain : {2.0, 4.0}) {
    camera.mode.gain = gain;
    const Frame frame = Simulator(wall(1, 0.3), camera, {.seed = 3, .noise = Noise::exact, .threads = 1}).frame(0);
    Raw recorded = frame.raw;
    recorded.tap_a.clear(), recorded.tap_b.clear();
    EXPECT_EQ(process(recorded, camera).range_m, frame.depth.range_m);
  }
}

TEST(gain, is_one_that_the_adc_has) {
  const auto refused = [](Camera camera) {
    try {
      Simulator(wall(1), camera);
    } catch (const Error& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  Camera camera = lit_camera();
  EXPECT_EQ(refused(camera), "");
  camera.mode.gain = 2;
  EXPECT_NE(refused(camera).find("expected 1, since adc.gains is not given"), std::string::npos) << refused(camera);
  camera.adc.gains = {1, 4};
  EXPECT_NE(refused(camera).find("got 2, expected one of adc.gains: 1, 4"), std::string::npos) << refused(camera);
  camera.mode.gain = 4;
  EXPECT_EQ(refused(camera), "");
  camera.adc.step_e_per_dn = 1e-6;
  EXPECT_NE(refused(camera).find("got 0.00000025 e/DN"), std::string::npos) << refused(camera);
}
