// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include "results/frame_file.h"

#include <algorithm>

#include "camera/readout/image_camera.h"
#include "files/atomic_file.h"
#include "results/array_table.h"
#include "results/meta.h"
#include "tofray/save.h"

namespace tofray::results {

using files::NamedArray;
using files::npy_view;
using files::NpyShape;
using files::NpyView;
using files::npz_bytes;
using files::utf32_of;
using files::write_file_atomically;

namespace {

NpyShape extents(ArrayShape shape, const Frame& frame, int height, int width) {
  const auto k = static_cast<std::size_t>(frame.raw.phases), b = static_cast<std::size_t>(frame.truth.bins),
             f = static_cast<std::size_t>(frame.depth.modulations), v = static_cast<std::size_t>(height),
             u = static_cast<std::size_t>(width);
  switch (shape) {
    case ArrayShape::image: return {v, u};
    case ArrayShape::pairs: return {v, u, 2};
    case ArrayShape::vectors: return {v, u, 3};
    case ArrayShape::stack: return {k, v, u};
    case ArrayShape::moved: return {k, v, u, 2};
    case ArrayShape::by_frequency: return {f, v, u};
    case ArrayShape::bins: return {b, v, u};
    case ArrayShape::list: return {k};
  }
  return {};
}

/// As OpenCV takes it: 5 numbers, 8 of a rational model, 4 of a fisheye.
std::vector<double> distortion_of(const camera::ImageCamera& camera) {
  const Lens& lens = camera.lens;
  if (lens.distortion == Lens::Distortion::fisheye) return {lens.k1, lens.k2, lens.k3, lens.k4};
  std::vector<double> out{lens.k1, lens.k2, lens.p1, lens.p2, lens.k3};
  if (lens.k4 != 0 || lens.k5 != 0 || lens.k6 != 0) out.insert(out.end(), {lens.k4, lens.k5, lens.k6});
  return out;
}

std::vector<double> matrix_of(const camera::ImageCamera& camera) {
  const Lens& lens = camera.lens;
  return {lens.fx_px, 0, lens.cx_px, 0, lens.fy_px, lens.cy_px, 0, 0, 1};
}

}  // namespace

FrameArrays::FrameArrays(const Frame& frame, const Camera& camera, const PoseMatrix& camera_pose, const ArrayChoice& choice)
    : time_{frame.truth.time_s},
      matrix_(matrix_of(camera::ImageCamera(camera))),
      distortion_(distortion_of(camera::ImageCamera(camera))),
      pose_(camera_pose.begin(), camera_pose.end()) {
  const auto add = [&](const char* name, const NpyShape& shape, const auto& data, bool there = true) {
    const ArrayRow& row = *find_array(name);
    if (there && !data.empty() && choice.has(row)) views_.push_back(npy_view(name, shape, data, row.type));
  };
#define TOFRAY_ADD(name, part, member, element, shape, ...) \
  add(#name, extents(ArrayShape::shape, frame, frame.part.height, frame.part.width), frame.part.member, frame.part.width > 0);
  TOFRAY_RAW_ARRAYS(TOFRAY_ADD)
  TOFRAY_EXPOSURE_ARRAYS(TOFRAY_ADD)
  TOFRAY_DEPTH_ARRAYS(TOFRAY_ADD)
  add("gt_time_s", {}, time_, frame.truth.width > 0);
  TOFRAY_TRUTH_ARRAYS(TOFRAY_ADD)
#undef TOFRAY_ADD
  add("camera_matrix", {3, 3}, matrix_);
  add("distortion", {distortion_.size()}, distortion_);
  add("camera_pose", {4, 4}, pose_);
}

void frame_npz_bytes(const Frame& frame, const Camera& camera, const PoseMatrix& camera_pose, const std::string& meta,
                     const FrameFileOptions& options, std::string& file) {
  const FrameArrays arrays(frame, camera, camera_pose, options.arrays);
  std::vector<NpyView> views = arrays.views();
  // a 0-d string; numpy has no strings of length 0
  const std::string meta_bytes = utf32_of(meta.empty() ? "{}" : meta);
  for (const NamedArray& one : options.kept) {
    const ArrayRow* row = find_array(one.name);
    const bool wanted = row != nullptr ? options.arrays.has(*row) : options.arrays.is_all();
    const bool own =
        one.name == "meta" || std::any_of(views.begin(), views.end(), [&](const NpyView& view) { return view.name == one.name; });
    if (wanted && !own) views.push_back({one.name, one.array.type, one.array.shape, one.array.bytes});
  }
  views.push_back({"meta", {'U', static_cast<int>(meta_bytes.size())}, {}, meta_bytes});
  npz_bytes(views, options.packing, file);
}

std::string frame_npz_bytes(const Frame& frame, const Camera& camera, const PoseMatrix& camera_pose, const std::string& meta,
                            const FrameFileOptions& options) {
  std::string file;
  frame_npz_bytes(frame, camera, camera_pose, meta, options, file);
  return file;
}

std::vector<std::string> missing_arrays(const Frame& frame, const FrameFileOptions& options) {
  std::vector<std::string> missing = options.arrays.named();
  const auto there = [&](const std::string& wanted) {
#define TOFRAY_IS_THERE(name, part, member, ...) \
  if (wanted == #name && !frame.part.member.empty()) return true;
    TOFRAY_FRAME_ARRAYS(TOFRAY_IS_THERE)
#undef TOFRAY_IS_THERE
    const ArrayRow* row = find_array(wanted);
    return (row != nullptr && !row->is_image()) ||
           std::any_of(options.kept.begin(), options.kept.end(), [&](const NamedArray& one) { return one.name == wanted; });
  };
  std::erase_if(missing, there);
  return missing;
}

void write_frame_npz(const std::filesystem::path& path, const Frame& frame, const Camera& camera, const PoseMatrix& camera_pose,
                     const std::string& meta) {
  write_file_atomically(path, frame_npz_bytes(frame, camera, camera_pose, meta));
}

}  // namespace tofray::results

namespace tofray {

std::string frame_npz(const Frame& frame, const Scene& scene, const Camera& camera, const SimulatorOptions& options, bool compress) {
  results::FrameFileOptions how;
  how.packing = compress ? files::Packing::deflated : files::Packing::stored;
  return results::frame_npz_bytes(frame, camera, camera_pose(scene, frame.truth.time_s),
                                  results::frame_meta(scene, camera, options, frame.index), how);
}

}  // namespace tofray
