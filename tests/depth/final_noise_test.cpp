// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
// The noise threshold asks for what the adaptive filter left, and filters leave a flag.               [theory: adaptive-filter, low-signal]
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "support/pixels.h"

using namespace tofray;
using namespace tofray::test;

namespace {

constexpr int final_width = 61, final_height = 43;

/// Noise of some centimetres: a third of the pixels is above the threshold.
Camera noisy(ImageFilter::Kind kind) {
  Camera camera = lit_camera(final_width, final_height, 60);
  camera.pixel.read_noise_e = 700;
  camera.adc = {16, 10, 32768, 0, 65535};
  camera.decoding.filter.kind = kind;
  camera.decoding.flying_check = false;
  return camera;
}

Frame seen_by(const Camera& camera, Noise noise = Noise::exact) {
  return Simulator(wall(1.2), camera, {.seed = 3, .noise = noise, .threads = 1}).frame(0);
}

std::vector<float> sorted_noise() {
  Camera camera = noisy(ImageFilter::Kind::none);
  camera.decoding.noise_threshold_m = 1e3;
  std::vector<float> out = seen_by(camera).depth.noise_m;
  std::sort(out.begin(), out.end());
  return out;
}

}  // namespace

// Pixels that are noisier than the threshold are means of their neighbours, and valid where that is good enough; what is invalid says that
// the noise which was left is too much. Errors of what was saved are as large as they say.
TEST(final_noise, of_the_adaptive_filter_counts) {
  const std::vector<float> all = sorted_noise();
  Camera camera = noisy(ImageFilter::Kind::adaptive);
  camera.decoding.noise_threshold_m = static_cast<double>(all[all.size() * 2 / 3]);
  camera.decoding.filter.goal_m = camera.decoding.noise_threshold_m, camera.decoding.filter.radius_px = 1;
  Camera plain = camera;
  plain.decoding.filter.kind = ImageFilter::Kind::none;
  const Frame before = seen_by(plain), after = seen_by(camera);
  const auto threshold = static_cast<float>(camera.decoding.noise_threshold_m);
  int saved = 0, lost = 0;
  double square = 0;
  for (std::size_t i = 0; i < before.depth.flags.size(); ++i) {
    const bool weak = (before.depth.flags[i] & flag_low_signal) != 0;
    EXPECT_EQ(weak, before.depth.noise_m[i] > threshold);
    EXPECT_EQ((after.depth.flags[i] & flag_low_signal) != 0, after.depth.noise_m[i] > threshold) << i;
    EXPECT_EQ(std::isnan(after.depth.z_m[i]), (after.depth.flags[i] & flags_invalid) != 0) << i;
    if (!weak) {
      EXPECT_EQ(after.depth.range_m[i], before.depth.range_m[i]) << i;
      EXPECT_EQ(after.depth.flags[i], before.depth.flags[i]) << i;
      continue;
    }
    if ((after.depth.flags[i] & flag_low_signal) != 0) {
      ++lost;
      continue;
    }
    EXPECT_NE(after.depth.flags[i] & flag_filtered, 0) << i;
    ++saved;
    square += std::pow(static_cast<double>((after.depth.range_m[i] - after.truth.range_m[i]) / after.depth.noise_m[i]), 2);
  }
  ASSERT_GT(saved, 300);
  EXPECT_LT(lost, saved / 3);
  // of neighbours that share their noise some 3·saved/9 are independent; choosing those within 3 σ takes 3 % off
  EXPECT_NEAR(square / saved, 1, 5 * std::sqrt(2.0 / (saved / 3.0)));
}

// Nine pixels are at most three times as good as one: where the noise is four times the threshold they do not do.
TEST(final_noise, that_is_left_too_large_is_low_signal) {
  const std::vector<float> all = sorted_noise();
  Camera camera = noisy(ImageFilter::Kind::adaptive);
  camera.decoding.noise_threshold_m = static_cast<double>(all[all.size() * 2 / 3]) / 4;
  camera.decoding.filter.goal_m = camera.decoding.noise_threshold_m, camera.decoding.filter.radius_px = 1;
  const Depth depth = seen_by(camera).depth;
  std::size_t lost = 0;
  for (std::size_t i = 0; i < depth.flags.size(); ++i) {
    const bool weak = (depth.flags[i] & flag_low_signal) != 0;
    ASSERT_EQ(weak, static_cast<double>(depth.noise_m[i]) > camera.decoding.noise_threshold_m) << i;
    ASSERT_EQ(std::isnan(depth.z_m[i]), (depth.flags[i] & flags_invalid) != 0) << i;
    lost += weak ? 1 : 0;
  }
  EXPECT_GT(lost, all.size() / 4);
  EXPECT_LT(lost, all.size());
}

// The other filters do not weigh by noise: a pixel that is too noisy would spoil its neighbours, and is left out before.
TEST(final_noise, of_the_pixel_itself_counts_with_other_filters) {
  const std::vector<float> all = sorted_noise();
  for (const auto kind : {ImageFilter::Kind::gaussian, ImageFilter::Kind::median, ImageFilter::Kind::bilateral}) {
    Camera camera = noisy(kind), plain = noisy(ImageFilter::Kind::none);
    camera.decoding.noise_threshold_m = plain.decoding.noise_threshold_m = static_cast<double>(all[all.size() * 2 / 3]);
    const Frame before = seen_by(plain), after = seen_by(camera);
    int changed = 0;
    for (std::size_t i = 0; i < before.depth.flags.size(); ++i) {
      const bool moved = after.depth.range_m[i] != before.depth.range_m[i] && !std::isnan(before.depth.range_m[i]);
      EXPECT_EQ(after.depth.flags[i], before.depth.flags[i] | (moved ? flag_filtered : 0)) << i;
      changed += moved ? 1 : 0;
    }
    EXPECT_GT(changed, 1000);
  }
}

// Without noise nothing is low signal.
TEST(final_noise, is_none_where_noise_is_off) {
  const Frame frame = seen_by(noisy(ImageFilter::Kind::adaptive), Noise::off);
  for (const std::uint16_t flags : frame.depth.flags) EXPECT_EQ(flags & flag_low_signal, 0);
}
