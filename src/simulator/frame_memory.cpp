// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include "simulator/frame_memory.h"

namespace tofray::simulator {

void prepare(Depth& depth, int width, int height) {
  const std::size_t pixels = static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
  depth.width = width, depth.height = height;
  for (auto* array : {&depth.z_m, &depth.range_m, &depth.amplitude_e, &depth.ambient_e, &depth.noise_m}) array->resize(pixels);
  depth.points_m.resize(3 * pixels);
  depth.confidence.resize(pixels);
  depth.flags.resize(pixels);
}

void prepare(Frame& frame, const Camera& camera, bool truth) {
  const int width = camera.sensor.width, height = camera.sensor.height, phases = static_cast<int>(camera.mode.sequence.size());
  const std::size_t pixels = static_cast<std::size_t>(width) * static_cast<std::size_t>(height), all = pixels * static_cast<std::size_t>(phases);
  Raw& raw = frame.raw;
  raw.width = width, raw.height = height, raw.phases = phases;
  raw.tap_a.resize(all), raw.tap_b.resize(all), raw.raw.resize(all);
  raw.modulation_frequency_hz.clear(), raw.reference_phase_rad.clear(), raw.integration_time_s.clear(), raw.lit.clear();
  for (const RawFrame& k : camera.mode.sequence) {
    raw.modulation_frequency_hz.push_back(k.lit ? k.modulation_frequency_hz : 0);
    raw.reference_phase_rad.push_back(k.lit ? k.reference_phase_rad : 0);
    raw.integration_time_s.push_back(k.integration_time_s);
    raw.lit.push_back(k.lit);
  }
  prepare(frame.depth, width, height);
  Truth& t = frame.truth;
  if (!truth) {
    t = {};
    return;
  }
  t.width = width, t.height = height, t.phases = phases;
  for (auto* array : {&t.range_m, &t.z_m, &t.reflectivity, &t.irradiance_w_m2, &t.radiance_w_m2_sr, &t.power_w}) array->resize(pixels);
  t.position_m.resize(3 * pixels), t.normal.resize(3 * pixels);
  t.object_id.resize(pixels);
  t.signal_e.resize(all);
}

flow::FrameView view_of(Depth& depth) {
  flow::FrameView view{};
  view.z = depth.z_m.data(), view.range = depth.range_m.data(), view.points = depth.points_m.data();
  view.amplitude = depth.amplitude_e.data(), view.ambient = depth.ambient_e.data(), view.noise = depth.noise_m.data();
  view.confidence = depth.confidence.data(), view.flags = depth.flags.data();
  return view;
}

flow::FrameView view_of(Frame& frame) {
  flow::FrameView view = view_of(frame.depth);
  view.tap_a = frame.raw.tap_a.data(), view.tap_b = frame.raw.tap_b.data(), view.raw = frame.raw.raw.data();
  Truth& t = frame.truth;
  if (t.range_m.empty()) return view;
  view.gt_range = t.range_m.data(), view.gt_z = t.z_m.data(), view.gt_reflectivity = t.reflectivity.data();
  view.gt_position = t.position_m.data(), view.gt_normal = t.normal.data(), view.gt_object = t.object_id.data();
  view.gt_irradiance = t.irradiance_w_m2.data(), view.gt_radiance = t.radiance_w_m2_sr.data(), view.gt_power = t.power_w.data();
  view.gt_signal = t.signal_e.data();
  return view;
}

}  // namespace tofray::simulator
