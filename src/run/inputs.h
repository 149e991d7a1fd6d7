// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <optional>
#include <string>
#include <vector>

#include "files/npz.h"
#include "results/frame_file.h"
#include "results/manifest.h"
#include "tofray/run.h"

namespace tofray::run {

/// Inputs, and what a run has to know of where they come from.
struct Loaded : Inputs {
  bool told_size = false;  ///< among the remarks: that a mesh alone is too large or too small for the camera
  // of a recording
  std::vector<files::NamedArray> kept;      ///< arrays that are written again as they are
  std::optional<results::PoseMatrix> pose;  ///< otherwise the scene says it
};

/// As load_inputs().
Loaded load(const InputRequest& request);

/// Inputs out of the texts that a manifest keeps, with what the request sets. Only meshes and keyframes are read, if they have the
/// manifest's SHA-256.
/// @throws Error
Loaded load_of_manifest(const results::Manifest& manifest, const InputRequest& request);

/// What a report of the scene finds, but for what the remarks say of a mesh alone and of a scene without objects.
/// @param notes  whether what may well be meant is told, too
std::vector<Remark> findings_of(const SceneReport& report, bool told_size, bool notes);

}  // namespace tofray::run
