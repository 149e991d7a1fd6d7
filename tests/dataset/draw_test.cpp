// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
// Draws by address: each law against its distribution on a million draws, and what decides a draw.
#include "dataset/draw.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <set>

#include "support/pi.h"
#include "support/statistics.h"

namespace {

using namespace tofray::dataset;
using tofray::test::chi_square_z;
using tofray::test::pi;

constexpr int draws = 1'000'000, cells = 200;
constexpr double infinity = std::numeric_limits<double>::infinity();

std::uint64_t bits_of(int sample, const char* path = "objects/ball/radius") {
  return random_bits({.seed = 7, .sample = static_cast<std::uint64_t>(sample)}, path);
}

/// A million draws through their distribution function, which has to make them even. @return χ² as a standard normal
double unevenness(const std::function<double(std::uint64_t)>& draw, const std::function<double(double)>& distribution) {
  std::vector<double> seen(cells), expected(cells, static_cast<double>(draws) / cells);
  for (int i = 0; i < draws; ++i) {
    const double share = distribution(draw(bits_of(i)));
    EXPECT_TRUE(share >= 0 && share <= 1) << share;
    seen[static_cast<std::size_t>(std::min(cells - 1.0, std::floor(share * cells)))] += 1;
  }
  return chi_square_z(seen, expected);
}

double normal_share(double x) { return 0.5 * std::erfc(-x / std::sqrt(2.0)); }

TEST(draw, of_each_law_has_its_distribution) {
  EXPECT_LT(std::abs(unevenness([](auto b) { return uniform(-2, 5, b); }, [](double x) { return (x + 2) / 7; })), 4.5);
  EXPECT_LT(
      std::abs(unevenness([](auto b) { return log_uniform(0.5, 8, b); }, [](double x) { return std::log(x / 0.5) / std::log(16.0); })),
      4.5);
  EXPECT_LT(
      std::abs(unevenness([](auto b) { return normal(3, 2, -infinity, infinity, b); }, [](double x) { return normal_share((x - 3) / 2); })),
      4.5);
  const auto cut = [](double low, double high) {
    return [=](double x) { return (normal_share(x) - normal_share(low)) / (normal_share(high) - normal_share(low)); };
  };
  EXPECT_LT(std::abs(unevenness([](auto b) { return normal(0, 1, -1, 2.5, b); }, cut(-1, 2.5))), 4.5);
  // Far in a tail, by the tail's own function on either side.
  const auto tail = [](double x) { return 1 - std::erfc(x / std::sqrt(2.0)) / std::erfc(6 / std::sqrt(2.0)); };
  EXPECT_LT(std::abs(unevenness([](auto b) { return normal(0, 1, 6, infinity, b); }, tail)), 4.5);
  EXPECT_LT(std::abs(unevenness([](auto b) { return -normal(0, 1, -infinity, -6, b); }, tail)), 4.5);
}

TEST(draw, of_whole_numbers_and_of_weights_has_their_shares) {
  std::vector<double> seen(7), expected(7, draws / 7.0), chosen(4), weights{3, 0, 1, 6}, shares{0.3 * draws, 0, 0.1 * draws, 0.6 * draws};
  for (int i = 0; i < draws; ++i) {
    seen.at(static_cast<std::size_t>(integer(-3, 3, bits_of(i)) + 3)) += 1;
    chosen.at(weighted(weights, bits_of(i))) += 1;
  }
  EXPECT_LT(std::abs(chi_square_z(seen, expected)), 4.5);
  EXPECT_EQ(chosen[1], 0);
  EXPECT_LT(std::abs(chi_square_z({chosen[0], chosen[2], chosen[3]}, {shares[0], shares[2], shares[3]})), 4.5);
}

TEST(draw, reaches_both_ends_and_never_beyond) {
  constexpr std::uint64_t none = 0, all = ~std::uint64_t{0};
  EXPECT_EQ(uniform(1, 3, none), 1);
  EXPECT_LE(uniform(1, 3, all), 3);
  EXPECT_GT(uniform(1, 3, all), 3 - 1e-15);
  EXPECT_EQ(uniform(-1e308, 1e308, none), -1e308);
  EXPECT_LE(uniform(-1e308, 1e308, all), 1e308);
  EXPECT_GE(log_uniform(1e-300, 1e300, none), 1e-300);
  EXPECT_LE(log_uniform(1e-300, 1e300, all), 1e300);
  EXPECT_EQ(log_uniform(2, 2, all), 2);
  for (const std::uint64_t bits : {none, all}) {
    const double x = normal(10, 0.1, 9.9, 10.3, bits);
    EXPECT_TRUE(x >= 9.9 && x <= 10.3) << x;
    EXPECT_TRUE(std::isfinite(normal(0, 1, -infinity, infinity, bits)));
  }
  EXPECT_EQ(normal(5, 0, -infinity, infinity, all), 5);
  EXPECT_EQ(normal(5, 0, 6, 7, all), 6);
  // Nothing of it lies there: the end that is nearer to the mean.
  EXPECT_EQ(normal(0, 1, 50, 60, all), 50);
  EXPECT_EQ(normal(0, 1, -60, -50, none), -50);
  const std::int64_t least = std::numeric_limits<std::int64_t>::min(), most = std::numeric_limits<std::int64_t>::max();
  EXPECT_EQ(integer(3, 12, none), 3);
  EXPECT_EQ(integer(3, 12, all), 12);
  EXPECT_EQ(integer(least, most, all), -1);
  EXPECT_EQ(integer(0, most, all), most);
}

TEST(draw, by_the_inverse_normal_distribution_is_exact_to_its_last_digits) {
  for (const double x : {-37.0, -8.0, -5.0, -2.0, -0.5, -1e-9, 0.0, 0.3, 1.2, 4.0, 6.0}) {
    const double p = 0.5 * std::erfc(-x / std::sqrt(2.0));
    // What p's own rounding makes of x: dx = dp/φ(x).
    const double slope = std::exp(-x * x / 2) / std::sqrt(2 * pi);
    EXPECT_NEAR(inverse_normal(p), x, 4e-15 * std::max(1.0, std::abs(x)) + 4e-16 * p / slope) << x;
  }
}

TEST(draw, depends_on_seed_sample_view_attempt_and_path) {
  const Address here{.seed = 7, .sample = 12, .view = 3, .attempt = 1};
  std::set<std::uint64_t> all{random_bits(here, "a")};
  for (int i = 0; i < 5; ++i) {
    Address other = here;
    if (i == 0) other.seed += std::uint64_t{1} << 40;
    if (i == 1) other.sample += std::uint64_t{1} << 33;
    if (i == 2) other.view += 1;
    if (i == 3) other.attempt += 1;
    all.insert(random_bits(other, i == 4 ? "b" : "a"));
  }
  EXPECT_EQ(all.size(), 6U);
  EXPECT_EQ(random_bits(here, "a"), random_bits(here, "a"));
}

TEST(draw, of_neighbouring_samples_and_paths_is_not_related) {
  tofray::test::Correlation samples(0.5, 0.5), paths(0.5, 0.5);
  for (int i = 0; i < draws; ++i) {
    samples.add(unit_number(bits_of(i)), unit_number(bits_of(i + 1)));
    paths.add(unit_number(bits_of(i, "objects/ball[0]")), unit_number(bits_of(i, "objects/ball[1]")));
  }
  EXPECT_LT(std::abs(samples.z()), 4.5);
  EXPECT_LT(std::abs(paths.z()), 4.5);
}

TEST(draw, in_even_order_takes_each_place_once) {
  for (const std::uint64_t n : {1, 2, 3, 5, 16, 17, 1000, 4097}) {
    std::set<std::uint64_t> places;
    std::uint64_t unmoved = 0;
    for (std::uint64_t i = 0; i < n; ++i) {
      const std::uint64_t place = permuted(i, n, 7, "a");
      EXPECT_LT(place, n);
      places.insert(place), unmoved += place == i ? 1 : 0;
    }
    EXPECT_EQ(places.size(), n);
    if (n >= 16) {
      EXPECT_LT(unmoved, 8U) << n;  // one is expected
    }
    if (n >= 1000) {
      EXPECT_NE(permuted(3, n, 7, "a"), permuted(3, n, 7, "b"));
    }
  }
}

}  // namespace
