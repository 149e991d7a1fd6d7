// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
// The points that stand for an area that shines.                                        [theory: rectangle-light, disk-light]
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "camera/light/area_points.h"
#include "camera/light/emitters.h"
#include "support/pi.h"
#include "tofray/tofray.h"

using namespace tofray;
using namespace tofray::test;
using base::operator+;
using base::operator-;
using base::operator*;

namespace {

Area disk_of(double radius, int points) { return {Area::Kind::disk, radius, 0, 0, points}; }
Area rectangle_of(double width, double height, int points) { return {Area::Kind::rectangle, 0, width, height, points}; }

/// Share of a disk of radius 1 on the left of x = t.
double disk_share(double t) { return t <= -1 ? 0 : t >= 1 ? 1 : 0.5 + (t * std::sqrt(1 - t * t) + std::asin(t)) / pi; }

/// Share of a rectangle where x·cos + y·sin < t: the integral of the trapezoid that its two sides make.
double rectangle_share(double width, double height, double angle, double t) {
  const double a = std::abs(width * std::cos(angle)), b = std::abs(height * std::sin(angle));
  const auto ramp = [](double x) { return x > 0 ? 0.5 * x * x : 0; };
  return (ramp(t + (a + b) / 2) - ramp(t + (a - b) / 2) - ramp(t - (a - b) / 2) + ramp(t - (a + b) / 2)) / (a * b);
}

/// How far the share of points on one side of a line is from that of the area, at worst of all lines across one direction.
template <class Share>
double worst_along(const std::vector<Vec3>& points, double angle, const Share& share) {
  std::vector<double> at;
  for (const Vec3& p : points) at.push_back(p[0] * std::cos(angle) + p[1] * std::sin(angle));
  std::sort(at.begin(), at.end());
  const auto n = static_cast<double>(at.size());
  double most = 0;
  for (std::size_t i = 0; i < at.size(); ++i) {
    const double s = share(at[i]), before = static_cast<double>(i) / n;
    most = std::max({most, std::abs(s - before), std::abs(s - before - 1 / n)});
  }
  return most;
}

/// The same of lines of all directions.
template <class Share>
double worst_of_all(const std::vector<Vec3>& points, const Share& share) {
  double most = 0;
  for (int i = 0; i < 180; ++i) {
    const double angle = pi * (i + 0.5) / 180;
    most = std::max(most, worst_along(points, angle, [&](double t) { return share(angle, t); }));
  }
  return most;
}

constexpr double shapes[][2] = {{1, 1}, {3, 1}, {1, 1.7}, {0.02, 5}, {1e-6, 10}};

}  // namespace

TEST(area_points, have_the_middle_as_their_mean_and_lie_within) {
  for (int n = 1; n <= 64; ++n) {
    Vec3 sum{0, 0, 0};
    const auto disk = camera::points_of(disk_of(0.2, n));
    ASSERT_EQ(disk.size(), static_cast<std::size_t>(n));
    for (const Vec3& p : disk) {
      EXPECT_LE(base::length(p), 0.2 * (1 + 1e-15)) << n;
      sum = sum + p;
    }
    EXPECT_LE(base::length(sum), 1e-14) << n;
    for (const auto& [width, height] : shapes) {
      const auto rectangle = camera::points_of(rectangle_of(width, height, n));
      ASSERT_EQ(rectangle.size(), static_cast<std::size_t>(n));
      sum = {0, 0, 0};
      for (const Vec3& p : rectangle) {
        EXPECT_LT(std::abs(p[0]), 0.5 * width);
        EXPECT_LT(std::abs(p[1]), 0.5 * height);
        EXPECT_EQ(p[2], 0);
        sum = sum + p;
      }
      EXPECT_LE(base::length(sum), 1e-13) << n;
    }
  }
  const auto point = camera::points_of({});
  ASSERT_EQ(point.size(), 1U);
  EXPECT_EQ(point[0], (Vec3{0, 0, 0}));
}

// Lines along x or y: off by half a point and no more, which is the least that n equal points can be off. Of 57 points in a disk two are
// held to its rim, a seventh of a percent of its radius from where they should be.
TEST(area_points, stand_in_columns_and_rows_of_their_own) {
  for (int n = 1; n <= 64; ++n) {
    const double least = 0.5 / n + 1e-12;
    for (const double angle : {0.0, pi / 2}) {
      EXPECT_LE(worst_along(camera::points_of(disk_of(1, n)), angle, disk_share), n == 57 ? 1.1 * least : least) << n;
    }
    for (const auto& [width, height] : shapes) {
      const auto points = camera::points_of(rectangle_of(width, height, n));
      const double w = width, h = height;
      EXPECT_LE(worst_along(points, 0, [&](double t) { return t / w + 0.5; }), least) << n << " " << width;
      EXPECT_LE(worst_along(points, pi / 2, [&](double t) { return t / h + 0.5; }), least) << n << " " << width;
    }
  }
}

// Lines of any direction: no set of n points does better than a constant times n^−¾.
TEST(area_points, are_even_in_all_directions) {
  for (int n = 8; n <= 64; ++n) {
    const double order = std::pow(n, -0.75);
    EXPECT_LT(worst_of_all(camera::points_of(disk_of(1, n)), [](double, double t) { return disk_share(t); }), 1.35 * order) << n;
    EXPECT_LT(worst_of_all(camera::points_of(rectangle_of(1, 1, n)), [](double a, double t) { return rectangle_share(1, 1, a, t); }),
              1.7 * order)
        << n;
    EXPECT_LT(worst_of_all(camera::points_of(rectangle_of(1.6, 1, n)), [](double a, double t) { return rectangle_share(1.6, 1, a, t); }),
              2.2 * order)
        << n;
  }
}

// Circles about the middle hold their share of the points, ∫x² dA/A = R²/4 and w²/12.
TEST(area_points, have_the_second_moments_of_their_area) {
  for (int n = 8; n <= 64; ++n) {
    Vec3 square{0, 0, 0};
    std::vector<double> shares;
    for (const Vec3& p : camera::points_of(disk_of(1, n))) {
      square = square + Vec3{p[0] * p[0], p[1] * p[1], p[0] * p[1]};
      shares.push_back(base::dot(p, p));
    }
    EXPECT_NEAR(4 * square[0] / n, 1, 0.4 / n);
    EXPECT_NEAR(4 * square[1] / n, 1, 0.4 / n);
    EXPECT_NEAR(4 * square[2] / n, 0, 3.7 / n);
    std::sort(shares.begin(), shares.end());
    for (int i = 0; i < n; ++i) EXPECT_NEAR(shares[static_cast<std::size_t>(i)], (i + 0.5) / n, 5 / static_cast<double>(n)) << n;
    square = {0, 0, 0};
    for (const Vec3& p : camera::points_of(rectangle_of(2, 3, n))) square = square + Vec3{p[0] * p[0] / 4, p[1] * p[1] / 9, 0};
    EXPECT_NEAR(12 * square[0] / n, 1, 1.001 / (n * n));
    EXPECT_NEAR(12 * square[1] / n, 1, 1.001 / (n * n));
  }
}

// Cells are squares as far as that goes: no two points are close together, and none stand along a diagonal.
TEST(area_points, keep_apart) {
  const auto nearest = [](const std::vector<Vec3>& points) {
    double least = 1e30;
    for (std::size_t i = 0; i < points.size(); ++i) {
      for (std::size_t k = 0; k < i; ++k) least = std::min(least, base::length(points[i] - points[k]));
    }
    return least;
  };
  for (int n = 2; n <= 64; ++n) {
    EXPECT_GT(nearest(camera::points_of(disk_of(1, n))) / std::sqrt(pi / n), 0.5) << n;
    for (const auto& [width, height] : {std::pair{1.0, 1.0}, std::pair{4.0, 1.0}, std::pair{1.0, 6.0}}) {
      const auto points = camera::points_of(rectangle_of(width, height, n));
      EXPECT_GT(nearest(points) / std::sqrt(width * height / n), 0.42) << n << " " << width;
      double both = 0;
      for (const Vec3& p : points) both += 12 * p[0] * p[1] / (width * height * n);
      if (width == height) {
        EXPECT_LT(std::abs(both), 1.8 / n) << n;
      }
    }
  }
}

// Across any axis: width along the source's own x, height along its y, even power, all of it.
TEST(area_points, stand_across_the_axis) {
  const Vec3 middle{0.1, -0.2, 0.05};
  for (const Vec3& axis : {Vec3{0, 0, 1}, Vec3{1, 0, 0}, Vec3{-3, 1, 2}, Vec3{0, -1, 0.2}}) {
    const Vec3 along = base::normalized(axis);
    const Vec3 aside = std::abs(along[0]) < 0.9 ? Vec3{1, 0, 0} : Vec3{0, 1, 0};
    const Vec3 x = base::normalized(aside - base::dot(aside, along) * along);
    Camera camera;
    camera.illumination.resize(2);
    camera.illumination[0].position = middle, camera.illumination[0].axis = axis, camera.illumination[0].power_w = 3;
    camera.illumination[0].area = rectangle_of(0.3, 0.1, 12);
    const Camera opened = camera::with_emitters(camera);
    ASSERT_EQ(opened.illumination.size(), 13U);
    double wide = 0, high = 0;
    for (std::size_t i = 0; i < 12; ++i) {
      const Illumination& one = opened.illumination[i];
      const Vec3 from = one.position - middle;
      EXPECT_NEAR(base::dot(from, along), 0, 1e-15);
      EXPECT_EQ(one.power_w, 0.25);
      EXPECT_EQ(one.axis, axis);
      EXPECT_EQ(one.area.kind, Area::Kind::none);
      wide = std::max(wide, std::abs(base::dot(from, x))), high = std::max(high, std::abs(base::dot(from, base::cross(along, x))));
    }
    EXPECT_NEAR(wide, 0.15 * 11 / 12, 1e-15);
    EXPECT_NEAR(high, 0.05 * 11 / 12, 1e-15);
  }
}

// A ring of areas: at each LED the same points.
TEST(area_points, stand_at_each_led_of_a_ring) {
  Camera camera;
  camera.illumination.resize(1);
  Illumination& light = camera.illumination[0];
  light.power_w = 6, light.ring_leds = 3, light.ring_radius_m = 0.5, light.area = disk_of(0.1, 4);
  const Camera opened = camera::with_emitters(camera);
  ASSERT_EQ(opened.illumination.size(), 12U);
  const auto points = camera::points_of(light.area);
  for (std::size_t i = 0; i < 12; ++i) {
    const double turn = 2 * pi * static_cast<double>(i / 4) / 3;
    const Vec3 led{0.5 * std::cos(turn), 0.5 * std::sin(turn), 0};
    EXPECT_LE(base::length(opened.illumination[i].position - led - points[i % 4]), 1e-15);
    EXPECT_EQ(opened.illumination[i].power_w, 0.5);
    EXPECT_EQ(opened.illumination[i].ring_leds, 1);
  }
}
