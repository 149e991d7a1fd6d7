// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
// Shadow rays of lamps and of the sun against brute force; nothing shades itself; lamps in and out of closed bodies.
#include <gtest/gtest.h>

#include "power/received.h"
#include "support/brute_force.h"
#include "support/meshes.h"
#include "support/random_scene.h"
#include "support/rays.h"
#include "trace/visible.h"

using namespace tofray;
using namespace tofray::test;

namespace {

flow::Surface<float> surface_seen(const scene::FrozenScene& frozen, const Ray& ray) {
  const scene::SceneView& view = frozen.view();
  return trace::surface(view, ray, trace::nearest(everything(view.camera_still()), ray, flow::no_hit<float>()));
}

Vec3 place_of(const flow::Place<float>& s) { return {static_cast<double>(s.x), static_cast<double>(s.y), static_cast<double>(s.z)}; }
Vec3 normal_of(const flow::Surface<float>& s) { return {static_cast<double>(s.nx), static_cast<double>(s.ny), static_cast<double>(s.nz)}; }

bool dark(const scene::FrozenScene& frozen, std::size_t light, const Vec3& at, const flow::Surface<float>& s) {
  const scene::Forms forms = frozen.view().light_still(static_cast<int>(light));
  const flow::Place<float> before = trace::a_little_before(frozen.view(), s, ray(place_of(s)));
  return trace::blocked(everything(forms), ray(place_of(before) - at), before);
}

bool dark_of_sun(const scene::FrozenScene& frozen, const flow::Surface<float>& s) {
  const Vec3& toward = frozen.toward_sun();
  const float sun[3] = {static_cast<float>(toward[0]), static_cast<float>(toward[1]), static_cast<float>(toward[2])};
  return trace::blocked_parallel(trace::Uncut{frozen.view().sun_still()}, sun, trace::a_little_before(frozen.view(), s, ray(place_of(s))));
}

enum class Answer { lit, dark, unsure };

/// Does anything cross p + t·d for t in (low, high)? Unsure within the margin at either end and near outlines. p lies in the surface of
/// `own`: it counts where the ray goes on through its inside, as it does for a camera within.
Answer crossed(const scene::FrozenScene& frozen, const Vec3& p, const Vec3& d, double high, int own) {
  bool unsure = false;
  for (const Span& s : spans(frozen, p, d)) {
    const double low = 1e-4;
    if (s.clearance < 1e-4) {
      unsure = true;
      continue;
    }
    if (s.object == own && s.leave < low) continue;
    if (s.leave > s.enter && s.leave - s.enter < 2 * low) {  // of the sun's light a corner as thin as the shadow's margin keeps off nothing
      unsure = true;
      continue;
    }
    if (s.enter > s.leave || s.leave < 0 || s.enter > high) continue;
    if (s.leave < low || s.enter > high * (1 - 1e-4)) {
      unsure = true;
      continue;
    }
    // a body that p or the light is inside of still stands between if its surface is crossed
    if (s.enter > low || s.leave < high * (1 - 1e-4)) return Answer::dark;
    if (s.enter > -low || s.leave < high * (1 + 1e-4)) unsure = true;
  }
  return unsure ? Answer::unsure : Answer::lit;
}

constexpr double no_end = 1e6;

}  // namespace

TEST(shadow, of_a_lamp_is_where_brute_force_finds_something_between) {
  Random random(1);
  int lit = 0, shaded = 0;
  for (int trial = 0; trial < 40; ++trial) {
    Scene scene = random_scene(random, 25, false);
    scene.camera.pose = random_pose(random);
    const std::vector<Vec3> lamps{{0.01547, 0, 0}, random.point(0.5), Vec3{0, 0, 2} + random.point(2)};
    const scene::FrozenScene frozen(scene, lamps, 1);
    for (int i = 0; i < 2000; ++i) {
      const Vec3 aside = random.point(0.6);
      const flow::Surface<float> s = surface_seen(frozen, ray({aside[0], aside[1], 1}));
      if (!s.found) continue;
      for (std::size_t l = 0; l < lamps.size(); ++l) {
        const Vec3 p = place_of(s), to_lamp = lamps[l] - p;
        if (base::dot(normal_of(s), to_lamp) <= 0) continue;  // turned away: dark without a shadow ray
        const Answer answer = crossed(frozen, p, to_lamp, 1, s.object);
        if (answer == Answer::unsure) continue;
        ++(answer == Answer::dark ? shaded : lit);
        // own closed bodies are a case of their own, below
        ASSERT_EQ(dark(frozen, l, lamps[l], s), answer == Answer::dark) << trial << " " << i << " " << l << " object " << s.object;
      }
    }
  }
  EXPECT_GT(lit, 20000);
  EXPECT_GT(shaded, 20000);
}

TEST(shadow, of_the_sun_is_where_brute_force_finds_something_between) {
  Random random(2);
  int lit = 0, shaded = 0;
  for (int trial = 0; trial < 60; ++trial) {
    Scene scene = random_scene(random, 25, false);
    scene.camera.pose = random_pose(random);
    scene.ambient.direction = random.direction();
    const scene::FrozenScene frozen(scene, {}, 1);
    const Vec3 toward = frozen.toward_sun();
    for (int i = 0; i < 2000; ++i) {
      const Vec3 aside = random.point(0.6);
      const flow::Surface<float> s = surface_seen(frozen, ray({aside[0], aside[1], 1}));
      if (!s.found || base::dot(normal_of(s), toward) <= 0) continue;
      const Answer answer = crossed(frozen, place_of(s), toward, no_end, s.object);
      if (answer == Answer::unsure) continue;
      ++(answer == Answer::dark ? shaded : lit);
      ASSERT_EQ(dark_of_sun(frozen, s), answer == Answer::dark) << trial << " " << i << " object " << s.object;
    }
  }
  EXPECT_GT(lit, 5000);
  EXPECT_GT(shaded, 20000);
}

// On bodies and on a mesh of objects of its own: what faces the light is lit, at any distance from zero.
TEST(shadow, is_never_cast_by_a_convex_thing_upon_itself) {
  Random random(3);
  int points = 0;
  constexpr int kinds = 6;
  for (int trial = 0; trial < 3 * kinds; ++trial) {
    const int kind = trial % kinds;
    const double far = 0.5 * std::pow(10, trial / kinds);
    Scene scene = wall(1);
    scene.objects.clear();
    if (kind == 0) {
      const ClosedMesh mesh = icosphere(2);
      for (const auto& t : mesh.triangles) {
        Triangle triangle;
        for (std::size_t k = 0; k < 3; ++k) triangle.vertices[k] = 0.3 * far * mesh.at(t[k]) + Vec3{0, 0, far};
        scene.objects.push_back(object(triangle));
      }
    }
    if (kind == 1) scene.objects.push_back(object(Sphere{{0.05 * far, 0, far}, 0.3 * far}));
    if (kind == 2) scene.objects.push_back(object(Box{{-0.3 * far, -0.2 * far, 0.8 * far}, {0.2 * far, 0.2 * far, 1.2 * far}}));
    if (kind == 3) scene.objects.push_back(object(Cylinder{{0.05 * far, 0, far}, random.direction(), 0.2 * far, 0.4 * far}));
    if (kind == 4) scene.objects.push_back(object(Capsule{{-0.1 * far, 0.05 * far, 0.9 * far}, {0.1 * far, 0, 1.1 * far}, 0.2 * far}));
    if (kind == 5) scene.objects.push_back(object(Cone{{0, 0.05 * far, far}, random.direction(), 0.2 * far, 0.5 * far}));
    const std::vector<Vec3> lamps{{0, 0.05 * far, 0}, {0, -0.1 * far, 0.2 * far}, {0.9 * far, 0.4 * far, 0.9 * far}};
    const scene::FrozenScene frozen(scene, lamps, 1);
    for (int i = 0; i < (kind == 0 ? 20000 : 100000); ++i) {
      const Vec3 d{random.between(-0.35, 0.35), random.between(-0.3, 0.3), 1};
      const flow::Surface<float> s = surface_seen(frozen, ray(d));
      if (!s.found) continue;
      for (std::size_t l = 0; l < lamps.size(); ++l) {
        const Vec3 to_lamp = lamps[l] - place_of(s);
        if (base::dot(normal_of(s), to_lamp) <= 0) continue;
        ++points;
        ASSERT_FALSE(dark(frozen, l, lamps[l], s)) << far << " " << i << " " << l << " object " << s.object;
      }
    }
  }
  EXPECT_GT(points, 1'000'000);
}

// Seen or lit at a grazing angle the range of a flat thing is uncertain by far more than the margin: it must not ask for itself.
TEST(shadow, is_not_cast_by_a_flat_thing_upon_itself_however_flat_the_light_falls) {
  Random random(4);
  for (int trial = 0; trial < 2000; ++trial) {
    Scene scene = wall(1);
    scene.objects.clear();
    const Vec3 n = base::normalized(Vec3{0, 0, -1} + random.point(0.8)), middle{0, 0, 2};
    const Vec3 x = random.across(n), y = base::cross(n, x);
    const bool plane = trial % 2 == 0;
    if (plane)
      scene.objects.push_back(object(Plane{middle, n}));
    else
      scene.objects.push_back(object(Triangle{{{middle + 9.0 * x, middle - 5.0 * x + 8.0 * y, middle - 5.0 * x - 8.0 * y}}}));
    const double angle = random.between(0, 2 * pi), rise = random.scale(1e-5, 1e-2);
    const Vec3 lamp = middle + 2.0 * std::cos(angle) * x + 2.0 * std::sin(angle) * y + rise * n;
    const scene::FrozenScene frozen(scene, {lamp}, 1);
    for (int i = 0; i < 50; ++i) {
      const Vec3 aside = random.point(0.1);
      const flow::Surface<float> s = surface_seen(frozen, ray({aside[0], aside[1], 1}));
      ASSERT_TRUE(s.found);
      ASSERT_FALSE(dark(frozen, 0, lamp, s)) << trial << " " << rise;
    }
  }
}

// A card that lies in the wall's own plane does not speckle it: rounding puts either in front.
TEST(shadow, is_not_cast_by_a_card_upon_the_wall_that_it_lies_in) {
  Random random(5);
  for (int trial = 0; trial < 300; ++trial) {
    const Vec3 n = base::normalized(Vec3{0, 0, -1} + random.point(0.3)), middle{0, 0, 2}, x = random.across(n), y = base::cross(n, x);
    Scene scene = wall(1);
    scene.objects.clear();
    scene.objects.push_back(object(Plane{middle, n}));
    scene.objects.push_back(object(Triangle{{{middle + 0.5 * x, middle - 0.3 * x + 0.4 * y, middle - 0.3 * x - 0.4 * y}}}));
    const Vec3 lamp = random.point(0.3);
    const scene::FrozenScene frozen(scene, {lamp}, 1);
    for (int i = 0; i < 200; ++i) {
      const Vec3 aside = random.point(0.4);
      const flow::Surface<float> s = surface_seen(frozen, ray({aside[0], aside[1], 1}));
      ASSERT_TRUE(s.found);
      ASSERT_FALSE(dark(frozen, 0, lamp, s)) << trial;
    }
  }
}

namespace {

/// Camera at zero, and a closed body about it or not, a lamp inside or not, a wall behind.
struct Closed {
  const char* name;
  bool box;
  Vec3 center;
  double size;
  Vec3 lamp;
  bool body_dark;  ///< what the camera sees of the body
  bool wall_dark;  ///< the wall, where the camera sees it
};

Scene closed_scene(const Closed& c) {
  Scene scene = wall(4);
  const Vec3 half{c.size, c.size, c.size};
  if (c.box)
    scene.objects.push_back(object(Box{c.center - half, c.center + half}));
  else
    scene.objects.push_back(object(Sphere{c.center, c.size}));
  return scene;
}

}  // namespace

TEST(shadow, of_a_closed_body_knows_inside_from_outside) {
  for (const bool box : {false, true}) {
    const Closed cases[] = {
        {"camera and lamp inside", box, {0, 0, 0}, 1, {0.3, 0.2, 0}, false, false},
        {"camera inside, lamp outside", box, {0, 0, 0}, 1, {2.5, 0, 0}, true, false},
        {"camera outside, lamp inside", box, {0, 0, 2}, 0.5, {0.1, 0, 2}, true, true},
        {"camera and lamp outside", box, {0, 0, 2}, 0.5, {0.1, 0, 0}, false, false},
    };
    for (const Closed& c : cases) {
      const Scene scene = closed_scene(c);
      const scene::FrozenScene frozen(scene, {c.lamp}, 1);
      int body = 0, walls = 0;
      for (double x = -0.6; x <= 0.6; x += 0.05) {
        const flow::Surface<float> s = surface_seen(frozen, ray({x, 0.01, 1}));
        ASSERT_TRUE(s.found);
        const Vec3 to_lamp = c.lamp - place_of(s);
        if (base::dot(normal_of(s), to_lamp) <= 0 && !(s.object == 1 && c.body_dark)) continue;
        ++(s.object == 1 ? body : walls);
        if (s.object == 1) {
          EXPECT_EQ(dark(frozen, 0, c.lamp, s), c.body_dark) << c.name << (box ? " box " : " sphere ") << x;
        } else if (c.wall_dark || std::abs(x) > 0.5) {
          EXPECT_EQ(dark(frozen, 0, c.lamp, s), c.wall_dark) << c.name << (box ? " box " : " sphere ") << x;
        }
      }
      EXPECT_GT(body, 5) << c.name;
      EXPECT_GT(walls, c.center[2] > 0 ? 5 : -1) << c.name;
    }
  }
}

TEST(shadow, inside_a_closed_body_no_sun_shines) {
  for (const bool box : {false, true}) {
    Scene scene = closed_scene({"", box, {0, 0, 0}, 1, {}, true, true});
    scene.objects.push_back(object(Sphere{{0, 0, 0.6}, 0.1}));  // something else inside
    scene.ambient.direction = Vec3{0.2, 0.1, 1};
    const scene::FrozenScene frozen(scene, {}, 1);
    for (const double x : {-0.5, 0.0, 0.05, 0.4}) {
      const flow::Surface<float> s = surface_seen(frozen, ray({x, 0.02, 1}));
      ASSERT_TRUE(s.found);
      EXPECT_TRUE(dark_of_sun(frozen, s)) << x;
    }
  }
}
