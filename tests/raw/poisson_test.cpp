// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "support/bench.h"

using namespace tofray;
using namespace tofray::test;

namespace {

/// P(N = n), in logarithms so that nothing overflows.
double poisson(double mean, double n) { return std::exp(n * std::log(mean) - mean - std::lgamma(n + 1)); }

/// Cells between whole numbers, each with a chance of about 1 in 200, and their chances.
struct Cells {
  std::vector<double> upper, chance;  // counts up to and including upper[i]
};

Cells cells_of(double mean) {
  const double spread = 9 * std::sqrt(mean) + 12, first = std::max(0.0, std::floor(mean - spread));
  Cells out;
  double share = 0, sum = 0;
  for (double n = first; n < mean + spread; ++n) {
    share += poisson(mean, n);
    if (share < 0.005) continue;
    out.upper.push_back(n), out.chance.push_back(share);
    sum += share, share = 0;
  }
  out.upper.push_back(1e30), out.chance.push_back(1 - sum);
  return out;
}

camera::SensorView sensor(std::uint32_t seed) {
  camera::SensorView s{};
  s.keys = num::round_keys(seed, 0), s.noise = camera::Noise::apart;
  return s;
}

class Poisson : public testing::TestWithParam<double> {};

constexpr int draws = 1'000'000;

}  // namespace

// Mean, variance and every cell of the distribution, both taps, 1e6 draws each: 66 statistics, |z| < 5: false alarm 4e-5 over
// fresh seeds.
TEST_P(Poisson, has_mean_variance_and_shape) {
  const double mean = GetParam();
  const auto s = sensor(77);
  const Cells cells = cells_of(mean);
  for (const bool second_tap : {false, true}) {
    Moments moments(mean);
    std::vector<double> seen(cells.upper.size()), expected;
    for (const double chance : cells.chance) expected.push_back(chance * draws);
    for (int i = 0; i < draws; ++i) {
      const auto got = raw::expose_apart<float>(s, {static_cast<float>(mean), static_cast<float>(mean)}, i, 3, {5, 0});
      const double n = static_cast<double>(second_tap ? got.b : got.a);
      ASSERT_EQ(n, std::floor(n));
      ASSERT_GE(n, 0);
      moments.add(n);
      ++seen[static_cast<std::size_t>(std::lower_bound(cells.upper.begin(), cells.upper.end(), n) - cells.upper.begin())];
    }
    EXPECT_LT(std::abs(moments.mean() - mean) / std::sqrt(mean / draws), 5);
    // variance of the sample variance: (μ4 − σ⁴)/n with μ4 = λ + 3λ²
    EXPECT_LT(std::abs(moments.variance() - mean) / std::sqrt((mean + 2 * mean * mean) / draws), 5);
    EXPECT_LT(std::abs(chi_square_z(seen, expected)), 5) << cells.upper.size() << " cells";
  }
}

INSTANTIATE_TEST_SUITE_P(means, Poisson, testing::Values(0.1, 1.0, 3.0, 9.9, 10.1, 15.9, 16.1, 30.0, 1e3, 1e5, 1e7), [](const auto& which) {
  std::string name = std::to_string(which.param);
  std::replace(name.begin(), name.end(), '.', '_');
  return name;
});

TEST(poisson, of_nothing_is_nothing) {
  const auto s = sensor(1);
  for (int i = 0; i < 1000; ++i) {
    const auto got = raw::expose_apart<float>(s, {0.0f, 0.0f}, i, 0, {0, 0});
    ASSERT_EQ(got.a, 0.0f);
    ASSERT_EQ(got.b, 0.0f);
  }
}

// One tap below the switch and one above: the small one takes bits that the normals leave over, or words of its own. Its distribution is as
// if alone, and it knows nothing of the other tap nor of the read noise; likewise where both are small. 1e6 draws, |z| < 5.
TEST(poisson, of_a_small_tap_beside_a_large_one_is_its_own) {
  auto silent = sensor(2), noisy = silent;
  noisy.read_noise = 10;
  for (const auto& [mean_a, mean_b] : {std::pair{8.0, 1000.0}, std::pair{1000.0, 8.0}, std::pair{8.0, 8.0}}) {
    const bool small_first = mean_a < 16;
    const Cells cells = cells_of(8);
    std::vector<double> seen(cells.upper.size()), expected;
    for (const double chance : cells.chance) expected.push_back(chance * draws);
    Correlation taps(mean_a, mean_b), read_a(8, 0), read_b(8, 0), reads(0, 0), spread(8, 0), read_spread(8, 200);
    for (int i = 0; i < draws; ++i) {
      const effect::TapPair<float> means{static_cast<float>(mean_a), static_cast<float>(mean_b)};
      const auto got = raw::expose_apart<float>(silent, means, i, 1, {3, 0}),
                 with_read = raw::expose_apart<float>(noisy, means, i, 1, {3, 0});
      const double small = static_cast<double>(small_first ? got.a : got.b);
      ++seen[static_cast<std::size_t>(std::lower_bound(cells.upper.begin(), cells.upper.end(), small) - cells.upper.begin())];
      const double ra = static_cast<double>(with_read.a - got.a), rb = static_cast<double>(with_read.b - got.b);
      taps.add(static_cast<double>(got.a), static_cast<double>(got.b));
      read_a.add(small, ra), read_b.add(small, rb), reads.add(ra, rb);
      const double other = small_first ? static_cast<double>(got.b) - mean_b : static_cast<double>(got.a) - mean_a;
      spread.add(small, other * other), read_spread.add(small, ra * ra + rb * rb);  // nor of how far they go
    }
    EXPECT_LT(std::abs(chi_square_z(seen, expected)), 5) << mean_a << " " << mean_b;
    for (const auto* pair : {&taps, &read_a, &read_b, &reads, &spread, &read_spread})
      EXPECT_LT(std::abs(pair->z()), 5) << mean_a << " " << mean_b;
  }
}

// Against the formula in double: N = ⌊λ + √λ·z + (z² + 2)/6 − (z + z³/2)/(36√λ)⌋, wherever that is not within rounding of a whole number
// (the last term is worked out to 0.2 %).
TEST(poisson, by_expansion_is_that_of_the_formula) {
  for (const double mean : {16.0, 16.7, 23.0, 100.3, 1e3, 1e4}) {
    const double held = static_cast<double>(static_cast<float>(mean));
    int compared = 0;
    for (int i = -5900; i <= 5900; ++i) {
      const float z = static_cast<float>(i) * 0.001f;
      const double x = static_cast<double>(z), last = (x + x * x * x / 2) / (36 * std::sqrt(held));
      const double exact = held + std::sqrt(held) * x + (x * x + 2) / 6 - last;
      if (std::abs(exact - std::round(exact)) < 0.002 * std::abs(last) + 4e-7 * held + 2e-6) continue;
      ASSERT_EQ(static_cast<double>(raw::poisson_by_expansion(static_cast<float>(mean), z)), std::max(0.0, std::floor(exact)))
          << mean << " " << x;
      ++compared;
    }
    EXPECT_GT(compared, 11'000) << mean;
  }
}

// The expansion is monotone in z: no count is out of order, and z = 0 gives the median.
TEST(poisson, by_expansion_grows_with_the_normal_it_comes_from) {
  for (const float mean : {16.0f, 30.0f, 1e3f, 1e5f}) {
    float before = -1;
    for (int i = -600; i <= 600; ++i) {
      const float n = raw::poisson_by_expansion(mean, static_cast<float>(i) * 0.01f);
      ASSERT_GE(n, before) << mean << " at " << i;
      before = n;
    }
    EXPECT_EQ(raw::poisson_by_expansion(mean, 0.0f), mean);  // the median of a whole mean is the mean
  }
}
