// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include "base/curve.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

#include "support/random.h"

using tofray::Curve;
using tofray::base::ClampedCurve;
using tofray::test::Random;

namespace {

/// Shares at places whose distances differ by up to a factor of 1000; `rough`: with no order, else in steps of any height, also flat ones.
Curve random_curve(Random& random, bool rough) {
  Curve curve;
  const int samples = 2 + static_cast<int>(random.between(0, 9));
  double x = 0, y = 0;
  for (int i = 0; i < samples; ++i) {
    x += random.scale(1, 1000);
    y = rough ? random.between(0, 1) : std::min(1.0, y + (i % 3 == 1 ? 0 : random.scale(1e-6, 0.5)));
    curve.x.push_back(x);
    curve.y.push_back(y);
  }
  return curve;
}

/// Whether the curve runs from each sample to the next without turning, at 200 places between them.
void expect_no_turns(const Curve& curve) {
  const ClampedCurve f(curve, "a test");
  for (std::size_t i = 1; i < curve.x.size(); ++i) {
    const double up = curve.y[i] >= curve.y[i - 1] ? 1 : -1;
    double before = curve.y[i - 1];
    for (int k = 1; k <= 200; ++k) {
      const double now = f.evaluate(curve.x[i - 1] + (curve.x[i] - curve.x[i - 1]) * k / 200);
      ASSERT_GE(up * (now - before), -1e-14) << "after sample " << i - 1 << ", " << k;  // rounding of numbers up to 1
      before = now;
    }
    ASSERT_NEAR(before, curve.y[i], 1e-14);
  }
}

}  // namespace

// The not-a-knot spline goes from −1.28 to 2.62 on such tables.
TEST(curve, of_shares_stays_within_its_samples_however_they_lie) {
  Random random(1);
  for (int i = 0; i < 3000; ++i) ASSERT_NO_FATAL_FAILURE(expect_no_turns(random_curve(random, true))) << i;
}

TEST(curve, rises_where_its_samples_rise_and_is_flat_where_they_are) {
  Random random(2);
  for (int i = 0; i < 3000; ++i) ASSERT_NO_FATAL_FAILURE(expect_no_turns(random_curve(random, false))) << i;
}

// Rounding is limited, too: a share of 1 is not 1 + 2e-16.
TEST(curve, never_leaves_the_range_of_its_samples_by_a_single_bit) {
  Random random(3);
  for (int i = 0; i < 1000; ++i) {
    Curve curve = random_curve(random, true);
    for (double& y : curve.y) y = std::round(y);
    const ClampedCurve f(curve, "a test");
    for (int k = 0; k < 300; ++k) {
      const double y = f.evaluate(random.between(curve.x.front() - 1, curve.x.back() + 1));
      ASSERT_TRUE(y >= 0 && y <= 1) << y;
    }
  }
}

// A silicon pixel's efficiency, as SciPy 1.10's CubicSpline reads it: where a spline does not turn, it is left as it is.
TEST(curve, that_is_smooth_is_the_not_a_knot_spline) {
  const Curve efficiency{{850, 855, 860, 865, 870, 880, 900}, {.41, .405, .397, .39, .381, .36, .31}};
  const ClampedCurve f(efficiency, "a test");
  for (const auto& [x, value] :
       {std::pair{852.5, .408259692513369}, {862.5, .3935290775401069}, {875.0, .37083556149732616}, {890.0, .3363262032085561}})
    EXPECT_NEAR(f.evaluate(x), value, 1e-13) << x;
}

// 0 and 0.9 a nanometre apart: halfway up in the middle, and flat on either side. Slopes of 0 at both ends make 3s² − 2s³.
TEST(curve, has_edges_without_ringing) {
  const ClampedCurve f({{800, 840, 841, 859, 860, 900}, {0, 0, .9, .9, 0, 0}}, "a test");
  for (const double x : {801.0, 820.0, 839.9}) EXPECT_EQ(f.evaluate(x), 0);
  for (const double x : {841.1, 850.0, 858.0}) EXPECT_EQ(f.evaluate(x), .9);
  EXPECT_NEAR(f.evaluate(840.5), .45, 1e-13);
  EXPECT_NEAR(f.evaluate(840.25), .9 * (3. / 16 - 2. / 64), 1e-13);
}

// One bad piece is mended with the slopes at its ends; pieces that share no such slope stay as they were.
TEST(curve, is_limited_only_where_the_spline_would_turn) {
  const std::vector<double> x{0, 1, 2, 3, 4, 5, 6, 7}, y{.1, .15, .21, .28, .36, .36, .45, .6};
  const ClampedCurve limited({x, y}, "a test");
  const tofray::base::Spline free(x, y);
  for (const double at : {.3, 1.5, 2.7, 6.5}) EXPECT_EQ(limited.evaluate(at), free.evaluate(at)) << at;
  EXPECT_LT(free.evaluate(4.6), .36);
  EXPECT_EQ(limited.evaluate(4.6), .36);
}

// x³ + x/10 rises everywhere, though at x = 1 with four times the secant before it: a limit of three for each slope would bend it.
TEST(curve, keeps_a_cubic_that_rises_however_its_slopes_differ) {
  const auto cubic = [](double x) { return x * x * x + 0.1 * x; };
  const ClampedCurve f({{-0.5, 1, 2, 3}, {cubic(-0.5), cubic(1), cubic(2), cubic(3)}}, "a test");
  for (int i = 0; i <= 350; ++i) EXPECT_NEAR(f.evaluate(-0.5 + 0.01 * i), cubic(-0.5 + 0.01 * i), 1e-13 * 27) << i;
}

// 1e-310 from sample to sample: slopes that no number holds. What is left runs between the samples all the same.
TEST(curve, of_samples_closer_than_numbers_can_tell_has_a_value_everywhere) {
  const ClampedCurve curve(Curve{{0, 1e-310, 1}, {1, 0.8, 0.3}}, "it");
  for (const double x : {0.0, 5e-311, 1e-310, 1e-300, 0.1, 0.5, 0.999, 1.0}) {
    const double y = curve.evaluate(x);
    EXPECT_TRUE(y >= 0.3 && y <= 1) << x << " " << y;
  }
}

TEST(curve, of_one_sample_is_a_constant_and_of_two_a_line_held_at_its_ends) {
  const ClampedCurve one({{850}, {.4}}, "a test"), two({{800, 900}, {.2, .6}}, "a test");
  for (const double x : {0.0, 850.0, 1e9}) EXPECT_EQ(one.evaluate(x), .4);
  EXPECT_EQ(two.evaluate(700), .2);
  EXPECT_NEAR(two.evaluate(825), .3, 1e-15);
  EXPECT_EQ(two.evaluate(1000), .6);
}
