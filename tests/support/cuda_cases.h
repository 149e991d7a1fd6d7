// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <gtest/gtest.h>

#include <cstdint>
#include <vector>

#include "flow/frame_view.h"
#include "support/every_array.h"
#include "support/same_frame.h"
#include "support/whole_pixel.h"
#include "tofray/tofray.h"

/// What tests of the GPU backend share.
namespace tofray::test {

/// A part of the usual sensor, with sides that are no multiples of a patch's.
inline Camera small(Camera camera) {
  camera.sensor.width = 21, camera.sensor.height = 15;
  camera.lens.fx_px *= 0.094, camera.lens.fy_px *= 0.087, camera.lens.cx_px = 10, camera.lens.cy_px = 7;
  return camera;
}

inline SimulatorOptions on(Backend backend, SimulatorOptions options = {}) {
  options.backend = backend;
  options.threads = 1;
  return options;
}

/// The first frames and a late one have the same bytes on both backends.
inline void expect_same(const Scene& scene, const Camera& camera, SimulatorOptions options,
                        const std::vector<std::uint64_t>& indices = {0, 1, 5, (3ull << 32) + 1}) {
  if (options.arrays.empty()) options.arrays = every_array();
  Simulator cpu(scene, camera, on(Backend::cpu, options)), cuda(scene, camera, on(Backend::cuda, options));
  ASSERT_EQ(cuda.ran_on().backend, "cuda");
  for (const std::uint64_t index : indices) {
    EXPECT_EQ(first_difference(cpu.frame(index), cuda.frame(index)), "") << scene.name << ", frame " << index;
  }
}

/// A frame of a batch as arrays of its own.
inline Frame copy_of(const FrameArrays& a) {
  Frame out;
  out.index = a.index;
#define TOFRAY_COPY(name, part, member, element, shape, ...) \
  if (a.name != nullptr)                                     \
    out.part.member.assign(                                  \
        a.name, a.name + flow::values_of(ArrayShape::shape, {std::int64_t{a.width} * a.height, a.phases, a.bins, a.modulations}));
  TOFRAY_IMAGE_ARRAYS(TOFRAY_COPY)
#undef TOFRAY_COPY
  return out;
}

/// A frame without what a batch does not hand out.
inline Frame arrays_only(Frame frame) {
#define TOFRAY_CLEAR(name, part, member, ...) frame.part.member.clear();
  TOFRAY_EXPOSURE_ARRAYS(TOFRAY_CLEAR)
#undef TOFRAY_CLEAR
  return frame;
}

inline Frame alone(const Scene& scene, const Camera& camera, SimulatorOptions options, const FrameRequest& request) {
  Scene posed = scene;
  if (request.pose) posed.camera.pose = *request.pose, posed.camera.keyframes.clear();
  if (request.seed) options.seed = *request.seed;
  return arrays_only(Simulator(posed, camera, on(Backend::cpu, options)).frame(request.index));
}

/// Filters, all effects of the pixel, a second light: what no scene has.
inline Camera with_everything(Camera camera) {
  camera = small(camera);
  turn_on_every_effect(camera);
  camera.illumination.push_back(camera.illumination[0]);
  camera.illumination[1].position = {-0.02, 0.01, 0.003}, camera.illumination[1].axis = {0.1, -0.2, 1};
  camera.illumination[1].waveform.jitter_s = 3e-10;
  camera.decoding.filter.kind = ImageFilter::Kind::median;
  return camera;
}

/// One of each kind: plain, another seed, another pose, both.
inline std::vector<FrameRequest> mixed_requests(const Scene& scene, std::size_t count) {
  std::vector<FrameRequest> out;
  for (std::size_t i = 0; i < count; ++i) {
    FrameRequest one{i * 3, {}, {}};
    Pose pose = scene.camera.pose;
    pose.position[0] += 0.01 * static_cast<double>(i), pose.position[2] -= 0.02;
    if (i % 2 == 1) one.seed = 1000 + i;
    if (i % 4 >= 2) one.pose = pose;
    out.push_back(one);
  }
  return out;
}

}  // namespace tofray::test
