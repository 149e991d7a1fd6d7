// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <array>
#include <filesystem>
#include <string>

#include "tofray/camera.h"
#include "tofray/frame.h"

/// frame.npz: every array of a frame, and raw data read back for `tofray process`.
namespace tofray::io {

/// Camera to world, [4][4] row-major, last row 0 0 0 1.
using PoseMatrix = std::array<double, 16>;

/// The bytes of frame.npz: raw data, depth, ground truth (where the frame has it), camera and `meta`, a JSON string (see meta.h).
/// The same arguments give the same bytes.
std::string frame_npz_bytes(const Frame& frame, const Camera& camera, const PoseMatrix& camera_pose, const std::string& meta);

/// Writes them, complete or not at all. @throws Error (io)
void write_frame_npz(const std::filesystem::path& path, const Frame& frame, const Camera& camera, const PoseMatrix& camera_pose,
                     const std::string& meta);

/// Reads raw data, simulated or measured: `raw`, or `tap_a` and `tap_b`, [phase, height, width], and `modulation_frequency_hz`,
/// `reference_phase_rad`, `integration_time_s`, `start_time_s`, `lit` [phase]. Whole numbers of any width are taken for `raw` where
/// they fit uint16, float32 and float64 for the taps.
/// @throws Error (bad_input) that names every array that is missing or misshapen; (io) where the file cannot be read
Raw read_raw_npz(const std::string& path);

}  // namespace tofray::io
