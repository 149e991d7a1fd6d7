// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
// How much light may go from surface to surface: numbers beyond their range, and all that stands in memory at once.
#include <gtest/gtest.h>

#include <string>

#include "support/pixels.h"
#include "support/sanitizers.h"

using namespace tofray;
using namespace tofray::test;

TEST(bounces, of_more_ways_than_can_be_followed_are_refused) {
  Camera camera = lit_camera(4, 4, 20);
  const auto refused = [&](const Transport& transport, const Camera& with) {
    Scene scene = wall(1);
    scene.transport = transport;
    try {
      (void)Simulator(scene, with).frame(0);
    } catch (const Error& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  EXPECT_EQ(refused({64, 65536, 0}, camera), "");
  EXPECT_NE(refused({65, 1, 0}, camera).find("bounces"), std::string::npos);
  EXPECT_NE(refused({-1, 1, 0}, camera).find("bounces"), std::string::npos);
  EXPECT_NE(refused({1, 0, 0}, camera).find("samples"), std::string::npos);
  EXPECT_NE(refused({1, 1'000'000'000, 0}, camera).find("samples"), std::string::npos);
  EXPECT_NE(refused({64, 65536, 0}, lit_camera(224, 172, 200)).find("--samples"), std::string::npos);
  camera.power_model = PowerModel::paper_literal;
  EXPECT_NE(refused({1, 1, 0}, camera), "");
}

// All images that stand in memory at once are counted, and histograms follow the ways of one time again.
TEST(bounces, are_limited_by_all_that_they_make) {
  const auto refused = [&](int side_px, int subpixel, const Transport& transport) {
    Scene scene = wall(1);
    scene.transport = transport;
    try {
      const Simulator simulator(scene, lit_camera(side_px, side_px, 200), {.subpixel = subpixel});
    } catch (const Error& error) {
      EXPECT_EQ(error.kind(), ErrorKind::limit);
      return std::string(error.what());
    }
    return std::string();
  };
  // 64 × 64 pixels, 65536 ways, 64 surfaces: 2^34 exactly.
  EXPECT_EQ(refused(64, 1, {.bounces = 64, .samples = 65536}), "");
  const TransientBins bins{.bins = 10, .first_m = 0, .width_m = 1};
  EXPECT_NE(refused(64, 1, {.bounces = 64, .samples = 65536, .transient = bins}).find("once more for their histograms"), std::string::npos);
  // One modulation frequency: up to 18 values a pixel. Samples within pixels need two images, bounces two more for each half of their ways.
  EXPECT_NE(refused(2300, 1, {.bounces = 1, .samples = 2, .smooth = true}).find("in 6 images"), std::string::npos);
  if (!with_sanitizers) {
    EXPECT_EQ(refused(2300, 1, {.bounces = 1, .samples = 2}), "");
  }
  EXPECT_NE(refused(2800, 1, {.bounces = 1, .samples = 2}).find("in 4 images"), std::string::npos);
}
