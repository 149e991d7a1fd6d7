// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "files/npz.h"
#include "options.h"
#include "results/frame_file.h"
#include "results/manifest.h"
#include "tofray/analysis.h"
#include "tofray/camera.h"
#include "tofray/scene.h"

namespace tofray::app {

/// What a simulation starts from.
struct Inputs {
  Scene scene;
  Camera camera;
  std::vector<results::InputFile> files;    ///< for manifest.json: the scene, a profile of one's own and its tables
  std::vector<files::NamedArray> kept;      ///< of a recording: arrays that are written again as they are
  std::string mesh_alone;                   ///< warnings of a mesh's file that stands alone
  bool told_size = false;                   ///< among them that it is too large or too small for the camera
  std::string idle_transport;               ///< a warning where the scene's file asks for ways of light that nothing follows
  double mode_integration_time_s = 0;       ///< longest lit exposure of the mode itself where camera.integration_time sets another; else 0
  std::optional<results::PoseMatrix> pose;  ///< of a recording; otherwise the scene says it
};

/// Reads the scene (a file or a built-in name) with --set, and the camera that it asks for with --mode and --root.
/// @throws Error, also (bad_input) for --samples where no light bounces
Inputs load_inputs(const std::string& scene, const Options& options);

/// The same from the texts that a manifest keeps; no file is read.
/// @throws Error
Inputs inputs_of(const results::Manifest& manifest, const Options& options);

/// What is wrong with a scene that can be simulated all the same: no objects, no light, exposures longer than the mode's own, what a mesh's
/// file has and is not used, ways of light without bounces. One or two lines each, or nothing; each names the key and its value,
/// or the file.
std::string warnings(const Inputs& in);
/// What a report of the scene finds, but for what warnings() says of a mesh alone.
std::vector<SceneFinding> findings_of(SceneReport report, const Inputs& in);
/// … and with a camera alone: no light source, no lit raw frame.
/// @param before  what stands before the camera's keys: "camera." or nothing
std::string warnings(const Camera& camera, const std::string& before);

/// --set where there is no scene: keys of the camera, with or without "camera." before them.
std::vector<std::pair<std::string, std::string>> camera_settings(const Options& options);

SimulatorOptions simulator_options(const Options& options);

}  // namespace tofray::app
