// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include "depth/passes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <vector>

#include "depth/filters.h"
#include "support/bench.h"

using namespace tofray;
using namespace tofray::test;

namespace {

constexpr float no_value = std::numeric_limits<float>::quiet_NaN();

/// Largest step of one surface: 0.018 m up to 1 m, 0.14 m from 4.5 m on, a line between.
double limit_at(double z) { return 0.018 + (0.14 - 0.018) * std::clamp((z - 1) / 3.5, 0.0, 1.0); }

/// Whether the middle of a cross of z values flies; without noise to speak of.
bool flies(const Bench& bench, float here, float left, float right, float up, float down, bool rows = true, bool columns = true) {
  const float z[9] = {0, up, 0, left, here, right, 0, down, 0}, noise[9] = {};
  return depth::flies<float>(bench.decoder(), {z + 4, noise + 4, 3}, 1, rows, columns);
}

/// Bench whose decoder knows that there is noise.
Bench noisy_bench(double sigmas) {
  Camera camera = bench_camera();
  camera.decoding.flying_sigmas = sigmas;
  return Bench(camera, true);
}

struct Image {
  int width, height;
  std::vector<float> range;
  std::vector<std::uint16_t> flags;
  Image(int w, int h, float value) : width(w), height(h), range(static_cast<std::size_t>(w * h), value), flags(range.size(), 0) {}
  [[nodiscard]] std::size_t at(int x, int y) const { return static_cast<std::size_t>(y * width + x); }
  [[nodiscard]] depth::RangeImage view() const { return {range.data(), flags.data(), width, height}; }
};

std::vector<float> weights_of(double sigma, int radius) {
  std::vector<float> out;
  for (int i = 0; i <= radius; ++i) out.push_back(static_cast<float>(std::exp(-0.5 * i * i / (sigma * sigma))));
  return out;
}

}  // namespace

TEST(flying_pixel, limit_grows_linearly_between_two_distances) {
  const Bench bench(bench_camera());
  for (const double z : {0.1, 0.5, 1.0, 1.7, 2.75, 4.0, 4.5, 7.0}) {
    EXPECT_NEAR(static_cast<double>(depth::flying_limit<float>(bench.decoder(), static_cast<float>(z))), limit_at(z), 1e-7) << z;
  }
  EXPECT_NEAR(limit_at(2.75), 0.079, 1e-12);
}

// Both neighbours of a pair must be off by more than the limit: a step has one that is not.
TEST(flying_pixel, needs_both_neighbours_of_a_pair) {
  const Bench bench(bench_camera());
  for (const double z : {0.5, 2.75, 6.0}) {
    for (const double share : {0.97, 1.03}) {
      for (const double sign : {-1.0, 1.0}) {
        const float here = static_cast<float>(z), off = static_cast<float>(z + sign * share * limit_at(z)),
                    other = static_cast<float>(z - sign * share * limit_at(z));
        const bool expected = share > 1;
        EXPECT_EQ(flies(bench, here, off, off, here, here), expected);
        EXPECT_EQ(flies(bench, here, off, other, here, here), expected) << "between front and back";
        EXPECT_EQ(flies(bench, here, here, here, off, off), expected);
        EXPECT_EQ(flies(bench, here, here, here, other, off), expected);
        EXPECT_FALSE(flies(bench, here, off, here, here, off)) << "a corner";
        EXPECT_FALSE(flies(bench, here, off, here, here, here)) << "a step";
      }
    }
  }
}

TEST(flying_pixel, takes_no_account_of_invalid_neighbours) {
  const Bench bench(bench_camera());
  EXPECT_FALSE(flies(bench, 1.0f, no_value, 2.0f, no_value, no_value));
  EXPECT_FALSE(flies(bench, 1.0f, 2.0f, no_value, 1.0f, 1.0f));
  EXPECT_TRUE(flies(bench, 1.0f, no_value, 2.0f, 2.0f, 2.0f));
  EXPECT_FALSE(flies(bench, no_value, 2.0f, 2.0f, 2.0f, 2.0f)) << "itself invalid";
}

TEST(flying_pixel, at_the_border_has_one_pair_only) {
  const Bench bench(bench_camera());
  EXPECT_FALSE(flies(bench, 1.0f, 2.0f, 2.0f, 1.0f, 1.0f, true, false));
  EXPECT_FALSE(flies(bench, 1.0f, 1.0f, 1.0f, 2.0f, 2.0f, false, true));
  EXPECT_TRUE(flies(bench, 1.0f, 2.0f, 2.0f, 2.0f, 2.0f, true, false));
  EXPECT_TRUE(flies(bench, 1.0f, 2.0f, 2.0f, 2.0f, 2.0f, false, true));
}

// Left (or up) is off by less, right (or down) by more: what the lesser one says, decides. σ̂ 30 mm here, 40 mm there: 50 mm of the difference.
TEST(flying_pixel, is_off_by_more_than_its_noise) {
  for (const double sigmas : {0.5, 4.0, 9.0}) {
    const Bench bench = noisy_bench(sigmas);
    for (const double share : {0.99, 1.01}) {
      for (const double sign : {-1.0, 1.0}) {
        const double most = std::max(limit_at(1.0), sigmas * 0.050), off = sign * share * most;
        for (const int neighbour : {1, 3, 5, 7}) {
          float z[9] = {0, 1, 0, 1, 1, 1, 0, 1, 0}, noise[9] = {0, 0.04f, 0, 0.04f, 0.03f, 0.04f, 0, 0.04f, 0};
          z[neighbour] = static_cast<float>(1.0 + off), z[8 - neighbour] = static_cast<float>(1.0 + 2 * off);
          EXPECT_EQ(depth::flies<float>(bench.decoder(), {z + 4, noise + 4, 3}, 1, true, true), share > 1) << sigmas << " " << neighbour;
        }
      }
    }
  }
}

// The noise of each neighbour counts, and of the pixel itself.
TEST(flying_pixel, looks_at_the_noise_of_all_three) {
  const Bench bench = noisy_bench(4);
  const float z[9] = {0, 1, 0, 1.2f, 1, 1.2f, 0, 1, 0};
  for (const int loud : {3, 4, 5}) {
    float noise[9] = {};
    EXPECT_TRUE(depth::flies<float>(bench.decoder(), {z + 4, noise + 4, 3}, 1, true, true));
    noise[loud] = 0.049f;  // 0.2 m are 4.08 of them
    EXPECT_TRUE(depth::flies<float>(bench.decoder(), {z + 4, noise + 4, 3}, 1, true, true)) << loud;
    noise[loud] = 0.051f;
    EXPECT_FALSE(depth::flies<float>(bench.decoder(), {z + 4, noise + 4, 3}, 1, true, true)) << loud;
  }
}

// Without noise, and where k is 0, the limit alone holds, whatever the estimate says.
TEST(flying_pixel, without_noise_is_found_by_the_limit_alone) {
  const float z[9] = {0, 1, 0, 1.02f, 1, 1.02f, 0, 1, 0}, noise[9] = {1, 1, 1, 1, 1, 1, 1, 1, 1};
  const Bench quiet(bench_camera()), zero = noisy_bench(0), loud = noisy_bench(4);
  EXPECT_TRUE(depth::flies<float>(quiet.decoder(), {z + 4, noise + 4, 3}, 1, true, true));
  EXPECT_TRUE(depth::flies<float>(zero.decoder(), {z + 4, noise + 4, 3}, 1, true, true));
  EXPECT_FALSE(depth::flies<float>(loud.decoder(), {z + 4, noise + 4, 3}, 1, true, true));
}

TEST(gaussian, preserves_a_constant_up_to_the_border) {
  const Image image(9, 7, 1.25f);
  const auto weights = weights_of(1.0, 3);
  for (int y = 0; y < 7; ++y) {
    for (int x = 0; x < 9; ++x) EXPECT_NEAR(depth::gaussian(image.view(), x, y, 3, weights.data()), 1.25f, 1e-6f);
  }
}

// A single bright pixel shows the filter itself: its weights, summing to 1.
TEST(gaussian, has_the_weights_of_a_gaussian) {
  Image image(17, 17, 0.0f);
  image.range[image.at(8, 8)] = 1;
  const auto weights = weights_of(1.2, 4);
  double sum = 0, norm = 0;
  for (int d = -4; d <= 4; ++d) norm += std::exp(-0.5 * d * d / (1.2 * 1.2));
  for (int y = 4; y <= 12; ++y) {
    for (int x = 4; x <= 12; ++x) {
      const double got = static_cast<double>(depth::gaussian(image.view(), x, y, 4, weights.data()));
      sum += got;
      EXPECT_NEAR(got, std::exp(-0.5 * ((x - 8) * (x - 8) + (y - 8) * (y - 8)) / (1.2 * 1.2)) / (norm * norm), 1e-7);
    }
  }
  EXPECT_NEAR(sum, 1, 1e-6);
}

TEST(filters, let_no_invalid_pixel_bleed) {
  for (const int flag : {1, 2, 4, 8, 16}) {
    Image image(7, 7, 1.0f);
    for (const auto& [x, y] : {std::pair{2, 3}, std::pair{4, 4}, std::pair{0, 0}}) {
      image.range[image.at(x, y)] = x == 4 ? no_value : 1000.0f;
      image.flags[image.at(x, y)] = static_cast<std::uint16_t>(flag);
    }
    const auto weights = weights_of(1.0, 3);
    EXPECT_NEAR(depth::gaussian(image.view(), 3, 3, 3, weights.data()), 1.0f, 1e-6f) << flag;
    EXPECT_EQ(depth::median(image.view(), 3, 3, 2), 1.0f) << flag;
  }
  Image warned(5, 5, 1.0f);  // a warning is not a fault: the pixel counts
  warned.range[warned.at(2, 2)] = 2.0f, warned.flags[warned.at(2, 2)] = 32 + 64;
  EXPECT_GT(depth::gaussian(warned.view(), 2, 2, 1, weights_of(1.0, 1).data()), 1.1f);
}

TEST(median, is_that_of_a_sorted_window) {
  std::mt19937 random(31);
  Image image(12, 11, 0);
  for (float& r : image.range) r = static_cast<float>(random() % 9) * 0.5f;  // many ties
  for (std::uint16_t& f : image.flags) f = random() % 4 == 0 ? 8 : 0;
  for (const int radius : {1, 2, 4}) {
    for (int y = 0; y < 11; ++y) {
      for (int x = 0; x < 12; ++x) {
        if (image.flags[image.at(x, y)] != 0) continue;
        std::vector<float> window;
        for (int v = std::max(0, y - radius); v <= std::min(10, y + radius); ++v) {
          for (int u = std::max(0, x - radius); u <= std::min(11, x + radius); ++u) {
            if (image.flags[image.at(u, v)] == 0) window.push_back(image.range[image.at(u, v)]);
          }
        }
        std::sort(window.begin(), window.end());
        ASSERT_EQ(depth::median(image.view(), x, y, radius), window[(window.size() - 1) / 2]) << x << ", " << y;
      }
    }
  }
}

TEST(median, of_ties_and_of_one_alone) {
  Image image(3, 3, 2.0f);
  EXPECT_EQ(depth::median(image.view(), 1, 1, 1), 2.0f);
  for (std::uint16_t& f : image.flags) f = 1;
  image.flags[4] = 0;
  EXPECT_EQ(depth::median(image.view(), 1, 1, 1), 2.0f);
  image.flags[0] = 0, image.range[0] = 5.0f;
  EXPECT_EQ(depth::median(image.view(), 1, 1, 1), 2.0f) << "of two the lower one";
}
