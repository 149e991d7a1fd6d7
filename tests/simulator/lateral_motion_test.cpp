// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
// An edge that sweeps a pixel while its raw frames are exposed: S16.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "support/pixels.h"
#include "tofray/simulator.h"

using namespace tofray;
using namespace tofray::test;

namespace {

constexpr double focal_px = 1e5, pixel_m = 1 / focal_px;  // of what is 1 m away
constexpr int samples = 10;

/// A−B of each raw frame [e⁻].
std::array<double, 4> differences(const Scene& scene) {
  Camera camera = plain_camera(1, 1, focal_px);
  camera.illumination.push_back(one_watt_per_steradian());
  const Frame frame = Simulator(scene, camera, {.noise = Noise::off, .subpixel = samples}).frame(0);
  std::array<double, 4> out{};
  for (std::size_t k = 0; k < 4; ++k) out[k] = static_cast<double>(frame.raw.tap_a[k]) - static_cast<double>(frame.raw.tap_b[k]);
  return out;
}

/// A wall at 1.6 m, and before it at 1 m what covers a share of the pixel at first, and more or less of it later.
Scene sweep(double share, double pixels_per_s) {
  Scene scene = wall(1.6);
  scene.objects.push_back(object(Rectangle{{(share - 0.5) * pixel_m - 0.5, 0, 1.0}, {1, 1}}));
  scene.objects.back().velocity_m_per_s = {pixels_per_s * pixel_m, 0, 0};
  return scene;
}

}  // namespace

TEST(lateral_motion, mixes_each_raw_frame_by_its_own_share) {
  const std::array<double, 4> near = differences(wall(1.0)), far = differences(wall(1.6));
  const double largest =
      std::abs(*std::max_element(near.begin(), near.end(), [](double a, double b) { return std::abs(a) < std::abs(b); }));
  const Frame times = Simulator(wall(1), lit_camera()).frame(0);
  for (const auto& [share, speed] : {std::pair{0.1, 200.0}, {0.9, -200.0}, {0.48, 60.0}, {-0.2, 350.0}}) {
    const std::array<double, 4> got = differences(sweep(share, speed));
    double least = 1, most = 0;
    for (std::size_t k = 0; k < 4; ++k) {
      const double edge = share + speed * (times.raw.start_time_s[k] + 0.5 * times.raw.integration_time_s[k]);
      int covered = 0;
      for (int i = 0; i < samples; ++i) {
        ASSERT_GT(std::abs((i + 0.5) / samples - edge), 0.01) << "a sample lies on the edge: the test asks for what roundings decide";
        covered += (i + 0.5) / samples < edge;
      }
      const double part = static_cast<double>(covered) / samples;
      EXPECT_NEAR(got[k], part * near[k] + (1 - part) * far[k], 1e-6 * largest) << share << ", raw frame " << k;
      least = std::min(least, part), most = std::max(most, part);
    }
    EXPECT_GT(most - least, 0.1) << "the edge moved on";
  }
}
