// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
// gt_ambient_e_per_s: what an unlit raw frame collects in a second, and what may be given back as light.
#include <gtest/gtest.h>

#include "support/pixels.h"

using namespace tofray;
using namespace tofray::test;

namespace {

/// An unlit raw frame of 3 ms before the lit ones; wells that nothing fills.
Camera camera_with_grey_frame() {
  Camera camera = lit_camera(33, 9, 40);
  camera.mode.sequence.insert(camera.mode.sequence.begin(), {false, 0, 0, 3e-3});
  camera.pixel.dark_current_e_per_s = 1e4, camera.pixel.full_well_e = 1e7;
  return camera;
}

}  // namespace

TEST(ambient_truth, is_what_an_unlit_raw_frame_collects_without_its_dark_current) {
  const Frame frame = expected_frame(sunny_wall(0.5), camera_with_grey_frame());
  ASSERT_EQ(frame.truth.ambient_e_per_s.size(), 33u * 9u);
  for (std::size_t i = 0; i < frame.truth.ambient_e_per_s.size(); ++i) {
    const double collected = static_cast<double>(frame.raw.tap_a[i]) + static_cast<double>(frame.raw.tap_b[i]) - 2 * 1e4 * 3e-3;
    ASSERT_GT(collected, 100) << i;
    ASSERT_NEAR(static_cast<double>(frame.truth.ambient_e_per_s[i]) * 3e-3, collected, 1e-5 * collected) << i;
  }
}

TEST(ambient_truth, grows_with_reflectivity_and_is_0_without_ambient_light_or_surface) {
  const Camera camera = camera_with_grey_frame();
  const std::vector<float> half = expected_frame(sunny_wall(0.5), camera).truth.ambient_e_per_s;
  const std::vector<float> full = expected_frame(sunny_wall(1), camera).truth.ambient_e_per_s;
  for (std::size_t i = 0; i < half.size(); ++i) ASSERT_FLOAT_EQ(full[i], 2 * half[i]) << i;
  const std::vector<float> nothing(half.size(), 0.0f);
  EXPECT_EQ(expected_frame(wall(1, 0.5), camera).truth.ambient_e_per_s, nothing);
  Scene empty = sunny_wall(0.5);
  empty.objects.clear();
  EXPECT_EQ(expected_frame(empty, camera).truth.ambient_e_per_s, nothing);
}

TEST(ambient_truth, given_back_as_light_is_the_truth_again) {
  const Camera camera = camera_with_grey_frame();
  const Truth truth = expected_frame(sunny_wall(0.5), camera).truth;
  PixelLight light;
  light.width = 33, light.height = 9;
  light.ambient_e_per_s = truth.ambient_e_per_s;
  light.power_w.assign(truth.power_w.size(), 0.0f);
  light.path_length_m.assign(truth.power_w.size(), 0.0f);
  EXPECT_EQ(Simulator({}, camera, {.noise = Noise::off}).frame(0, light).truth.ambient_e_per_s, truth.ambient_e_per_s);
}
