// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <string>
#include <utility>
#include <vector>

#include "run/inputs.h"

/// Files of raw frames, or of light by path length, that are processed further.
namespace tofray::run {

/// A file, and what it says of its camera.
struct Recording {
  std::string path, bytes;
  std::string meta;  ///< empty where it has none
};
/// @throws Error (io, bad_input)
Recording read_recording(const std::string& path);

/// Which camera made it.
struct RecordingCamera {
  std::string name;  ///< of a profile; empty: the one that the file itself describes
  std::string mode;  ///< of the profile
  std::vector<std::pair<std::string, std::string>> set;
};

/// Its camera, and the arrays that processing does not make, which are written again as they are.
/// @param role  of the file, for the manifest
/// @throws Error (bad_input) where the camera that made it is not known
Loaded load_recording(const Recording& from, const char* role, const RecordingCamera& camera);

/// Its raw frames. @param noise  becomes Noise::off where they are expected values
Frame recorded_frame(const Recording& from, const Camera& camera, Noise& noise);

/// What the file knows of the truth: z, for the error map of preview.png; range and object, which say which depths are whole cycles off.
/// The whole ground truth is among the arrays that are kept.
Truth truth_of(const std::vector<files::NamedArray>& arrays, const Depth& depth);

}  // namespace tofray::run
