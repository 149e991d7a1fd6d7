// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
// Ray and rectangle: as the user puts it, from both sides, edge-on, and against the plane and its two coordinates in double precision.
#include <gtest/gtest.h>

#include <limits>

#include "support/brute_force.h"
#include "support/pixels.h"
#include "support/random.h"
#include "support/rays.h"
#include "trace/visible.h"

using namespace tofray;
using namespace tofray::base;
using tofray::test::Random;
using tofray::test::Span;

namespace {

shape::Rectangle rectangle(const Vec3& center, const Vec3& x, const Vec3& y) {
  return {{test::vec(center - x - y), test::vec(center + x - y), test::vec(center + x + y), test::vec(center - x + y)}};
}

double w(const shape::Rectangle& shape, const Vec3& origin, const test::Ray& ray) {
  return static_cast<double>(inverse_range(seen_from(shape, test::vec(origin)), ray));
}

/// A rectangle in the world and a camera at zero, through the whole of the simulator's scene.
scene::FrozenScene placed(const Rectangle& shape, const Rotation& rotation, const std::optional<Vec3>& sun = {}) {
  Scene scene = test::wall(5);
  scene.objects = {test::object(shape)};
  scene.objects[0].rotation = rotation;
  scene.ambient.direction = sun;
  return scene::FrozenScene(scene, {Vec3{0, 0, 4}}, 1);
}

flow::Surface<float> seen(const scene::FrozenScene& frozen, const Vec3& d) {
  const test::Ray ray = test::ray(d);
  return trace::surface(frozen.view(), ray, trace::nearest(test::everything(frozen.view().camera_still()), ray, flow::no_hit<float>()));
}

}  // namespace

// 0.8 m wide, 0.4 m high, 2 m before the camera: its edges are at 0.2 and 0.1 of z.
TEST(rectangle, stands_across_the_view_before_it_is_turned) {
  const scene::FrozenScene frozen = placed({{0, 0, 2}, {0.8, 0.4}}, {});
  for (const double x : {-0.2001, -0.1999, 0.0, 0.1999, 0.2001}) {
    for (const double y : {-0.1001, -0.0999, 0.0, 0.0999, 0.1001}) {
      const flow::Surface<float> s = seen(frozen, {x, y, 1});
      ASSERT_EQ(s.found, std::abs(x) < 0.2 && std::abs(y) < 0.1) << x << " " << y;
      if (!s.found) continue;
      EXPECT_NEAR(static_cast<double>(s.z), 2, 1e-6);
      EXPECT_EQ(s.nx, 0);
      EXPECT_EQ(s.ny, 0);
      EXPECT_EQ(s.nz, -1);
    }
  }
}

// A quarter turn about z exchanges width and height; 60 degrees about y make it half as wide, and its right edge nearer by 0.4·sin 60°.
TEST(rectangle, turns_about_its_centre) {
  const scene::FrozenScene upright = placed({{0, 0, 2}, {0.8, 0.4}}, {{0, 0, 1}, 0.5 * test::pi});
  EXPECT_TRUE(seen(upright, {0, 0.1999, 1}).found);
  EXPECT_TRUE(seen(upright, {0.0999, 0, 1}).found);
  EXPECT_FALSE(seen(upright, {0, 0.2001, 1}).found);
  EXPECT_FALSE(seen(upright, {0.1001, 0, 1}).found);
  const scene::FrozenScene slanted = placed({{0, 0, 2}, {0.8, 0.4}}, {{0, 1, 0}, test::pi / 3});
  const double near = 2 - 0.4 * std::sin(test::pi / 3);
  const flow::Surface<float> s = seen(slanted, {0.2 / near * 0.9999, 0, 1});
  ASSERT_TRUE(s.found);
  EXPECT_NEAR(static_cast<double>(s.z), near, 1e-4);
  EXPECT_NEAR(std::abs(static_cast<double>(s.nz)), 0.5, 1e-6);
  EXPECT_FALSE(seen(slanted, {0.2 / near * 1.0001, 0, 1}).found);
}

// Its edges are known to a part in 2^24 of the direction's length (a plane through the origin and the edge, its numbers rounded once);
// the range as that of a plane: three products and sums, longer by 1/cos of the angle between ray and normal.
TEST(rectangle, is_hit_and_missed_like_the_closed_form) {
  Random random(1);
  int hits = 0, misses = 0;
  for (int i = 0; i < 1000000; ++i) {
    const Vec3 center = random.point(3), x = random.scale(1e-3, 3) * random.direction();
    const Vec3 y = random.scale(1e-3, 3) * random.across(normalized(x)), origin = random.point(3);
    const shape::Rectangle shape = rectangle(center, x, y);
    const Vec3 aim = center + random.between(-1.5, 1.5) * x + random.between(-1.5, 1.5) * y;
    const test::Ray ray = test::ray(normalized(aim - origin));
    const Vec3 d = test::direction(ray), n = normalized(cross(x, y));
    const double slant = std::abs(dot(n, d)) / length(d), size = std::fmin(length(x), length(y));
    const Span s = test::span(shape, origin, d);
    if (s.clearance < 8 * 0x1p-24 * length(aim - origin) / (size * slant) || slant < 1e-4) continue;
    const double got = w(shape, origin, ray);
    ASSERT_EQ(got > 0, test::first(s) > 0) << i;
    if (!(got > 0)) {
      ++misses;
      continue;
    }
    ++hits;
    ASSERT_LE(std::abs(1 / got - s.enter), 8 * 0x1p-24 * length(aim - origin) / slant) << i;
  }
  EXPECT_GT(hits, 300000);
  EXPECT_GT(misses, 300000);
}

// Of a strip 1 mm by 10 m, and 1 cm wide 10 km away, every ray into its middle hits and every one beside it misses.
TEST(rectangle, may_be_long_and_far) {
  Random random(2);
  for (int i = 0; i < 100000; ++i) {
    const bool far = i % 2 == 0;
    const Vec3 x = random.direction(), y = random.across(x), n = cross(x, y);
    const double half = far ? 5e-3 : 5e-4, away = far ? 1e4 : random.between(0.1, 5);
    const Vec3 center = away * n + random.between(-0.5, 0.5) * away * x;
    const shape::Rectangle shape = rectangle(center, half * x, 5.0 * y);
    const double u = random.between(-2, 2), v = random.between(-1.2, 1.2);
    const Vec3 at = center + half * u * x + 5 * v * y;
    const Vec3 d = test::direction(test::ray(at));
    // The ray as single precision has it, where it meets the plane.
    const Vec3 met = (dot(n, center) / dot(n, d)) * d - center;
    const double across = std::abs(dot(met, x)) / half - 1, along = std::abs(dot(met, y)) / 5 - 1;
    if (std::fmin(std::abs(across) * half, std::abs(along) * 5) < 8 * 0x1p-24 * length(at)) continue;
    ASSERT_EQ(w(shape, {0, 0, 0}, test::ray(at)) > 0, across < 0 && along < 0) << i;
  }
}

TEST(rectangle, is_not_seen_edge_on_nor_behind) {
  const shape::Rectangle shape = rectangle({0, 0, 2}, {0.5, 0, 0}, {0, 0, 0.5});
  Random random(3);
  for (int i = 0; i < 1000; ++i) {
    EXPECT_FALSE(w(shape, {0, 0, 0}, test::ray(Vec3{0, 0, 1} + random.point(0.3))) > 0);
    const shape::Rectangle behind = rectangle({0, 0, -1}, {0.5, 0, 0}, {0, 0.5, 0});
    EXPECT_FALSE(w(behind, {0, 0, 0}, test::ray(Vec3{0, 0, 1} + random.point(0.3))) > 0);
    EXPECT_TRUE(w(behind, {0, 0, -2}, test::ray(Vec3{0, 0, 1} + random.point(0.3))) > 0);  // its other side
  }
}

// A sun that shines across it shades what is before or behind it, in its own outline; one along it nothing.
TEST(rectangle, shades_from_the_sun_where_its_outline_is) {
  Random random(4);
  int dark = 0, lit = 0;
  for (int i = 0; i < 200000; ++i) {
    const Vec3 center = random.point(2), x = random.direction(), y = random.across(x), n = cross(x, y);
    const Vec3 half{random.scale(1e-3, 1), random.scale(1e-3, 1), 0};
    const bool along = i % 20 == 0;
    const Vec3 s = along ? normalized(x + random.between(-9e-7, 9e-7) * n) : random.direction();
    const shape::Rectangle shape = rectangle(center, half[0] * x, half[1] * y);
    const double u = random.between(-1.5, 1.5), v = random.between(-1.5, 1.5), t = random.between(-1, 2);
    flow::Surface<float> p{};
    const Vec3 at = center + half[0] * u * x + half[1] * v * y - t * s;
    p.x = static_cast<float>(at[0]), p.y = static_cast<float>(at[1]), p.z = static_cast<float>(at[2]);
    const float sun[3] = {static_cast<float>(s[0]), static_cast<float>(s[1]), static_cast<float>(s[2])};
    const bool got = blocks(seen_along(shape, test::vec(s)), p, sun, 1e-4f);
    const double slant = std::abs(dot(n, s)), sure = 1e-5 / std::fmin(half[0], half[1]) / slant;
    ASSERT_FALSE(along && got) << i;
    if (slant < 1e-3 || std::abs(std::abs(u) - 1) < sure || std::abs(std::abs(v) - 1) < sure || std::abs(t) < 1e-3 / slant) continue;
    ASSERT_EQ(got, std::abs(u) < 1 && std::abs(v) < 1 && t > 0) << i;
    ++(got ? dark : lit);
  }
  EXPECT_GT(dark, 20000);
  EXPECT_GT(lit, 20000);
}

TEST(rectangle, shades_a_lamp_and_not_itself) {
  const scene::FrozenScene frozen = placed({{0, 0, 2}, {0.8, 0.4}}, {});
  const flow::Surface<float> s = seen(frozen, {0.1, 0.05, 1});
  const scene::Forms lamp = frozen.view().light_still(0);  // 4 m before the camera, behind the rectangle
  const auto dark = [&](const Vec3& at, int object) {
    flow::Surface<float> p = s;
    p.object = object;
    return trace::blocked(test::everything(lamp), test::ray(at - Vec3{0, 0, 4}), p);
  };
  EXPECT_FALSE(dark({0.2, 0.1, 2}, 0));
  EXPECT_TRUE(dark({0.79, 0, 0}, 1));  // twice as far from the lamp its shadow is 1.6 m wide
  EXPECT_FALSE(dark({0.81, 0, 0}, 1));
  EXPECT_TRUE(dark({0, 0.39, 0}, 1));
  EXPECT_FALSE(dark({0, 0.41, 0}, 1));
  EXPECT_FALSE(dark({0, 0, 3}, 1));
}
