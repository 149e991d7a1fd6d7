// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
// Noise that the reset of a tap leaves in it, and what correlated double sampling makes of it.                 [theory: reset-noise]
#include <gtest/gtest.h>

#include <cmath>

#include "support/bench.h"
#include "support/statistics.h"

using namespace tofray;
using namespace tofray::test;

namespace {

Camera with_reset(double read_e, double reset_e, bool cancelled, double celsius = 25) {
  Camera camera = bench_camera();
  camera.pixel.read_noise_e = read_e, camera.pixel.reset_noise_e = reset_e, camera.pixel.cancels_reset_noise = cancelled;
  camera.temperature.celsius = celsius;
  return camera;
}

/// Variance of a dark tap over so many frames of four raw frames, both taps.
constexpr int reset_frames = 10000;
double dark_variance(const Camera& camera) {
  const Bench bench(camera, true, 5);
  Moments all;
  for (std::uint64_t frame = 0; frame < reset_frames; ++frame)
    for (const auto& taps : bench.expose({}, 0, frame)) all.add(static_cast<double>(taps.a)), all.add(static_cast<double>(taps.b));
  return all.variance();
}

}  // namespace

// σ² = σ_r² + σ_0²·T/T_0, or 2σ_r² where reset noise is cancelled [theory: reset-noise]. 80000 squares of a normal draw scatter by
// √(2/80000): 5 of them.
// From 4 electrons on noise is one draw, below a draw of its own.
TEST(reset_noise, adds_its_variance_to_that_of_reading) {
  struct Case {
    double read_e, reset_e;
    bool cancelled;
    double celsius, expected;
  };
  const double warmer = (85 + 273.15) / (25 + 273.15);
  for (const Case& at : {Case{20, 30, false, 25, 1300}, Case{20, 30, false, 85, 400 + 900 * warmer}, Case{20, 30, true, 25, 800},
                         Case{20, 0, true, 85, 800}, Case{20, 0, false, 85, 400}, Case{0, 30, true, 25, 0}, Case{0, 30, false, 25, 900},
                         Case{1, 2, false, 25, 5}, Case{2, 9, true, 25, 8}}) {
    const double seen = dark_variance(with_reset(at.read_e, at.reset_e, at.cancelled, at.celsius));
    EXPECT_NEAR(seen, at.expected, 5 * std::sqrt(2.0 / (8 * reset_frames)) * at.expected)
        << at.read_e << " " << at.reset_e << " " << at.celsius;
  }
}

// V̂ knows it [theory: noise-estimate]: σ̂² of the same light goes with S + 2σ² + s²/12.
TEST(reset_noise, is_in_the_noise_that_depth_says_of_itself) {
  const auto said = [](const Camera& camera) { return static_cast<double>(Bench(camera).measure({20000, 1.3, 0}).depth.noise); };
  const double plain = said(with_reset(20, 0, false)), of_light = 20000 + 1 / 12.0;
  EXPECT_NEAR(said(with_reset(20, 90, false)) / plain, std::sqrt((of_light + 2 * (400 + 8100)) / (of_light + 800)), 1e-5);
  EXPECT_NEAR(said(with_reset(20, 90, true)) / plain, std::sqrt((of_light + 1600) / (of_light + 800)), 1e-5);
}

TEST(reset_noise, is_none_unless_given) {
  EXPECT_EQ(Pixel().reset_noise_e, 0);
  EXPECT_FALSE(Pixel().cancels_reset_noise);
  EXPECT_EQ(Bench(with_reset(20, 0, false, 85)).sensor().read_noise, 20.0f);
}
