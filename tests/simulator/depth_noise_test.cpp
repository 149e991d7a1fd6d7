// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
// Depth noise of the pico flexx over 200 frames of a card against the closed form, which is worked out here in double from the
// profile's numbers alone: light table, lens, pixel, harmonics, ADC step, weights of the two modulation frequencies.
#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <vector>

#include "support/statistics.h"
#include "tofray/tofray.h"

using namespace tofray;
using namespace tofray::test;

namespace {

constexpr double degree = pi / 180;

/// Undistorted (x, y) of a pixel: Newton's method on r(1 + k1·r²) = r_d.
std::pair<double, double> direction(int u, int v) {
  const double xd = (u - 111.5) / 212, yd = (v - 85.5) / 212, rd = std::hypot(xd, yd);
  double r = rd;
  for (int i = 0; i < 50; ++i) r -= (r - 0.30 * r * r * r - rd) / (1 - 0.90 * r * r);
  return {xd * r / rd, yd * r / rd};
}

/// Electrons of both taps in 2 ms from a card of reflectivity ρ that stands at z, facing the camera.
double signal(double x, double y, double z, double reflectivity) {
  const double lx = x * z - 0.01547, ly = y * z, distance = std::sqrt(lx * lx + ly * ly + z * z);
  const double theta = std::atan2(std::hypot(lx, ly), z), psi = std::atan2(ly, lx);
  const double ax = theta * std::cos(psi) / (31 * degree), ay = theta * std::sin(psi) / (22.5 * degree);
  const double intensity = 0.2 / 0.805095 * std::exp(-std::log(2.0) * (std::pow(ax, 8) + std::pow(ay, 8)));
  const double radiance = reflectivity / pi * intensity * (z / distance) / (distance * distance);
  const double cos_alpha = 1 / std::sqrt(x * x + y * y + 1);
  const double power = pi * 0.85 * radiance * std::pow(cos_alpha, 4) / (4 * 1.6 * 1.6) * 12e-6 * 12e-6 * 0.8;
  return power * 2e-3 * 850e-9 * 0.40 / 1.98644586e-25;
}

/// Phase noise of one modulation frequency for S electrons and the path ℓ: √(V/2)/(Â·|dφ̂/dφ|).
double phase_deviation(double electrons, double path, double f) {
  const double variance = electrons + 2 * 1000 * 2e-3 + 2 * 50.0 * 50.0 + 20.0 * 20.0 / 12;  // no ambient light
  const auto sinc = [](double v) { return std::sin(pi * v) / (pi * v); };
  const double phi = two_pi * f * path / c;
  std::complex<double> z{0, 0}, slope{0, 0};
  for (const int m : {1, 3, 5, 7}) {
    const double a =
        4 / (pi * m) * std::sin(m * pi / 2) * sinc(0.25 * m) * sinc(m * f * 1e-9) * 0.75 / std::sqrt(1 + std::pow(m * f / 180e6, 2));
    const double turn = (m % 4 == 1 ? 1 : -1) * (m * phi - std::atan(m * f / 180e6)), rate = m % 4 == 1 ? m : -m;
    z += a * std::polar(1.0, turn);
    slope += rate * a * std::polar(1.0, turn);
  }
  return std::sqrt(variance / 2) / (electrons * std::abs(z) * std::abs((slope / z).real()));
}

/// Of the range: both modulation frequencies weighed by 1/σ², and how the range follows half the path (the light stands aside).
double range_deviation(double x, double y, double z, double reflectivity) {
  const double range = z * std::sqrt(x * x + y * y + 1), light = std::sqrt(std::pow(x * z - 0.01547, 2) + y * y * z * z + z * z);
  const double path = range + light, s = signal(x, y, z, reflectivity);
  double weights = 0;
  for (const double f : {80.32e6, 60.24e6}) weights += std::pow(4 * pi * f / (c * phase_deviation(s, path, f)), 2);
  const double along = x * z / range * 0.01547;  // u·L
  const auto range_of = [&](double l) { return (l * l - 0.01547 * 0.01547) / (2 * (l - along)); };
  const double per_half_path = (range_of(path + 2e-4) - range_of(path - 2e-4)) / 2e-4;
  return per_half_path / std::sqrt(weights);
}

struct Card {
  double reflectivity, z;
};

class DepthNoise : public testing::TestWithParam<Card> {};

}  // namespace

// 24 × 24 pixels about the centre, 200 frames, each pixel against its own expectation: 115 200 values, whose deviation is known to 0.2 %.
TEST_P(DepthNoise, is_that_of_the_closed_form) {
  const Card card = GetParam();
  Scene scene = load_scene("card");
  std::get<Plane>(scene.objects[0].shape).point = {0, 0, card.z};
  scene.materials[static_cast<std::size_t>(scene.objects[0].material)].diffuse = card.reflectivity;
  Camera camera = load_camera(scene);
  // Flags would sort out the widest noise, and the deviation of what is left would be less.
  camera.decoding.flying_near_limit_m = camera.decoding.flying_far_limit_m = 10, camera.decoding.noise_threshold_m = 10;
  Simulator simulator(scene, camera, {.seed = 4, .truth = false});
  Frame frame;
  constexpr int frames = 200, side = 24, left = 112 - side / 2, top = 86 - side / 2;
  std::vector<Moments> range(side * side, Moments(card.z));
  std::vector<double> said(side * side);
  for (std::uint64_t n = 0; n < frames; ++n) {
    simulator.frame(n, frame);
    for (int i = 0; i < side * side; ++i) {
      const std::size_t at = static_cast<std::size_t>((top + i / side) * 224 + left + i % side);
      ASSERT_EQ(frame.depth.flags[at] & flags_invalid, 0) << "pixel " << i << " of frame " << n;
      range[static_cast<std::size_t>(i)].add(static_cast<double>(frame.depth.range_m[at]));
      said[static_cast<std::size_t>(i)] += static_cast<double>(frame.depth.noise_m[at]) / frames;
    }
  }
  double ratio = 0, bias = 0, estimate = 0;
  for (int i = 0; i < side * side; ++i) {
    const auto [x, y] = direction(left + i % side, top + i / side);
    const double expected = range_deviation(x, y, card.z, card.reflectivity);
    const Moments& got = range[static_cast<std::size_t>(i)];
    ratio += got.variance() / (expected * expected) / (side * side);
    bias += (got.mean() - card.z * std::sqrt(x * x + y * y + 1)) / expected / (side * side);
    estimate += said[static_cast<std::size_t>(i)] / expected / (side * side);
  }
  EXPECT_NEAR(std::sqrt(ratio), 1, 0.03);
  // The camera's own estimate knows S from amplitudes that wiggle, and takes the grey frame's noise for ambient light where it is positive:
  // the mean of max(0, n) is σ/√(2π), ten times that in the ten times longer lit raw frames.
  const auto [x, y] = direction(112, 86);
  const double variance = signal(x, y, card.z, card.reflectivity) + 2 * 50.0 * 50.0 + 20.0 * 20.0 / 12;
  const double taken_for_light = 10 * std::sqrt((2 * 50.0 * 50.0 + 20.0 * 20.0 / 12) / two_pi);
  EXPECT_NEAR(estimate, 1 + 0.5 * taken_for_light / variance, 0.015);
  // The mean range is off by 0.3 % of σ for want of more frames (1 sigma), and by some σ_φ/2 of it because the wiggling curve is bent.
  EXPECT_LT(std::abs(bias), 0.06);
}

INSTANTIATE_TEST_SUITE_P(cards, DepthNoise,
                         testing::Values(Card{0.8, 0.5}, Card{0.8, 1}, Card{0.8, 2}, Card{0.8, 3}, Card{0.18, 0.5}, Card{0.18, 1}),
                         [](const auto& which) {
                           return std::to_string(std::lround(100 * which.param.reflectivity)) + "_percent_at_" +
                                  std::to_string(std::lround(1000 * which.param.z)) + "_mm";
                         });
