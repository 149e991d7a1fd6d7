// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
// The GPU backend gives the processor's bytes of all that can be in a frame: its host side and its functions by pixel on a stand-in for
// CUDA's runtime, and its kernels on a GPU where there is one.
#include <gtest/gtest.h>

#include <memory>
#include <string>

#include "support/cuda_cases.h"
#include "support/files.h"
#include "support/gpu.h"
#include "support/own_arrays.h"
#include "support/random_scene.h"
#include "support/stand_in_cuda.h"
#include "support/wobble.h"
#include "tofray/tofray.h"

using namespace tofray;
using namespace tofray::test;

namespace {

/// Its parameter says where: "stand_in" or "gpu".
class CudaBytes : public testing::TestWithParam<std::string> {
 protected:
  void SetUp() override {
    if (GetParam() == "stand_in")
      stand_in_ = std::make_unique<WithStandIn>();
    else
      need_gpu();
  }

 private:
  std::unique_ptr<WithStandIn> stand_in_;
};

/// Turning things, keyframes, a camera that moves, and a sun.
Scene scene_in_motion(int number) {
  Random random(static_cast<std::uint64_t>(number) + 90);
  Scene scene = random_scene(random, 4 + 4 * number, number % 2 == 1);
  cut_out(scene);
  scene.name = "in motion " + std::to_string(number);
  scene.camera.pose = random_pose(random);
  set_in_motion(random, scene, number % 2 == 0);
  scene.ambient.spectrum = Ambient::Spectrum::sun_am15, scene.ambient.amount = 0.1;
  if (number % 3 != 0) scene.ambient.direction = Vec3{0.1, 0.2, 1} + random.point(0.3);
  return scene;
}

}  // namespace

// As many lights as there may be: four LEDs, each a disk of sixteen points.
TEST_P(CudaBytes, has_the_same_bytes_with_64_lights) {
  for (const char* name : {"flying-ball", "step-and-rod", "bench-mesh"}) {
    const Scene scene = load_scene(name);
    Camera camera = small(load_camera(scene));
    camera.illumination[0].ring_leds = 4, camera.illumination[0].ring_radius_m = 0.08;
    camera.illumination[0].area = {Area::Kind::disk, 0.03, 0, 0, 16};
    expect_same(scene, camera, {.seed = 7});
    expect_same(scene, camera, {.noise = Noise::off, .culling = false});
  }
}

TEST_P(CudaBytes, has_the_same_bytes_with_everything_switched_on) {
  const Scene scene = load_scene("demo");
  Camera camera = with_everything(load_camera(scene));
  for (const auto kind : {ImageFilter::Kind::none, ImageFilter::Kind::gaussian, ImageFilter::Kind::median, ImageFilter::Kind::bilateral,
                          ImageFilter::Kind::adaptive}) {
    camera.decoding.filter.kind = kind;
    for (const PowerModel model : {PowerModel::tofray, PowerModel::paper_literal}) {
      camera.power_model = model;
      expect_same(scene, camera, {});
      expect_same(scene, camera, {.culling = false});
    }
  }
}

// A column has noise in each raw frame, one pixel or many: here there are more draws of lines than pixels.
TEST_P(CudaBytes, has_the_same_bytes_of_noisy_lines_where_they_outnumber_the_pixels) {
  const Scene scene = load_scene("card");
  for (const auto& [width, height] : {std::pair{1, 1}, std::pair{3, 1}, std::pair{1, 5}, std::pair{33, 2}}) {
    Camera camera = small(load_camera(scene));
    camera.sensor.width = width, camera.sensor.height = height;
    camera.pixel.column_noise_e = 3000, camera.pixel.row_noise_e = 2000;
    for (const auto kind : {ImageFilter::Kind::none, ImageFilter::Kind::median}) {
      camera.decoding.filter.kind = kind;
      expect_same(scene, camera, {});
    }
  }
}

TEST_P(CudaBytes, has_the_same_bytes_of_random_scenes_still_and_moving) {
  const Camera camera = small(load_camera("pico-flexx"));
  for (int i = 0; i < 12; ++i) {
    Random random(static_cast<std::uint64_t>(i) + 50);
    Scene scene = random_scene(random, i < 10 ? 3 + 5 * i : 150, i % 2 == 1);
    scene.name = "random " + std::to_string(i);
    scene.camera.pose = random_pose(random);
    expect_same(scene, camera, {});
  }
}

TEST_P(CudaBytes, has_the_same_bytes_of_scenes_in_motion_and_of_several_times_within_an_exposure) {
  for (int i = 0; i < 5; ++i) {
    const Scene scene = scene_in_motion(i);
    const Camera camera = i == 3 ? with_everything(load_camera("pico-flexx")) : small(load_camera("pico-flexx"));
    expect_same(scene, camera, {.exposure_samples = 1 + i});
    expect_same(scene, camera, {.last_stage = Stage::trace, .exposure_samples = 1 + i});
  }
}

TEST_P(CudaBytes, batches_of_scenes_in_motion_take_seeds_and_poses) {
  for (int i = 0; i < 2; ++i) {
    const Scene scene = scene_in_motion(i);
    const Camera camera = small(load_camera("pico-flexx"));
    const SimulatorOptions options{.batch_bytes = 320'000, .exposure_samples = 2};
    const std::vector<FrameRequest> requests = mixed_requests(scene, 8);
    for (const Backend backend : {Backend::cpu, Backend::cuda}) {
      Simulator simulator(scene, camera, on(backend, options));
      std::size_t next = 0;
      simulator.frames(requests, [&](const FrameArrays& arrays) {
        const FrameRequest& request = requests[next++];
        EXPECT_EQ(first_difference(copy_of(arrays), alone(scene, camera, options, request)), "") << scene.name << ", request " << next - 1;
      });
      EXPECT_EQ(next, requests.size());
    }
  }
}

TEST_P(CudaBytes, has_the_same_bytes_of_meshes_that_change_their_shape) {
  const Camera camera = small(load_camera("pico-flexx"));
  for (int i = 0; i < 3; ++i) {
    Random random(static_cast<std::uint64_t>(i) + 90);
    Scene scene = random_scene(random, 5, i == 1);
    scene.name = "wobbling " + std::to_string(i);
    for (int k = 0; k < 2; ++k) {
      TriangleMesh triangles = single(stone(random, 2, 0.4, {0, 0, 1.2}));
      if (k == 0) add_details(random, triangles);
      scene.objects.push_back(object(wobbling(shared(std::move(triangles)), 0.1, 6)));
      scene.objects.back().angular_velocity_rad_per_s = random.point(3 * k);
    }
    expect_same(scene, camera, {.exposure_samples = 1 + i});
  }
}

// The light image: of still scenes shared by all frames of a batch and kept for the next one, of all others each frame's own.
TEST_P(CudaBytes, has_the_same_bytes_of_samples_within_pixels_and_of_scattered_light) {
  Scatter kernel{Scatter::Kind::kernel, 0.5};
  kernel.rows = 3, kernel.columns = 1, kernel.kernel = {1, 2, 3};
  const Scatter scatters[] = {{}, {Scatter::Kind::gaussians, 0.1, {1, 9}}, kernel};
  for (const int i : {0, 1, 4, 5}) {
    Random random(static_cast<std::uint64_t>(i) + 70);
    Scene scene = random_scene(random, 9, i % 2 == 1);
    scene.name = "sampled " + std::to_string(i);
    Camera camera = i < 4 ? small(load_camera("pico-flexx")) : with_everything(load_camera("pico-flexx"));
    camera.lens.scatter = scatters[i % 3];
    expect_same(scene, camera, {.exposure_samples = 2, .subpixel = 1 + i % 4}, {0, 5});
    expect_same(scene, camera, {.last_stage = Stage::trace, .subpixel = 2}, {1, 2});
    expect_same(scene, camera, {.arrays = {"raw", "gt_mixed"}, .subpixel = 2}, {0, 1});
    expect_same(scene, camera, {.truth = false, .subpixel = 3}, {5});
    expect_same_own_arrays(load_scene("demo"), camera);
    const SimulatorOptions options{.batch_bytes = 320'000, .exposure_samples = 2, .subpixel = 2};
    for (const bool alike : {true, false}) {
      std::vector<FrameRequest> requests = mixed_requests(scene, 5);
      for (FrameRequest& request : requests)
        if (alike) request.pose = {}, request.seed = {};
      Simulator simulator(scene, camera, on(Backend::cuda, options));
      for (int round = 0; round < 2; ++round) {
        std::size_t next = 0;
        simulator.frames(requests, [&](const FrameArrays& arrays) {
          const FrameRequest& request = requests[next++];
          EXPECT_EQ(first_difference(copy_of(arrays), alone(scene, camera, options, request)), "") << scene.name << ", " << next - 1;
        });
        EXPECT_EQ(next, requests.size());
      }
      if (alike || i % 3 != 0) continue;
      Frame into;
      for (std::size_t which = 0; which < 4; ++which) {  // each kind of request once
        simulator.frame(requests[which], into);
        EXPECT_EQ(first_difference(arrays_only(into), alone(scene, camera, options, requests[which])), "") << scene.name << ", " << which;
      }
    }
  }
}

// Light from surface to surface, of what stands still and of what moves, with a sky and a sun, with samples within the pixels and without.
TEST_P(CudaBytes, has_the_same_bytes_of_bounces) {
  for (int i = 0; i < 4; ++i) {
    Random random(static_cast<std::uint64_t>(i) + 90);
    Scene scene = random_scene(random, 9, i % 2 == 1);
    scene.name = "bouncing " + std::to_string(i);
    scene.transport = {2 + i, 3, 8, i % 2 == 1 ? 16 : 0, i == 1 ? 1e-3 : 0, i >= 2};
    if (i != 1) scene.transport.transient = {60, 0.5, 0.1};
    if (i < 2) scene.ambient = {Ambient::Spectrum::sun_am15, Ambient::Quantity::level, 0.2, {}, {}, {}};
    if (i == 1) scene.ambient.direction = Vec3{0.3, 0.2, 1};
    Camera camera = small(load_camera("pico-flexx"));
    camera.sensor.width = 20, camera.sensor.height = 14;
    if (i == 2) camera.lens.scatter = {Scatter::Kind::gaussians, 0.1, {1, 9}};
    expect_same(scene, camera, {.exposure_samples = 2, .subpixel = 1 + i % 3});
    expect_same(scene, camera, {.last_stage = Stage::power});
    expect_same(scene, camera, {.truth = false});
    const SimulatorOptions options{.batch_bytes = 1'100'000, .subpixel = 1 + i % 2};
    std::vector<FrameRequest> requests = mixed_requests(scene, 6);
    Simulator simulator(scene, camera, on(Backend::cuda, options));
    for (int round = 0; round < 2; ++round) {
      std::size_t next = 0;
      simulator.frames(requests, [&](const FrameArrays& arrays) {
        EXPECT_EQ(first_difference(copy_of(arrays), alone(scene, camera, options, requests[next])), "") << scene.name << ", " << next;
        ++next;
      });
      EXPECT_EQ(next, requests.size());
      for (FrameRequest& request : requests) request.pose = {}, request.seed = {};
    }
  }
}

// Light by path length, without bounces and with them, of what stands still and of what moves, of several lights.
TEST_P(CudaBytes, has_the_same_bytes_of_light_by_path_length) {
  double found = 0, lost = 0;
  for (int i = 0; i < 4; ++i) {
    Random random(static_cast<std::uint64_t>(i) + 130);
    Scene scene = random_scene(random, 9, i % 2 == 1);
    scene.name = "by length " + std::to_string(i);
    scene.transport = {i / 2 * 2, 3, 8, i == 3 ? 16 : 0};
    scene.transport.transient = {40, 1.5, 0.05};
    Camera camera = small(load_camera("pico-flexx"));
    camera.sensor.width = 20, camera.sensor.height = 14;
    if (i > 1) camera.illumination.push_back(camera.illumination[0]), camera.illumination[1].position = {0.2, 0, 0};
    const SimulatorOptions options{.exposure_samples = 2, .subpixel = 1 + i % 3};
    expect_same(scene, camera, options);
    expect_same(scene, camera, {.last_stage = Stage::power});
    const Frame frame = Simulator(scene, camera, on(Backend::cpu, options)).frame(0);
    for (const float light : frame.truth.transient_e_per_s) found += static_cast<double>(light);
    for (const float light : frame.truth.transient_lost_e_per_s) lost += static_cast<double>(light);
  }
  EXPECT_GT(found, 0);
  EXPECT_GT(lost, 0);
}

TEST_P(CudaBytes, stops_after_any_stage) {
  for (const char* name : {"demo", "flying-ball"}) {
    const Scene scene = load_scene(name);
    const Camera camera = small(load_camera(scene));
    for (const Stage stage : {Stage::trace, Stage::power, Stage::raw, Stage::depth}) {
      expect_same(scene, camera, {.last_stage = stage});
      expect_same(scene, camera, {.truth = false, .last_stage = stage});
    }
  }
}

// One after the other on one GPU: none may take another's arrays or graph.
TEST_P(CudaBytes, enters_at_any_stage) {
  for (const char* name : {"demo", "flying-ball", "sun-outdoors"}) {
    const Scene scene = load_scene(name);
    expect_same_own_arrays(scene, small(load_camera(scene)));
    expect_same_own_arrays(scene, with_everything(load_camera(scene)));
  }
}

TEST_P(CudaBytes, batches_take_seeds_and_poses) {
  for (const char* name : {"card", "flying-ball", "sun-outdoors"}) {
    Scene scene = load_scene(name);
    scene.camera.pose.position[0] += 1e-3;
    const Camera camera = small(load_camera(scene));
    const std::vector<FrameRequest> requests = mixed_requests(scene, 9);
    for (const Backend backend : {Backend::cpu, Backend::cuda}) {
      Simulator simulator(scene, camera, on(backend));
      std::size_t i = 0;
      simulator.frames(requests, [&](const FrameArrays& arrays) {
        EXPECT_EQ(first_difference(copy_of(arrays), alone(scene, camera, {}, requests[i])), "") << name << ", request " << i;
        ++i;
      });
      EXPECT_EQ(i, requests.size());
      EXPECT_EQ(first_difference(arrays_only(simulator.frame(4)), alone(scene, camera, {}, {4, {}, {}})), "")
          << "afterwards all is as before";
    }
  }
}

TEST_P(CudaBytes, decodes_recorded_raw_data) {
  const Scene scene = load_scene("demo");
  Camera camera = small(load_camera(scene));
  for (const auto kind : {ImageFilter::Kind::none, ImageFilter::Kind::median, ImageFilter::Kind::adaptive}) {
    camera.decoding.filter.kind = kind;
    Frame recorded = Simulator(scene, camera, on(Backend::cpu)).frame(0), on_gpu;
    for (const bool taps : {false, true}) {
      if (taps) recorded.raw.raw.clear();
      recorded.depth = process(recorded.raw, camera, on(Backend::cpu));
      on_gpu = recorded;
      on_gpu.depth = process(recorded.raw, camera, on(Backend::cuda));
      EXPECT_EQ(first_difference(recorded, on_gpu), "");
    }
  }
}

INSTANTIATE_TEST_SUITE_P(on, CudaBytes, testing::Values("stand_in", "gpu"), [](const auto& where) { return where.param; });
