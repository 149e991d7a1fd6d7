// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include "io/frame_file.h"

#include <algorithm>

#include "io/atomic_file.h"
#include "io/npz.h"

namespace tofray::io {
namespace {

/// Collects views of a frame's arrays; empty ones (ground truth that was not asked for) are left out.
class FrameArrays {
 public:
  template <class T>
  void add(const char* name, const NpyShape& shape, const std::vector<T>& data, NpyType type = npy_type_of<T>()) {
    if (!data.empty()) views_.push_back(npy_view(name, shape, data, type));
  }
  [[nodiscard]] const std::vector<NpyView>& views() const { return views_; }

 private:
  std::vector<NpyView> views_;
};

NpyShape image(int height, int width) { return {static_cast<std::size_t>(height), static_cast<std::size_t>(width)}; }

NpyShape vectors(int height, int width) { return {static_cast<std::size_t>(height), static_cast<std::size_t>(width), 3}; }

NpyShape stack(int phases, int height, int width) {
  return {static_cast<std::size_t>(phases), static_cast<std::size_t>(height), static_cast<std::size_t>(width)};
}

void add_raw(FrameArrays& arrays, const Raw& raw) {
  const NpyShape stacked = stack(raw.phases, raw.height, raw.width);
  const NpyShape by_phase = {static_cast<std::size_t>(raw.phases)};
  arrays.add("tap_a", stacked, raw.tap_a);
  arrays.add("tap_b", stacked, raw.tap_b);
  arrays.add("raw", stacked, raw.raw);
  arrays.add("modulation_frequency_hz", by_phase, raw.modulation_frequency_hz);
  arrays.add("reference_phase_rad", by_phase, raw.reference_phase_rad);
  arrays.add("integration_time_s", by_phase, raw.integration_time_s);
  arrays.add("start_time_s", by_phase, raw.start_time_s);
  arrays.add("lit", by_phase, raw.lit, npy_type_of<bool>());
}

void add_depth(FrameArrays& arrays, const Depth& depth) {
  const NpyShape shape = image(depth.height, depth.width);
  arrays.add("z_m", shape, depth.z_m);
  arrays.add("range_m", shape, depth.range_m);
  arrays.add("points_m", vectors(depth.height, depth.width), depth.points_m);
  arrays.add("amplitude_e", shape, depth.amplitude_e);
  arrays.add("ambient_e", shape, depth.ambient_e);
  arrays.add("noise_m", shape, depth.noise_m);
  arrays.add("confidence", shape, depth.confidence);
  arrays.add("flags", shape, depth.flags);
}

/// @param time  one element, which must live as long as the views
void add_truth(FrameArrays& arrays, const Truth& truth, const std::vector<double>& time) {
  if (truth.range_m.empty()) return;
  const NpyShape shape = image(truth.height, truth.width);
  arrays.add("gt_time_s", {}, time);
  arrays.add("gt_range_m", shape, truth.range_m);
  arrays.add("gt_z_m", shape, truth.z_m);
  arrays.add("gt_reflectivity", shape, truth.reflectivity);
  arrays.add("gt_position_m", vectors(truth.height, truth.width), truth.position_m);
  arrays.add("gt_normal", vectors(truth.height, truth.width), truth.normal);
  arrays.add("gt_object_id", shape, truth.object_id);
  arrays.add("gt_irradiance_w_m2", shape, truth.irradiance_w_m2);
  arrays.add("gt_radiance_w_m2_sr", shape, truth.radiance_w_m2_sr);
  arrays.add("gt_power_w", shape, truth.power_w);
  arrays.add("gt_signal_e", stack(truth.phases, truth.height, truth.width), truth.signal_e);
}

}  // namespace

std::string frame_npz_bytes(const Frame& frame, const Camera& camera, const PoseMatrix& camera_pose, const std::string& meta,
                            const std::vector<NamedArray>& kept) {
  FrameArrays arrays;
  add_raw(arrays, frame.raw);
  add_depth(arrays, frame.depth);
  const std::vector<double> time = {frame.truth.time_s};
  add_truth(arrays, frame.truth, time);

  const Lens& lens = camera.lens;
  const std::vector<double> matrix = {lens.fx_px, 0, lens.cx_px, 0, lens.fy_px, lens.cy_px, 0, 0, 1};
  const std::vector<double> distortion = {lens.k1, lens.k2, lens.p1, lens.p2, lens.k3};
  const std::vector<double> pose(camera_pose.begin(), camera_pose.end());
  arrays.add("camera_matrix", {3, 3}, matrix);
  arrays.add("distortion", {5}, distortion);
  arrays.add("camera_pose", {4, 4}, pose);

  // a 0-d string; numpy has no strings of length 0
  const std::string meta_bytes = utf32_of(meta.empty() ? "{}" : meta);
  std::vector<NpyView> views = arrays.views();
  for (const NamedArray& one : kept) {
    const bool own =
        one.name == "meta" || std::any_of(views.begin(), views.end(), [&](const NpyView& view) { return view.name == one.name; });
    if (!own) views.push_back({one.name, one.array.type, one.array.shape, one.array.bytes});
  }
  views.push_back({"meta", {'U', static_cast<int>(meta_bytes.size())}, {}, meta_bytes});
  return npz_bytes(views);
}

void write_frame_npz(const std::filesystem::path& path, const Frame& frame, const Camera& camera, const PoseMatrix& camera_pose,
                     const std::string& meta) {
  write_file_atomically(path, frame_npz_bytes(frame, camera, camera_pose, meta));
}

}  // namespace tofray::io
