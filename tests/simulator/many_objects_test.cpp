// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
// Thousands of objects give the same bytes whether tiles look for them in clusters or every pixel tests each of them.
#include <gtest/gtest.h>

#include "backend/cpu/cpu.h"
#include "support/crowd.h"
#include "support/same_frame.h"
#include "support/sanitizers.h"

using namespace tofray;
using namespace tofray::test;

namespace {

Camera small_camera(int lights, Random& random) {
  Camera camera = load_camera("pico-flexx");
  camera.sensor.width = 45, camera.sensor.height = 19;
  Lens& lens = camera.lens;
  lens.cx_px = 22, lens.cy_px = 9, lens.fx_px = lens.fy_px = 40;
  for (int i = 1; i < lights; ++i) {
    camera.illumination.push_back(camera.illumination[0]);
    camera.illumination.back().position = random.point(0.7);
  }
  return camera;
}

/// The second frame that the simulator makes.
Frame frame_of(const Scene& scene, const Camera& camera, Isa isa, bool culling, int threads = 1, int samples = 1) {
  SimulatorOptions options;
  options.seed = 7, options.isa = isa, options.culling = culling, options.threads = threads, options.exposure_samples = samples;
  Simulator simulator(scene, camera, options);
  const Frame before = simulator.frame(0);
  return simulator.frame(before.index + 5);
}

/// On all kinds of code, against one object after the other. @return pixels that see an object but the wall
int expect_same_without_culling(const Scene& scene, const Camera& camera, int samples = 1) {
  const Frame reference = frame_of(scene, camera, Isa::best, false, 1, samples);
  for (const Isa isa : backend::isas_here)
    if (backend::can_run(isa)) {
      EXPECT_EQ(first_difference(frame_of(scene, camera, isa, true, 1, samples), reference), "") << backend::isa_name(isa);
    }
  EXPECT_EQ(first_difference(frame_of(scene, camera, Isa::best, true, 3, samples), reference), "") << "three threads";
  int seen = 0;
  for (const std::int32_t id : reference.truth.object_id) seen += id > 0;
  return seen;
}

constexpr int crowd_size = with_sanitizers ? 700 : 3000;

Scene moving_crowd_in_the_sun(Random& random) {
  Scene scene = crowd(random, crowd_size / 2, true);
  scene.camera.pose = random_pose(random);
  scene.ambient.spectrum = Ambient::Spectrum::sun_am15;
  scene.ambient.amount = 0.5, scene.ambient.direction = Vec3{0.3, 0.5, 1} + random.point(0.2);
  return scene;
}

}  // namespace

TEST(many_objects, still_with_three_lights) {
  Random random(81);
  const Camera camera = small_camera(3, random);
  EXPECT_GT(expect_same_without_culling(crowd(random, crowd_size, false), camera), 50);
}

TEST(many_objects, moving_in_the_sun) {
  Random random(82);
  for (int trial = 0; trial < 2; ++trial) {
    Scene scene = moving_crowd_in_the_sun(random);
    EXPECT_GT(expect_same_without_culling(scene, small_camera(2, random)), with_sanitizers ? 5 : 50);
  }
}

// They turn, follow keyframes and change their shape, before a camera that stands or moves.
TEST(many_objects, turning_changing_and_passed_by) {
  Random random(85);
  for (int trial = 0; trial < 2; ++trial) {
    Scene scene = moving_crowd_in_the_sun(random);
    let_meshes_change(scene);
    set_in_motion(random, scene, trial == 1);
    EXPECT_GT(expect_same_without_culling(scene, small_camera(2, random), 1 + trial), with_sanitizers ? 5 : 50);
  }
}

// Of two at one place the first one is seen, wherever the others of its cluster stand.
TEST(many_objects, twins_show_the_first_of_them) {
  Random random(83);
  Scene scene;
  scene.materials = {{"matt", Material::Brdf::lambert, 0.7, 0, 1}, {"dark", Material::Brdf::lambert, 0.2, 0, 1}};
  std::vector<Sphere> balls;
  for (int i = 0; i < 600; ++i) balls.push_back({random.point(0.8) + Vec3{0, 0, 2}, 0.05});
  for (int round = 0; round < 3; ++round)
    for (const Sphere& ball : balls) {
      scene.objects.push_back(object(ball));
      scene.objects.back().material = round == 0 ? 0 : 1;
    }
  const Camera camera = small_camera(1, random);
  EXPECT_GT(expect_same_without_culling(scene, camera), 200);
  int seen = 0;
  for (const std::int32_t id : frame_of(scene, camera, Isa::best, true).truth.object_id) {
    EXPECT_LT(id, 600);
    seen += id >= 0;
  }
  EXPECT_GT(seen, 200);
}

// Instances of one mesh and bodies that touch, share faces and stand in each other, some of them twice at one place: tiles look for these
// square by square, the nearest first, which must not show. In the sun, and before lights that are elsewhere.
TEST(many_objects, that_touch_and_overlap_are_met_as_one_after_the_other) {
  Random random(86);
  for (const bool moving : {false, true}) {
    Scene scene;
    scene.materials = {{"matt", Material::Brdf::lambert, 0.7, 0, 1}, {"dark", Material::Brdf::lambert, 0.2, 0, 1}};
    const auto rock = shared(single(stone(random, 2, 0.1, {0, 0, 0})));
    const int side = with_sanitizers ? 6 : 12;
    for (int i = 0; i < side * side * 6; ++i) {
      const Vec3 at{0.12 * (i % side - 0.5 * side), 0.12 * (i / side % side - 0.5 * side),
                    1.2 + 0.1 * static_cast<double>(i / (side * side))};
      Object out;
      switch (random.below(4)) {
        case 0: out = object(Sphere{at, 0.06}); break;                                               // touches its neighbours
        case 1: out = object(Box{at - Vec3{0.06, 0.06, 0.05}, at + Vec3{0.06, 0.06, 0.05}}); break;  // shares faces with them
        default:
          out.shape = rock, out.position = at;
          if (random.below(2) == 0) out.rotation = {random.direction(), random.between(-3, 3)};
      }
      if (moving && random.below(2) == 0) out.velocity_m_per_s = random.point(1);
      scene.objects.push_back(out);
      if (random.below(4) == 0) scene.objects.push_back(out), scene.objects.back().material = 1;  // a twin
    }
    scene.ambient.spectrum = Ambient::Spectrum::sun_am15;
    scene.ambient.amount = 0.5, scene.ambient.direction = Vec3{0.3, 0.5, 1};
    EXPECT_GT(expect_same_without_culling(scene, small_camera(2, random)), 200);
  }
}

// Where a light sees few forms of a tile, packs look for them; once something passes close before the camera it sees many, and squares do.
// What does not change meanwhile is in their shade as before.
TEST(many_objects, of_which_a_light_sees_more_while_something_passes) {
  Random random(87);
  for (int trial = 0; trial < 8; ++trial) {
    Scene scene;
    scene.materials = {{"matt", Material::Brdf::lambert, 0.7, 0, 1}};
    scene.objects.push_back(object(Plane{{0, 0, 4}, Vec3{0, 0, -1}}));
    for (int i = 0; i < 40 + 10 * (trial % 4); ++i) {
      const double z = random.between(1.5, 3.5);
      scene.objects.push_back(
          object(Sphere{Vec3{random.between(-0.7, 0.7) * z, random.between(-0.4, 0.4) * z, z}, random.between(0.05, 0.15)}));
    }
    Object passing = object(Rectangle{{random.between(-0.3, 0.1), random.between(-0.15, 0.15), 0.5}, {0.15, 0.1}});
    passing.velocity_m_per_s = {random.between(2, 10), random.between(-1, 1), 0};
    scene.objects.push_back(passing);
    EXPECT_GT(expect_same_without_culling(scene, small_camera(3, random)), 20);
  }
}

// As many as a scene may have, of which one tile holds more than any list had room for.
TEST(many_objects, in_one_tile_as_many_as_there_may_be) {
  Random random(84);
  Scene scene;
  scene.materials = {{"matt", Material::Brdf::lambert, 0.7, 0, 1}};
  const int count = with_sanitizers ? 5000 : 20000;
  for (int i = 0; i < count; ++i) {
    const double wide = i % 3 == 0 ? 0.02 : 1;
    scene.objects.push_back(object(Sphere{Vec3{random.between(-wide, wide), random.between(-wide, wide), random.between(1, 3)}, 0.004}));
  }
  EXPECT_GT(expect_same_without_culling(scene, small_camera(1, random)), with_sanitizers ? 20 : 100);
}
