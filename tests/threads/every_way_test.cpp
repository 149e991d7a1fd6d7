// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
// Each way through the simulator by several threads, which ThreadSanitizer watches (.ci/run): the same bytes as by one.
#include <gtest/gtest.h>

#include <limits>

#include "support/own_arrays.h"
#include "support/pixels.h"
#include "support/random_scene.h"

using namespace tofray;
using namespace tofray::test;

namespace {

/// More tiles than threads.
Camera some_tiles(const Scene& scene) {
  Camera camera = load_camera(scene);
  const double x = 97.0 / camera.sensor.width, y = 61.0 / camera.sensor.height;
  camera.sensor.width = 97, camera.sensor.height = 61;
  camera.lens.fx_px *= x, camera.lens.fy_px *= y, camera.lens.cx_px = 48, camera.lens.cy_px = 30;
  return camera;
}

/// What `frames_of` makes of simulators with one thread and with several, each asked twice.
template <class FramesOf>
void expect_same_bytes(const Scene& scene, const Camera& camera, SimulatorOptions options, const FramesOf& frames_of) {
  options.seed = 7, options.backend = Backend::cpu, options.threads = 1;
  Simulator alone(scene, camera, options);
  const std::vector<Frame> reference = frames_of(alone);
  ASSERT_FALSE(reference.empty());
  for (const int threads : {2, 5}) {
    options.threads = threads;
    Simulator several(scene, camera, options);
    for (int round = 0; round < 2; ++round) {
      const std::vector<Frame> frames = frames_of(several);
      ASSERT_EQ(frames.size(), reference.size());
      for (std::size_t i = 0; i < frames.size(); ++i)
        EXPECT_EQ(first_difference(frames[i], reference[i]), "") << scene.name << ", frame " << i << ", " << threads << " threads";
    }
  }
}

std::vector<Frame> two_frames(Simulator& simulator) { return {simulator.frame(0), simulator.frame(3)}; }

std::vector<Frame> a_batch(const Scene& scene, Simulator& simulator) {
  std::vector<Frame> out;
  simulator.frames(mixed_requests(scene, 5), [&](const FrameArrays& arrays) { out.push_back(copy_of(arrays)); });
  return out;
}

}  // namespace

TEST(every_way, of_a_frame_of_each_kind_of_scene) {
  for (const char* name : {"demo", "flying-ball", "bench-mesh", "penumbra"}) {
    const Scene scene = load_scene(name);
    expect_same_bytes(scene, some_tiles(scene), {}, two_frames);
  }
}

TEST(every_way, of_scenes_in_motion_seen_several_times_in_each_exposure) {
  Scene scene = load_scene("room");
  Random random(5);
  set_in_motion(random, scene, true);
  expect_same_bytes(scene, some_tiles(scene), {.exposure_samples = 3, .subpixel = 2}, two_frames);
}

TEST(every_way, of_everything_switched_on) {
  const Scene scene = load_scene("demo");
  Camera camera = with_everything(some_tiles(scene));
  camera.sensor.width = 97, camera.sensor.height = 61;
  camera.decoding.temporal_frames = 2;
  for (const auto kind :
       {ImageFilter::Kind::gaussian, ImageFilter::Kind::median, ImageFilter::Kind::bilateral, ImageFilter::Kind::adaptive}) {
    camera.decoding.filter.kind = kind;
    for (const Isa isa : {Isa::scalar, Isa::best}) expect_same_bytes(scene, camera, {.isa = isa}, two_frames);
  }
}

TEST(every_way, of_light_that_bounces) {
  Scene scene = load_scene("corner");
  scene.transport = {.bounces = 2, .samples = 4, .max_samples = 8, .smooth = true, .transient = {50, 0, 0.1}};
  expect_same_bytes(scene, some_tiles(scene), {}, two_frames);
}

TEST(every_way, of_batches) {
  for (const char* name : {"demo", "flying-ball"}) {
    const Scene scene = load_scene(name);
    expect_same_bytes(scene, some_tiles(scene), {}, [&](Simulator& simulator) { return a_batch(scene, simulator); });
  }
}

TEST(every_way, of_geometry_of_light_and_of_recordings_of_ones_own) {
  const Scene scene = load_scene("card");
  const Camera camera = some_tiles(scene);
  const Frame frame = Simulator(scene, camera, {.threads = 1}).frame(0);
  const Geometry seen = geometry_of(scene, camera, frame);
  const PixelLight light = light_of(camera, frame);
  expect_same_bytes(scene, camera, {}, [&](Simulator& simulator) {
    std::vector<Frame> out = {simulator.frame(1, seen), simulator.frame(1, light), frame};
    out.back().depth = process(frame.raw, camera, {.threads = simulator.ran_on().threads});
    return out;
  });
}

TEST(every_way, of_light_by_the_length_of_its_path) {
  Scene scene = load_scene("card");
  scene.transport.transient = {400, 0, 0.02};
  const Camera camera = some_tiles(scene);
  const Frame frame = Simulator(scene, camera, {.threads = 1}).frame(0);
  const Transient light{frame.truth.width, frame.truth.height, 400, 0, 0.02, frame.truth.transient_e_per_s, frame.truth.ambient_e_per_s};
  expect_same_bytes(scene, camera, {}, [&](Simulator& simulator) { return std::vector<Frame>{simulator.frame(1, light)}; });
}

TEST(any_number_of_threads, beyond_the_limit_is_refused) {
  const Scene scene = wall(1);
  const Camera camera = lit_camera(8, 4, 9);
  const Raw raw = Simulator(scene, camera, {.threads = 1024}).frame(0).raw;
  for (const int threads : {1025, std::numeric_limits<int>::max()}) {
    for (const bool recorded : {false, true}) {
      try {
        if (recorded) {
          process(raw, camera, {.threads = threads});
        } else {
          Simulator(scene, camera, {.threads = threads});
        }
        ADD_FAILURE() << threads << " threads passed";
      } catch (const Error& error) {
        EXPECT_EQ(error.kind(), ErrorKind::limit);
      }
    }
  }
}
