// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
// Nothing to see, no light source, no lit raw frame: frames of full size in which every depth is invalid.
#include <gtest/gtest.h>

#include <cmath>

#include "backend/cpu/cpu.h"
#include "support/pixels.h"

using namespace tofray;
using namespace tofray::test;

namespace {

constexpr Noise every_noise[] = {Noise::off, Noise::exact};

/// 33 × 9 pixels, a grey raw frame of 1 ms and one of 3 ms before the lit ones, noisy and offset.
Camera grey_camera() {
  Camera camera = lit_camera(33, 9, 40);
  camera.mode.sequence.insert(camera.mode.sequence.begin(), {{false, 0, 0, 1e-3}, {false, 0, 0, 3e-3}});
  camera.pixel.read_noise_e = 30, camera.pixel.dark_current_e_per_s = 1e4, camera.pixel.full_well_e = 1e7, camera.adc.step_e_per_dn = 100;
  return camera;
}

void expect_all_invalid(const Depth& depth) {
  ASSERT_EQ(depth.flags.size(), 33u * 9u);
  for (std::size_t i = 0; i < depth.flags.size(); ++i) {
    ASSERT_TRUE((depth.flags[i] & flag_no_return) != 0) << i;
    ASSERT_TRUE(std::isnan(depth.z_m[i]) && std::isnan(depth.range_m[i]) && std::isnan(depth.points_m[3 * i]) &&
                std::isnan(depth.noise_m[i]))
        << i;
    ASSERT_EQ(depth.confidence[i], 0) << i;
    ASSERT_TRUE(std::isfinite(depth.amplitude_e[i]) && std::isfinite(depth.ambient_e[i])) << i;
  }
}

/// All noises, all instruction sets: the same bytes, and nothing valid in them.
void expect_all_invalid(const Scene& scene, const Camera& camera) {
  for (const Noise noise : every_noise) {
    const Frame reference = Simulator(scene, camera, {.noise = noise, .threads = 1, .isa = Isa::scalar}).frame(2);
    expect_all_invalid(reference.depth);
    expect_all_invalid(process(reference.raw, camera, {.noise = noise, .threads = 1}));
    for (const Isa isa : backend::isas_here) {
      if (!backend::can_run(isa)) continue;
      const Frame frame = Simulator(scene, camera, {.noise = noise, .threads = 2, .isa = isa}).frame(2);
      expect_all_invalid(frame.depth);
      EXPECT_EQ(frame.raw.raw, reference.raw.raw);
      EXPECT_EQ(frame.depth.amplitude_e, reference.depth.amplitude_e);
      EXPECT_EQ(frame.depth.ambient_e, reference.depth.ambient_e);
      EXPECT_EQ(frame.depth.flags, reference.depth.flags);
    }
  }
}

Camera without_lights(Camera camera) {
  camera.illumination.clear();
  return camera;
}
Camera without_lit_raw_frames(Camera camera) {
  camera.mode.sequence.resize(2);
  return camera;
}

}  // namespace

TEST(no_light_source, makes_every_depth_invalid) {
  expect_all_invalid(sunny_wall(), without_lights(grey_camera()));
  expect_all_invalid(Scene(), without_lights(grey_camera()));
}

TEST(no_light_source, leaves_ambient_light) {
  const Frame dark = expected_frame(sunny_wall(), without_lights(grey_camera())), lit = expected_frame(sunny_wall(), grey_camera());
  EXPECT_EQ(dark.depth.ambient_e, lit.depth.ambient_e);
  EXPECT_GT(dark.depth.ambient_e[0], 1000);
  for (const float power : dark.truth.power_w) EXPECT_EQ(power, 0);
  for (const float signal : dark.truth.signal_e) EXPECT_EQ(signal, 0);
  EXPECT_EQ(dark.truth.range_m, lit.truth.range_m);
}

TEST(no_lit_raw_frame, makes_every_depth_invalid) {
  expect_all_invalid(sunny_wall(), without_lit_raw_frames(grey_camera()));
  expect_all_invalid(Scene(), without_lit_raw_frames(grey_camera()));
  expect_all_invalid(Scene(), without_lights(without_lit_raw_frames(grey_camera())));
}

// The exposures of 1 ms and 3 ms take 2 ms on the average.
TEST(no_lit_raw_frame, gives_ambient_light_of_the_mean_exposure) {
  Camera camera = without_lit_raw_frames(grey_camera());
  camera.pixel.dark_current_e_per_s = 0;
  camera.adc.step_e_per_dn = 1000;  // the longer exposure collects a million electrons
  const Frame frame = expected_frame(sunny_wall(), camera);
  for (std::size_t i = 0; i < frame.depth.flags.size(); ++i) {
    const double mean = 0.5 * (static_cast<double>(frame.raw.tap_a[i]) + static_cast<double>(frame.raw.tap_a[33 * 9 + i]));
    EXPECT_GT(mean, 1000);
    EXPECT_NEAR(static_cast<double>(frame.depth.ambient_e[i]), mean, 1e-6 * mean);
    EXPECT_EQ(frame.depth.amplitude_e[i], 0);
  }
}

TEST(no_objects, makes_every_depth_invalid_without_noise) {
  for (const Isa isa : backend::isas_here) {
    if (!backend::can_run(isa)) continue;
    const Frame frame = Simulator(Scene(), grey_camera(), {.noise = Noise::off, .threads = 1, .isa = isa}).frame(0);
    expect_all_invalid(frame.depth);
    for (const std::int32_t object : frame.truth.object_id) EXPECT_EQ(object, -1);
  }
}
