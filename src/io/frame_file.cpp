// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include "io/frame_file.h"

#include <algorithm>

#include "io/array_table.h"
#include "io/atomic_file.h"
#include "io/npz.h"

namespace tofray::io {
namespace {

NpyShape extents(ArrayShape shape, int phases, int height, int width) {
  const auto k = static_cast<std::size_t>(phases), v = static_cast<std::size_t>(height), u = static_cast<std::size_t>(width);
  switch (shape) {
    case ArrayShape::image: return {v, u};
    case ArrayShape::vectors: return {v, u, 3};
    case ArrayShape::stack: return {k, v, u};
    case ArrayShape::list: return {k};
  }
  return {};
}

/// What a file has beside the frame's own arrays; it must live as long as the views.
struct Beside {
  std::vector<double> time, matrix, distortion, pose;

  Beside(const Frame& frame, const Lens& lens, const PoseMatrix& camera_pose)
      : time{frame.truth.time_s},
        matrix{lens.fx_px, 0, lens.cx_px, 0, lens.fy_px, lens.cy_px, 0, 0, 1},
        distortion{lens.k1, lens.k2, lens.p1, lens.p2, lens.k3},
        pose(camera_pose.begin(), camera_pose.end()) {}
};

/// Views of all arrays that are there, in the table's order. Empty ones (ground truth that was not asked for) are left out.
std::vector<NpyView> views_of(const Frame& frame, const Beside& beside) {
  std::vector<NpyView> views;
  const auto add = [&]<class T>(const char* name, const NpyShape& shape, const std::vector<T>& data) {
    if (!data.empty()) views.push_back(npy_view(name, shape, data, find_array(name)->type));
  };
#define TOFRAY_ADD(name, part, member, element, shape, ...) \
  add(#name, extents(ArrayShape::shape, frame.raw.phases, frame.part.height, frame.part.width), frame.part.member);
  TOFRAY_RAW_ARRAYS(TOFRAY_ADD)
  TOFRAY_EXPOSURE_ARRAYS(TOFRAY_ADD)
  TOFRAY_DEPTH_ARRAYS(TOFRAY_ADD)
  if (frame.truth.width > 0) add("gt_time_s", {}, beside.time);
  TOFRAY_TRUTH_ARRAYS(TOFRAY_ADD)
#undef TOFRAY_ADD
  add("camera_matrix", {3, 3}, beside.matrix);
  add("distortion", {5}, beside.distortion);
  add("camera_pose", {4, 4}, beside.pose);
  return views;
}

}  // namespace

std::string frame_npz_bytes(const Frame& frame, const Camera& camera, const PoseMatrix& camera_pose, const std::string& meta,
                            const std::vector<NamedArray>& kept) {
  const Beside beside(frame, camera.lens, camera_pose);
  std::vector<NpyView> views = views_of(frame, beside);
  // a 0-d string; numpy has no strings of length 0
  const std::string meta_bytes = utf32_of(meta.empty() ? "{}" : meta);
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
