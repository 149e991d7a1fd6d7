// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <string>
#include <vector>

#include "io/manifest.h"
#include "options.h"
#include "tofray/camera.h"
#include "tofray/scene.h"

namespace tofray::app {

/// What a simulation starts from.
struct Inputs {
  Scene scene;
  Camera camera;
  std::vector<io::InputFile> files;  ///< for manifest.json: the scene, a profile of one's own and its tables
};

/// Reads the scene (a file or a built-in name) with --set, and the camera that it asks for with --mode and --root.
/// @throws Error
Inputs load_inputs(const std::string& scene, const Options& options);

/// The same from the texts that a manifest keeps; no file is read.
/// @throws Error
Inputs inputs_of(const io::Manifest& manifest, const Options& options);

/// What is wrong with a scene that can be simulated all the same: no objects, no light. One or two lines each, or nothing.
std::string warnings(const Scene& scene, const Camera& camera);
/// … and with a camera alone: no light source, no lit raw frame.
std::string warnings(const Camera& camera);

SimulatorOptions simulator_options(const Options& options);

}  // namespace tofray::app
