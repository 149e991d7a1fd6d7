// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
// Ray and box, also from inside, with zero components and either sign of zero.
#include <gtest/gtest.h>

#include <limits>

#include "support/random.h"
#include "support/rays.h"

using namespace tofray;
using namespace tofray::base;
using tofray::test::Random;

namespace {

struct BoxCase {
  Vec3 center, half, origin;
  Mat3 axes{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};

  [[nodiscard]] float w(const test::Ray& ray, int& axis) const {
    return inverse_range(seen_from(shape::Box{test::vec(center), test::mat(axes), test::vec(half)}, test::vec(origin)), ray, axis);
  }
};

struct Slabs {
  double t = 0;         ///< 0: missed
  double axis_gap = 0;  ///< how much later the second axis is entered (earlier left): which side is hit is sure where this is large
  int axis = 0;
};

/// The slab method in double precision; `grow` moves all sides outward.
Slabs slabs(const BoxCase& c, const Vec3& direction, double grow) {
  const Vec3 o = c.axes * (c.origin - c.center), d = c.axes * direction;
  double in[3], out[3];
  bool inside = true;
  for (std::size_t k = 0; k < 3; ++k) {
    const double half = c.half[k] + grow;
    inside = inside && std::abs(o[k]) < half;
    if (d[k] == 0) {
      const double infinite = std::numeric_limits<double>::infinity();
      in[k] = std::abs(o[k]) < half ? -infinite : infinite, out[k] = std::abs(o[k]) < half ? infinite : -infinite;
      continue;
    }
    const double a = (-half - o[k]) / d[k], b = (half - o[k]) / d[k];
    in[k] = std::fmin(a, b), out[k] = std::fmax(a, b);
  }
  const double enter = std::fmax(in[0], std::fmax(in[1], in[2])), leave = std::fmin(out[0], std::fmin(out[1], out[2]));
  Slabs s;
  if (enter > leave || leave <= 0) return s;
  s.t = inside ? leave : enter;
  if (!inside && enter <= 0) return Slabs{};
  const double* edges = inside ? out : in;
  for (int k = 0; k < 3; ++k) {
    if (edges[k] == s.t) s.axis = k;
  }
  s.axis_gap = 1e300;
  for (int k = 0; k < 3; ++k) {
    if (k != s.axis) s.axis_gap = std::fmin(s.axis_gap, std::abs(edges[k] - s.t));
  }
  return s;
}

/// @param shell  how far the sides may seem to be displaced [units in the last place of the box's farthest point]
void compare(const BoxCase& c, const test::Ray& ray, double shell, int& hits, int& misses) {
  int axis = -1;
  const float w = c.w(ray, axis);
  ASSERT_FALSE(std::isnan(w));
  const Vec3 d = test::direction(ray);
  const double size = length(c.center - c.origin) + length(c.half), grow = shell * 0x1p-23 * size;
  const Slabs larger = slabs(c, d, grow), smaller = slabs(c, d, -grow);
  if (larger.t > 0 && smaller.t > 0) {
    ++hits;
    ASSERT_GT(w, 0);
    const double t = 1 / static_cast<double>(w), low = std::fmin(larger.t, smaller.t), high = std::fmax(larger.t, smaller.t);
    ASSERT_GE(t, low * (1 - 0x1p-22));
    ASSERT_LE(t, high * (1 + 0x1p-22));
    const double sure = 2 * (high - low) + 0x1p-20 * high;
    if (larger.axis == smaller.axis && larger.axis_gap > sure && smaller.axis_gap > sure) {
      ASSERT_EQ(axis, larger.axis);
    }
  }
  if (larger.t == 0 && smaller.t == 0) {
    ++misses;
    ASSERT_LE(w, 0);
  }
}

BoxCase random_box(Random& random, bool inside) {
  BoxCase c;
  c.half = {random.scale(0.01, 3), random.scale(0.01, 3), random.scale(0.01, 3)};
  c.center = random.point(5);
  c.origin = random.point(5);
  if (inside) {
    const Vec3 at = random.point(0.999);
    c.origin = c.center + Vec3{at[0] * c.half[0], at[1] * c.half[1], at[2] * c.half[2]};
  }
  return c;
}

Vec3 aim(const BoxCase& c, Random& random) {
  const Vec3 at = random.point(1.2);
  const Vec3 local{at[0] * c.half[0], at[1] * c.half[1], at[2] * c.half[2]};
  return normalized(c.center + transposed(c.axes) * local - c.origin);
}

}  // namespace

TEST(box, along_the_axes_is_hit_and_missed_like_the_closed_form_outside_a_shell_of_four_units) {
  Random random(1);
  int hits = 0, misses = 0;
  for (int i = 0; i < 500000; ++i) {
    const BoxCase c = random_box(random, i % 4 == 0);
    compare(c, test::ray(aim(c, random)), 4, hits, misses);
    if (HasFatalFailure()) FAIL() << i;
  }
  EXPECT_GT(hits, 200000);
  EXPECT_GT(misses, 50000);
}

// The rotated axes are rounded, and so are three products and sums: seven half units of the distance for each side; 12 with room for all.
TEST(box, turned_any_way_is_hit_and_missed_like_the_closed_form) {
  Random random(2);
  int hits = 0, misses = 0;
  for (int i = 0; i < 500000; ++i) {
    BoxCase c = random_box(random, false);
    c.axes = random.rotation();
    if (i % 4 == 0) c.origin = c.center + 0.5 * std::fmin(c.half[0], std::fmin(c.half[1], c.half[2])) * random.direction();
    compare(c, test::ray(aim(c, random)), 12, hits, misses);
    if (HasFatalFailure()) FAIL() << i;
  }
  EXPECT_GT(hits, 200000);
  EXPECT_GT(misses, 50000);
}

TEST(box, takes_rays_along_its_axes_with_either_zero) {
  Random random(3);
  int hits = 0, misses = 0;
  for (int i = 0; i < 200000; ++i) {
    const BoxCase c = random_box(random, i % 4 == 0);
    Vec3 d = aim(c, random);
    const int zeros = 1 + random.below(6);  // which components are zero: at least one, not all
    for (std::size_t k = 0; k < 3; ++k) {
      if ((zeros >> k) & 1) d[k] = random.uniform() < 0.5 ? 0.0 : -0.0;
    }
    compare(c, test::ray(d), 4, hits, misses);
    if (HasFatalFailure()) FAIL() << i;
  }
  EXPECT_GT(hits, 50000);
  EXPECT_GT(misses, 20000);
}

TEST(box, never_gives_nan_when_the_origin_lies_in_a_side_or_edge) {
  Random random(4);
  for (int i = 0; i < 200000; ++i) {
    BoxCase c = random_box(random, true);
    c.center = {0, 0, 0};
    for (std::size_t k = 0; k < 3; ++k) {
      const int place = random.below(4);
      if (place < 2) c.origin[k] = place == 0 ? c.half[k] : -c.half[k];
      if (place == 2) c.origin[k] = 0;
    }
    Vec3 d = random.direction();
    for (std::size_t k = 0; k < 3; ++k) {
      if (random.uniform() < 0.3) d[k] = random.uniform() < 0.5 ? 0.0 : -0.0;
    }
    if (length(d) == 0) continue;
    int axis = -1;
    ASSERT_FALSE(std::isnan(c.w(test::ray(d), axis))) << i;
    ASSERT_TRUE(axis >= 0 && axis < 3);
  }
}

// The origin in the very plane of a side: rays that lead away from the box miss it, on whichever side of it the box lies.
TEST(box, seen_from_the_plane_of_its_side) {
  for (const double side : {-1.0, 1.0}) {
    for (std::size_t k = 0; k < 2; ++k) {
      BoxCase box{{0, 0, 3}, {0.5, 0.5, 0.5}, {0, 0, 0}};
      box.center[k] = 0.5 * side;
      for (const double lean : {-0.15, -0.01, 0.01, 0.15}) {
        Vec3 direction{0.02, 0.02, 1};
        direction[k] = lean;
        int axis = 0;
        const float w = box.w(flow::make_ray(static_cast<float>(direction[0]), static_cast<float>(direction[1]), 1.0f), axis);
        if (lean * side > 0) {
          EXPECT_NEAR(w, 1 / 2.5, 1e-6) << side << " " << k << " " << lean;
        } else {
          EXPECT_LE(w, 0) << side << " " << k << " " << lean;
        }
      }
    }
  }
}
