// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
// The GPU backend's host side, on a stand-in for CUDA's runtime: every scene's bytes, and what only a stand-in can tell.
#include <gtest/gtest.h>

#include "support/cuda_cases.h"
#include "support/files.h"
#include "support/placed_scene.h"
#include "support/random_scene.h"
#include "support/samples.h"
#include "support/stand_in_cuda.h"
#include "tofray/tofray.h"

using namespace tofray;
using namespace tofray::test;
using out_test::error_of;

namespace {

class EveryScene : public testing::TestWithParam<std::string> {};

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

// Its arrays are copied to their places in pieces, by several threads.
TEST(cuda_host, a_frame_of_the_usual_size_has_the_same_bytes_for_any_number_of_threads) {
  const WithStandIn here;
  const Scene scene = load_scene("card");
  const Camera camera = load_camera(scene);
  const Frame wanted = Simulator(scene, camera, on(Backend::cpu)).frame(2);
  for (const int threads : {1, 3}) {
    SimulatorOptions options = on(Backend::cuda);
    options.threads = threads;
    EXPECT_EQ(first_difference(Simulator(scene, camera, options).frame(2), wanted), "") << threads;
  }
}

// Delays that decoding knows are its own: there are two maps of them where the sensor has none, and one.
TEST(cuda_host, decodes_by_what_is_known_of_a_specimen) {
  const WithStandIn here;
  const Scene scene = load_scene("card");
  for (const double delay : {0.0, 1e-10}) {
    Camera camera = small(load_camera(scene));
    camera.pixel.delay_s = delay;
    DecoderCalibration& known = camera.decoding.calibration;
    known.kind = DecoderCalibration::Kind::none;
    expect_same(scene, camera, {.seed = 7});
    known.kind = DecoderCalibration::Kind::specimen;
    for (const RawFrame& frame : camera.mode.sequence) {
      if (!frame.lit || (!known.frequencies.empty() && known.frequencies.back().modulation_frequency_hz == frame.modulation_frequency_hz))
        continue;
      FrequencyCalibration one{frame.modulation_frequency_hz, 0.1, 1e-4, {0, 0.01}, {0.01, 0}, "phases.npy", {}};
      for (int i = 0; i < 21 * 15; ++i)
        one.pixel_phase_rad.push_back(1e-3 * (i % 17) + 0.01 * static_cast<double>(known.frequencies.size()));
      known.frequencies.push_back(one);
    }
    ASSERT_EQ(known.frequencies.size(), 2U);
    expect_same(scene, camera, {.seed = 7});
  }
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

TEST(cuda_host, says_the_occupancy_of_the_kernel_that_takes_the_time) {
  WithStandIn here;
  Scene scene = load_scene("card");
  const Camera camera = small(load_camera(scene));
  (void)Simulator(scene, camera, on(Backend::cuda)).frame(0);
  EXPECT_EQ(here.cuda.occupancy_of, pipeline::pass<pipeline::FromRays>);
  scene.transport.bounces = 1;
  (void)Simulator(scene, camera, on(Backend::cuda)).frame(0);
  EXPECT_EQ(here.cuda.occupancy_of, pipeline::pass<pipeline::Bounces>);
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
        Simulator simulator(scene, camera, on(backend, {.seed = 5, .batch_bytes = 220'000}));
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
  EXPECT_LT(here.cuda.pinned_bytes - pinned, 60u * 21 * 15 * 50) << "the host has no room for frames that it does not take";
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

// Each frame takes along where things are: on the device as by a scene whose keyframes say the same.
TEST(cuda_host, objects_and_cameras_are_placed_from_outside) {
  const WithStandIn here;
  const Camera camera = small(placed_camera());
  const Scene rest = placed_scene_at_rest(), moving = scene_on_a_path(rest, camera, 8, true);
  std::vector<FrameRequest> requests;
  for (const std::uint64_t i : {3, 1, 1, 5}) requests.push_back(request_on_the_path(moving, i));
  requests[2].seed = 9, requests[3].start_time_s = 0.5;
  Simulator cpu(rest, camera, on(Backend::cpu)), cuda(rest, camera, on(Backend::cuda));
  std::vector<Frame> expected(requests.size());
  for (std::size_t i = 0; i < requests.size(); ++i) {
    cpu.frame(requests[i], expected[i]);
    Frame one;
    cuda.frame(requests[i], one);
    EXPECT_EQ(first_difference(one, expected[i]), "") << i;
  }
  std::size_t next = 0;
  cuda.frames(requests,
              [&](const FrameArrays& got) { EXPECT_EQ(first_difference(copy_of(got), arrays_only(expected[next++])), "") << next; });
  EXPECT_EQ(next, requests.size());
  DeviceFrames stay;
  cuda.frames_on_device(requests, stay);
  for (std::size_t i = 0; i < requests.size(); ++i) EXPECT_EQ(first_difference(copy_of(stay[i]), arrays_only(expected[i])), "") << i;
  requests[1].objects.pop_back();
  const std::string told = error_of([&] { cuda.frames_on_device(requests, stay); }).what();
  EXPECT_NE(told.find("not all requests place the same objects"), std::string::npos) << told;
}
