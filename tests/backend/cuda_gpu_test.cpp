// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
// On a real GPU: the same bytes as the processor. Where there is none, each test says that it was skipped.
#include <gtest/gtest.h>

#include "support/cuda_cases.h"
#include "support/files.h"
#include "support/gpu.h"
#include "support/own_arrays.h"
#include "support/random_scene.h"

using namespace tofray;
using namespace tofray::test;

namespace {

class Gpu : public testing::Test {
 protected:
  void SetUp() override { need_gpu(); }
};
class GpuScene : public Gpu, public testing::WithParamInterface<std::string> {};
class GpuBlockSize : public Gpu, public testing::WithParamInterface<int> {};

/// Arrays in the GPU's memory, one by one, in host memory.
FrameArrays fetched(const FrameArrays& there, std::vector<std::vector<unsigned char>>& memory) {
  backend::gpu::Device device(there.device);
  const backend::gpu::Stream stream = device.stream();
  FrameArrays here = there;
  const auto pixels = static_cast<std::size_t>(there.width) * static_cast<std::size_t>(there.height),
             all = pixels * static_cast<std::size_t>(there.phases);
  const auto fetch = [&]<class T>(const T*& array, std::size_t count) {
    if (array == nullptr) return;
    memory.emplace_back(count * sizeof(T));
    const backend::gpu::PinnedMemory pinned = device.allocate_pinned(count * sizeof(T));
    device.check(device.runtime().copy(pinned.get(), array, count * sizeof(T), backend::gpu::Way::to_host, stream.get()),
                 "fetching an array");
    device.check(device.runtime().synchronize(stream.get()), "fetching an array");
    std::memcpy(memory.back().data(), pinned.get(), count * sizeof(T));
    array = reinterpret_cast<const T*>(memory.back().data());
  };
  fetch(here.tap_a, all), fetch(here.tap_b, all), fetch(here.raw, all);
  fetch(here.z_m, pixels), fetch(here.range_m, pixels), fetch(here.points_m, 3 * pixels), fetch(here.amplitude_e, pixels);
  fetch(here.ambient_e, pixels), fetch(here.noise_m, pixels), fetch(here.confidence, pixels), fetch(here.flags, pixels);
  return here;
}

}  // namespace

TEST_P(GpuScene, has_the_bytes_of_the_processor) {
  const Scene scene = load_scene(GetParam());
  const Camera camera = load_camera(scene);
  for (const Noise noise : {Noise::off, Noise::exact}) expect_same(scene, camera, {.seed = 7, .noise = noise});
  Camera quiet = camera;
  quiet.pixel.read_noise_e = 3;
  expect_same(scene, quiet, {.seed = 7});
  expect_same(scene, camera, {.culling = false});
  expect_same(scene, small(camera), {});
}
INSTANTIATE_TEST_SUITE_P(all, GpuScene, testing::ValuesIn(scene_names()), [](const auto& which) { return test_name(which.param); });

TEST_P(GpuBlockSize, gives_the_bytes_of_the_processor) {
  for (const char* name : {"bench-primitives", "flying-ball"}) {
    const Scene scene = load_scene(name);
    expect_same(scene, load_camera(scene), {.block_size = GetParam()});
  }
}
INSTANTIATE_TEST_SUITE_P(all, GpuBlockSize, testing::Range(32, 1025, 32), testing::PrintToStringParamName());

TEST_F(Gpu, enters_at_any_stage) {
  for (const char* name : {"demo", "flying-ball", "sun-outdoors"}) {
    const Scene scene = load_scene(name);
    expect_same_own_arrays(scene, load_camera(scene));
  }
}

TEST_F(Gpu, filters_and_stages_have_the_bytes_of_the_processor) {
  const Scene scene = load_scene("demo");
  Camera camera = load_camera(scene);
  for (const auto kind : {ImageFilter::Kind::none, ImageFilter::Kind::gaussian, ImageFilter::Kind::median, ImageFilter::Kind::bilateral,
                          ImageFilter::Kind::adaptive}) {
    camera.decoding.filter.kind = kind;
    expect_same(scene, with_everything(camera), {});
    for (const Stage stage : {Stage::trace, Stage::power, Stage::raw, Stage::depth}) expect_same(scene, camera, {.last_stage = stage});
  }
}

TEST_F(Gpu, random_scenes_have_the_bytes_of_the_processor) {
  const Camera camera = load_camera("pico-flexx");
  for (int i = 0; i < 20; ++i) {
    Random random(static_cast<std::uint64_t>(i) + 50);
    Scene scene = random_scene(random, 3 + 5 * i, i % 2 == 1);
    cut_out(scene);
    scene.name = "random " + std::to_string(i);
    scene.camera.pose = random_pose(random);
    expect_same(scene, camera, {});
  }
}

TEST_F(Gpu, batches_have_the_bytes_of_the_processor) {
  for (const char* name : {"bench-primitives", "flying-ball"}) {
    const Scene scene = load_scene(name);
    const Camera camera = load_camera(scene);
    Simulator cuda(scene, camera, {.backend = Backend::cuda});
    std::uint64_t next = 0;
    cuda.frames(0, 100, [&](const FrameArrays& arrays) {
      ASSERT_EQ(arrays.index, next++);
      if (arrays.index % 9 != 0) return;
      EXPECT_EQ(first_difference(copy_of(arrays), alone(scene, camera, {}, {arrays.index, {}, {}})), "")
          << name << ", frame " << arrays.index;
    });
    EXPECT_EQ(next, 100u);
  }
}

TEST_F(Gpu, frames_left_there_have_the_bytes_of_the_processor) {
  for (const char* name : {"bench-primitives", "flying-ball"}) {
    const Scene scene = load_scene(name);
    const Camera camera = load_camera(scene);
    Simulator cuda(scene, camera, {.backend = Backend::cuda, .truth = false});
    const std::vector<FrameRequest> requests = mixed_requests(scene, 12);
    DeviceFrames frames;
    cuda.frames_on_device(requests, frames);
    for (std::size_t i = 0; i < requests.size(); ++i) {
      std::vector<std::vector<unsigned char>> memory;
      EXPECT_EQ(first_difference(copy_of(fetched(frames[i], memory)), alone(scene, camera, {.truth = false}, requests[i])), "")
          << name << ", request " << i;
    }
  }
}

TEST_F(Gpu, recorded_raw_data_have_the_depth_of_the_processor) {
  const Scene scene = load_scene("demo");
  const Camera camera = load_camera(scene);
  Frame frame = Simulator(scene, camera, {.backend = Backend::cpu}).frame(0), again = frame;
  again.depth = process(frame.raw, camera, {.backend = Backend::cuda});
  EXPECT_EQ(first_difference(frame, again), "");
}
