// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include "num/philox.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "support/statistics.h"

using namespace tofray;

namespace {

using Words = std::array<std::uint32_t, 4>;

Words philox(const Words& counter, std::uint32_t k0, std::uint32_t k1) {
  const auto r = num::philox<float>(counter[0], counter[1], counter[2], counter[3], num::round_keys(k0, k1));
  return {r.w[0], r.w[1], r.w[2], r.w[3]};
}

}  // namespace

// The test vectors that Salmon et al. published with their generator.
TEST(philox, gives_the_published_words) {
  EXPECT_EQ(philox({0, 0, 0, 0}, 0, 0), (Words{0x6627e8d5, 0xe169c58d, 0xbc57ac4c, 0x9b00dbd8}));
  EXPECT_EQ(philox({~0u, ~0u, ~0u, ~0u}, ~0u, ~0u), (Words{0x408f276d, 0x41c83b0e, 0xa20bc7c6, 0x6d5451fd}));
  EXPECT_EQ(philox({0x243f6a88, 0x85a308d3, 0x13198a2e, 0x03707344}, 0xa4093822, 0x299f31d0),
            (Words{0xd16cfe09, 0x94fdcceb, 0x5001e420, 0x24126ea1}));
}

// C++26 [rand.predef]: the 10000th draw of a default-constructed philox4x32 (seed 20111115, counter from 0) is 1955073260. Four words
// come from each counter, so that it is the last word of counter 2499.
TEST(philox, has_the_10000th_draw_of_the_cpp_standard) { EXPECT_EQ(philox({2499, 0, 0, 0}, 20111115, 0)[3], 1955073260u); }

TEST(uniform, is_the_middle_of_its_cell_and_never_0_or_1) {
  EXPECT_EQ(num::uniform<float>(0u), 0x1p-24f);
  EXPECT_EQ(num::uniform<float>(0x1ffu), 0x1p-24f);
  EXPECT_EQ(num::uniform<float>(0x200u), 3 * 0x1p-24f);
  EXPECT_EQ(num::uniform<float>(~0u), 1 - 0x1p-24f);
}

// Against Box and Muller's formula in double, over 2^20 pairs and the ends of both words.
// The square of the radius is that of −2·ln u within the fit's 2.9e-6 and its own rounding, the angle that of the other word.
TEST(normal_pair, is_that_of_the_formula) {
  double worst = 0;
  const auto check = [&](std::uint32_t radius_word, std::uint32_t angle_word) {
    float first, second;
    num::normal_pair<float>(radius_word, angle_word, first, second);
    const double u = ((radius_word >> 8) + 1.0) * 0x1p-24, square = -2 * std::log(u);
    const double r = static_cast<double>(static_cast<std::int32_t>(angle_word << 1)) * 0x1p-33;
    const double turn = (angle_word >> 31) != 0 ? -1 : 1;
    const double x = turn * std::cos(2 * test::pi * r), y = turn * std::sin(2 * test::pi * r);
    const double f = static_cast<double>(first), g = static_cast<double>(second), radius = std::sqrt(f * f + g * g);
    EXPECT_LT(std::abs(f * f + g * g - square), 3.3e-6 + 5e-7 * square) << radius_word;
    worst = std::max({worst, std::abs(f - radius * x), std::abs(g - radius * y)});
  };
  for (std::uint32_t i = 0; i < 1u << 20; ++i) {
    const Words w = philox({i, 0, 0, 0}, 1, 2);
    check(w[0], w[1]);
  }
  for (const std::uint32_t a : {0u, 0xffu, 0x100u, 0x7fffffffu, 0xffffff00u, ~0u}) {
    for (const std::uint32_t b : {0u, 0x3fu, 0x40u, 0x3fffffffu, 0x40000000u, 0x80000000u, 0xc0000000u, ~0u}) check(a, b);
  }
  EXPECT_LT(worst, 2e-6);  // |z| < 6: four units in its last place
}

// Moments 1 to 4 of a normal, and those of the two of a pair together. 4e6 draws, 7 statistics, |z| < 6: false alarm 1.4e-8.
TEST(normal_pair, has_the_moments_of_two_independent_normals) {
  constexpr int pairs = 2'000'000;
  double sum[5] = {}, product = 0, squares = 0;
  for (std::uint32_t i = 0; i < pairs; ++i) {
    const Words w = philox({i, 7, 0, 0}, 3, 4);
    float fx, fy;
    num::normal_pair<float>(w[2], w[3], fx, fy);
    const double x = static_cast<double>(fx), y = static_cast<double>(fy);
    for (const double z : {x, y}) sum[1] += z, sum[2] += z * z, sum[3] += z * z * z, sum[4] += z * z * z * z;
    product += x * y;
    squares += (x * x - 1) * (y * y - 1);
  }
  const double n = 2.0 * pairs;
  EXPECT_LT(std::abs(sum[1]) / std::sqrt(n), 6);
  EXPECT_LT(std::abs(sum[2] - n) / std::sqrt(2 * n), 6);
  EXPECT_LT(std::abs(sum[3]) / std::sqrt(15 * n), 6);
  EXPECT_LT(std::abs(sum[4] - 3 * n) / std::sqrt(96 * n), 6);
  EXPECT_LT(std::abs(product) / std::sqrt(pairs), 6);
  EXPECT_LT(std::abs(squares) / std::sqrt(4.0 * pairs), 6);
}

// 100 cells of equal probability, 4e6 normals: chi² within 6 sigma of its mean.
TEST(normal_pair, fills_the_cells_of_a_normal_evenly) {
  constexpr int cells = 100, pairs = 2'000'000;
  std::vector<double> seen(cells), expected(cells, 2.0 * pairs / cells);
  for (std::uint32_t i = 0; i < pairs; ++i) {
    const Words w = philox({i, 8, 0, 0}, 3, 4);
    float z[2];
    num::normal_pair<float>(w[0], w[1], z[0], z[1]);
    for (const float x : z) {
      const double share = 0.5 * std::erfc(-static_cast<double>(x) / std::sqrt(2.0));
      ++seen[std::min<std::size_t>(cells - 1, static_cast<std::size_t>(share * cells))];
    }
  }
  EXPECT_LT(std::abs(test::chi_square_z(seen, expected)), 6);
}
