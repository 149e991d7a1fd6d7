// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
// Light that bounces among many bodies: packs of rays that ask boxes first find what a ray alone finds that looks at each body, which is
// what scalar code does.
#include <gtest/gtest.h>

#include "backend/cpu/cpu.h"
#include "support/bounces.h"
#include "support/crowd.h"
#include "support/same_frame.h"
#include "support/sanitizers.h"

using namespace tofray;
using namespace tofray::test;

namespace {

Camera small_camera(Random& random) {
  Camera camera = load_camera("pico-flexx");
  camera.sensor.width = 37, camera.sensor.height = 13;
  Lens& lens = camera.lens;
  lens.cx_px = 18, lens.cy_px = 6, lens.fx_px = lens.fy_px = 30;
  camera.illumination.push_back(camera.illumination[0]);
  camera.illumination.back().position = random.point(0.7) + Vec3{0, 0, 1.5};  // among them, so that light goes all ways
  return camera;
}

constexpr int bouncing_crowd = with_sanitizers ? 400 : 600;

/// @return its indirect light
double expect_same_as_scalar(Scene scene, const Camera& camera, int ways = 4) {
  scene.transport.bounces = 2, scene.transport.samples = ways;
  const auto frame = [&](Isa isa, int threads) {
    Simulator simulator(scene, camera, {.threads = threads, .isa = isa});
    const Frame before = simulator.frame(0);
    return simulator.frame(before.index + 3);
  };
  const Frame reference = frame(Isa::scalar, 1);
  for (const Isa isa : backend::isas_here)
    if (backend::can_run(isa)) {
      EXPECT_EQ(first_difference(frame(isa, 2), reference), "") << backend::isa_name(isa);
    }
  return sum_over(reference.truth.indirect_e, 0, reference.truth.indirect_e.size());
}

void let_the_sun_shine(Random& random, Scene& scene) {
  scene.ambient.spectrum = Ambient::Spectrum::sun_am15;
  scene.ambient.amount = 0.5, scene.ambient.direction = Vec3{0.3, 0.5, 1} + random.point(0.2);
}

}  // namespace

TEST(bounces, in_a_crowd_are_those_of_each_body_looked_at) {
  Random random(91);
  for (const bool sun : {false, true}) {
    Scene scene = crowd(random, bouncing_crowd, false, 0.8);
    scene.camera.pose = random_pose(random);
    if (sun) let_the_sun_shine(random, scene);
    EXPECT_GT(expect_same_as_scalar(scene, small_camera(random)), 0);
  }
}

TEST(bounces, in_a_crowd_that_moves_are_those_of_each_body_looked_at) {
  Random random(92);
  for (const bool passed : {false, true}) {
    Scene scene = crowd(random, bouncing_crowd / 2, true, 0.8);
    let_the_sun_shine(random, scene);
    let_meshes_change(scene);
    set_in_motion(random, scene, passed);
    EXPECT_GT(expect_same_as_scalar(scene, small_camera(random), 2), 0);
  }
}

// Of several at one place the first one is met, wherever the others of its cluster stand.
TEST(bounces, in_a_crowd_of_twins_come_from_the_first_of_them) {
  Random random(93);
  const auto rock = shared(single(stone(random, 1, 0.05, {0, 0, 0})));
  for (const bool meshes : {false, true}) {
    Scene scene;
    scene.materials = {{"white", Material::Brdf::lambert, 0.9, 0, 1}, {"black", Material::Brdf::lambert, 0, 0, 1}};
    std::vector<Object> things;
    for (int i = 0; i < 100; ++i) {
      const Vec3 middle = random.point(0.5) + Vec3{0, 0, 1.5};
      things.push_back(object(Sphere{middle, 0.08}));
      if (meshes) things.back().shape = rock, things.back().position = middle;
    }
    const auto light_of = [&](int black_first) {
      Scene twins = scene;
      for (int round = 0; round < 3; ++round)
        for (Object thing : things) {
          thing.material = (round == 0) == (black_first == 1) ? 1 : 0;
          twins.objects.push_back(thing);
        }
      return expect_same_as_scalar(twins, small_camera(random));
    };
    EXPECT_GT(light_of(0), 0);
    EXPECT_EQ(light_of(1), 0);
  }
}
