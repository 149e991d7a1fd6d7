// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
// The correlation curve of a pixel, against samples at reference phases that only another camera takes.
#include <gtest/gtest.h>

#include <cmath>

#include "support/pi.h"
#include "support/pixels.h"
#include "tofray/error.h"
#include "tofray/pixel.h"

using namespace tofray;
using namespace tofray::test;

namespace {

/// Takes samples at these phases, of light that is a rectangle of 40 %: with harmonics.
Camera sampling(const std::vector<double>& phases_rad) {
  Camera camera = lit_camera(3, 3, 100);
  camera.illumination[0].power_w = 0.02;
  camera.illumination[0].waveform = {};
  camera.illumination[0].waveform.kind = Waveform::Kind::rectangular;
  camera.illumination[0].waveform.duty = 0.4;
  camera.pixel.contrast = {{60e6}, {0.7}};  // of all of it, four harmonics would overshoot what a tap holds
  camera.mode.sequence.clear();
  for (const double phase : phases_rad) camera.mode.sequence.push_back({true, 60e6, phase, 1e-3});
  return camera;
}

PixelChain chain_seen(const Camera& camera) {
  SimulatorOptions options;
  options.noise = Noise::off, options.backend = Backend::cpu, options.threads = 1;
  return pixel_chain(Simulator(wall(1.3, 0.5), camera, options).frame(0), camera, 1, 1, Noise::off);
}

TEST(correlation_curves, pass_through_the_samples_of_a_camera_that_takes_others) {
  const Camera four = sampling({0, pi / 2, pi, 3 * pi / 2});
  const PixelChain chain = chain_seen(four);
  const std::vector<std::vector<double>> curves = correlation_curves(chain, four, 64);
  ASSERT_EQ(curves.size(), 1u);
  ASSERT_EQ(curves[0].size(), 64u);
  // An eighth of a turn between them: sixteenths are none of the camera's own.
  const PixelChain other = chain_seen(sampling({pi / 8, 5 * pi / 8, 9 * pi / 8, 13 * pi / 8}));
  double most = 0;
  for (const ChainRawFrame& k : chain.raw_frames) most = std::max(most, std::abs(k.difference_e));
  ASSERT_GT(most, 200);
  ASSERT_LT(most, 2000) << "codes clip";
  for (const PixelChain* of : {&chain, &other})
    for (const ChainRawFrame& k : of->raw_frames) {
      const auto point = static_cast<std::size_t>(std::lround(k.reference_phase_rad / (2 * pi) * 64));
      EXPECT_NEAR(curves[0][point], k.difference_e, 1e-4 * most) << k.reference_phase_rad;
    }
}

TEST(correlation_curves, have_the_harmonics_of_the_camera) {
  const Camera camera = sampling({0, pi / 2, pi, 3 * pi / 2});
  const std::vector<double> curve = correlation_curves(chain_seen(camera), camera, 96)[0];
  double first[2] = {}, third[2] = {};
  for (int i = 0; i < 96; ++i) {
    first[0] += curve[static_cast<std::size_t>(i)] * std::cos(2 * pi * i / 96),
        first[1] += curve[static_cast<std::size_t>(i)] * std::sin(2 * pi * i / 96);
    third[0] += curve[static_cast<std::size_t>(i)] * std::cos(6 * pi * i / 96),
        third[1] += curve[static_cast<std::size_t>(i)] * std::sin(6 * pi * i / 96);
  }
  // Of a rectangle of duty d: sin(3 pi d)/9 over sin(pi d) [theory: rectangular-light].
  EXPECT_NEAR(std::hypot(third[0], third[1]) / std::hypot(first[0], first[1]), std::abs(std::sin(1.2 * pi)) / 9 / std::sin(0.4 * pi), 1e-6);
}

TEST(correlation_curves, are_of_the_pixel_s_own_camera) {
  const Camera four = sampling({0, pi / 2, pi, 3 * pi / 2}), three = sampling({0, 2 * pi / 3, 4 * pi / 3});
  EXPECT_THROW(correlation_curves(chain_seen(four), three), Error);
  EXPECT_THROW(correlation_curves(chain_seen(four), four, 0), Error);
}

}  // namespace
