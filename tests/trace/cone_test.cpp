// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
// Ray and cone: from outside, from inside, from above its tip and below its base, flat and steep, against the quadratic in double.
#include <gtest/gtest.h>

#include "support/closed_shapes.h"

using namespace tofray;
using namespace tofray::base;
using namespace tofray::test;

namespace {

struct ConeCase {
  Vec3 tip, axis, origin;
  double radius, height;

  [[nodiscard]] shape::Cone shape() const { return {vec(tip), vec(axis), radius, height}; }
  [[nodiscard]] double size() const { return std::hypot(radius, height); }
  [[nodiscard]] Vec3 middle() const { return tip - 0.75 * height * axis; }
};

ConeCase random_cone(Random& random) {
  ConeCase c{random.point(3), random.direction(), {}, random.scale(0.02, 1), random.scale(0.02, 1)};
  c.origin = c.middle() + random.between(0.1, 6) * c.size() * random.direction();
  return c;
}

/// Within the mirror image of its side, above the tip.
ConeCase above_the_tip(Random& random) {
  ConeCase c = random_cone(random);
  const double above = random.scale(0.01, 5) * c.height;
  c.origin = c.tip + above * c.axis + random.between(0, 0.99) * above / c.height * c.radius * random.across(c.axis);
  return c;
}

/// Within its side continued below the base.
ConeCase below_the_base(Random& random) {
  ConeCase c = random_cone(random);
  const double below = (1 + random.scale(0.01, 5)) * c.height;
  c.origin = c.tip - below * c.axis + random.between(0, 0.99) * below / c.height * c.radius * random.across(c.axis);
  return c;
}

Side side_of_cone(const ConeCase& c, const Vec3& p) {
  const Vec3 q = p - c.tip, across = q - dot(q, c.axis) * c.axis;
  const double below = -dot(q, c.axis), out = length(across), slope = c.radius / c.height;
  const double to_base = std::abs(c.height - below), to_side = std::abs(out - slope * below) / std::hypot(1, slope);
  if (to_base < to_side) return {1, c.axis, to_side};
  return {0, normalized(normalized(across) + slope * c.axis), std::fmin(to_base, length(q))};
}

}  // namespace

TEST(cone, is_hit_and_missed_like_the_closed_form_from_outside) {
  Random random(1);
  const Tally t = compare_from_outside<ConeCase>(600000, random, random_cone, side_of_cone);
  EXPECT_GT(t.hits, 100000);
  EXPECT_GT(t.misses, 100000);
  EXPECT_GT(t.facets[0], 60000);
  EXPECT_GT(t.facets[1], 40000);
}

// The mirror image of the side is not there, neither before the camera nor about it.
TEST(cone, has_no_image_above_its_tip) {
  Random random(2);
  const Tally t = compare_from_outside<ConeCase>(300000, random, above_the_tip, side_of_cone);
  EXPECT_GT(t.facets[0], 40000);
  EXPECT_EQ(t.facets[1], 0);
  for (int i = 0; i < 100000; ++i) {
    const ConeCase c = random_cone(random);
    const Vec3 image = c.tip + random.between(0.1, 1) * c.height * c.axis + 0.1 * c.radius * random.point(1);
    const Ray ray = test::ray(normalized(image - c.origin));
    if (test::first(span(c.shape(), c.origin, direction(ray))) > 0 || span(c.shape(), c.origin, direction(ray)).clearance < 0.01) continue;
    int side = -1;
    ASSERT_FALSE(inverse_range_of(c, ray, side) > 0) << i;
  }
}

TEST(cone, shows_its_base_alone_from_below) {
  Random random(3);
  const Tally t = compare_from_outside<ConeCase>(300000, random, below_the_base, side_of_cone);
  EXPECT_EQ(t.facets[0], 0);
  EXPECT_GT(t.facets[1], 60000);
}

TEST(cone, seen_from_inside_is_hit_by_every_ray_at_its_far_side) {
  Random random(4);
  const auto within = [](Random& from) {
    ConeCase c = random_cone(from);
    const double below = from.between(0.02, 0.98) * c.height;
    c.origin = c.tip - below * c.axis;
    if (from.below(10) != 0) c.origin = c.origin + from.between(0, 0.98) * below / c.height * c.radius * from.across(c.axis);
    return c;
  };
  const Tally t = compare_from_inside<ConeCase>(300000, random, within, side_of_cone);
  EXPECT_GT(t.facets[0], 90000);
  EXPECT_GT(t.facets[1], 60000);
}

// On its very axis, from either end; behind the origin there is nothing.
TEST(cone, along_its_axis_shows_its_tip_or_its_base) {
  for (const double sign : {-1.0, 1.0}) {
    const ConeCase c{{0, 0, 2}, {0, 0, sign}, {0, 0, 0}, 0.2, 0.5};
    int side = -1;
    double w = inverse_range_of(c, ray({0, 0, 1}), side);
    ASSERT_GT(w, 0);
    EXPECT_NEAR(1 / w, sign < 0 ? 2 : 1.5, 1e-6);
    EXPECT_EQ(side, sign < 0 ? 0 : 1);
    EXPECT_FALSE(inverse_range_of(c, ray({0, 0, -1}), side) > 0);
    for (const double aside : {0.05, 0.0999, 0.11, 0.3}) {  // from the tip's side z = 2 + aside·0.5/0.2, from the base's 1.5
      const ConeCase beside{{aside, 0, 2}, c.axis, {0, 0, 0}, 0.2, 0.5};
      w = inverse_range_of(beside, ray({0, 0, 1}), side);
      EXPECT_EQ(w > 0, aside < 0.2) << aside;
      if (w > 0) {
        EXPECT_NEAR(1 / w, sign < 0 ? 2 + aside * 2.5 : 1.5, 2e-6) << aside;
      }
    }
  }
}

// 1 mm by 10 m, 10 m by 1 mm, and 1 m at 10 km. A ray through a point of its surface that faces the camera hits it there.
TEST(cone, may_be_steep_flat_and_far) {
  Random random(5);
  int hits = 0, sides = 0;
  for (int i = 0; i < 300000; ++i) {
    const int kind = i % 3;
    ConeCase c{{0, 0, 0}, random.direction(), {0, 0, 0}, kind == 0 ? 1e-3 : kind == 1 ? 10 : 1, kind == 0 ? 10 : kind == 1 ? 1e-3 : 1};
    const bool base = random.below(2) == 0;
    const double below = base ? c.height : random.between(0.05, 0.95) * c.height, share = base ? std::sqrt(random.uniform()) : 1;
    const Vec3 at = share * below / c.height * c.radius * random.across(c.axis) - below * c.axis;  // from the tip
    const double away = kind == 2 ? 1e4 : random.between(0.5, 20);
    const Vec3 target = away * random.direction();
    c.tip = target - at;
    const Vec3 n = base ? -1.0 * c.axis : side_of_cone(c, target).normal, d = normalized(target);
    if (dot(n, d) > -0.05) continue;  // turned away
    const Ray ray = test::ray(d);
    // Where it is thinner than rounding knows, it may be missed.
    const double border = (base ? 1 - share : std::fmin(c.height - below, below) / c.height) * std::fmin(c.radius, c.height);
    if (border < 64 * 0x1p-24 * (away + c.size()) / -dot(n, d)) continue;
    int side = -1;
    const double w = inverse_range_of(c, ray, side);
    ASSERT_GT(w, 0) << i;
    ASSERT_EQ(side, base ? 1 : 0) << i;
    ASSERT_LE(std::abs(1 / w - away), 32 * 0x1p-24 * (away + c.size()) / -dot(n, d)) << i;
    ++hits, sides += !base;
  }
  EXPECT_GT(hits, 60000);
  EXPECT_GT(sides, 20000);
}

TEST(cone, has_the_normal_of_its_side) {
  Random random(6);
  for (int i = 0; i < 30000; ++i) {
    const ConeCase c = random_cone(random);
    const double below = random.between(0.05, 1) * c.height;
    const Vec3 out = random.across(c.axis), at = c.tip - below * c.axis + below / c.height * c.radius * out;
    const Vec3 expected = normalized(c.height * out + c.radius * c.axis);
    const Vec3 got = normal_at(c.shape(), 0, at);
    ASSERT_NEAR(length(got - expected), 0, 16 * 0x1p-24 * (1 + length(c.tip) * c.height / (below * c.radius))) << i;
    ASSERT_NEAR(length(got), 1, 1e-6);
  }
  const Vec3 down = normal_at(shape::Cone{{1, 2, 3}, {0, 0.6, -0.8}, 2, 1}, 1, {1, 2, 3});
  EXPECT_EQ(down, (Vec3{0, static_cast<double>(0.6f), static_cast<double>(-0.8f)}));
  const Vec3 tip = normal_at(shape::Cone{{1, 2, 3}, {0, 1, 0}, 3, 4}, 0, {1, 2, 3});
  EXPECT_NEAR(length(tip - Vec3{0, 0.6, 0}), 0, 1e-6);
}

TEST(cone, shades_from_the_sun_what_brute_force_finds_behind_it) {
  Random random(7);
  const Tally t = compare_sun_shadows<ConeCase>(400000, random, random_cone);
  EXPECT_GT(t.hits, 40000);
  EXPECT_GT(t.misses, 60000);
}

// Light along a line of its side has one root at infinity. 3-4-5: the line goes from the base at (3, 0, −4) to the tip at 0.
TEST(cone, shades_from_a_sun_along_its_side) {
  const shape::Cone cone{{0, 0, 0}, {0, 0, 1}, 3, 4};
  const auto dark = [&](const Vec3& s, double x, double y, double z) {
    flow::Surface<float> p{};
    p.x = static_cast<float>(x), p.y = static_cast<float>(y), p.z = static_cast<float>(z);
    const float sun[3] = {static_cast<float>(s[0]), static_cast<float>(s[1]), static_cast<float>(s[2])};
    return blocks(seen_along(cone, vec(s)), p, sun, 1e-4f);
  };
  const Vec3 up{-0.6, 0, 0.8}, down{0.6, 0, -0.8};
  EXPECT_TRUE(dark(up, 2.9, 0, -5));      // from below the base, through it
  EXPECT_TRUE(dark(up, 0, 0, -2));        // from inside
  EXPECT_FALSE(dark(up, 3.9, 0, -5));     // past its side
  EXPECT_FALSE(dark(up, -4.2, 0, -5));    // beyond the base's rim
  EXPECT_FALSE(dark(up, 0, 0, 1));        // from above the tip
  EXPECT_TRUE(dark(down, -3, 0, -1));     // in at its side, out at its base
  EXPECT_FALSE(dark(down, 0.1, 0, 0));    // past its side
  EXPECT_FALSE(dark(down, 0, 0, -4.1));   // from below its base
  EXPECT_FALSE(dark(down, -1, 3.1, -3));  // past it, aside
}

TEST(cone, has_bounds_that_hold_it) {
  Random random(8);
  EXPECT_GT(hits_within_bounds<ConeCase>(200000, random, random_cone), 30000);
  const shape::ConeForm form = seen_from(shape::Cone{{0, 0, 2}, {0, 0, -1}, 0.2, 1}, {0, 0, 0});
  EXPECT_FALSE(can_meet(form, {0.07f, 1, -1, 1}));  // its rim is 3 m away
  EXPECT_FALSE(can_meet(form, {-1, 1, -1, -0.07f}));
}

// Camera in and lamp out of it, or the other way round: its own surface is in the dark.
TEST(cone, keeps_light_from_the_other_side_of_its_surface) {
  const shape::Cone about{{0, -0.5, 0}, {0, -1, 0}, 1, 1}, aside{{0, 0, 2}, {0, 0, -1}, 1, 1};
  for (const auto& [shape, eye, dark] : {std::tuple{about, shape::Vec{0.3, 0.4, 0}, 0},
                                         {about, shape::Vec{0, 0.6, 0}, 1},
                                         {about, shape::Vec{0, -0.6, 0}, 1},
                                         {about, shape::Vec{0.6, 0, 0}, 1},
                                         {aside, shape::Vec{0, 0, 2.5}, 1},
                                         {aside, shape::Vec{0, 0, 1.5}, 0},
                                         {aside, shape::Vec{0.6, 0, 2.5}, 0}}) {
    EXPECT_EQ(seen_from(shape, eye).own_blocks, dark) << eye.x << " " << eye.y << " " << eye.z;
  }
  EXPECT_EQ(seen_along(about, {1, 0, 0}).own_blocks, 1);
  EXPECT_EQ(seen_along(aside, {1, 0, 0}).own_blocks, 0);
}
