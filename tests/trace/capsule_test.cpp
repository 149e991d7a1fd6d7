// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
// Ray and capsule: from outside, from inside, along its axis and beyond its ends, against a cylinder's and two spheres' roots in double.
#include <gtest/gtest.h>

#include "support/closed_shapes.h"

using namespace tofray;
using namespace tofray::base;
using namespace tofray::test;

namespace {

struct CapsuleCase {
  Vec3 center, axis, origin;
  double radius, half;

  [[nodiscard]] shape::Capsule shape() const { return {vec(center), vec(axis), radius, half}; }
  [[nodiscard]] double size() const { return radius + half; }
  [[nodiscard]] Vec3 middle() const { return center; }
};

CapsuleCase random_capsule(Random& random) {
  CapsuleCase c{random.point(3), random.direction(), {}, random.scale(0.02, 1), random.scale(0.02, 1)};
  c.origin = c.center + random.between(0.3, 6) * c.size() * random.direction();
  return c;
}

/// In the tube beyond an end, as close as the end lets one.
CapsuleCase ahead_of_an_end(Random& random) {
  CapsuleCase c = random_capsule(random);
  c.origin = c.center + random.between(0, 0.99) * c.radius * random.across(c.axis) +
             (random.below(2) == 0 ? 1 : -1) * (c.half + random.scale(0.02, 5) * c.radius) * c.axis;
  return c;
}

Side side_of_capsule(const CapsuleCase& c, const Vec3& p) {
  const double z = dot(p - c.center, c.axis), held = std::fmin(std::fmax(z, -c.half), c.half);
  return {std::abs(z) < c.half ? 0 : z > 0 ? 1 : 2, normalized(p - c.center - held * c.axis), std::abs(std::abs(z) - c.half)};
}

}  // namespace

TEST(capsule, is_hit_and_missed_like_the_closed_form_from_outside) {
  Random random(1);
  const Tally t = compare_from_outside<CapsuleCase>(600000, random, random_capsule, side_of_capsule);
  EXPECT_GT(t.hits, 200000);
  EXPECT_GT(t.misses, 60000);
  for (const int facet : t.facets) EXPECT_GT(facet, 40000);
}

// Within the tube that its side is part of, an end alone is seen.
TEST(capsule, shows_an_end_to_what_is_ahead_of_it) {
  Random random(2);
  const Tally t = compare_from_outside<CapsuleCase>(300000, random, ahead_of_an_end, side_of_capsule);
  EXPECT_EQ(t.facets[0], 0);
  EXPECT_GT(t.facets[1], 30000);
  EXPECT_GT(t.facets[2], 30000);
  for (const double sign : {-1.0, 1.0}) {
    for (const double aside : {0.0, 0.06, 0.0999, 0.1001}) {
      const CapsuleCase c{{0, 0, 2}, {0, 0, sign}, {aside, 0, 0}, 0.1, 0.25};
      int side = -1;
      const double w = inverse_range_of(c, ray({0, 0, 1}), side);
      EXPECT_EQ(w > 0, aside < 0.1) << aside;
      if (w > 0) {
        EXPECT_NEAR(1 / w, 1.75 - std::sqrt(0.01 - aside * aside), 2e-5);
        EXPECT_EQ(side, sign > 0 ? 2 : 1);
      }
      EXPECT_FALSE(inverse_range_of(c, ray({0, 0, -1}), side) > 0);
    }
  }
}

// In the tube by less than single precision knows, and beyond the end's centre by as little: what leads away meets nothing.
TEST(capsule, touched_where_side_and_end_meet_is_not_in_the_way) {
  const CapsuleCase c{{0, 0, 0}, {0, 0, 1}, {1 - 0x1p-53, 0, 1 + 0x1p-25}, 1, 1};
  int side = -1;
  EXPECT_FALSE(inverse_range_of(c, ray({1, 0, 0}), side) > 0);
  EXPECT_FALSE(inverse_range_of(c, ray({1, 0, 1}), side) > 0);
}

TEST(capsule, seen_from_inside_is_hit_by_every_ray_at_its_far_side) {
  Random random(3);
  const auto within = [](Random& from) {
    CapsuleCase c = random_capsule(from);
    c.origin = c.center + from.between(-1, 1) * c.half * c.axis;
    if (from.below(10) != 0) c.origin = c.origin + from.between(0, 0.98) * c.radius * from.direction();
    return c;
  };
  const Tally t = compare_from_inside<CapsuleCase>(300000, random, within, side_of_capsule);
  for (const int facet : t.facets) EXPECT_GT(facet, 50000);
}

// 1 mm by 10 m, 10 m round for 1 mm of length, and 1 m at 10 km.
TEST(capsule, may_be_long_short_and_far) {
  Random random(4);
  const auto make = [](Random& from) {
    const int kind = from.below(3);
    const double radius = kind == 0 ? 1e-3 : kind == 1 ? 10 : 1, half = kind == 0 ? 5 : kind == 1 ? 5e-4 : 1;
    CapsuleCase c{{0, 0, 0}, from.direction(), {}, radius, half};
    if (kind == 0) {  // at a point of it
      c.center = from.between(0.1, 3) * from.across(c.axis) + from.between(-4, 4) * c.axis;
    } else {
      c.center = (kind == 1 ? from.between(11, 40) : 1e4) * from.direction();
    }
    return c;
  };
  int hits = 0, misses = 0;
  for (int i = 0; i < 200000; ++i) {
    const CapsuleCase c = make(random);
    const Vec3 aim = c.center + random.between(-1, 1) * c.half * c.axis + random.between(0, 2) * c.radius * random.direction();
    const Ray ray = test::ray(normalized(aim - c.origin));
    const Span s = span(c.shape(), c.origin, direction(ray));
    const double away = length(aim - c.origin);
    if (s.clearance < 1e-3 + 16 * 0x1p-24 * away / c.radius) continue;
    int side = -1;
    const double w = inverse_range_of(c, ray, side), t = first(s);
    ASSERT_EQ(w > 0, t > 0) << i;
    ++(w > 0 ? hits : misses);
    const double cosine = w > 0 ? std::abs(dot(side_of_capsule(c, c.origin + t * direction(ray)).normal, normalized(direction(ray)))) : 0;
    ASSERT_TRUE(cosine < 0.02 || std::abs(1 / w - t) <= 16 * 0x1p-24 * away / cosine) << i;
  }
  EXPECT_GT(hits, 50000);
  EXPECT_GT(misses, 20000);
}

TEST(capsule, has_the_normals_of_its_side_and_ends) {
  Random random(5);
  for (int i = 0; i < 30000; ++i) {
    const CapsuleCase c = random_capsule(random);
    const Vec3 out = i % 3 == 0 ? random.across(c.axis) : random.direction();
    const int side = i % 3 == 0 ? 0 : dot(out, c.axis) > 0 ? 1 : 2;
    const double z = side == 0 ? random.between(-1, 1) * c.half : side == 1 ? c.half : -c.half;
    const Vec3 got = normal_at(c.shape(), side, c.center + z * c.axis + c.radius * out);
    ASSERT_NEAR(length(got - out), 0, 16 * 0x1p-24 * (length(c.center) + c.size()) / c.radius) << i;
  }
}

TEST(capsule, shades_from_the_sun_what_brute_force_finds_behind_it) {
  Random random(6);
  const Tally t = compare_sun_shadows<CapsuleCase>(300000, random, random_capsule);
  EXPECT_GT(t.hits, 60000);
  EXPECT_GT(t.misses, 60000);
}

TEST(capsule, has_bounds_that_hold_it) {
  Random random(7);
  EXPECT_GT(hits_within_bounds<CapsuleCase>(200000, random, random_capsule), 60000);
  // Along z from 2 m to 3 m, 10 cm round: at 2 m the rim is at 0.05 and a bit.
  const shape::CapsuleForm form = seen_from(shape::Capsule{{0, 0, 2.5}, {0, 0, 1}, 0.1, 0.5}, {0, 0, 0});
  EXPECT_FALSE(can_meet(form, {0.051f, 1, -1, 1}));
  EXPECT_FALSE(can_meet(form, {-1, 1, -1, -0.051f}));
}

// Camera in and lamp out of it, or the other way round: its own surface is in the dark.
TEST(capsule, keeps_light_from_the_other_side_of_its_surface) {
  const shape::Capsule about{{0, 0, 0.5}, {0, 0, 1}, 0.3, 0.6}, aside{{0, 0, 2}, {0, 0, 1}, 0.3, 0.6};
  for (const auto& [shape, eye, dark] : {std::tuple{about, shape::Vec{0, 0, 1.3}, 0},
                                         {about, shape::Vec{0, 0, 1.41}, 1},
                                         {about, shape::Vec{0.2, 0.2, -0.3}, 1},
                                         {aside, shape::Vec{0, 0, 2}, 1},
                                         {aside, shape::Vec{0, 0, 1.2}, 1},
                                         {aside, shape::Vec{0, 0, 1}, 0}}) {
    EXPECT_EQ(seen_from(shape, eye).own_blocks, dark) << eye.x << " " << eye.y << " " << eye.z;
  }
  EXPECT_EQ(seen_along(about, {1, 0, 0}).own_blocks, 1);
  EXPECT_EQ(seen_along(aside, {1, 0, 0}).own_blocks, 0);
}
