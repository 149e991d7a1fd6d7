// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
// No GPU, or one that fails: whatever call fails, and for whatever reason, auto goes on with the processor and cuda says why.
#include <gtest/gtest.h>

#include "backend/cuda/cuda.h"
#include "support/cuda_cases.h"
#include "support/sanitizers.h"
#include "support/stand_in_cuda.h"

using namespace tofray;
using namespace tofray::test;

namespace {

struct Ailment {
  const char* name;
  backend::gpu::Cause cause;
  bool stays;
  const char* says;
};

class Failing : public testing::TestWithParam<Ailment> {};

/// Batches of few frames, so that several are on their way.
const SimulatorOptions few_bytes{.batch_bytes = 22'000};

/// What a user does: frames alone, a batch.
std::vector<Frame> some_frames(Simulator& simulator) {
  std::vector<Frame> out = {arrays_only(simulator.frame(1)), arrays_only(simulator.frame(2))};
  simulator.frames(3, 5, [&](const FrameArrays& arrays) { out.push_back(copy_of(arrays)); });
  return out;
}

/// One run in which call number n fails.
void run_with_failure(const Ailment& ailment, std::uint64_t n, Backend backend, const Scene& scene, const Camera& camera,
                      const std::vector<Frame>& reference) {
  WithStandIn here;
  here.cuda.failure = ailment.cause, here.cuda.stays_broken = ailment.stays, here.cuda.fail_at = n;
  std::string said;
  try {
    Simulator simulator(scene, camera, on(backend, few_bytes));
    const std::vector<Frame> frames = some_frames(simulator);
    said = simulator.ran_on().fallback_reason;
    for (std::size_t i = 0; i < frames.size(); ++i) ASSERT_EQ(first_difference(frames[i], reference[i]), "") << "frame " << i;
    EXPECT_EQ(simulator.ran_on().backend, said.empty() ? "cuda" : "cpu");
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::device);
    EXPECT_EQ(backend, Backend::cuda) << "auto must not fail: " << error.what();
    said = error.what();
  }
  // Looking for further GPUs may fail and change nothing.
  EXPECT_TRUE(said.empty() || said.find(ailment.says) != std::string::npos) << said;
  EXPECT_TRUE(n > 8 || !said.empty());
  EXPECT_EQ(here.cuda.held(), 0u) << "given back";
}

}  // namespace

TEST_P(Failing, at_any_call) {
  const Scene scene = load_scene("flying-ball");
  Camera camera = small(load_camera(scene));
  camera.sensor.width = 20, camera.sensor.height = 6;
  camera.decoding.filter.kind = ImageFilter::Kind::median;
  camera.illumination[0].waveform.kind = Waveform::Kind::sine;  // whose table takes no time: hundreds of simulators are made
  Simulator cpu(scene, camera, on(Backend::cpu, few_bytes));
  const std::vector<Frame> reference = some_frames(cpu);
  std::uint64_t calls = 0;
  {
    const WithStandIn here;
    Simulator simulator(scene, camera, on(Backend::cuda, few_bytes));
    (void)some_frames(simulator);
    calls = here.cuda.calls;
  }
  ASSERT_GT(calls, 40u);
  for (std::uint64_t n = 1; n <= calls; n += with_sanitizers ? 7 : 1) {
    SCOPED_TRACE("call " + std::to_string(n));
    run_with_failure(GetParam(), n, Backend::automatic, scene, camera, reference);
    run_with_failure(GetParam(), n, Backend::cuda, scene, camera, reference);
  }
}

INSTANTIATE_TEST_SUITE_P(
    cuda_fault, Failing,
    testing::Values(Ailment{"no_driver", backend::gpu::Cause::no_driver, true, "no NVIDIA driver is installed"},
                    Ailment{"old_driver", backend::gpu::Cause::old_driver, true, "too old: it knows CUDA 11.8, this build needs 13.0"},
                    Ailment{"no_device", backend::gpu::Cause::no_device, true, "there is no GPU"},
                    Ailment{"device_busy", backend::gpu::Cause::busy, false, "taken by another program"},
                    Ailment{"no_memory", backend::gpu::Cause::no_memory, false, "too little memory"},
                    Ailment{"architecture_not_built", backend::gpu::Cause::no_code, true, "this build has no code for"},
                    Ailment{"kernel_error", backend::gpu::Cause::other, false, "standInError: number 999"},
                    Ailment{"lost_device", backend::gpu::Cause::other, true, "standInError: number 999"}),
    [](const auto& which) { return std::string(which.param.name); });

TEST(cuda_fault, while_decoding_recorded_data) {
  const Scene scene = load_scene("card");
  const Camera camera = small(load_camera(scene));
  Frame frame = Simulator(scene, camera, on(Backend::cpu)).frame(0), again = frame;
  for (std::uint64_t n = 1; n <= 25; ++n) {
    WithStandIn here;
    here.cuda.fail_at = n;
    RanOn machine;
    again.depth = process(frame.raw, camera, on(Backend::automatic), &machine);
    EXPECT_EQ(first_difference(frame, again), "") << n;
    const bool failed = here.cuda.calls >= n;
    EXPECT_EQ(machine.backend, failed ? "cpu" : "cuda") << n;
    EXPECT_EQ(machine.fallback_reason.empty(), !failed) << n;
    here.cuda.fail_at = here.cuda.calls + n;
    EXPECT_THROW((void)process(frame.raw, camera, on(Backend::cuda)), Error) << n;
    EXPECT_EQ(here.cuda.held(), 0u);
  }
}

TEST(cuda_fault, says_which_gpus_there_are) {
  WithStandIn here;
  here.cuda.devices = 2;
  const Scene scene = load_scene("card");
  const Camera camera = small(load_camera(scene));
  EXPECT_EQ(Simulator(scene, camera, {.device = 1}).ran_on().device, "Stand-in 1");
  EXPECT_EQ(Simulator(scene, camera, {}).ran_on().device, "Stand-in 0");
  EXPECT_EQ(Simulator(scene, camera, {.backend = Backend::cpu}).ran_on().backend, "cpu");
  const Simulator none(scene, camera, {.device = 2});
  EXPECT_EQ(none.ran_on().backend, "cpu");
  EXPECT_EQ(none.ran_on().fallback_reason, "there is no GPU number 2; the machine has 2, counted from 0");
  here.cuda.devices = 0;
  EXPECT_EQ(Simulator(scene, camera, {}).ran_on().fallback_reason, "there is no GPU");
  EXPECT_THROW(Simulator(scene, camera, {.backend = Backend::cuda}), Error);
}

// auto takes the first GPU that can be used, and batches all that can.
TEST(cuda_fault, passes_over_gpus_that_cannot_be_used) {
  WithStandIn here;
  here.cuda.devices = 4;
  here.cuda.unusable = {0, 2};
  const Scene scene = load_scene("card");
  const Camera camera = small(load_camera(scene));
  Simulator simulator(scene, camera, {.batch_bytes = 220'000});
  EXPECT_EQ(simulator.ran_on().device, "Stand-in 1");
  for (int round = 0; round < 2; ++round) simulator.frames(0, 30, [](const FrameArrays&) {});
  EXPECT_EQ(here.cuda.frames_by_device.size(), 2u);
  EXPECT_EQ(here.cuda.frames_by_device.count(1) + here.cuda.frames_by_device.count(3), 2u);
  EXPECT_EQ(backend::why_no_cuda(-1).gpu, "Stand-in 1");
  EXPECT_EQ(Simulator(scene, camera, {.device = 2}).ran_on().backend, "cpu");
  here.cuda.unusable = {0, 1, 2, 3};
  EXPECT_NE(Simulator(scene, camera).ran_on().fallback_reason.find("Stand-in 0"), std::string::npos) << "the first one's reason";
}

// Whatever GPU another simulator, or another library, has made the current one.
TEST(cuda_fault, memory_is_taken_on_the_gpu_that_computes) {
  WithStandIn here;
  here.cuda.devices = 2;
  const Scene scene = load_scene("card");
  const Camera camera = small(load_camera(scene));
  Simulator first(scene, camera, on(Backend::cuda, {.device = 0})), second(scene, camera, on(Backend::cuda, {.device = 1}));
  DeviceFrames a, b;
  for (int round = 0; round < 2; ++round) {
    first.frames_on_device(0, 3, a);
    second.frames_on_device(0, 4 + static_cast<std::uint64_t>(round), b);
    EXPECT_EQ(first_difference(second.frame(1), first.frame(1)), "");
    second.frames_on_device(0, 3, a);  // moves to the other GPU
    EXPECT_EQ(a[0].device, 1);
  }
}

// The real runtime on a machine without a driver, or without CUDA: what most users have.
TEST(cuda_fault, a_machine_without_a_gpu_says_so) {
  const backend::CudaLack lack = backend::why_no_cuda(-1);
  if (lack.reason.empty()) GTEST_SKIP() << "this machine has a GPU";
  const Scene scene = load_scene("card");
  const Camera camera = small(load_camera(scene));
  EXPECT_EQ(Simulator(scene, camera).ran_on().fallback_reason, lack.reason);
  EXPECT_EQ(Simulator(scene, camera).ran_on().backend, "cpu");
  EXPECT_EQ(lack.reason.find('\n'), std::string::npos) << "one line";
  try {
    Simulator simulator(scene, camera, {.backend = Backend::cuda});
    FAIL() << "no error";
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::device);
    EXPECT_NE(std::string(error.what()).find(lack.reason), std::string::npos);
  }
}
