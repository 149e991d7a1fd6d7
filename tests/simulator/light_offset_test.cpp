// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
// Range against z, and the light beside the lens.
#include <gtest/gtest.h>

#include "power/received.h"
#include "support/pixels.h"
#include "support/random.h"
#include "support/rays.h"
#include "trace/nearest.h"

using namespace tofray;
using namespace tofray::test;

namespace {

/// Half the path minus the range, as stages 1 and 2 have it [m].
double excess(double z, double beside) {
  const Scene scene = wall(z);
  const Vec3 light{beside, 0, 0};
  scene::FrozenScene frozen(scene, {light}, 1);
  const Ray view = ray({0, 0, 1});
  const auto hit = trace::nearest(everything(frozen.view().camera_still()), view, flow::no_hit<float>());
  const auto surface = trace::surface(frozen.view(), view, hit);
  camera::LightView lamp{};
  lamp.position[0] = static_cast<float>(beside);
  camera::PowerView power{};
  flow::Radiometry<float> sum{};
  const float path = power::received(power, lamp, surface, view, power::light_ray(lamp, surface), false, 1.0f, sum).length;
  return 0.5 * (static_cast<double>(path) - 2 * static_cast<double>(surface.range));
}

}  // namespace

// The path is a float of at most 16 m: half a unit of it, halved again, and that of the distance.
TEST(light_offset, makes_the_path_longer_as_the_closed_form_says) {
  const double table[][2] = {{0.1, 0.594765e-3}, {0.5, 0.119632e-3}, {1, 0.059827e-3}, {5, 0.011966e-3}};
  for (const auto& [z, expected] : table) {
    const double b = 15.47e-3, closed = 0.5 * (std::sqrt(z * z + b * b) - z);
    EXPECT_NEAR(closed, expected, 1e-9);
    EXPECT_NEAR(excess(z, b), closed, 2 * z * 0x1p-23) << z;
  }
}

// The whole way: phase from the path with the light beside the lens, decoded by the exact inverse. Without either, the range is off by
// up to 0.6 mm at 0.1 m; what is left is single precision in phase and range (some 1e-6 of half a wave, 2.5 m).
TEST(light_offset, is_taken_out_again_by_the_decoder) {
  Camera camera = lit_camera(9, 9, 8);
  camera.illumination[0].position = {15.47e-3, 0, 0};
  camera.adc.step_e_per_dn = 1e4;  // nothing clips, as near as that
  for (const double z : {0.1, 0.2, 0.5, 1.0, 2.0}) {
    const Frame frame = expected_frame(wall(z), camera);
    for (std::size_t i = 0; i < 81; ++i) {
      if (frame.truth.signal_e[i] <= 0) continue;  // beyond the cone of light
      EXPECT_NEAR(static_cast<double>(frame.depth.range_m[i]), static_cast<double>(frame.truth.range_m[i]), 2e-5) << z << " " << i;
    }
  }
}

TEST(range, is_z_over_the_cosine_and_a_wall_has_one_z) {
  Camera camera = lit_camera(31, 23, 20);
  const Truth t = truth(wall(2.5), camera);
  for (std::size_t i = 0; i < t.range_m.size(); ++i) {
    const double x = (static_cast<double>(i % 31) - 15) / 20, y = (std::floor(static_cast<double>(i) / 31) - 11) / 20;
    EXPECT_NEAR(static_cast<double>(t.z_m[i]), 2.5, 2.5 * 1e-7);
    const double range = 2.5 * std::sqrt(1 + x * x + y * y);
    EXPECT_NEAR(static_cast<double>(t.range_m[i]), range, range * roundings(6));
    EXPECT_NEAR(static_cast<double>(t.position_m[3 * i]), 2.5 * x, 2.5 * roundings(4));
    EXPECT_NEAR(static_cast<double>(t.position_m[3 * i + 1]), 2.5 * y, 2.5 * roundings(4));
  }
}

TEST(range, and_z_of_the_depth_belong_to_the_same_ray) {
  Camera camera = lit_camera(31, 23, 40);
  camera.adc.step_e_per_dn = 1e4;
  const Frame frame = expected_frame(wall(1.2), camera);
  int valid = 0;
  for (std::size_t i = 0; i < frame.depth.range_m.size(); ++i) {
    if (std::isnan(frame.depth.range_m[i])) continue;
    ++valid;
    const double x = (static_cast<double>(i % 31) - 15) / 40, y = (std::floor(static_cast<double>(i) / 31) - 11) / 40;
    const double range = static_cast<double>(frame.depth.range_m[i]);
    EXPECT_NEAR(static_cast<double>(frame.depth.z_m[i]), range / std::sqrt(1 + x * x + y * y), range * roundings(4));
  }
  EXPECT_GT(valid, 600);
}
