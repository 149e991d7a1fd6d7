// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
// Looking at clusters first finds what looking at each form finds, in its order.
#include <gtest/gtest.h>

#include "pipeline/tile.h"
#include "support/crowd.h"
#include "support/culler.h"
#include "support/rays.h"

using namespace tofray;
using namespace tofray::test;

namespace {

constexpr int of_moments = 2;

/// `some`: a third has a velocity; `turning`: others turn and follow keyframes, meshes change; `passed`: and the camera moves.
enum class Moves { some, turning, passed };

struct Crowd {
  Scene scene;
  scene::FrozenScene frozen;
  Crowd(Random& random, int objects, Moves moves = Moves::some)
      : scene(crowd_in_the_sun(random, objects, moves)), frozen(scene, {Vec3{0.02, 0, 0}, random.point(1)}, of_moments) {
    for (const double time : {0.05, 0.1}) {
      frozen.look({}, {{time, time + 0.6}, 0, 0.2});
      frozen.derive();
    }
  }
  static Scene crowd_in_the_sun(Random& random, int objects, Moves moves) {
    Scene out = crowd(random, objects, true);
    out.camera.pose = random_pose(random);
    out.ambient.direction = Vec3{0.3, 0.8, 0.4} + random.point(0.3);
    if (moves != Moves::some) let_meshes_change(out), set_in_motion(random, out, false);
    if (moves == Moves::passed) {
      Pose later = out.camera.pose;
      later.position = later.position + random.point(0.3), later.look_at = later.look_at + random.point(0.5);
      out.camera.keyframes = {{0, out.camera.pose}, {1, later}};
    }
    return out;
  }
  /// Each set of forms that a frame looks at.
  template <class Each>
  void each_view(const Each& each) const {
    const scene::SceneView& s = frozen.view();
    each(s.camera_still()), each(s.light_still(0)), each(s.light_still(1));
    for (int m = 0; m < of_moments; ++m) each(s.camera_moving(m)), each(s.light_moving(m, 0)), each(s.light_moving(m, 1));
  }
};

scene::Bounds small_rectangle(Random& random) {
  const double width = random.scale(1e-3, 1), height = random.scale(1e-3, 1), x = random.between(-1, 1), y = random.between(-1, 1);
  return {static_cast<float>(x), static_cast<float>(x + width), static_cast<float>(y), static_cast<float>(y + height)};
}

/// One form after the other.
template <class From, class FormsOf, class Can>
void compare(const FormsOf& forms, const From& picked, const Can& can, long& kept, long& all) {
  int k = 0;
  for (int i = 0; i < forms.count; ++i) {
    if (!can(forms.at[i])) continue;
    ASSERT_LT(k, picked.picked.count) << "form " << i << " of " << forms.count << " is not found";
    ASSERT_EQ(picked.picked.index[k], i) << "of " << forms.count;
    ++k;
  }
  ASSERT_EQ(picked.picked.count, k);
  kept += k, all += forms.count;
}

template <class... T, class Each>
void each_shape(shape::List<T...>, const Each& each) {
  (each(shape::List<T>{}), ...);
}

/// A thing of any shape and proportions, often almost in the light's way; a point in it, and ways to its ends.
struct ThinThing {
  Object object;
  Vec3 inside;
  std::vector<Vec3> ways;
};
ThinThing thin_thing(Random& random, const Vec3& sun) {
  const Vec3 middle = random.point(3), aside = random.across(sun), up = base::cross(sun, aside);
  const double size = random.scale(1e-3, 1), thin = random.scale(1e-6, 1);
  const Vec3 axis =
      base::normalized(random.below(2) == 0 ? random.direction() : thin * random.direction() + (random.below(2) == 0 ? aside : sun));
  const Vec3 sides = size * Vec3{random.scale(1e-6, 1), random.scale(1e-3, 1), 1};
  ThinThing out{{}, middle, {aside, up, axis, -1.0 * axis, random.direction()}};
  Triangle needle;
  switch (random.below(10)) {
    case 0: out.object.shape = Sphere{middle, size}; break;
    case 1: out.object.shape = Box{middle - sides, middle + sides}; break;
    case 2: out.object.shape = Cylinder{middle, axis, thin * size, size}; break;
    case 3:
      out.object.shape = Rectangle{middle, {sides[0], size}};
      out.object.rotation = {random.direction(), random.between(-3, 3)};
      break;
    case 4: out.object.shape = Disk{middle, axis, size}; break;
    case 5: out.object.shape = Capsule{middle - size * axis, middle + size * axis, thin * size}; break;
    case 6: out.object.shape = Cone{middle - 0.5 * size * axis, axis, thin * size, size}; break;
    case 7: out.object.shape = Cone{middle - 0.5 * thin * size * axis, axis, size, thin * size}; break;
    default:
      for (Vec3& corner : needle.vertices) {
        const bool across = random.below(2) == 0;
        corner = middle + size * (across ? thin * random.point(1) : thin * random.uniform() * aside + random.between(-1, 1) * sun) +
                 size * random.between(-1, 1) * up;
      }
      out.object.shape = needle;
      out.inside = (1.0 / 3) * (needle.vertices[0] + needle.vertices[1] + needle.vertices[2]);
      for (const Vec3& corner : needle.vertices) out.ways.push_back(base::normalized(corner - out.inside));
  }
  return out;
}

/// Goes from the shadow of a scene's only thing on a screen far behind it, halving, to its border. @return 1 where it has begun in the shadow
int graze(const scene::SceneView& s, const Vec3& start, const Vec3& way, int trial) {
  const Vec3 sun{s.toward_sun->x, s.toward_sun->y, s.toward_sun->z};
  const pipeline::OnScreen<float> screen(*s.toward_sun);
  const scene::Alongs alongs = s.sun_still();
  const auto dark = [&](double far) {
    const Vec3 at = start + far * way, back = at - (base::dot(at, sun) + 5) * sun;
    flow::Surface<float> p{};
    p.found = true, p.object = -1;
    p.x = static_cast<float>(back[0]), p.y = static_cast<float>(back[1]), p.z = static_cast<float>(back[2]);
    p.range = static_cast<float>(base::length(back));
    if (!trace::blocked_parallel(trace::Uncut{alongs}, s.sun(0), p)) return false;
    const scene::Bounds alone = screen.at(p.x, p.y, p.z, true).bounds();
    bool held = false;
    each_shape(shape::Shapes{}, [&]<class T>(shape::List<T>) {
      for (int i = 0; i < alongs.of<T>().count; ++i) held = held || shape::can_shade(alongs.of<T>().at[i], alone);
    });
    EXPECT_TRUE(held) << "trial " << trial << ", " << far;
    return true;
  };
  if (!dark(0)) return 0;
  double in = 0, out = 20;
  for (int i = 0; i < 40; ++i) {
    const double middle = 0.5 * (in + out);
    (dark(middle) ? in : out) = middle;
  }
  return 1;
}

}  // namespace

TEST(clusters, hold_what_each_form_says_in_the_order_of_the_forms) {
  Random random(71);
  long kept = 0, all = 0;
  // 32 bodies of a shape make a cluster, 1,024 of them what is looked at at once.
  for (const int objects : {20, 290, 300, 330, 3000, 20000}) {
    for (const Moves moves : {Moves::some, Moves::turning, Moves::passed}) {
      const Crowd crowd(random, objects, moves);
      crowd.each_view([&](const scene::Forms& forms) {
        Culler culler(forms);
        for (int trial = 0; trial < 30; ++trial) {
          const scene::Bounds r = small_rectangle(random);
          const auto some = culler.cull<trace::Culled>(forms, r);
          each_shape(shape::Shapes{}, [&]<class T>(shape::List<T>) {
            compare(
                forms.of<T>(), some.of<T>(), [&](const auto& form) { return can_meet(form, r); }, kept, all);
          });
        }
      });
    }
  }
  EXPECT_GT(kept, 20000);
  EXPECT_LT(kept, all / 4);
}

TEST(clusters, hold_what_each_form_says_on_the_screen_of_the_sun) {
  Random random(72);
  long kept = 0, all = 0;
  for (const Moves moves : {Moves::some, Moves::turning, Moves::passed}) {
    const Crowd crowd(random, moves == Moves::some ? 300 : 3000, moves);
    const scene::SceneView& s = crowd.frozen.view();
    for (const scene::Alongs& alongs : {s.sun_still(), s.sun_moving(0), s.sun_moving(1)}) {
      Culler culler(alongs);
      for (int trial = 0; trial < 60; ++trial) {
        const scene::Bounds r = small_rectangle(random);
        const auto some = culler.cull<trace::CulledAlong>(alongs, r);
        each_shape(shape::Shapes{}, [&]<class T>(shape::List<T>) {
          compare(
              alongs.of<T>(), some.of<T>(), [&](const auto& form) { return shape::can_shade(form, r); }, kept, all);
        });
      }
    }
  }
  EXPECT_GT(kept, 500);
  EXPECT_LT(kept, all / 4);
}

// What a pack narrows a tile's list to is what its own rectangle overlaps.
TEST(clusters, are_narrowed_to_what_a_smaller_rectangle_holds) {
  Random random(73);
  long kept = 0, all = 0;
  const Crowd crowd(random, 8000);
  crowd.each_view([&](const scene::Forms& forms) {
    Culler culler(forms);
    for (int trial = 0; trial < 60; ++trial) {
      const scene::Bounds r = small_rectangle(random);
      const float x = 0.5f * (r.x_min + r.x_max), y = 0.5f * (r.y_min + r.y_max);
      const scene::Bounds part{x, r.x_max, r.y_min, y};
      const auto tile = culler.cull<trace::Culled>(forms, r);
      const auto pack = culler.narrow(tile, part);
      each_shape(shape::Shapes{}, [&]<class T>(shape::List<T>) {
        if constexpr (shape::bounded<T>) {
          const auto& picked = tile.of<T>().picked;
          const bool few = picked.count <= trace::few_forms;
          int k = 0;
          for (int i = 0; i < picked.count; ++i) {
            if (!few && !shape::overlap(forms.of<T>().at[picked.index[i]].bounds, part)) continue;
            ASSERT_LT(k, pack.of<T>().picked.count);
            ASSERT_EQ(pack.of<T>().picked.index[k++], picked.index[i]);
          }
          ASSERT_EQ(pack.of<T>().picked.count, k);
          if (!few) kept += k, all += picked.count;
        }
      });
    }
  });
  EXPECT_GT(kept, 10000);
  EXPECT_LT(kept, all * 19 / 20);
}

// More in one place than any tile meets otherwise; beyond what 16 bits count.
TEST(clusters, have_no_end) {
  Random random(74);
  Scene pile;
  for (int i = 0; i < 70000; ++i) pile.objects.push_back(object(Sphere{{1e-3 * random.uniform(), 0, 2 + 1e-3 * random.uniform()}, 0.1}));
  const scene::FrozenScene frozen(pile, {}, 1);
  const scene::Forms forms = frozen.view().camera_still();
  Culler culler(forms);
  const auto all = culler.cull<trace::Culled>(forms, {-0.001f, 0.001f, -0.001f, 0.001f});
  ASSERT_EQ(all.count(), 70000);
  for (int i = 0; i < 70000; ++i) ASSERT_EQ(all.of<shape::Sphere>().picked.index[i], i);
  EXPECT_EQ(culler.cull<trace::Culled>(forms, {1.0f, 1.1f, 0.0f, 0.1f}).count(), 0);
}

// All that keeps the sun off a few points is in the rectangle of these points, or its forms are not left out.
TEST(clusters, leave_all_shadows_of_the_sun) {
  Random random(75);
  int dark = 0, lit = 0;
  long few = 0, kept = 0, all = 0;
  for (int trial = 0; trial < 12; ++trial) {
    const Moves moves = trial % 3 == 0 ? Moves::some : trial % 3 == 1 ? Moves::turning : Moves::passed;
    const Crowd crowd(random, 2000, moves);
    const scene::SceneView& s = crowd.frozen.view();
    const int moment = trial % 2;
    const float* sun = s.sun(moment);
    const pipeline::OnScreen<float> screen(s.toward_sun[moment]);
    for (const scene::Alongs& alongs : {s.sun_still(), s.sun_moving(moment)}) {
      Culler culler(alongs);
      for (int i = 0; i < 200; ++i) {
        const Vec3 middle = random.point(1) + Vec3{0, 0, 2};
        std::vector<flow::Surface<float>> points(4);
        pipeline::Rectangle<float> seen;
        for (auto& p : points) {
          const Vec3 at = middle + 0.05 * random.point(1);
          p = {}, p.found = true, p.object = -1, p.range = 2;
          p.x = static_cast<float>(at[0]), p.y = static_cast<float>(at[1]), p.z = static_cast<float>(at[2]);
          screen.add(p.x, p.y, p.z, true, seen);
        }
        const auto some = culler.cull<trace::CulledAlong>(alongs, seen.bounds());
        for (const auto& p : points) {
          const auto own = culler.narrow(alongs, some, screen.at(p.x, p.y, p.z, true));
          const bool whole = trace::blocked_parallel(trace::Uncut{alongs}, sun, p);
          ASSERT_EQ(trace::blocked_parallel(some, sun, p), whole) << trial;
          ASSERT_EQ(trace::blocked_parallel(own, sun, p), whole) << trial << ", alone";
          few += own.count();
          (whole ? dark : lit) += 1;
        }
        kept += some.count();
        each_shape(shape::Shapes{}, [&]<class T>(shape::List<T>) { all += alongs.of<T>().count; });
      }
    }
  }
  EXPECT_GT(dark, 1000);
  EXPECT_GT(lit, 1000);
  EXPECT_LT(kept, all / 4);
  EXPECT_LT(few, 4 * kept);
}

// What keeps the sun off a point has a rectangle that holds the point, also where rounding lets it keep the sun off a little beside it: as
// it does far beyond the ends of needles, and of triangles that the sun sees almost from their edge.
TEST(clusters, hold_what_grazes_in_the_sun) {
  Random random(76);
  int grazed = 0;
  for (int trial = 0; trial < 6000; ++trial) {
    const Vec3 sun = random.direction();
    Scene scene;
    scene.materials = {{"matt", Material::Brdf::lambert, 0.7, 0, 1}};
    const ThinThing thing = thin_thing(random, sun);
    scene.objects = {thing.object};
    scene.ambient.direction = -1.0 * sun;
    const scene::FrozenScene frozen(scene, {}, 1);
    for (const Vec3& way : thing.ways) grazed += graze(frozen.view(), thing.inside, way, trial);
  }
  EXPECT_GT(grazed, 20000);
}
