// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
// The GPU backend's host side and its functions by pixel, on a stand-in for CUDA's runtime: every frame must have the processor's bytes.
#include <gtest/gtest.h>

#include "support/cuda_cases.h"
#include "support/files.h"
#include "support/own_arrays.h"
#include "support/random_scene.h"
#include "support/stand_in_cuda.h"
#include "support/wobble.h"
#include "tofray/tofray.h"

using namespace tofray;
using namespace tofray::test;

namespace {

class EveryScene : public testing::TestWithParam<std::string> {};

/// Turning things, keyframes, a camera that moves, and a sun.
Scene scene_in_motion(int number) {
  Random random(static_cast<std::uint64_t>(number) + 90);
  Scene scene = random_scene(random, 4 + 4 * number, number % 2 == 1);
  scene.name = "in motion " + std::to_string(number);
  scene.camera.pose = random_pose(random);
  set_in_motion(random, scene, number % 2 == 0);
  scene.ambient.spectrum = Ambient::Spectrum::sun_am15, scene.ambient.amount = 0.1;
  if (number % 3 != 0) scene.ambient.direction = Vec3{0.1, 0.2, 1} + random.point(0.3);
  return scene;
}

}  // namespace

TEST_P(EveryScene, has_the_same_bytes_by_the_functions_of_the_gpu) {
  const WithStandIn here;
  const Scene scene = load_scene(GetParam());
  const Camera camera = small(load_camera(scene));
  for (const Noise noise : {Noise::off, Noise::exact}) expect_same(scene, camera, {.seed = 7, .noise = noise});
  Camera quiet = camera;
  quiet.pixel.read_noise_e = 3;
  expect_same(scene, quiet, {.seed = 7});
}

INSTANTIATE_TEST_SUITE_P(cuda_host, EveryScene, testing::ValuesIn(scene_names()), [](const auto& which) { return test_name(which.param); });

// As many lights as there may be: four LEDs, each a disk of sixteen points.
TEST(cuda_host, has_the_same_bytes_with_64_lights) {
  const WithStandIn here;
  for (const char* name : {"flying-ball", "step-and-rod", "bench-mesh"}) {
    const Scene scene = load_scene(name);
    Camera camera = small(load_camera(scene));
    camera.illumination[0].ring_leds = 4, camera.illumination[0].ring_radius_m = 0.08;
    camera.illumination[0].area = {Area::Kind::disk, 0.03, 0, 0, 16};
    expect_same(scene, camera, {.seed = 7});
    expect_same(scene, camera, {.noise = Noise::off, .culling = false});
  }
}

TEST(cuda_host, has_the_same_bytes_with_everything_switched_on) {
  const WithStandIn here;
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
TEST(cuda_host, has_the_same_bytes_of_noisy_lines_where_they_outnumber_the_pixels) {
  const WithStandIn here;
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

TEST(cuda_host, has_the_same_bytes_of_random_scenes_still_and_moving) {
  const WithStandIn here;
  const Camera camera = small(load_camera("pico-flexx"));
  for (int i = 0; i < 12; ++i) {
    Random random(static_cast<std::uint64_t>(i) + 50);
    Scene scene = random_scene(random, i < 10 ? 3 + 5 * i : 150, i % 2 == 1);
    scene.name = "random " + std::to_string(i);
    scene.camera.pose = random_pose(random);
    expect_same(scene, camera, {});
  }
}

TEST(cuda_host, has_the_same_bytes_of_scenes_in_motion_and_of_several_times_within_an_exposure) {
  const WithStandIn here;
  for (int i = 0; i < 5; ++i) {
    const Scene scene = scene_in_motion(i);
    const Camera camera = i == 3 ? with_everything(load_camera("pico-flexx")) : small(load_camera("pico-flexx"));
    expect_same(scene, camera, {.exposure_samples = 1 + i});
    expect_same(scene, camera, {.last_stage = Stage::trace, .exposure_samples = 1 + i});
  }
}

TEST(cuda_host, batches_of_scenes_in_motion_take_seeds_and_poses) {
  const WithStandIn here;
  for (int i = 0; i < 2; ++i) {
    const Scene scene = scene_in_motion(i);
    const Camera camera = small(load_camera("pico-flexx"));
    const SimulatorOptions options{.batch_bytes = 1'100'000, .exposure_samples = 2};
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

TEST(cuda_host, has_the_same_bytes_of_meshes_that_change_their_shape) {
  const WithStandIn here;
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
TEST(cuda_host, has_the_same_bytes_of_samples_within_pixels_and_of_scattered_light) {
  const WithStandIn here;
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
    const SimulatorOptions options{.batch_bytes = 1'100'000, .exposure_samples = 2, .subpixel = 2};
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
TEST(cuda_host, has_the_same_bytes_of_bounces) {
  const WithStandIn here;
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
TEST(cuda_host, has_the_same_bytes_of_light_by_path_length) {
  const WithStandIn here;
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

TEST(cuda_host, keeps_the_light_of_what_stands_still) {
  WithStandIn here;
  const Scene scene = load_scene("card");
  Simulator simulator(scene, small(load_camera(scene)), on(Backend::cuda, {.truth = false, .subpixel = 3}));
  const auto launched = [&] {
    const int before = here.cuda.frames_by_device[0];
    (void)simulator.frame(1);
    return here.cuda.frames_by_device[0] - before;
  };
  EXPECT_EQ(launched(), 9) << "a pass over the pixels for each sample";
  EXPECT_EQ(launched(), 0);
  EXPECT_EQ(launched(), 0);
  EXPECT_EQ(here.cuda.graphs_made, 2) << "with them, and without";
}

TEST(cuda_host, stops_after_any_stage) {
  const WithStandIn here;
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
TEST(cuda_host, enters_at_any_stage) {
  const WithStandIn here;
  for (const char* name : {"demo", "flying-ball", "sun-outdoors"}) {
    const Scene scene = load_scene(name);
    expect_same_own_arrays(scene, small(load_camera(scene)));
    expect_same_own_arrays(scene, with_everything(load_camera(scene)));
  }
}

TEST(cuda_host, says_the_occupancy_of_the_kernel_that_takes_the_time) {
  WithStandIn here;
  Scene scene = load_scene("card");
  const Camera camera = small(load_camera(scene));
  (void)Simulator(scene, camera, on(Backend::cuda)).frame(0);
  EXPECT_EQ(here.cuda.occupancy_of, pipeline::Pass::pixels);
  scene.transport.bounces = 1;
  (void)Simulator(scene, camera, on(Backend::cuda)).frame(0);
  EXPECT_EQ(here.cuda.occupancy_of, pipeline::Pass::bounces);
}

TEST(cuda_host, any_block_size_gives_the_same_bytes) {
  WithStandIn here;
  const Scene scene = load_scene("card");
  const Camera camera = small(load_camera(scene));
  const Frame reference = Simulator(scene, camera, on(Backend::cpu)).frame(3);
  for (int size = 32; size <= 1024; size += 32) {
    Simulator cuda(scene, camera, on(Backend::cuda, {.block_size = size}));
    EXPECT_EQ(cuda.ran_on().block_size, size);
    EXPECT_EQ(first_difference(cuda.frame(3), reference), "") << size;
    EXPECT_GT(here.cuda.launches_by_block_size[size], 0);
    EXPECT_GT(cuda.ran_on().occupancy, 0);
  }
  for (const int wrong : {-32, 1, 31, 48, 1056}) {
    EXPECT_THROW(Simulator(scene, camera, on(Backend::automatic, {.block_size = wrong})), Error) << wrong;
  }
}

TEST(cuda_host, makes_the_graph_of_a_frame_once) {
  WithStandIn here;
  const Scene scene = load_scene("card");
  Camera camera = small(load_camera(scene));
  Simulator cuda(scene, camera, on(Backend::cuda));
  for (std::uint64_t i = 0; i < 5; ++i) (void)cuda.frame(i);
  EXPECT_EQ(here.cuda.graphs_made, 1);
  EXPECT_EQ(here.cuda.graphs_launched, 5);
  const Scene moving = load_scene("flying-ball");
  Simulator moved(moving, camera, on(Backend::cuda));
  for (std::uint64_t i = 0; i < 4; ++i) (void)moved.frame(i);
  EXPECT_EQ(here.cuda.graphs_made, 2) << "what moves is copied by the graph";
  camera.temperature.warm_up_m = 0.01, camera.temperature.warm_up_time_s = 1;  // the sensor is another one in each frame
  expect_same(scene, camera, {});
}

TEST(cuda_host, batches_have_the_bytes_of_single_frames) {
  for (const int devices : {1, 3}) {
    WithStandIn here;
    here.cuda.devices = devices;
    for (const char* name : {"card", "flying-ball"}) {
      const Scene scene = load_scene(name);
      Camera camera = small(load_camera(scene));
      camera.pixel.column_noise_e = 30, camera.pixel.row_noise_e = 20;
      for (const Backend backend : {Backend::cpu, Backend::cuda}) {
        Simulator simulator(scene, camera, on(backend, {.seed = 5, .batch_bytes = 750'000}));
        Simulator single(scene, camera, on(Backend::cpu, {.seed = 5}));
        std::uint64_t next = 2;
        simulator.frames(2, 30, [&](const FrameArrays& arrays) {
          ASSERT_EQ(arrays.index, next++);
          if (arrays.index % 7 != 2) return;
          EXPECT_EQ(first_difference(copy_of(arrays), arrays_only(single.frame(arrays.index))), "") << arrays.index;
        });
        EXPECT_EQ(next, 32u);
      }
    }
    EXPECT_EQ(here.cuda.frames_by_device.size(), static_cast<std::size_t>(devices)) << "all of them take part";
  }
}

// What goes to the GPU is bounded as well.
TEST(cuda_host, batches_of_poses_take_little_pinned_memory) {
  WithStandIn here;
  const Scene scene = load_scene("card");
  const Camera camera = small(load_camera(scene));
  Simulator simulator(scene, camera, on(Backend::cuda, {.batch_bytes = 370'000}));
  std::vector<FrameRequest> requests(400, {0, {}, scene.camera.pose});
  for (std::size_t i = 0; i < requests.size(); ++i) requests[i].index = i;
  DeviceFrames frames;
  simulator.frames_on_device(requests, frames);
  ASSERT_EQ(frames.size(), 400u);
  EXPECT_EQ(frames[399].index, 399u);
  EXPECT_LT(here.cuda.pinned_bytes, 1'000'000u);
}

// Only poses and times go to the GPU: a frame of a large scene takes as much along as one of a small scene.
TEST(cuda_host, poses_and_motion_take_no_shapes_along) {
  for (const bool moving : {false, true}) {
    std::size_t taken[2] = {};
    for (const int large : {0, 1}) {
      WithStandIn here;
      Random random(3);
      Scene scene = random_scene(random, large != 0 ? 200 : 5, false);
      if (moving) scene.objects.back().velocity_m_per_s = {0.1, 0, 0};
      const Camera camera = small(load_camera("pico-flexx"));
      Simulator simulator(scene, camera, on(Backend::cuda, {.batch_bytes = 100'000'000, .last_stage = Stage::trace}));
      const std::size_t before = here.cuda.pinned_bytes;
      std::vector<FrameRequest> requests(3, {0, {}, scene.camera.pose});
      DeviceFrames frames;
      simulator.frames_on_device(requests, frames);
      taken[large] = here.cuda.pinned_bytes - before;
    }
    EXPECT_EQ(taken[0], taken[1]) << moving;
    EXPECT_GT(taken[0], 0u);
  }
}

TEST(cuda_host, batches_take_seeds_and_poses) {
  const WithStandIn here;
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

TEST(cuda_host, frames_can_stay_on_the_device) {
  WithStandIn here;
  const Scene scene = load_scene("flying-ball");
  const Camera camera = small(load_camera(scene));
  Simulator cuda(scene, camera, on(Backend::cuda, {.truth = false}));
  DeviceFrames frames;
  const std::vector<FrameRequest> requests = mixed_requests(scene, 6);
  cuda.frames_on_device(requests, frames);
  ASSERT_EQ(frames.size(), 6u);
  EXPECT_GT(frames.seconds(), 0);
  for (std::size_t i = 0; i < 6; ++i) {
    EXPECT_EQ(frames[i].device, 0);
    EXPECT_EQ(frames[i].gt_range_m, nullptr);
    EXPECT_EQ(first_difference(copy_of(frames[i]), alone(scene, camera, {.truth = false}, requests[i])), "") << i;
  }
  const std::size_t pinned = here.cuda.pinned_bytes;
  DeviceFrames many;
  cuda.frames_on_device(0, 60, many);
  EXPECT_LT(here.cuda.pinned_bytes - pinned, 60u * 37 * 29 * 50) << "the host has no room for frames that it does not take";
  const float* memory = frames[0].z_m;
  cuda.frames_on_device(7, 2, frames);
  EXPECT_EQ(frames[0].z_m, memory) << "it is used again";
  EXPECT_EQ(first_difference(copy_of(frames[1]), alone(scene, camera, {.truth = false}, {8, {}, {}})), "");
  // Also so many that their bytes are few again, modulo 2^64.
  const auto frame_bytes = static_cast<std::uint64_t>(4 * (frames[1].z_m - frames[0].z_m));
  for (const std::uint64_t too_many : {std::uint64_t{1} << 20, std::uint64_t{1} << 63, ~std::uint64_t{0} / frame_bytes + 2})
    EXPECT_THROW(cuda.frames_on_device(0, too_many, frames), Error) << too_many;
  cuda.frames_on_device(3, 1, frames);
  EXPECT_EQ(first_difference(copy_of(frames[0]), alone(scene, camera, {.truth = false}, {3, {}, {}})), "");
  Simulator cpu(scene, camera, on(Backend::cpu));
  EXPECT_THROW(cpu.frames_on_device(0, 1, frames), Error);
}

TEST(cuda_host, decodes_recorded_raw_data) {
  const WithStandIn here;
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
