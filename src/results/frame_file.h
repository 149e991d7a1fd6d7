// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <array>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "files/npz.h"
#include "results/array_table.h"
#include "tofray/camera.h"
#include "tofray/frame.h"

/// frame.npz: every array of a frame. Raw data are read back by raw_file.h.
namespace tofray::results {

/// Camera to world, [4][4] row-major, last row 0 0 0 1.
using PoseMatrix = std::array<double, 16>;

struct FrameFileOptions {
  ArrayChoice arrays;
  files::Packing packing = files::Packing::stored;
  /// Further arrays, before `meta`: those of the table where they are chosen and the frame has none, others where all are.
  std::span<const files::NamedArray> kept = {};
};

/// Views of a frame's arrays that are there and wanted, and of the few numbers of the camera that go with them, in the table's order. Empty arrays (ground truth that was
/// not asked for) are left out.
class FrameArrays {
 public:
  /// @param frame  has to live as long as this
  FrameArrays(const Frame& frame, const Camera& camera, const PoseMatrix& camera_pose, const ArrayChoice& choice);
  FrameArrays(const FrameArrays&) = delete;
  FrameArrays& operator=(const FrameArrays&) = delete;
  [[nodiscard]] const std::vector<files::NpyView>& views() const { return views_; }

 private:
  std::vector<double> time_, matrix_, distortion_, pose_;
  std::vector<files::NpyView> views_;
};

/// The bytes of frame.npz: raw data, depth, ground truth (where the frame has it), camera and `meta`, a JSON string (see meta.h).
/// Equal arguments give equal bytes.
std::string frame_npz_bytes(const Frame& frame, const Camera& camera, const PoseMatrix& camera_pose, const std::string& meta,
                            const FrameFileOptions& options = {});
/// The bytes of frame.npz, into memory that is used again.
void frame_npz_bytes(const Frame& frame, const Camera& camera, const PoseMatrix& camera_pose, const std::string& meta,
                     const FrameFileOptions& options, std::string& file);

/// Arrays that were asked for by name and that are neither the frame's nor kept.
std::vector<std::string> missing_arrays(const Frame& frame, const FrameFileOptions& options);

/// Writes them, complete or not at all. @throws Error (io)
void write_frame_npz(const std::filesystem::path& path, const Frame& frame, const Camera& camera, const PoseMatrix& camera_pose,
                     const std::string& meta);

}  // namespace tofray::results
