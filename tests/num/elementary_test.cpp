// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include "num/elementary.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

#include "support/statistics.h"

using namespace tofray;
using test::two_pi;

namespace {

/// Two million arguments over [low, high], evenly spread, ends included, and as many at random.
template <class Check>
void sweep(double low, double high, Check check) {
  constexpr int count = 1'000'000;
  std::mt19937_64 random(11);
  for (int i = 0; i <= count; ++i) {
    check(static_cast<float>(low + (high - low) * i / count));
    check(static_cast<float>(low + (high - low) * static_cast<double>(random() >> 11) * 0x1p-53));
  }
}

double wide(float a) { return static_cast<double>(a); }

/// Distance in units in the last place of the exact value.
double error_in_ulps(float got, double exact) {
  int exponent;
  std::frexp(exact, &exponent);
  return std::abs(wide(got) - exact) / std::ldexp(1.0, std::max(exponent, -125) - 24);
}

}  // namespace

TEST(wrap_turns, takes_whole_turns_off) {
  sweep(-1e6, 1e6, [](float t) {
    const float w = num::wrap_turns(t);
    ASSERT_LE(std::abs(w), 0.5f);
    ASSERT_EQ(wide(w), wide(t) - std::nearbyint(wide(t)));  // exact: both have the same grid of last places
  });
}

// Within 1.2e-7 absolutely: two units in the last place of 1. Near a zero the sine's own last places are kept.
TEST(sincos_turns, is_within_two_ulps_of_one) {
  double worst = 0;
  const auto check = [&](float t) {
    float s, c;
    num::sincos_turns(t, s, c);
    const double turns = wide(t) - std::nearbyint(wide(t));
    worst = std::max({worst, std::abs(wide(s) - std::sin(two_pi * turns)), std::abs(wide(c) - std::cos(two_pi * turns))});
  };
  sweep(-1, 1, check);
  sweep(-2e6, 2e6, check);
  sweep(-1e-6, 1e-6, check);
  EXPECT_LT(worst, 1.2e-7);
}

TEST(sincos_turns, keeps_the_last_places_of_a_small_sine) {
  sweep(1e-30, 0.01, [](float t) {
    float s, c;
    num::sincos_turns(t, s, c);
    ASSERT_LT(error_in_ulps(s, std::sin(two_pi * wide(t))), 2) << t;
  });
}

TEST(sincos_turns, is_exact_at_quarter_turns) {
  const float expected[4][2] = {{0, 1}, {1, 0}, {0, -1}, {-1, 0}};
  for (int k = -40; k <= 40; ++k) {
    float s, c;
    num::sincos_turns(0.25f * static_cast<float>(k), s, c);
    EXPECT_EQ(s, expected[k & 3][0]) << k;
    EXPECT_EQ(c, expected[k & 3][1]) << k;
  }
}

// 4e-8 turns are 2.5e-7 rad; phases near half a turn have units of 3e-8 turns.
TEST(atan2_turns, is_within_4e_8_turns) {
  double worst = 0;
  std::mt19937_64 random(12);
  const auto check = [&](float y, float x) {
    worst = std::max(worst, std::abs(wide(num::atan2_turns(y, x)) - std::atan2(wide(y), wide(x)) / two_pi));
  };
  sweep(-0.5, 0.5, [&](float t) {
    const float scale = std::ldexp(1.0f, static_cast<int>(random() % 60) - 30);
    check(scale * static_cast<float>(std::sin(two_pi * wide(t))), scale * static_cast<float>(std::cos(two_pi * wide(t))));
  });
  EXPECT_LT(worst, 4e-8);
}

TEST(atan2_turns, is_exact_on_the_axes_and_diagonals) {
  const float at[8][3] = {{0, 1, 0},     {1, 1, 0.125f},    {1, 0, 0.25f},   {1, -1, 0.375f},
                          {0, -1, 0.5f}, {-1, -1, -0.375f}, {-1, 0, -0.25f}, {-1, 1, -0.125f}};
  for (const float size : {1e-30f, 1.0f, 1e30f}) {
    for (const auto& [y, x, turns] : at) EXPECT_NEAR(num::atan2_turns(y * size, x * size), turns, 3e-8f);
  }
  EXPECT_EQ(num::atan2_turns(0.0f, 0.0f), 0.0f);
  EXPECT_EQ(num::atan2_turns(0.0f, 1.0f), 0.0f);
  EXPECT_EQ(num::atan2_turns(0.0f, -1.0f), 0.5f);
  EXPECT_EQ(num::atan2_turns(-0.0f, -1.0f), -0.5f);
}

// Two octaves hold all mantissas with either parity of the exponent; the rest is a matter of powers of two, up to the last normal numbers.
TEST(inverse_root, is_within_4e_7_of_one) {
  const auto check = [](float x) {
    const float root = std::sqrt(x);
    ASSERT_NEAR(wide(num::inverse_root(x, root)) * std::sqrt(wide(x)), 1, 4e-7) << x;
  };
  for (std::uint32_t bits = 0x3f800000u; bits < 0x40800000u; bits += 3) check(num::from_bits(bits));
  sweep(16, 1e7, check);
  for (const float end : {std::numeric_limits<float>::min(), 1e15f, std::numeric_limits<float>::max()}) check(end);
}

TEST(log, is_within_two_ulps_and_3e_8) {
  double relative = 0, absolute = 0;
  std::mt19937_64 random(13);
  const auto check = [&](float a) {
    const double exact = std::log(wide(a)), off = std::abs(wide(num::log(a)) - exact);
    absolute = std::max(absolute, off - 1.2e-7 * std::abs(exact));  // two units in the last place at worst …
    if (std::abs(exact) < 0.3) relative = std::max(relative, off / std::max(std::abs(exact), 1e-30));  // … and next to log 1 = 0 as well
  };
  for (int i = 0; i < 2'000'000; ++i)
    check(num::from_bits(0x00800000u + static_cast<std::uint32_t>(random() % 0x7f000000u)));  // every binade
  sweep(0.7, 1.42, check);
  EXPECT_LT(absolute, 3e-8);
  EXPECT_LT(relative, 2.4e-7);
  EXPECT_EQ(num::log(1.0f), 0.0f);
}

TEST(exp2, is_within_two_ulps_and_cuts_off_where_it_says) {
  double worst = 0;
  sweep(-126, 127, [&](float a) { worst = std::max(worst, error_in_ulps(num::exp2(a), std::exp2(wide(a)))); });
  EXPECT_LT(worst, 2);
  for (int k = -126; k <= 127; ++k) EXPECT_EQ(num::exp2(static_cast<float>(k)), std::ldexp(1.0f, k)) << k;
  EXPECT_EQ(num::exp2(std::nextafter(-126.0f, -200.0f)), 0.0f);
  EXPECT_EQ(num::exp2(-std::numeric_limits<float>::infinity()), 0.0f);
  EXPECT_EQ(num::exp2(1000.0f), 0x1p127f);
}

// The argument's last place counts: |a|·6e-8.
TEST(exp, is_within_the_rounding_of_its_argument) {
  sweep(-80, 80, [](float a) { ASSERT_LT(std::abs(wide(num::exp(a)) / std::exp(wide(a)) - 1), 2.4e-7 + 1.2e-7 * std::abs(wide(a))) << a; });
}

TEST(power, is_that_of_the_formula_within_the_rounding_of_its_exponent) {
  std::mt19937_64 random(14);
  for (int i = 0; i < 2'000'000; ++i) {
    const float base = static_cast<float>(static_cast<double>(random() >> 11) * 0x1p-53);
    const float exponent = static_cast<float>(static_cast<double>(random() >> 11) * 0x1p-53 * 200);
    const double exact = std::pow(wide(base), wide(exponent));
    const double argument = std::abs(wide(exponent) * std::log(std::max(wide(base), 1e-38)));
    if (argument > 86) {
      ASSERT_LT(num::power(base, exponent), 1e-36f);
    } else {
      ASSERT_LT(std::abs(wide(num::power(base, exponent)) / exact - 1), 3e-7 + 2.5e-7 * argument) << base << "^" << exponent;
    }
  }
}

TEST(power, knows_its_ends) {
  EXPECT_EQ(num::power(0.0f, 0.0f), 1.0f);
  EXPECT_EQ(num::power(0.0f, 3.0f), 0.0f);
  EXPECT_EQ(num::power(0.0f, 0.01f), 0.0f);
  EXPECT_EQ(num::power(0.5f, 0.0f), 1.0f);
  EXPECT_EQ(num::power(1.0f, 250.0f), 1.0f);
  EXPECT_NEAR(num::power(0.5f, 10.0f), 0x1p-10f, 1e-9f);
}
