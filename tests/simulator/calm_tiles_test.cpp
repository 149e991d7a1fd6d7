// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
// Tiles of pixels before which nothing moves are looked at once for all raw frames, and the light of their samples is added up once for each
// modulation frequency. Without culling no rectangle says that nothing moves there, so that each tile is looked at for each raw frame: the
// bytes are the same.
#include <gtest/gtest.h>

#include "backend/cpu/cpu.h"
#include "support/random.h"
#include "support/same_frame.h"
#include "tofray/load.h"

using namespace tofray;
using namespace tofray::test;

namespace {

/// 3 × 5 tiles.
Camera camera_of(int lights, Random& random) {
  Camera camera = load_camera("pico-flexx");
  camera.sensor.width = 96, camera.sensor.height = 40;
  Lens& lens = camera.lens;
  lens.cx_px = 47.5, lens.cy_px = 19.5, lens.fx_px = lens.fy_px = 80;
  for (int i = 1; i < lights; ++i) {
    camera.illumination.push_back(camera.illumination[0]);
    camera.illumination.back().position = random.point(0.5);
  }
  return camera;
}

/// A ball of a few pixels that goes about half of its width during a frame, before a wall.
Scene ball_before_a_wall(Random& random) {
  Scene scene = load_scene("flying-ball");
  auto& ball = std::get<Sphere>(scene.objects.at(1).shape);
  ball.radius = random.between(0.02, 0.06);
  ball.center = {random.between(-0.4, 0.4), random.between(-0.15, 0.15), random.between(0.7, 1.1)};
  scene.objects[1].velocity_m_per_s = random.between(0.2, 3) * random.direction();
  return scene;
}

Frame frame_of(const Scene& scene, const Camera& camera, SimulatorOptions options, Isa isa, bool culling) {
  options.isa = isa, options.culling = culling, options.threads = culling ? 3 : 1;
  return Simulator(scene, camera, options).frame(2);
}

void expect_one_look_enough(const Scene& scene, const Camera& camera, const SimulatorOptions& options) {
  const Frame each_time = frame_of(scene, camera, options, Isa::best, false);
  for (const Isa isa : backend::isas_here)
    if (backend::can_run(isa)) {
      EXPECT_EQ(first_difference(frame_of(scene, camera, options, isa, true), each_time), "")
          << backend::isa_name(isa) << ", subpixel " << options.subpixel << ", exposure samples " << options.exposure_samples;
    }
}

}  // namespace

TEST(calm_tiles, have_the_bytes_of_tiles_that_are_looked_at_for_each_raw_frame) {
  Random random(61);
  for (int trial = 0; trial < 3; ++trial)
    for (const int times : {1, 3})
      expect_one_look_enough(ball_before_a_wall(random), camera_of(1 + trial % 2, random), {.exposure_samples = times});
}

// The rays of some samples meet the ball in a tile where those of the samples before did not.
TEST(calm_tiles, add_up_samples_of_which_some_are_not_calm) {
  Random random(62);
  for (int trial = 0; trial < 12; ++trial)
    expect_one_look_enough(ball_before_a_wall(random), camera_of(1, random), {.subpixel = 2 + trial % 2});
  expect_one_look_enough(ball_before_a_wall(random), camera_of(2, random), {.exposure_samples = 2, .subpixel = 2});
}

TEST(calm_tiles, in_the_sun_with_late_pixels_and_a_lens_that_scatters) {
  Random random(63);
  for (int trial = 0; trial < 3; ++trial) {
    Scene scene = ball_before_a_wall(random);
    scene.ambient.spectrum = Ambient::Spectrum::sun_am15, scene.ambient.amount = 0.3;
    scene.ambient.direction = Vec3{0.3, -0.4, -1} + random.point(0.3);
    Camera camera = camera_of(1, random);
    camera.pixel.delay_s = 20e-12;
    if (trial == 1) camera.lens.scatter = {.kind = Scatter::Kind::gaussians, .share = 0.1, .sigma_px = {3}};
    expect_one_look_enough(scene, camera, {.exposure_samples = 1 + trial, .subpixel = 2});
  }
}

TEST(calm_tiles, are_none_before_a_camera_that_moves) {
  Random random(64);
  Scene scene = ball_before_a_wall(random);
  scene.camera.keyframes = {{0, {{0, 0, 0}, {0, 0, 1}, {0, -1, 0}}}, {0.1, {{0.2, 0, 0}, {0.1, 0, 1}, {0, -1, 0}}}};
  expect_one_look_enough(scene, camera_of(1, random), {.subpixel = 2});
}
