// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
// Ray and disk: from both sides, edge-on, small, large and far, and against the plane and the distance from its centre in double precision.
#include <gtest/gtest.h>

#include "support/brute_force.h"
#include "support/random.h"
#include "support/rays.h"
#include "trace/visible.h"

using namespace tofray;
using namespace tofray::base;
using tofray::test::Random;
using tofray::test::Span;

namespace {

struct DiskCase {
  Vec3 center, normal, origin;
  double radius;

  [[nodiscard]] shape::Disk shape() const { return {test::vec(center), test::vec(normal), radius}; }
  [[nodiscard]] double w(const test::Ray& ray) const {
    return static_cast<double>(inverse_range(seen_from(shape(), test::vec(origin)), ray));
  }
};

}  // namespace

// Its outline is a cone of directions whose numbers are rounded once: it is known to some 2^-24 of the distance across the ray, in
// the disk's plane longer by 1/cos of the angle between ray and normal; so is the range. Eight of these: three sums of three products.
TEST(disk, is_hit_and_missed_like_the_closed_form) {
  Random random(1);
  int hits = 0, misses = 0, grazing = 0;
  for (int i = 0; i < 1000000; ++i) {
    const DiskCase c{random.point(3), random.direction(), random.point(3), random.scale(1e-3, 3)};
    const double share = 1.4 * std::sqrt(random.uniform());
    const Vec3 aim = c.center + share * c.radius * random.across(c.normal);
    const test::Ray ray = test::ray(normalized(aim - c.origin));
    const Vec3 d = test::direction(ray);
    const double slant = std::abs(dot(c.normal, d)) / length(d), distance = length(aim - c.origin) + length(c.center - c.origin);
    if (slant < 1e-4 || std::abs(share - 1) * c.radius < 8 * 0x1p-24 * distance / slant) continue;
    const Span s = test::span(c.shape(), c.origin, d);
    const double got = c.w(ray);
    ASSERT_EQ(got > 0, share < 1) << i;
    if (!(got > 0)) {
      ++misses;
      continue;
    }
    ++hits;
    grazing += slant < 0.02;
    ASSERT_LE(std::abs(1 / got - s.enter), 8 * 0x1p-24 * distance / slant) << i;
  }
  EXPECT_GT(hits, 400000);
  EXPECT_GT(misses, 400000);
  EXPECT_GT(grazing, 3000);
}

TEST(disk, is_not_seen_edge_on_nor_behind) {
  Random random(2);
  for (int i = 0; i < 10000; ++i) {
    const Vec3 n = random.direction(), aside = random.across(n), center = random.point(2);
    const DiskCase edge_on{center, n, center + random.between(0, 3) * aside, 1};
    EXPECT_FALSE(edge_on.w(test::ray(random.direction())) > 0);
    const DiskCase c{center, n, center + random.scale(1e-6, 3) * n + random.between(0, 0.9) * aside, 1};
    EXPECT_FALSE(c.w(test::ray(n)) > 0);
    EXPECT_TRUE(c.w(test::ray(-1.0 * n)) > 0);
  }
}

// On its axis the outline is at R/distance, at any scale: 1 mm at 10 km, 10 m from 1 mm.
TEST(disk, is_round_at_any_scale) {
  Random random(3);
  for (int i = 0; i < 100000; ++i) {
    const double away = random.scale(1e-3, 1e4), radius = random.scale(std::fmax(1e-3, 1e-5 * away), 10);
    const double share = random.below(2) == 0 ? random.between(0, 1 - 1e-4) : random.between(1 + 1e-4, 2);
    const Vec3 n = random.direction(), at = share * radius * random.across(n);
    const double slant = away / std::hypot(away, length(at));
    if (std::abs(share - 1) * radius < 16 * 0x1p-24 * std::hypot(away, length(at)) / slant) continue;
    const DiskCase c{away * n, n, {0, 0, 0}, radius};
    const double got = c.w(test::ray(normalized(away * n + at)));
    ASSERT_EQ(got > 0, share < 1) << i << " " << away << " " << radius << " " << share;
    if (got > 0) {
      ASSERT_NEAR(1 / got, std::hypot(away, length(at)), 16 * 0x1p-24 * away / (slant * slant)) << i;
    }
  }
}

// From the plane a disk looks like a strip; its bounds hold it from every side.
TEST(disk, has_bounds_that_hold_it) {
  Random random(4);
  int hits = 0;
  for (int i = 0; i < 200000; ++i) {
    const DiskCase c{Vec3{0, 0, 2} + random.point(2), random.direction(), {0, 0, 0}, random.scale(0.01, 2)};
    const Vec3 at = c.center + 0.9999 * c.radius * random.across(c.normal);
    if (at[2] <= 0) continue;
    const test::Ray ray = test::ray({at[0] / at[2], at[1] / at[2], 1});
    if (!(c.w(ray) > 0)) continue;
    ++hits;
    ASSERT_TRUE(can_meet(seen_from(c.shape(), {0, 0, 0}), {ray.x, ray.x, ray.y, ray.y})) << i;
  }
  EXPECT_GT(hits, 100000);
  const shape::DiskForm form = seen_from(shape::Disk{{0, 0, 2}, {0, 0, 1}, 0.2}, {0, 0, 0});
  EXPECT_FALSE(can_meet(form, {0.11f, 0.2f, -1, 1}));
  EXPECT_FALSE(can_meet(form, {-1, 1, -0.2f, -0.11f}));
}

// A sun across it shades what is before or behind it within the ellipse of its shadow; one along it nothing.
TEST(disk, shades_from_the_sun_where_its_outline_is) {
  Random random(5);
  int dark = 0, lit = 0;
  for (int i = 0; i < 200000; ++i) {
    const Vec3 center = random.point(2), n = random.direction(), out = random.across(n);
    const double radius = random.scale(1e-3, 10), share = 1.4 * std::sqrt(random.uniform()), t = random.between(-1, 2);
    const bool along = i % 20 == 0;
    const Vec3 s = along ? normalized(random.across(n) + random.between(-9e-7, 9e-7) * n) : i % 20 == 1 ? n : random.direction();
    const Vec3 at = center + share * radius * out - t * s;
    flow::Surface<float> p{};
    p.x = static_cast<float>(at[0]), p.y = static_cast<float>(at[1]), p.z = static_cast<float>(at[2]);
    const float sun[3] = {static_cast<float>(s[0]), static_cast<float>(s[1]), static_cast<float>(s[2])};
    const bool got = blocks(seen_along(shape::Disk{test::vec(center), test::vec(n), radius}, test::vec(s)), p, sun, 1e-4f);
    const double slant = std::abs(dot(n, s));
    ASSERT_FALSE(along && got) << i;
    if (slant < 1e-3 || std::abs(share - 1) * radius < 1e-5 / slant || std::abs(t) < 1e-3 / slant) continue;
    ASSERT_EQ(got, share < 1 && t > 0) << i;
    ++(got ? dark : lit);
  }
  EXPECT_GT(dark, 40000);
  EXPECT_GT(lit, 60000);
}

TEST(disk, faces_along_its_normal) {
  shape::Facet facet{};
  facet.curved = 1;
  facet_of(shape::Disk{{1, 2, 3}, {0, 0.6, -0.8}, 2}, 0, facet);
  EXPECT_EQ(facet.curved, 0);
  EXPECT_EQ(facet.number[0], 0);
  EXPECT_EQ(facet.number[1], 0.6f);
  EXPECT_EQ(facet.number[2], -0.8f);
}
