// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include "num/setup_math.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>

namespace setup = tofray::num::setup;

namespace {

constexpr int points = 100000;
const double infinity = std::numeric_limits<double>::infinity();
const double not_a_number = std::numeric_limits<double>::quiet_NaN();

/// Largest error over equally spaced arguments, in units in the last place of the right value. The oracle has 64 bits of mantissa.
template <class Ours, class Oracle>
double worst_ulp(double from, double to, Ours ours, Oracle oracle) {
  static_assert(std::numeric_limits<long double>::digits >= 64, "the oracle must be better than what it judges");
  double worst = 0;
  for (int i = 0; i < points; ++i) {
    const double x = from + (to - from) * (i + 0.37) / points;
    const long double right = oracle(static_cast<long double>(x));
    const double near = std::fabs(static_cast<double>(right));
    const long double ulp = static_cast<long double>(std::nextafter(near, infinity)) - static_cast<long double>(near);
    worst = std::fmax(worst, static_cast<double>(std::fabs(static_cast<long double>(ours(x)) - right) / ulp));
  }
  return worst;
}

bool same_bits(double a, double b) { return std::memcmp(&a, &b, sizeof a) == 0; }

}  // namespace

// A correctly rounded function would have 0.5 ulp; the rest is the rounding of the last few terms of the series.
constexpr double ulps = 0.9;

TEST(setup_math, sine_is_within_one_ulp) {
  const auto oracle = [](long double x) { return std::sin(x); };
  for (const double range : {1e-3, 0.8, 7.0, 1e3, 1e6, 9e8}) EXPECT_LT(worst_ulp(-range, range, setup::sin, oracle), ulps) << range;
}

TEST(setup_math, cosine_is_within_one_ulp) {
  const auto oracle = [](long double x) { return std::cos(x); };
  for (const double range : {1e-3, 0.8, 7.0, 1e3, 1e6, 9e8}) EXPECT_LT(worst_ulp(-range, range, setup::cos, oracle), ulps) << range;
}

// Next to a multiple of π/2 nearly all bits of the argument cancel; only a π/2 of many bits leaves a right rest.
TEST(setup_math, sine_and_cosine_are_within_one_ulp_next_to_their_zeros) {
  const long double half_pi = std::acos(-1.0L) / 2;
  double worst = 0;
  for (int k = 1; k < 640000; ++k) {
    const auto x = static_cast<double>(half_pi * k);
    const long double right = k % 2 ? std::cos(static_cast<long double>(x)) : std::sin(static_cast<long double>(x));
    const double near = std::fabs(static_cast<double>(right));
    const double ulp = std::nextafter(near, infinity) - near;
    const double ours = k % 2 ? setup::cos(x) : setup::sin(x);
    worst = std::fmax(worst, static_cast<double>(std::fabs(static_cast<long double>(ours) - right)) / ulp);
  }
  EXPECT_LT(worst, ulps);
}

TEST(setup_math, tangent_is_within_one_ulp) {
  const auto oracle = [](long double x) { return std::tan(x); };
  for (const double range : {1e-3, 1.5707, 7.0, 1e3, 1e6}) EXPECT_LT(worst_ulp(-range, range, setup::tan, oracle), ulps) << range;
}

TEST(setup_math, inverse_angles_are_within_one_ulp) {
  for (const double range : {1e-9, 0.5, 1.0})
    EXPECT_LT(worst_ulp(-range, range, setup::asin, [](long double x) { return std::asin(x); }), ulps) << range;
  for (const double range : {1e-9, 0.5, 1.0})
    EXPECT_LT(worst_ulp(-range, range, setup::acos, [](long double x) { return std::acos(x); }), ulps) << range;
  EXPECT_LT(worst_ulp(1 - 1e-9, 1.0, setup::acos, [](long double x) { return std::acos(x); }), ulps);
  for (const double range : {1e-9, 0.07, 1.0, 3.0, 1e3, 1e300})
    EXPECT_LT(worst_ulp(-range, range, setup::atan, [](long double x) { return std::atan(x); }), ulps) << range;
  for (const double x : {-3.7, 1e-3, 2.9e5, -1e-200}) {
    const auto ours = [x](double y) { return setup::atan2(y, x); };
    const auto oracle = [x](long double y) { return std::atan2(y, static_cast<long double>(x)); };
    for (const double range : {1e-5, 5.0, 1e7}) EXPECT_LT(worst_ulp(-range, range, ours, oracle), ulps) << x << " " << range;
  }
}

TEST(setup_math, exponential_logarithm_and_power_are_within_one_ulp) {
  const auto exp = [](long double x) { return std::exp(x); };
  for (const double range : {1e-3, 1.0, 700.0}) EXPECT_LT(worst_ulp(-range, range, setup::exp, exp), ulps) << range;
  const auto log = [](long double x) { return std::log(x); };
  EXPECT_LT(worst_ulp(0.99, 1.01, setup::log, log), ulps);
  for (const double range : {1e-310, 1e-300, 1.0, 3.0, 1e10, 1e300}) EXPECT_LT(worst_ulp(0, range, setup::log, log), ulps) << range;
  for (const double y : {0.5, -2.0, 8.0, 1e-3, 77.7, -137.25}) {
    const auto ours = [y](double x) { return setup::pow(x, y); };
    const auto oracle = [y](long double x) { return std::pow(x, static_cast<long double>(y)); };
    EXPECT_LT(worst_ulp(0.01, 100.0, ours, oracle), ulps) << y;
    EXPECT_LT(worst_ulp(0.99, 1.01, ours, oracle), ulps) << y;
  }
}

TEST(setup_math, hypotenuse_neither_overflows_nor_loses_bits) {
  for (const double unit : {1e-300, 1.0, 1e300}) {
    const auto ours = [unit](double x) { return setup::hypot(x * unit, unit); };
    const auto oracle = [unit](long double x) {
      return std::hypot(static_cast<long double>(static_cast<double>(x) * unit), static_cast<long double>(unit));
    };
    EXPECT_LT(worst_ulp(-7.0, 7.0, ours, oracle), 0.51) << unit;
  }
  EXPECT_EQ(setup::hypot(3e307, -4e307), 5e307);
  EXPECT_EQ(setup::hypot(3 * 0x1p-1074, 4 * 0x1p-1074), 5 * 0x1p-1074);
  EXPECT_EQ(setup::hypot(-infinity, not_a_number), infinity);
  EXPECT_TRUE(std::isnan(setup::hypot(not_a_number, 1)));
}

TEST(setup_math, complementary_error_function_keeps_14_digits_down_to_the_smallest_normal_number) {
  double worst = 0;
  for (int i = 0; i < points; ++i) {
    const double x = -3.0 + 29.2 * i / points;
    const long double right = std::erfc(static_cast<long double>(x));
    worst = std::fmax(worst, static_cast<double>(std::fabs(static_cast<long double>(setup::erfc(x)) / right - 1)));
  }
  EXPECT_LT(worst, 2e-15);
  EXPECT_EQ(setup::erfc(0), 1.0);
  EXPECT_EQ(setup::erfc(infinity), 0.0);
  EXPECT_EQ(setup::erfc(-infinity), 2.0);
  EXPECT_TRUE(std::isnan(setup::erfc(not_a_number)));
}

TEST(setup_math, identities_hold) {
  for (int i = 1; i < points; ++i) {
    const double x = 0.001 * i;
    EXPECT_NEAR(setup::sin(x) * setup::sin(x) + setup::cos(x) * setup::cos(x), 1.0, 4e-16);
    EXPECT_EQ(setup::sin(-x), -setup::sin(x));
    EXPECT_EQ(setup::cos(-x), setup::cos(x));
    EXPECT_DOUBLE_EQ(setup::pow(x, 2.0), x * x);  // to 4 ulp; each side is rounded
    EXPECT_DOUBLE_EQ(setup::pow(x, 0.5), std::sqrt(x));
    EXPECT_EQ(setup::pow(-x, 3.0), -setup::pow(x, 3.0));
    EXPECT_NEAR(setup::log(setup::exp(x)), x < 700 ? x : infinity, 2.3e-16 * std::fmax(1.0, x));
    EXPECT_NEAR(setup::sin(setup::asin(1e-5 * i)), 1e-5 * i, 2.3e-16);
  }
}

TEST(setup_math, special_values_are_those_of_iso_c) {
  const double pi = 3.141592653589793;
  for (const double zero : {0.0, -0.0}) {
    for (const auto function : {setup::sin, setup::tan, setup::asin, setup::atan}) EXPECT_TRUE(same_bits(function(zero), zero));
    EXPECT_EQ(setup::cos(zero), 1.0);
    EXPECT_EQ(setup::exp(zero), 1.0);
    EXPECT_EQ(setup::log(zero), -infinity);
    EXPECT_EQ(setup::pow(not_a_number, zero), 1.0);
  }
  for (const double bad : {not_a_number, infinity, -infinity, 1.1e9})
    for (const auto function : {setup::sin, setup::cos, setup::tan, setup::asin, setup::acos}) EXPECT_TRUE(std::isnan(function(bad)));
  EXPECT_TRUE(same_bits(setup::acos(1), 0.0));
  EXPECT_EQ(setup::acos(-1), pi);
  EXPECT_EQ(setup::asin(-1), -pi / 2);
  EXPECT_EQ(setup::atan(-infinity), -pi / 2);
  EXPECT_EQ(setup::exp(infinity), infinity);
  EXPECT_EQ(setup::exp(-infinity), 0.0);
  EXPECT_EQ(setup::exp(709.79), infinity);
  EXPECT_EQ(setup::exp(-745.1), 0x1p-1074);
  EXPECT_EQ(setup::exp(-745.2), 0.0);
  EXPECT_TRUE(std::isnan(setup::exp(not_a_number)));
  EXPECT_TRUE(std::isnan(setup::log(-1)));
  EXPECT_EQ(setup::log(infinity), infinity);
  EXPECT_TRUE(same_bits(setup::log(1), 0.0));
}

TEST(setup_math, atan2_knows_its_quadrants) {
  const double values[] = {-infinity, -2.0, -1e-320, -0.0, 0.0, 1e-320, 2.0, infinity};
  for (const double y : values)
    for (const double x : values)
      EXPECT_TRUE(same_bits(setup::atan2(y, x), static_cast<double>(std::atan2(static_cast<long double>(y), static_cast<long double>(x)))))
          << y << " " << x;
  EXPECT_TRUE(std::isnan(setup::atan2(not_a_number, 1)));
  EXPECT_TRUE(std::isnan(setup::atan2(1, not_a_number)));
}

TEST(setup_math, powers_of_special_values_are_those_of_iso_c) {
  const double values[] = {-infinity, -3.0, -2.5, -1.0, -0.5, -0.0, 0.0, 0.5, 1.0, 2.0, 3.0, 0x1p1000, 0x1p-1000, infinity};
  for (const double x : values)
    for (const double y : values) {
      const double right = std::pow(x, y), ours = setup::pow(x, y);
      EXPECT_TRUE(std::isnan(right) ? std::isnan(ours) : same_bits(ours, right)) << x << "^" << y << ": " << ours << " for " << right;
    }
}

// 240,000 results from arguments that are exact everywhere: another compiler or CPU that differs in a single bit is caught.
TEST(setup_math, bits_are_the_same_on_every_machine) {
  std::uint64_t hash = 14695981039346656037ULL;  // FNV-1a over 64-bit words
  const auto take = [&hash](double value) {
    std::uint64_t bits;
    std::memcpy(&bits, &value, sizeof bits);
    hash = (hash ^ bits) * 1099511628211ULL;
  };
  for (int i = 1; i <= 20000; ++i) {
    const double x = i * 0x1.3c6ef372fe95p-9, small = i * 0x1.9p-15;
    for (const auto function : {setup::sin, setup::cos, setup::tan, setup::atan, setup::log, setup::erfc}) take(function(x));
    for (const auto function : {setup::exp, setup::asin, setup::acos}) take(function(small));
    take(setup::pow(x, 2.2 - small));
    take(setup::atan2(small - 0.3, 1.0 - x));
    take(setup::hypot(x, small));
  }
  EXPECT_EQ(hash, 4448604039199248960ULL);
}
