// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
// Lights that are rings of LEDs.                                                                           [theory: led-ring]
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "base/vec.h"
#include "camera/light/emitters.h"
#include "support/pixels.h"
#include "support/same_frame.h"
#include "tofray/tofray.h"

using namespace tofray;
using namespace tofray::test;

namespace {

Camera ringed(int leds, double radius) {
  Camera camera = load_camera("pico-flexx");
  camera.illumination[0].position = {0.01, -0.02, 0.003};
  camera.illumination[0].ring_leds = leds, camera.illumination[0].ring_radius_m = radius;
  return camera;
}

}  // namespace

TEST(ring, of_one_led_is_a_light_aside_toward_x) {
  Camera aside = ringed(1, 0);
  aside.illumination[0].position[0] += 0.05;
  EXPECT_EQ(first_difference(Simulator(load_scene("demo"), ringed(1, 0.05)).frame(2), Simulator(load_scene("demo"), aside).frame(2)), "");
}

// Four LEDs stand right, below, left and above of the middle, a quarter of the power each, with shadows of their own.
TEST(ring, is_its_leds) {
  Camera each = ringed(1, 0);
  const Illumination one = each.illumination[0];
  each.illumination.clear();
  for (const auto& [x, y] : {std::pair{0.03, 0.0}, std::pair{0.0, 0.03}, std::pair{-0.03, 0.0}, std::pair{0.0, -0.03}}) {
    Illumination led = one;
    led.position[0] += x, led.position[1] += y;
    led.power_w /= 4;
    each.illumination.push_back(led);
  }
  const SimulatorOptions quiet{.noise = Noise::off};
  for (const char* scene : {"demo", "flying-ball"}) {
    const Frame a = Simulator(load_scene(scene), ringed(4, 0.03), quiet).frame(1), b = Simulator(load_scene(scene), each, quiet).frame(1);
    double most = 0;
    for (std::size_t i = 0; i < a.raw.tap_a.size(); ++i) {
      const double one_tap = static_cast<double>(a.raw.tap_a[i]), other = static_cast<double>(b.raw.tap_a[i]);
      most = std::max(most, std::abs(one_tap - other) / (1 + other));
    }
    EXPECT_LT(most, 1e-5) << scene;  // the turns of the circle are rounded
  }
}

// On the axis of a ring around the lens all paths are √(z² + ρ²) + z long: the light adds up as if it came from one LED, and depth is exact.
TEST(ring, around_the_lens_is_even_on_the_axis) {
  const double radius = 0.04, z = 0.5;
  const auto frame_of = [&](int leds) {
    Camera camera = lit_camera(9, 9);
    camera.adc.step_e_per_dn = 1e4;  // nothing clips
    camera.illumination[0].ring_leds = leds, camera.illumination[0].ring_radius_m = radius;
    return Simulator(wall(z), camera, {.noise = Noise::off}).frame(0);
  };
  const Frame one = frame_of(1), eight = frame_of(8);
  EXPECT_NEAR(static_cast<double>(eight.truth.power_w[40] / one.truth.power_w[40]), 1, 1e-6);
  EXPECT_NEAR(static_cast<double>(eight.depth.amplitude_e[40] / one.depth.amplitude_e[40]), 1, 1e-5);
  EXPECT_NEAR(static_cast<double>(eight.depth.z_m[40]), z, 2e-6 * z + 2e-6);
  EXPECT_NEAR(static_cast<double>(frame_of(3).depth.z_m[40]), z, 2e-6 * z + 2e-6);
}

// Across any axis, also one along x: the middle of the LEDs is the light's place, and all are as far from it.
TEST(ring, stands_across_its_axis) {
  for (const Vec3 axis : {Vec3{0, 0, 1}, Vec3{1, 0, 0}, Vec3{-3, 1, 2}, Vec3{0, -1, 0.2}}) {
    Camera camera = ringed(5, 0.1);
    camera.illumination[0].axis = axis;
    const Camera opened = camera::with_emitters(camera);
    ASSERT_EQ(opened.illumination.size(), 5u);
    Vec3 sum{0, 0, 0};
    double power = 0;
    for (const Illumination& led : opened.illumination) {
      const Vec3 from = led.position - camera.illumination[0].position;
      EXPECT_NEAR(base::dot(from, axis), 0, 1e-15);
      EXPECT_NEAR(base::length(from), 0.1, 1e-15);
      sum = sum + from, power += led.power_w;
    }
    EXPECT_NEAR(base::length(sum), 0, 1e-15);
    EXPECT_NEAR(power, camera.illumination[0].power_w, 1e-15);
  }
}

TEST(ring, of_more_leds_than_there_may_be_lights_is_refused) {
  Camera camera = ringed(33, 0.1);
  camera.illumination.push_back(camera.illumination[0]);
  try {
    (void)Simulator({}, camera);
    FAIL();
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::limit);
    EXPECT_STREQ(error.what(),
                 "error: illumination[0].ring_leds: the camera has too many light sources\n  got 66, at most 64 (`tofray --limits`); each "
                 "LED of a ring and each point of an area is a source; take fewer points or LEDs");
  }
}
