// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
// Rays from anywhere: each shape's distance against the crossings in double precision, from outside, inside and the surface itself.
#include <gtest/gtest.h>

#include "support/brute_force.h"
#include "support/random_scene.h"

using namespace tofray;
using namespace tofray::test;

namespace {

shape::FreeRay<float> free_ray(const Vec3& o, const Vec3& d) {
  const auto f = [](double a) { return static_cast<float>(a); };
  return {f(o[0]), f(o[1]), f(o[2]), f(d[0]), f(d[1]), f(d[2])};
}
Vec3 origin_of(const shape::FreeRay<float>& r) { return {static_cast<double>(r.x), static_cast<double>(r.y), static_cast<double>(r.z)}; }
Vec3 direction_of(const shape::FreeRay<float>& r) {
  return {static_cast<double>(r.dx), static_cast<double>(r.dy), static_cast<double>(r.dz)};
}

/// What a ray meets of one shape, further on than `least`: 0 for nothing.
template <class T>
double met(const T& shape, const shape::FreeRay<float>& ray, double least) {
  num::Int<float> named;
  float t;
  if constexpr (T::closed) {
    const shape::Passage<float> line = passage(free_of(shape), ray);
    const double in = static_cast<double>(line.in), out = static_cast<double>(line.out);
    return in > out || out <= least ? 0 : in > least ? in : out;
  } else if constexpr (shape::many_of<T>) {
    t = distance_to(free_of(shape), ray, static_cast<float>(least), shape::never, true, named);
  } else {
    t = distance_to(free_of(shape), ray, static_cast<float>(least), named);
  }
  return t < shape::never ? static_cast<double>(t) : 0;
}

struct Met {
  double distance = 0;
  int object = -1;
};

template <class... T>
Met nearest(shape::List<T...>, const scene::FrozenScene& frozen, const shape::FreeRay<float>& ray, double least) {
  Met out;
  const auto look = [&]<class One>(const scene::BodiesOf<One>& bodies) {
    for (int i = 0; i < bodies.count; ++i) {
      const double t = met(in_frame(bodies.first[i].shape, frozen.view().camera), ray, least);
      if (t > 0 && (out.object < 0 || t < out.distance)) out = {t, bodies.first[i].object};
    }
  };
  (look(frozen.view().still.bodies.of<T>()), ...);
  return out;
}

/// The nearest crossing beyond `least` by brute force, and whether rounding may decide which it is.
struct Expected {
  Met met;
  bool unsure = false;
};
Expected expected(const scene::FrozenScene& frozen, const shape::FreeRay<float>& ray, double least) {
  Expected out;
  const Vec3 d = direction_of(ray);
  const double size = base::length(d);
  double second = 1e300;
  for (const Span& s : spans(frozen, origin_of(ray), d)) {
    out.unsure = out.unsure || s.clearance < 1e-3;
    if (s.enter > s.leave) continue;
    for (const double t : {s.enter * size, s.leave * size}) {
      if (std::abs(t - least) < 0.5 * least) out.unsure = true;
      if (t <= least) continue;
      if (out.met.object < 0 || t < out.met.distance) {
        if (out.met.object >= 0) second = std::fmin(second, out.met.distance);
        out.met = {t, s.object};
      } else if (t > out.met.distance) {
        second = std::fmin(second, t);
      }
    }
  }
  if (out.met.object >= 0 && second - out.met.distance < 1e-4) out.unsure = true;
  return out;
}

}  // namespace

TEST(free_rays, meet_what_brute_force_finds_from_anywhere) {
  Random random(3);
  int compared = 0, found = 0;
  for (int trial = 0; trial < 40; ++trial) {
    Scene scene = random_scene(random, 25, false);
    scene.camera.pose = random_pose(random);
    const scene::FrozenScene frozen(scene, {}, 1);
    for (int i = 0; i < 1500; ++i) {
      const auto ray = free_ray(Vec3{0, 0, 2} + random.point(2.5), random.direction());
      const double least = 1e-4;
      const Expected e = expected(frozen, ray, least);
      if (e.unsure) continue;
      ++compared;
      const Met m = nearest(shape::Shapes{}, frozen, ray, least);
      ASSERT_EQ(m.object, e.met.object) << trial << " " << i << ": " << m.distance << " and " << e.met.distance;
      if (m.object < 0) continue;
      ++found;
      ASSERT_NEAR(m.distance, e.met.distance, 3e-5 * (1 + e.met.distance)) << trial << " " << i << " of object " << m.object;
    }
  }
  EXPECT_GT(compared, 35000);
  EXPECT_GT(found, 20000);
}

// From where a ray has met something: on along a random way, to either side of the surface.
TEST(free_rays, that_leave_a_surface_do_not_meet_it_where_they_begin) {
  Random random(4);
  int compared = 0;
  for (int trial = 0; trial < 40; ++trial) {
    Scene scene = random_scene(random, 25, false);
    scene.camera.pose = random_pose(random);
    const scene::FrozenScene frozen(scene, {}, 1);
    for (int i = 0; i < 1500; ++i) {
      auto ray = free_ray({0, 0, 0}, base::normalized(Vec3{0, 0, 1} + random.point(0.6)));
      const Met seen = nearest(shape::Shapes{}, frozen, ray, 1e-4);
      if (seen.object < 0) continue;
      const Vec3 at = seen.distance * direction_of(ray);
      ray = free_ray(at, random.direction());
      const double least = 1e-4 * seen.distance;
      const Expected e = expected(frozen, ray, least);
      if (e.unsure) continue;
      ++compared;
      const Met m = nearest(shape::Shapes{}, frozen, ray, least);
      ASSERT_EQ(m.object, e.met.object) << trial << " " << i << ": " << m.distance << " and " << e.met.distance << " from " << seen.object;
      if (m.object < 0) continue;
      ASSERT_NEAR(m.distance, e.met.distance, 1e-4 * (1 + e.met.distance)) << trial << " " << i;
    }
  }
  EXPECT_GT(compared, 25000);
}

// A closed room of triangles that share corners lets no ray out, from anywhere in it.
TEST(free_rays, do_not_leak_between_polygons_that_share_corners) {
  Random random(5);
  const Vec3 low{-0.7, -0.4, 0.3}, high{0.9, 0.8, 2.1};
  std::vector<shape::Triangle> room;
  for (int axis = 0; axis < 3; ++axis) {
    for (const bool far : {false, true}) {
      const auto corner = [&](bool u, bool v) {
        Vec3 p;
        const auto k = static_cast<std::size_t>(axis);
        p[k] = far ? high[k] : low[k];
        p[(k + 1) % 3] = u ? high[(k + 1) % 3] : low[(k + 1) % 3], p[(k + 2) % 3] = v ? high[(k + 2) % 3] : low[(k + 2) % 3];
        return vec(p);
      };
      room.push_back({{corner(false, false), corner(true, false), corner(true, true)}});
      room.push_back({{corner(false, false), corner(true, true), corner(false, true)}});
    }
  }
  for (int i = 0; i < 300000; ++i) {
    Vec3 o, to;
    for (std::size_t k = 0; k < 3; ++k) o[k] = random.between(low[k] + 0.01, high[k] - 0.01);
    // at the edges and diagonals, where leaks would be
    const shape::Triangle& one = room[static_cast<std::size_t>(random.below(12))];
    const Vec3 a = vec3(one.vertex[random.below(3)]), b = vec3(one.vertex[random.below(3)]);
    to = a + random.uniform() * (b - a);
    const auto ray = free_ray(o, base::normalized(to - o));
    double best = 0;
    for (const shape::Triangle& t : room) {
      const double distance = met(t, ray, 1e-5);
      if (distance > 0 && (best == 0 || distance < best)) best = distance;
    }
    ASSERT_GT(best, 0) << i;
    ASSERT_NEAR(best, base::length(to - o), 2e-4 * (1 + best)) << i;
  }
}
