// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
// Pixels that no ray through the lens model leads to see nothing: not what lies on the axis.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "support/pixels.h"

using namespace tofray;
using namespace tofray::test;

namespace {

/// A barrel whose corners have no inverse, in a short mode with one unlit raw frame; no dark current.
Camera barrel() {
  Camera camera = load_camera("pico-flexx", {.mode = "MODE_5_35FPS_600"});
  camera.lens.k1 = -0.37;
  camera.pixel.dark_current_e_per_s = 0;
  return camera;
}

Scene bright_wall() {
  Scene scene = wall(1, 0.8);
  scene.ambient = {Ambient::Spectrum::sun_am15, Ambient::Quantity::level, 0.2, {}, {}, {}};
  return scene;
}

void expect_nothing_outside(const Frame& frame) {
  const Truth& t = frame.truth;
  const std::size_t pixels = t.z_m.size();
  const auto is_nan = [](const std::vector<float>& array, std::size_t i, std::size_t of = 1) {
    return std::all_of(array.begin() + static_cast<std::ptrdiff_t>(of * i), array.begin() + static_cast<std::ptrdiff_t>(of * (i + 1)),
                       [](float a) { return std::isnan(a); });
  };
  int outside = 0;
  for (std::size_t i = 0; i < pixels; ++i) {
    if ((frame.depth.flags[i] & flag_outside_lens) == 0) continue;
    ++outside;
    ASSERT_TRUE(is_nan(t.range_m, i) && is_nan(t.z_m, i) && is_nan(t.reflectivity, i)) << i;
    ASSERT_TRUE(is_nan(t.position_m, i, 3) && is_nan(t.normal, i, 3)) << i;
    ASSERT_EQ(t.object_id[i], -1) << i;
    ASSERT_TRUE(t.irradiance_w_m2[i] == 0 && t.radiance_w_m2_sr[i] == 0 && t.power_w[i] == 0) << i;
    ASSERT_TRUE(is_nan(frame.depth.z_m, i) && is_nan(frame.depth.range_m, i) && is_nan(frame.depth.points_m, i, 3)) << i;
    for (std::size_t k = 0; k < static_cast<std::size_t>(t.phases); ++k) {
      ASSERT_EQ(t.signal_e[k * pixels + i], 0) << i;
      ASSERT_TRUE(frame.raw.tap_a[k * pixels + i] == 0 && frame.raw.tap_b[k * pixels + i] == 0) << i;
    }
  }
  EXPECT_GT(outside, 10);
  EXPECT_GT(t.irradiance_w_m2[pixels / 2 + 112], 0);
}

}  // namespace

TEST(outside_the_lens_model, nothing_is_seen_of_a_scene) {
  expect_nothing_outside(Simulator(bright_wall(), barrel(), {.noise = Noise::off}).frame(0));
}

TEST(outside_the_lens_model, nothing_is_seen_of_what_moves) {
  Scene scene = bright_wall();
  scene.objects[0].velocity_m_per_s = {0, 0, 1};
  expect_nothing_outside(Simulator(scene, barrel(), {.noise = Noise::off}).frame(0));
}

TEST(outside_the_lens_model, nothing_is_seen_of_what_another_renderer_saw) {
  const Camera camera = barrel();
  const std::size_t pixels = 224 * 172;
  Geometry seen;
  seen.width = 224, seen.height = 172;
  seen.z_m.assign(pixels, 1.0f), seen.diffuse.assign(pixels, 0.8f);
  for (std::size_t i = 0; i < pixels; ++i) seen.normal.insert(seen.normal.end(), {0, 0, -1});
  expect_nothing_outside(Simulator(bright_wall(), camera, {.noise = Noise::off}).frame(0, seen));
}
