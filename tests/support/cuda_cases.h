// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "support/same_frame.h"
#include "tofray/tofray.h"

/// What tests of the GPU backend share.
namespace tofray::test {

/// A part of the usual sensor, with sides that are no multiples of a patch's.
inline Camera small(Camera camera) {
  camera.sensor.width = 67, camera.sensor.height = 43;
  camera.lens.fx_px *= 0.3, camera.lens.fy_px *= 0.25, camera.lens.cx_px = 33, camera.lens.cy_px = 21;
  return camera;
}

inline SimulatorOptions on(Backend backend, SimulatorOptions options = {}) {
  options.backend = backend;
  options.threads = 1;
  return options;
}

/// A frame of a batch as arrays of its own.
inline Frame copy_of(const FrameArrays& a) {
  Frame out;
  const auto pixels = static_cast<std::size_t>(a.width) * static_cast<std::size_t>(a.height), all = pixels * static_cast<std::size_t>(a.phases);
  const auto copy = [](const auto* from, std::size_t count, auto& to) {
    if (from != nullptr) to.assign(from, from + count);
  };
  out.index = a.index;
  copy(a.tap_a, all, out.raw.tap_a), copy(a.tap_b, all, out.raw.tap_b), copy(a.raw, all, out.raw.raw);
  copy(a.z_m, pixels, out.depth.z_m), copy(a.range_m, pixels, out.depth.range_m), copy(a.points_m, 3 * pixels, out.depth.points_m);
  copy(a.amplitude_e, pixels, out.depth.amplitude_e), copy(a.ambient_e, pixels, out.depth.ambient_e), copy(a.noise_m, pixels, out.depth.noise_m);
  copy(a.confidence, pixels, out.depth.confidence), copy(a.flags, pixels, out.depth.flags);
  copy(a.gt_range_m, pixels, out.truth.range_m), copy(a.gt_z_m, pixels, out.truth.z_m), copy(a.gt_reflectivity, pixels, out.truth.reflectivity);
  copy(a.gt_position_m, 3 * pixels, out.truth.position_m), copy(a.gt_normal, 3 * pixels, out.truth.normal);
  copy(a.gt_object_id, pixels, out.truth.object_id), copy(a.gt_irradiance_w_m2, pixels, out.truth.irradiance_w_m2);
  copy(a.gt_radiance_w_m2_sr, pixels, out.truth.radiance_w_m2_sr), copy(a.gt_power_w, pixels, out.truth.power_w);
  copy(a.gt_signal_e, all, out.truth.signal_e);
  return out;
}

/// The same without what a batch does not hand out.
inline Frame arrays_only(Frame frame) {
  frame.raw.start_time_s.clear();
  return frame;
}

inline Frame alone(const Scene& scene, const Camera& camera, SimulatorOptions options, const FrameRequest& request) {
  Scene posed = scene;
  if (request.pose) posed.camera.pose = *request.pose;
  if (request.seed) options.seed = *request.seed;
  return arrays_only(Simulator(posed, camera, on(Backend::cpu, options)).frame(request.index));
}

/// Filters, fixed patterns, suppression, a second light: what no scene has.
inline Camera with_everything(Camera camera) {
  camera = small(camera);
  camera.pixel.prnu = 0.01, camera.pixel.dsnu_dn = 1, camera.pixel.delay_s = 1e-11;
  camera.pixel.suppression_threshold_e = 2000, camera.pixel.suppression_budget_e = 20000;
  camera.illumination.push_back(camera.illumination[0]);
  camera.illumination[1].position = {-0.02, 0.01, 0.003}, camera.illumination[1].axis = {0.1, -0.2, 1};
  camera.illumination[1].waveform.jitter_s = 3e-10;
  camera.decoding.filter.kind = ImageFilter::Kind::median;
  camera.temperature.drift_m_per_kelvin = 1e-4, camera.temperature.celsius = 41;
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
