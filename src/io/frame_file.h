// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <array>
#include <filesystem>
#include <string>

#include "io/npz.h"
#include "tofray/camera.h"
#include "tofray/frame.h"

/// frame.npz: every array of a frame. Raw data are read back by raw_file.h.
namespace tofray::io {

/// Camera to world, [4][4] row-major, last row 0 0 0 1.
using PoseMatrix = std::array<double, 16>;

/// The bytes of frame.npz: raw data, depth, ground truth (where the frame has it), camera and `meta`, a JSON string (see meta.h).
/// The same arguments give the same bytes.
/// @param kept  further arrays, before `meta`; one whose name the frame's own arrays have is left out
std::string frame_npz_bytes(const Frame& frame, const Camera& camera, const PoseMatrix& camera_pose, const std::string& meta,
                            const std::vector<NamedArray>& kept = {});

/// Writes them, complete or not at all. @throws Error (io)
void write_frame_npz(const std::filesystem::path& path, const Frame& frame, const Camera& camera, const PoseMatrix& camera_pose,
                     const std::string& meta);

}  // namespace tofray::io
