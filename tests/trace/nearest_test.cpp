// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
// Which surface a camera ray meets, and its normal.
#include <gtest/gtest.h>

#include "support/brute_force.h"
#include "support/random_scene.h"
#include "support/rays.h"

using namespace tofray;
using namespace tofray::test;

namespace {

struct Found {
  flow::Hit<float> hit;
  flow::Surface<float> surface;
};

Found look(const scene::FrozenScene& frozen, const Ray& ray) {
  const scene::SceneView& view = frozen.view();
  const auto hit = trace::nearest(everything(view.camera_still()), ray, flow::no_hit<float>());
  return {hit, trace::surface(view, ray, hit)};
}

Vec3 wide(float x, float y, float z) { return {static_cast<double>(x), static_cast<double>(y), static_cast<double>(z)}; }
Vec3 normal(const Found& f) { return wide(f.surface.nx, f.surface.ny, f.surface.nz); }
Vec3 place(const Found& f) { return wide(f.surface.x, f.surface.y, f.surface.z); }

}  // namespace

TEST(nearest, is_the_first_that_brute_force_finds) {
  Random random(1);
  int compared = 0, objects_seen = 0;
  for (int trial = 0; trial < 40; ++trial) {
    Scene scene = random_scene(random, 25, false);
    scene.camera.pose = random_pose(random);
    const scene::FrozenScene frozen(scene, {}, 1);
    for (int i = 0; i < 2000; ++i) {
      const Vec3 aside = random.point(0.6);
      const Ray ray = test::ray({aside[0], aside[1], 1});
      double best = 1e300, second = 1e300;
      int object = -1;
      bool unsure = false;
      for (const Span& s : spans(frozen, {0, 0, 0}, direction(ray))) {
        unsure = unsure || s.clearance < 1e-4;
        const double t = first(s);
        if (t <= 0) continue;
        if (t < best)
          second = best, best = t, object = s.object;
        else
          second = std::fmin(second, t);
      }
      if (unsure || second - best < 1e-4 * best) continue;  // outlines and touching things: rounding may decide
      ++compared;
      objects_seen += object > 0;
      const Found f = look(frozen, ray);
      ASSERT_EQ(f.surface.found, object >= 0);
      if (object < 0) continue;
      ASSERT_EQ(f.surface.object, object) << trial << " " << i;
      ASSERT_NEAR(static_cast<double>(f.surface.z), best, 2e-5 * best);
    }
  }
  EXPECT_GT(compared, 60000);
  EXPECT_GT(objects_seen, 20000);
}

// Unit length, toward the camera, and the closed form's direction: the gradient of each shape.
TEST(nearest, normals_face_the_camera_and_are_those_of_the_shapes) {
  Random random(2);
  int seen[5] = {};
  double worst[5] = {};
  for (int trial = 0; trial < 20000; ++trial) {
    Scene scene = wall(5);
    scene.objects.clear();
    Object one;
    const Vec3 middle = Vec3{0, 0, 2} + random.point(0.3);
    const int kind = trial % 5;
    const Vec3 n = random.direction();
    std::array<Vec3, 3> v;
    for (Vec3& vertex : v) vertex = middle + 0.8 * random.direction();
    if (kind == 0) one.shape = Plane{middle, 3.0 * n};
    if (kind == 1) one.shape = Sphere{middle, 0.4};
    if (kind == 2) one.shape = Box{middle - Vec3{0.4, 0.3, 0.2}, middle + Vec3{0.4, 0.3, 0.2}};
    if (kind == 3) one.shape = Triangle{v};
    if (kind == 4) {  // turned about zero, not about its middle
      for (Vec3& vertex : v) vertex = vertex - middle;
      one.shape = shared(single({{v.begin(), v.end()}, {{0, 1, 2}}}));
    }
    one.rotation.axis = random.direction();
    one.rotation.angle_rad = random.between(-3, 3);
    one.position = random.point(0.1) + (kind == 4 ? middle : Vec3{0, 0, 0});
    scene.objects.push_back(one);
    scene.camera.pose = random_pose(random);
    const scene::FrozenScene frozen(scene, {}, 1);
    const Vec3 aside = random.point(0.15);
    const Ray ray = test::ray({aside[0], aside[1], 1});
    const Found f = look(frozen, ray);
    if (!f.surface.found) continue;
    ++seen[kind];
    const Vec3 got = normal(f), d = direction(ray), point = place(f);
    ASSERT_NEAR(base::length(got), 1, 1e-6) << kind;
    ASSERT_LE(base::dot(got, d), 0) << kind;
    ASSERT_NEAR(static_cast<double>(f.surface.cos_view), -base::dot(got, d) / base::length(d), 1e-6);
    // in the object's own axes
    const scene::CameraFrame camera = scene::camera_frame(scene.camera.pose);
    const double a = one.rotation.angle_rad, c = std::cos(a), s = std::sin(a);
    const Vec3 k = base::normalized(one.rotation.axis);
    const auto turn = [&](const Vec3& p) { return c * p + s * base::cross(k, p) + ((1 - c) * base::dot(k, p)) * k; };
    const auto to_camera = [&](const Vec3& p) { return camera.rotation * p; };
    // How far the tips of the two normals are apart, whichever side each is of.
    const auto apart = [&](const Vec3& expected) { return std::fmin(base::length(got - expected), base::length(got + expected)); };
    double off = 2;
    if (kind == 0) off = apart(to_camera(turn(n)));
    if (kind == 1) off = apart(base::normalized(point - to_camera(middle + one.position - camera.position)));
    if (kind == 2) {
      for (const Vec3& axis : {Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}}) off = std::fmin(off, apart(to_camera(turn(axis))));
    }
    if (kind >= 3) off = apart(to_camera(turn(base::normalized(base::cross(v[1] - v[0], v[2] - v[0])))));
    worst[kind] = std::fmax(worst[kind], off);
  }
  for (const int count : seen) EXPECT_GT(count, 300);
  for (const double off : worst) EXPECT_LT(off, 1e-6);
}

// A box's side is right, not only some side: the hit point lies in it.
TEST(nearest, names_the_side_of_a_box_that_the_ray_goes_through) {
  Random random(3);
  int sides[3] = {};
  for (int trial = 0; trial < 3000; ++trial) {
    Scene scene = wall(5);
    const Vec3 half{0.4, 0.3, 0.2}, middle{0, 0, 2};
    scene.objects[0].shape = Box{middle - half, middle + half};
    const Vec3 from = 2.5 * random.direction();
    scene.camera.pose = {middle + from, middle, random.across(base::normalized(from))};
    const scene::FrozenScene frozen(scene, {}, 1);
    const Vec3 aside = random.point(0.12);
    const Ray ray = test::ray({aside[0], aside[1], 1});
    const Found f = look(frozen, ray);
    if (!f.surface.found) continue;
    const base::Mat3 back = base::transposed(scene::camera_frame(scene.camera.pose).rotation);
    const Vec3 n = back * normal(f), at = back * place(f) + scene::camera_frame(scene.camera.pose).position - middle;
    for (std::size_t k = 0; k < 3; ++k) {
      if (std::abs(n[k]) < 0.5) continue;
      ++sides[k];
      ASSERT_NEAR(at[k], std::copysign(half[k], n[k]), 3e-6);
    }
  }
  for (const int count : sides) EXPECT_GT(count, 300);
}
