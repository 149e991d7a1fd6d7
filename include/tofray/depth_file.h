// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <array>
#include <optional>
#include <string>
#include <vector>

#include "tofray/frame.h"

/// Images of depth out of files, of this simulator and of others. As load.h, of libtofray_files.
namespace tofray {

/// What a file does not say of itself.
struct DepthFileOptions {
  double unit_m = 0;  ///< length of a file's 1; 0: 1 mm of a picture, 1 m of others
  /// fx, fy, cx, cy in pixels of a lens without distortion, for points of an image of z alone; none: what the file says, if anything.
  std::optional<std::array<double, 4>> intrinsics = {};
};

/// What one file holds. Arrays that it does not have are empty.
struct DepthFile {
  std::string file;
  Depth depth;
  Truth truth;
};

/// Reads .npz (tofray's arrays: z_m and others, gt_z_m and others; one of the two is enough), .npy and .csv (a matrix of z; nan, 0 or
/// nothing: invalid), and .png (grey, 16 bits; 0: invalid). Points follow from z by a camera_matrix in the file without distortion, or
/// by the options. Not read: point clouds (.ply, .pcd), whose points have no pixels, and recordings of robots (.bag, .mcap).
/// @throws Error (io, bad_input, limit) by file, with the way out
DepthFile load_depth(const std::string& file, const DepthFileOptions& options = {});

/// Depth of each frame of a folder: its .npz files, or where it has none its .npy, .png or .csv files, in the order of their names.
/// A file alone is a list of one.
/// @throws Error as load_depth(); (bad_input) for a folder without any, with what lies there instead
std::vector<DepthFile> load_depths(const std::string& file_or_folder, const DepthFileOptions& options = {});

}  // namespace tofray
