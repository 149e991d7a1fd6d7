// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
// Ray and cylinder with caps: from outside and inside, along and across its axis, against the quadratic and the slab in double precision.
#include <gtest/gtest.h>

#include "support/brute_force.h"
#include "support/random.h"
#include "support/rays.h"

using namespace tofray;
using namespace tofray::base;
using tofray::test::Random;
using tofray::test::Span;

namespace {

struct CylinderCase {
  Vec3 center, axis, origin;
  double radius, half;

  [[nodiscard]] shape::Cylinder shape() const { return {test::vec(center), test::vec(axis), radius, half}; }
  [[nodiscard]] double w(const test::Ray& ray, int& side) const {
    return static_cast<double>(inverse_range(seen_from(shape(), test::vec(origin)), ray, side));
  }
  [[nodiscard]] Span span(const test::Ray& ray) const { return test::span(shape(), origin, test::direction(ray)); }
};

CylinderCase random_case(Random& random, double away) {
  CylinderCase c;
  c.center = random.point(3), c.axis = random.direction(), c.radius = random.scale(0.02, 1), c.half = random.scale(0.02, 1);
  c.origin = c.center + away * (c.radius + c.half) * random.direction();
  return c;
}

/// A ray that comes near it.
test::Ray aim(const CylinderCase& c, Random& random) {
  const Vec3 aside = random.point(1.2);
  return test::ray(normalized(c.center + random.between(-1.2, 1.2) * c.half * c.axis + c.radius * aside - c.origin));
}

}  // namespace

// Where the side or the cap is, is known to some 2^-24 of |o − c|: m and d are rounded once each, and six products and sums: 8 of these,
// along the ray longer by 1/cos of the angle between ray and normal.
TEST(cylinder, is_hit_and_missed_like_the_closed_form_from_outside) {
  Random random(1);
  int hits = 0, misses = 0, caps = 0, measured = 0;
  for (int i = 0; i < 1000000; ++i) {
    const CylinderCase c = random_case(random, random.between(1.2, 6));
    const test::Ray ray = aim(c, random);
    const Span s = c.span(ray);
    if (s.clearance < 0.01) continue;
    int side = -1;
    const double w = c.w(ray, side);
    ASSERT_EQ(w > 0, test::first(s) > 0) << i;
    if (!(w > 0)) {
      ++misses;
      continue;
    }
    ++hits;
    const double t = test::first(s);
    const Vec3 d = test::direction(ray), at = c.origin + t * d - c.center, out = at - dot(at, c.axis) * c.axis;
    const double to_cap = std::abs(std::abs(dot(at, c.axis)) - c.half), to_side = std::abs(length(out) - c.radius);
    if (std::abs(to_cap - to_side) < 1e-4) continue;  // the rim is both
    caps += to_cap < to_side;
    ASSERT_EQ(side, to_cap < to_side ? 1 : 0) << i;
    const double cosine = std::abs(dot(to_cap < to_side ? c.axis : normalized(out), d)) / length(d);
    if (cosine < 0.02) continue;
    ++measured;
    ASSERT_LE(std::abs(1 / w - t), 8 * 0x1p-24 * length(c.origin - c.center) / cosine) << i;
  }
  EXPECT_GT(hits, 300000);
  EXPECT_GT(measured, 280000);
  EXPECT_GT(misses, 100000);
  EXPECT_GT(caps, 50000);
}

TEST(cylinder, seen_from_inside_is_hit_by_every_ray_at_its_far_side) {
  Random random(2);
  for (int i = 0; i < 300000; ++i) {
    CylinderCase c = random_case(random, 1);
    c.origin = c.center + random.between(-0.95, 0.95) * c.half * c.axis + random.between(0, 0.95) * c.radius * random.across(c.axis);
    if (i % 10 == 0) c.origin = c.center;
    const test::Ray ray = test::ray(i % 7 == 0 ? c.axis : random.direction());
    const Span s = c.span(ray);
    int side = -1;
    const double w = c.w(ray, side);
    ASSERT_GT(w, 0) << i;
    ASSERT_NEAR(1 / w, s.leave, 1e-4 * s.leave + 1e-6) << i;
    const Vec3 at = c.origin + s.leave * test::direction(ray) - c.center;
    const bool cap = std::abs(dot(at, c.axis)) > c.half * (1 - 1e-5), round = length(at - dot(at, c.axis) * c.axis) > c.radius * (1 - 1e-5);
    ASSERT_TRUE(cap == round || side == (cap ? 1 : 0)) << i;
  }
}

// Along the axis there is no side to be met, and no angle about the axis; behind the origin there is nothing.
TEST(cylinder, along_its_axis_shows_its_cap) {
  for (const double aside : {0.0, 0.05, 0.0999, 0.1001, 0.2}) {
    for (const double sign : {-1.0, 1.0}) {
      const CylinderCase c{{0, 0, 2}, {0, 0, sign}, {aside, 0, 0}, 0.1, 0.25};
      int side = -1;
      const double w = c.w(test::ray({0, 0, 1}), side);
      EXPECT_EQ(w > 0, aside < 0.1) << aside;
      if (w > 0) {
        EXPECT_NEAR(1 / w, 1.75, 1e-6);
        EXPECT_EQ(side, 1);
      }
      EXPECT_FALSE(c.w(test::ray({0, 0, -1}), side) > 0);
    }
  }
}

// Its side is that of the unit circle about the axis: 1 m before a cylinder of 0.1 m across the view the range is 0.9 m on the middle line.
TEST(cylinder, has_the_normal_of_its_side) {
  Random random(4);
  for (int i = 0; i < 20000; ++i) {
    const CylinderCase c = random_case(random, 1);
    shape::Facet facet{};
    facet.curved = 1;
    facet_of(c.shape(), 0, facet);
    ASSERT_EQ(facet.curved, 1);
    const Vec3 out = random.across(c.axis), at = c.center + random.between(-1, 1) * c.half * c.axis + c.radius * out;
    const auto f = [](double a) { return static_cast<float>(a); };
    const shape::Direction<float> n = shape::Cylinder::normal(facet, f(at[0]), f(at[1]), f(at[2]));
    const Vec3 got{static_cast<double>(n.x), static_cast<double>(n.y), static_cast<double>(n.z)};
    ASSERT_NEAR(length(got - out), 0, 8 * 0x1p-24 * (length(c.center) + c.radius) / c.radius) << i;
    facet_of(c.shape(), 1, facet);
    EXPECT_EQ(facet.curved, 0);
  }
}
