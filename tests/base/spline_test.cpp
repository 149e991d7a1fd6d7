// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include "base/spline.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "tofray/error.h"

using tofray::base::Spline;

namespace {

// Rounding: some ten operations on numbers of size one.
constexpr double tolerance = 1e-13;

using Points = std::vector<std::pair<double, double>>;

void expect_values(const Spline& spline, const Points& points) {
  for (const auto& [x, value] : points) EXPECT_NEAR(spline.evaluate(x), value, tolerance) << "at " << x;
}

const std::vector<double> sine_knots{0, .5, 1.3, 2, 2.9, 3.1, 4, 5.5};

Spline sine_spline() {
  std::vector<double> y;
  for (const double x : sine_knots) y.push_back(std::sin(x));
  return {sine_knots, y};
}

Spline ring() { return {{0, .3, .7, 1.1, 1.9, 2.5, 3.0}, {1.0, 2.0, -1.0, .5, .25, 3.0, 1.0}, Spline::Kind::periodic}; }

std::string refusal(std::vector<double> x, std::vector<double> y, Spline::Kind kind = Spline::Kind::not_a_knot) {
  try {
    const Spline spline(std::move(x), std::move(y), kind);
  } catch (const tofray::Error& error) {
    EXPECT_EQ(error.kind(), tofray::ErrorKind::bad_input);
    return error.what();
  }
  return "not refused";
}

}  // namespace

// Expected values: SciPy 1.10's CubicSpline, to which Octave 7.3's spline agrees within 3e-15.
TEST(spline_not_a_knot, agrees_with_other_programs_on_a_sine) {
  expect_values(sine_spline(), {{.25, .2493319848714629},
                                {.9, .781226901833852},
                                {1.65, .9966383342997924},
                                {2.45, .6365299531732319},
                                {3, .14101221345312262},
                                {3.55, -.39189793903730663},
                                {4.75, -1.0492074757091494},
                                {-.1, -.10275639182358995},
                                {5.6, -.5966962780729304}});
}

TEST(spline_not_a_knot, agrees_with_other_programs_on_a_quantum_efficiency) {
  const Spline spline({850, 855, 860, 865, 870, 880, 900}, {.41, .405, .397, .39, .381, .36, .31});
  expect_values(spline, {{852.5, .408259692513369}, {862.5, .3935290775401069}, {875, .37083556149732616}, {890, .3363262032085561}});
}

TEST(spline_not_a_knot, agrees_with_other_programs_on_a_triangle_wave) {
  const double pi = 3.141592653589793;
  std::vector<double> x, y;
  for (int i = 0; i < 9; ++i) {
    x.push_back(2 * pi * i / 8);
    y.push_back(std::fabs(i - 4.0) / 2 - 1);
  }
  expect_values(Spline(x, y), {{pi / 8, .7572115384615384}, {pi - .2, -.9499171699628238}, {1.7 * pi, .3963076923076923}});
}

TEST(spline_not_a_knot, goes_through_its_knots_with_continuous_second_derivative) {
  const Spline spline = sine_spline();
  const double step = 1e-5;
  for (std::size_t i = 0; i < sine_knots.size(); ++i) {
    const double x = sine_knots[i];
    EXPECT_DOUBLE_EQ(spline.evaluate(x), spline.y()[i]);
    const double left = (spline.derivative(x - step) - spline.derivative(x - 2 * step)) / step;
    const double right = (spline.derivative(x + 2 * step) - spline.derivative(x + step)) / step;
    EXPECT_NEAR(left, right, 1e-3) << x;  // 3 steps of a third derivative below 10, and 1e-16 over the step
  }
}

TEST(spline_not_a_knot, slopes_and_areas_are_those_of_its_pieces) {
  const Spline spline = sine_spline();
  EXPECT_NEAR(spline.derivative(.25), .9658842999579227, tolerance);
  EXPECT_NEAR(spline.derivative(1.65), -.07948322807655098, tolerance);
  EXPECT_NEAR(spline.derivative(-.1), 1.032264164567612, tolerance);
  EXPECT_NEAR(spline.derivative(5.6), 1.1719355839990433, tolerance);
  EXPECT_NEAR(spline.integral(.25, 4.75), .9158905050624567, tolerance);
  EXPECT_NEAR(spline.integral(-.1, 5.6), .17048095240054018, tolerance);
  EXPECT_EQ(spline.integral(4.75, .25), -spline.integral(.25, 4.75));
  EXPECT_EQ(spline.integral(2, 2), 0.0);
}

TEST(spline_not_a_knot, three_samples_make_a_parabola_and_four_a_cubic) {
  expect_values(Spline({0, 1, 2}, {1, 0, 3}), {{.5, 0.0}, {1.5, 1.0}, {2.5, 6.0}});
  expect_values(Spline({0, 1, 2, 3}, {0, 1, -1, 2}), {{.5, 1.375}, {1.5, -.125}, {2.5, -.625}, {3.5, 7.875}});
}

TEST(spline_not_a_knot, two_samples_make_a_line) {
  const Spline line({1, 3}, {5, 9});
  expect_values(line, {{0, 3.0}, {2, 7.0}, {10, 23.0}});
  EXPECT_EQ(line.derivative(2.7), 2.0);
  EXPECT_NEAR(line.integral(0, 3), 18.0, tolerance);
}

TEST(spline_not_a_knot, reproduces_every_cubic_everywhere) {
  const auto cubic = [](double x) { return 0.3 - x * (0.7 - x * (0.11 + 0.05 * x)); };
  const auto slope = [](double x) { return -0.7 + x * (0.22 + 0.15 * x); };
  const auto area = [](double x) { return x * (0.3 - x * (0.35 - x * (0.11 / 3 + 0.0125 * x))); };
  for (std::size_t n = 4; n <= 12; ++n) {
    std::vector<double> x, y;
    for (std::size_t i = 0; i < n; ++i) {
      x.push_back(-1.0 + 0.3 * static_cast<double>(i) + 0.1 * static_cast<double>(i % 3));
      y.push_back(cubic(x.back()));
    }
    const Spline spline(x, y);
    for (double at = x.front() - 1; at < x.back() + 1; at += 0.0371) {
      const bool inside = at >= x.front() && at <= x.back();
      const double error = inside ? tolerance : 10 * tolerance;  // beyond the ends rounding grows with the cube of the distance
      EXPECT_NEAR(spline.evaluate(at), cubic(at), error);
      EXPECT_NEAR(spline.derivative(at), slope(at), 10 * error);  // a division by knot distances of 0.2
      EXPECT_NEAR(spline.integral(-0.5, at), area(at) - area(-0.5), error);
    }
  }
}

// Expected values: SciPy 1.10's CubicSpline with bc_type='periodic'.
TEST(spline_periodic, agrees_with_another_program) {
  const Spline spline = ring();
  expect_values(spline, {{.15, 1.6258367839844976},
                         {.5, .5869256468904587},
                         {1.3, .813864198501067},
                         {2.2, 1.9650187470013085},
                         {2.9, 1.0808157272140702},
                         {-.4, 2.6805377380341806},
                         {3.7, -1.0},
                         {7.45, .5879415203812884}});
  EXPECT_NEAR(spline.derivative(.15), 5.011255999109354, tolerance);
  EXPECT_NEAR(spline.derivative(2.9), -2.938524656839231, tolerance);
  EXPECT_NEAR(spline.integral(0, 3), 2.898608689178234, tolerance);
  EXPECT_NEAR(spline.integral(.2, 2.2), .8801522504501482, tolerance);
  EXPECT_NEAR(spline.integral(.2 - 6, 2.2 + 3), .8801522504501482 + 3 * 2.898608689178234, 1e-12);
}

TEST(spline_periodic, closes_smoothly) {
  const Spline spline = ring();
  EXPECT_NEAR(spline.derivative(0), spline.derivative(std::nextafter(3.0, 0.0)), 1e-12);
  for (const double x : {-7.3, .1, 2.99}) EXPECT_NEAR(spline.evaluate(x), spline.evaluate(x + 9), 1e-12);
}

TEST(spline_periodic, works_with_four_three_and_two_knots) {
  expect_values(Spline({0, 1, 3, 4.5}, {1, 2, -1, 1}, Spline::Kind::periodic), {{.5, 1.7716346153846154},
                                                                                {1.3, 1.7590673076923073},
                                                                                {2.2, .07569230769230734},
                                                                                {3.3, -.9350769230769234},
                                                                                {4.2, .4227692307692312}});
  expect_values(Spline({0, 1, 3}, {1, 2, 1}, Spline::Kind::periodic), {{.5, 1.5}, {1.3, 2.0285}, {2.2, 1.304}, {2.9, .9645}});
  expect_values(Spline({0, 1}, {4, 4}, Spline::Kind::periodic), {{-3.3, 4.0}, {.5, 4.0}});
}

TEST(spline_linear, joins_the_samples_by_lines) {
  const Spline lines({0, 1, 3}, {1, 2, -2}, Spline::Kind::linear);
  expect_values(lines, {{-1, 0.0}, {.5, 1.5}, {1, 2.0}, {2, 0.0}, {4, -4.0}});
  EXPECT_EQ(lines.derivative(1), -2.0);
  EXPECT_NEAR(lines.integral(0.5, 2), 0.875 + 1.0, tolerance);
}

TEST(spline_refuses, what_is_no_curve) {
  const double nan = std::numeric_limits<double>::quiet_NaN(), infinity = std::numeric_limits<double>::infinity();
  EXPECT_NE(refusal({}, {}).find("at least 2 samples\n  got 0"), std::string::npos);
  EXPECT_NE(refusal({1}, {1}).find("at least 2 samples\n  got 1"), std::string::npos);
  EXPECT_NE(refusal({0, 1, 2}, {1, 2}).find("got 3 positions and 2 values"), std::string::npos);
  EXPECT_NE(refusal({0, 1, 1, 2}, {1, 2, 3, 4}).find("got x = 1 twice"), std::string::npos);
  EXPECT_NE(refusal({0, 2, 1, 3}, {1, 2, 3, 4}).find("got x = 1 after 2"), std::string::npos);
  EXPECT_NE(refusal({0, nan, 2}, {1, 2, 3}).find("sample 1 of a curve is not a finite number"), std::string::npos);
  EXPECT_NE(refusal({0, 1, 2}, {1, 2, nan}).find("sample 2 of a curve is not a finite number"), std::string::npos);
  EXPECT_NE(refusal({0, 1, infinity}, {1, 2, 3}).find("not a finite number"), std::string::npos);
  EXPECT_NE(refusal({0, 1, 2}, {1, 2, 3}, Spline::Kind::periodic).find("must end with the value it starts with"), std::string::npos);
}
