// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
// Culling leaves out only what no ray of the bundle meets.
#include <gtest/gtest.h>

#include "support/culler.h"
#include "support/random_scene.h"
#include "support/rays.h"

using namespace tofray;
using namespace tofray::test;

namespace {

scene::Bounds random_rectangle(Random& random) {
  const double width = random.scale(1e-4, 1), height = random.scale(1e-4, 1), x = random.between(-1, 1), y = random.between(-1, 1);
  return {static_cast<float>(x), static_cast<float>(x + width), static_cast<float>(y), static_cast<float>(y + height)};
}

/// A ray of the rectangle, often in its rim.
Ray ray_within(const scene::Bounds& r, Random& random) {
  const auto pick = [&](float low, float high) {
    const int place = random.below(4);
    const auto inner = static_cast<float>(random.between(static_cast<double>(low), static_cast<double>(high)));
    return place == 0 ? low : place == 1 ? high : std::fmin(std::fmax(inner, low), high);
  };
  const float x = pick(r.x_min, r.x_max);
  const float y = pick(r.y_min, r.y_max);
  return flow::make_ray(x, y, 1.0f);
}

}  // namespace

TEST(culling, changes_no_hit_of_any_ray_in_the_rectangle) {
  Random random(1);
  long kept = 0, all = 0, hits = 0;
  for (int trial = 0; trial < 4000; ++trial) {
    Scene scene = random_scene(random, 30, false);
    scene.camera.pose = random_pose(random);
    const scene::FrozenScene frozen(scene, {Vec3{0, 0, 1} + random.point(1.5)}, 1);
    for (const scene::Forms& forms : {frozen.view().camera_still(), frozen.view().light_still(0)}) {
      const scene::Bounds rectangle = random_rectangle(random);
      Culler culler(forms);
      const auto some = culler.cull<trace::Culled>(forms, rectangle);
      const trace::Culled full = everything(forms);
      kept += some.count();
      all += full.count();
      for (int i = 0; i < 60; ++i) {
        const Ray ray = ray_within(rectangle, random);
        const auto without = trace::nearest(full, ray, flow::no_hit<float>());
        const auto with = trace::nearest(some, ray, flow::no_hit<float>());
        ASSERT_EQ(num::bits(with.w), num::bits(without.w)) << trial;
        ASSERT_EQ(with.facet, without.facet) << trial;
        hits += with.w > 0;
      }
    }
  }
  EXPECT_GT(hits, 200000);
  EXPECT_LT(kept, all / 2);  // and it does leave something out
}

// Rays that graze an outline, each in a rectangle of its own: the bounds may not be a hair too small.
TEST(culling, keeps_what_a_ray_grazes) {
  Random random(2);
  int grazed = 0;
  for (int trial = 0; trial < 100000; ++trial) {
    const Vec3 middle = Vec3{0, 0, 2} + random.point(1);
    Seen view;
    const Vec3 origin{0, 0, 0};
    std::vector<Vec3> outline;
    if (trial % 3 == 0) {
      for (int i = 0; i < 3; ++i) outline.push_back(middle + 0.3 * random.direction());
      view.add(shape::Triangle{{vec(outline[0]), vec(outline[1]), vec(outline[2])}}, origin);
    } else if (trial % 3 == 1) {
      const double radius = random.between(0.05, 0.5);
      view.add(shape::Sphere{vec(middle), radius}, origin);
      const double far = base::length(middle), half = std::asin(radius / far);  // the cone that touches it
      const Vec3 axis = base::normalized(middle);
      for (int i = 0; i < 4; ++i) outline.push_back(std::cos(half * (1 - 1e-6)) * axis + std::sin(half * (1 - 1e-6)) * random.across(axis));
    } else {
      const Vec3 half{random.between(0.05, 0.4), random.between(0.05, 0.4), random.between(0.05, 0.4)};
      const base::Mat3 axes = random.rotation();
      view.add(shape::Box{vec(middle), mat(axes), vec(half)}, origin);
      for (int i = 0; i < 8; ++i) {
        const Vec3 corner{(i & 1 ? 1 : -1) * half[0], (i & 2 ? 1 : -1) * half[1], (i & 4 ? 1 : -1) * half[2]};
        outline.push_back(middle + (1 - 1e-6) * (base::transposed(axes) * corner));
      }
    }
    for (const Vec3& at : outline) {
      const Ray ray = test::ray({at[0] / at[2], at[1] / at[2], 1});
      const auto hit = trace::nearest(everything(view.forms()), ray, flow::no_hit<float>());
      if (!(hit.w > 0)) continue;
      ++grazed;
      const scene::Bounds alone{ray.x, ray.x, ray.y, ray.y};
      Culler culler(view.forms());
      ASSERT_EQ(culler.cull<trace::Culled>(view.forms(), alone).count(), 1) << trial;
    }
  }
  EXPECT_GT(grazed, 200000);
}
