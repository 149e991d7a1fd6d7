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
  std::vector<float> range, noise;
  std::vector<std::uint16_t> flags;
  Image(int w, int h, float value, float sigma = 0.01f)
      : width(w), height(h), range(static_cast<std::size_t>(w * h), value), noise(range.size(), sigma), flags(range.size(), 0) {}
  [[nodiscard]] std::size_t at(int x, int y) const { return static_cast<std::size_t>(y * width + x); }
  [[nodiscard]] depth::RangeImage view() const { return {range.data(), noise.data(), flags.data(), width, height}; }
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
  // Each neighbour's own: 0.2 m to one side are 3.92 of 51 mm, 0.3 m to the other 5.9.
  for (const int near : {1, 3, 5, 7}) {
    float uneven[9] = {0, 1, 0, 1, 1, 1, 0, 1, 0}, noise[9] = {};
    uneven[near] = 1.2f, uneven[8 - near] = 1.3f, noise[near] = 0.051f;
    EXPECT_FALSE(depth::flies<float>(bench.decoder(), {uneven + 4, noise + 4, 3}, 1, true, true)) << near;
    std::swap(noise[near], noise[8 - near]);
    EXPECT_TRUE(depth::flies<float>(bench.decoder(), {uneven + 4, noise + 4, 3}, 1, true, true)) << near;
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
    for (int x = 0; x < 9; ++x) EXPECT_NEAR(depth::gaussian(image.view(), x, y, 3, weights.data()).range, 1.25f, 1e-6f);
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
      const double got = static_cast<double>(depth::gaussian(image.view(), x, y, 4, weights.data()).range);
      sum += got;
      EXPECT_NEAR(got, std::exp(-0.5 * ((x - 8) * (x - 8) + (y - 8) * (y - 8)) / (1.2 * 1.2)) / (norm * norm), 1e-7);
    }
  }
  EXPECT_NEAR(sum, 1, 1e-6);
}

namespace {
/// All filters at one pixel.
std::vector<depth::Filtered> by_all(const depth::RangeImage& image, int x, int y) {
  const auto weights = weights_of(1.0, 3);
  return {depth::gaussian(image, x, y, 3, weights.data()), depth::median(image, x, y, 2),
          depth::bilateral(image, x, y, 3, weights.data(), {25.0f, 0.0f}), depth::adaptive(image, x, y, 3, 25.0f, 0.0f)};
}

/// A wall with normal noise whose σ changes from pixel to pixel, as the pixels know.
Image noisy_wall(int side, std::uint32_t seed) {
  std::mt19937 random(seed);
  std::normal_distribution<double> normal;
  Image image(side, side, 0);
  for (std::size_t i = 0; i < image.range.size(); ++i) {
    image.noise[i] = 0.010f + 0.002f * static_cast<float>(i % 3);
    image.range[i] = static_cast<float>(1.5 + static_cast<double>(image.noise[i]) * normal(random));
  }
  return image;
}

/// Deviation of what a filter leaves of that wall, over what it says.
template <class Filter>
double noise_over_said(const Image& image, const Filter& filter) {
  double square = 0, said = 0;
  for (int y = 5; y < image.height - 5; ++y) {
    for (int x = 5; x < image.width - 5; ++x) {
      const depth::Filtered got = filter(image.view(), x, y);
      square += (static_cast<double>(got.range) - 1.5) * (static_cast<double>(got.range) - 1.5);
      said += static_cast<double>(got.noise) * static_cast<double>(got.noise);
    }
  }
  return std::sqrt(square / said);
}
}  // namespace

TEST(filters, say_as_much_noise_as_there_was_where_a_pixel_stands_alone) {
  Image image(5, 5, 1.0f, 0.03f);
  std::fill(image.flags.begin(), image.flags.end(), std::uint16_t{8});
  image.flags[12] = 0;
  for (const depth::Filtered& got : by_all(image.view(), 2, 2)) {
    EXPECT_EQ(got.range, 1.0f);
    EXPECT_NEAR(got.noise, 0.03f, 1e-8f);
  }
}

// σ·√Σw²/Σw of a Gaussian; σ·√(π/(2n + π − 2)) of a median, σ/√n of n equal pixels.
TEST(filters, leave_noise_by_their_closed_forms) {
  const Image image(21, 21, 1.0f, 0.03f);
  double weights = 0, squares = 0;
  for (int i = -3; i <= 3; ++i) weights += std::exp(-0.5 * i * i), squares += std::exp(-1.0 * i * i);
  const auto got = by_all(image.view(), 10, 10);
  EXPECT_NEAR(static_cast<double>(got[0].noise), 0.03 * squares / (weights * weights), 1e-7);
  EXPECT_NEAR(static_cast<double>(got[1].noise), 0.03 * std::sqrt(pi / (2 * 25 + pi - 2)), 1e-7);
  EXPECT_NEAR(static_cast<double>(got[2].noise), 0.03 * squares / (weights * weights), 1e-7) << "where all ranges are alike, a Gaussian";
  EXPECT_NEAR(static_cast<double>(got[3].noise), 0.03 / 7, 1e-7);
}

// 190 × 190 pixels; a window of w × w makes (190/w)² independent ones, 700 of the largest: the ratio is known to 1/√1400 = 2.7 %, and 4 of
// these are allowed. Weights that depend on noise are taken by their slope alone, which says too much: by up to 8 % at k = 3.
TEST(filters, leave_as_much_noise_as_they_say) {
  const Image image = noisy_wall(200, 17);
  const auto weights = weights_of(1.0, 3);
  EXPECT_NEAR(noise_over_said(image, [&](const auto& of, int x, int y) { return depth::gaussian(of, x, y, 3, weights.data()); }), 1, 0.05);
  EXPECT_NEAR(noise_over_said(image, [&](const auto& of, int x, int y) { return depth::median(of, x, y, 1); }), 1, 0.05);
  EXPECT_NEAR(noise_over_said(image, [&](const auto& of, int x, int y) { return depth::median(of, x, y, 3); }), 1, 0.10);
  for (const int radius : {1, 2, 3}) {
    EXPECT_NEAR(noise_over_said(image, [&](const auto& of, int x, int y) { return depth::adaptive(of, x, y, radius, 9.0f, 0.0f); }), 1,
                radius == 1 ? 0.05 : 0.10)
        << radius;
  }
  for (const float k : {3.0f, 4.0f, 6.0f}) {
    const double ratio = noise_over_said(image, [&](const auto& of, int x, int y) {
      return depth::bilateral(of, x, y, 3, weights.data(), {k * k, 0.0f});
    });
    EXPECT_GT(ratio, k < 4 ? 0.88 : 0.91) << k;
    EXPECT_LT(ratio, 1.03) << k;
  }
}

// A step of ten times the noise of the difference stays where it is, to the bit; a Gaussian takes it away.
TEST(filters, that_keep_edges_do_not_mix_what_lies_on_both_sides) {
  Image image(12, 12, 1.0f);
  for (int y = 0; y < 12; ++y)
    for (int x = 6; x < 12; ++x) image.range[image.at(x, y)] = 1.15f;
  for (int x = 3; x < 9; ++x) {
    const auto got = by_all(image.view(), x, 5);
    EXPECT_EQ(got[2].range, image.range[image.at(x, 5)]);
    EXPECT_EQ(got[3].range, image.range[image.at(x, 5)]);
    EXPECT_GT(std::abs(got[0].range - image.range[image.at(x, 5)]), 1e-4f);
  }
}

// One neighbour is off by Δ: its weight is g(1 − Δ²/s²)², s² = k²·2σ² + range².
TEST(bilateral, weighs_by_tukeys_function_of_the_range) {
  const auto weights = weights_of(1.0, 1);
  const double g = std::exp(-0.5), sigma = 0.01;
  for (const auto& [k, range] : {std::pair{3.0, 0.0}, {0.0, 0.05}, {2.0, 0.03}}) {
    for (const double off : {0.005, 0.02, 0.041, 0.06}) {
      Image image(3, 3, 1.0f, static_cast<float>(sigma));
      for (const int i : {0, 1, 2, 3, 6, 7, 8}) image.flags[static_cast<std::size_t>(i)] = 8;
      image.range[5] = static_cast<float>(1 + off);
      const double square = k * k * 2 * sigma * sigma + range * range, share = std::max(0.0, 1 - off * off / square);
      const auto got =
          depth::bilateral(image.view(), 1, 1, 1, weights.data(), {static_cast<float>(k * k), static_cast<float>(range * range)});
      EXPECT_NEAR(static_cast<double>(got.range), 1 + off * g * share * share / (1 + g * share * share), 2e-7) << k << " " << off;
    }
  }
}

// The slope of the whole function by each of the two ranges, found by moving them.
TEST(bilateral, knows_its_noise_by_its_slope) {
  const auto weights = weights_of(1.0, 1);
  const auto value = [&](double here, double there) {
    const double d = there - here, share = std::max(0.0, 1 - d * d / (9 * (0.01 * 0.01 + 0.02 * 0.02))), w = std::exp(-0.5) * share * share;
    return here + w * d / (1 + w);
  };
  for (const double off : {-0.03, 0.0, 0.01, 0.04, 0.06}) {
    Image image(3, 1, 1.0f);
    image.flags[0] = 8, image.noise[2] = 0.02f, image.range[2] = static_cast<float>(1 + off);
    const double step = 1e-6, by_own = (value(1 + step, 1 + off) - value(1 - step, 1 + off)) / (2 * step),
                 by_other = (value(1, 1 + off + step) - value(1, 1 + off - step)) / (2 * step);
    const auto got = depth::bilateral(image.view(), 1, 0, 1, weights.data(), {9.0f, 0.0f});
    EXPECT_NEAR(static_cast<double>(got.noise), std::hypot(by_own * 0.01, by_other * 0.02), 1e-7) << off;
  }
}

// σ = 10 mm each: 9 pixels leave 3.3 mm, 25 leave 2 mm, 81 leave 1.1 mm.
TEST(adaptive, adds_rings_until_the_noise_is_low_enough) {
  const Image image(11, 11, 1.0f);
  const auto left = [&](double goal, int radius) {
    return 1e3 * static_cast<double>(depth::adaptive(image.view(), 5, 5, radius, 9.0f, static_cast<float>(goal * goal)).noise);
  };
  EXPECT_NEAR(left(0.0101, 4), 10, 1e-4);
  EXPECT_NEAR(left(0.0099, 4), 10 / 3.0, 1e-4);
  EXPECT_NEAR(left(0.0034, 4), 10 / 3.0, 1e-4);
  EXPECT_NEAR(left(0.0033, 4), 2, 1e-4);
  EXPECT_NEAR(left(0, 4), 10 / 9.0, 1e-4);
  EXPECT_NEAR(left(0, 2), 2, 1e-4);
}

// Of σ 10 mm and 20 mm the weights are 4 : 1; a neighbour that is off by more than k times 22.4 mm does not count.
TEST(adaptive, weighs_by_the_variance_what_is_within_the_noise) {
  for (const double off : {0.03, 0.066, 0.068}) {
    Image image(3, 1, 1.0f);
    image.flags[0] = 8, image.noise[2] = 0.02f, image.range[2] = static_cast<float>(1 + off);
    const auto got = depth::adaptive(image.view(), 1, 0, 1, 9.0f, 0.0f);
    const bool counts = off < 3 * std::hypot(0.01, 0.02);
    EXPECT_NEAR(static_cast<double>(got.range), counts ? 1 + 0.2 * off : 1, 2e-7) << off;
    EXPECT_NEAR(static_cast<double>(got.noise), counts ? 0.02 / std::sqrt(5) : 0.01, 1e-7) << off;
  }
}

TEST(filters, let_no_invalid_pixel_bleed) {
  for (const int flag : {1, 2, 4, 8, 16, 128}) {
    Image image(7, 7, 1.0f);
    for (const auto& [x, y] : {std::pair{2, 3}, std::pair{4, 4}, std::pair{0, 0}}) {
      image.range[image.at(x, y)] = x == 4 ? no_value : 1000.0f, image.noise[image.at(x, y)] = x == 4 ? no_value : 1000.0f;
      image.flags[image.at(x, y)] = static_cast<std::uint16_t>(flag);
    }
    const auto weights = weights_of(1.0, 3);
    EXPECT_NEAR(depth::gaussian(image.view(), 3, 3, 3, weights.data()).range, 1.0f, 1e-6f) << flag;
    EXPECT_EQ(depth::median(image.view(), 3, 3, 2).range, 1.0f) << flag;
    for (const depth::Filtered& got : by_all(image.view(), 3, 3)) {
      EXPECT_NEAR(got.range, 1.0f, 1e-6f) << flag;
      EXPECT_LT(got.noise, 0.01f) << flag;
    }
  }
  Image warned(5, 5, 1.0f);  // a warning is not a fault: the pixel counts
  warned.range[warned.at(2, 2)] = 2.0f, warned.flags[warned.at(2, 2)] = 32 + 64;
  EXPECT_GT(depth::gaussian(warned.view(), 2, 2, 1, weights_of(1.0, 1).data()).range, 1.1f);
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
        ASSERT_EQ(depth::median(image.view(), x, y, radius).range, window[(window.size() - 1) / 2]) << x << ", " << y;
      }
    }
  }
}

TEST(median, of_ties_and_of_one_alone) {
  Image image(3, 3, 2.0f);
  EXPECT_EQ(depth::median(image.view(), 1, 1, 1).range, 2.0f);
  for (std::uint16_t& f : image.flags) f = 1;
  image.flags[4] = 0;
  EXPECT_EQ(depth::median(image.view(), 1, 1, 1).range, 2.0f);
  image.flags[0] = 0, image.range[0] = 5.0f;
  EXPECT_EQ(depth::median(image.view(), 1, 1, 1).range, 2.0f) << "of two the lower one";
}
