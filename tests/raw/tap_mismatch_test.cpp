// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
// Taps that differ: A·(1 + g/2) + o/2 and B·(1 − g/2) − o/2.                                                        [theory: tap-mismatch]
#include <gtest/gtest.h>

#include <cmath>

#include "support/bench.h"

using namespace tofray;
using namespace tofray::test;

namespace {

Camera unlike(double gain_mismatch, double offset_mismatch_e, int phases = 4) {
  Camera camera = bench_camera({60.24e6}, phases, 0.7, true);
  camera.pixel.tap_gain_mismatch = gain_mismatch, camera.pixel.tap_offset_mismatch_e = offset_mismatch_e;
  camera.pixel.dark_current_e_per_s = 5e4;  // 50 e⁻ a tap
  return camera;
}

constexpr double unlike_signal = 20000, unlike_ambient = 3000, unlike_dark = 50, unlike_contrast = 0.7;

}  // namespace

// 1 e⁻ codes do not matter: without noise the difference is not rounded. Single precision leaves some 1e-7 of the charge.
TEST(tap_mismatch, is_that_of_the_closed_form_in_each_raw_frame) {
  for (const double g : {0.02, -0.3, 1.0, -1.0}) {
    for (const double o : {0.0, 40.0, -25.0}) {
      const auto taps = Bench(unlike(g, o)).expose({unlike_signal, 1.1, unlike_ambient});
      EXPECT_NEAR(static_cast<double>(taps[0].a), (1 + g / 2) * (unlike_ambient + unlike_dark) + o / 2, 0.01);  // the grey one, all on A
      EXPECT_NEAR(static_cast<double>(taps[0].b), (1 - g / 2) * unlike_dark - o / 2, 0.01);
      for (std::size_t k = 0; k < 4; ++k) {
        const double half = 0.5 * unlike_signal * unlike_contrast * std::cos(two_pi * (2.2 * 60.24e6 / c + static_cast<double>(k) / 4));
        const double a = 0.5 * (unlike_signal + unlike_ambient) + half + unlike_dark,
                     b = 0.5 * (unlike_signal + unlike_ambient) - half + unlike_dark;
        EXPECT_NEAR(static_cast<double>(taps[k + 1].a), (1 + g / 2) * a + o / 2, 0.01) << g << " " << o << " " << k;
        EXPECT_NEAR(static_cast<double>(taps[k + 1].b), (1 - g / 2) * b - o / 2, 0.01) << g << " " << o << " " << k;
        EXPECT_NEAR(static_cast<double>(taps[k + 1].difference), a - b + g / 2 * (a + b) + o, 0.01) << g << " " << o << " " << k;
      }
    }
  }
}

// What both taps have too much is the same in all raw frames of a modulation frequency, and Σ e^{−iτ_k} = 0 takes it out of the phase. Opposite
// reference phases no longer cancel, and the flag says so.
TEST(tap_mismatch, is_no_error_of_the_range_but_one_that_the_flag_sees) {
  for (const int phases : {3, 4, 5, 8}) {
    const double plain = static_cast<double>(Bench(unlike(0, 0, phases)).measure({unlike_signal, 1.1, unlike_ambient}).depth.range);
    const auto depth = Bench(unlike(0.2, 100, phases)).measure({unlike_signal, 1.1, unlike_ambient}).depth;
    EXPECT_NEAR(static_cast<double>(depth.range), plain, 2e-6) << phases;
    const bool pairs = phases % 2 == 0;  // D_k + D_k' = g·(S + B + both dark) + 2o = 4820, and 5·√(2V) some 1090
    EXPECT_EQ((depth.flags & depth::inconsistent_phases) != 0, pairs) << phases;
  }
  EXPECT_EQ(Bench(unlike(0, 0)).measure({unlike_signal, 1.1, unlike_ambient}).depth.flags, 0);
}

TEST(tap_mismatch, of_zero_is_none) {
  EXPECT_EQ(Pixel().tap_gain_mismatch, 0);
  EXPECT_EQ(Pixel().tap_offset_mismatch_e, 0);
  EXPECT_EQ(Bench(unlike(0, 0)).sensor().taps_differ, 0);
}
