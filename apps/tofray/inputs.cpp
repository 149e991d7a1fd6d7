// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include "inputs.h"

#include <fmt/format.h>

#include <algorithm>

#include "base/text.h"
#include "io/builtin.h"
#include "io/convert.h"
#include "io/load.h"
#include "io/text_file.h"
#include "profile_tables.h"
#include "tofray/error.h"

namespace tofray::app {

namespace {

bool is_builtin_source(const std::string& source) { return source.starts_with("<"); }

/// The camera that the scene asks for, out of the texts of its profile and of the profile's tables.
Camera camera_of_texts(const Scene& scene, const io::InputFile& profile, const std::vector<io::InputFile>& files, const std::string& mode) {
  CameraOptions wanted;
  wanted.mode = mode.empty() ? scene.camera.mode : mode;
  return io::camera_from_text(profile_with_tables(profile, scene.camera.overrides, files), profile.name, "", wanted);
}

}  // namespace

Inputs load_inputs(const std::string& scene, const Options& options) {
  Inputs in;
  if (io::find_builtin(io::builtin_scenes(), scene) != nullptr) {
    in.scene = io::load_scene(scene, options.set);
    in.files.push_back({"scene", scene, {}});
  } else {
    // Read once, so that a pipe is good, too, and the manifest holds what was simulated.
    const std::string text = io::read_named("scene", scene, io::builtin_scenes());
    in.scene = io::scene_from_text(text, scene, options.set);
    in.files.push_back({"scene", scene, text});
  }
  in.camera = load_camera(in.scene, {options.mode, {}, options.root});
  if (is_builtin_source(in.camera.source)) return in;
  in.files.push_back({"profile", in.camera.source, io::read_text(in.camera.source)});
  const auto tables = profile_tables(in.files.back(), io::folder_of(in.camera.source), in.scene.camera.overrides);
  in.files.insert(in.files.end(), tables.begin(), tables.end());
  return in;
}

Inputs inputs_of(const io::Manifest& manifest, const Options& options) {
  if (manifest.inputs.empty() || manifest.inputs[0].role != "scene")
    throw Error(ErrorKind::bad_input, options.from + ": error: inputs has no scene\n  expected the manifest.json of a `tofray render`");
  const io::InputFile& first = manifest.inputs[0];
  // A stranger's manifest reads no files of ours: what is not in it has to be built in.
  if (first.text.empty() && io::find_builtin(io::builtin_scenes(), first.name) == nullptr)
    throw Error(ErrorKind::bad_input, fmt::format("{}: error: it does not hold the text of the scene {}\n  expected the scene's file in it, or the "
                                                  "name of a built-in one",
                                                  base::printable(options.from), base::in_quotes(first.name)));
  Inputs in;
  in.files = manifest.inputs;
  in.scene = first.text.empty() ? io::load_scene(first.name, options.set) : io::scene_from_text(first.text, first.name, options.set);
  const auto profile = std::find_if(in.files.begin(), in.files.end(), [](const io::InputFile& file) { return file.role == "profile"; });
  const std::string& named = in.scene.camera.profile;
  if (profile == in.files.end() && io::find_builtin(io::builtin_profiles(), named) == nullptr)
    throw Error(ErrorKind::bad_input, fmt::format("{}: error: it does not hold the text of the camera profile {}\n  expected the profile's file in it, "
                                                  "or the name of a built-in one",
                                                  base::printable(options.from), base::in_quotes(named)));
  in.camera = profile == in.files.end() ? load_camera(in.scene, {options.mode, {}, {}})
                                        : camera_of_texts(in.scene, *profile, in.files, options.mode);
  return in;
}

std::string warnings(const Scene& scene, const Camera& camera) {
  std::string text;
  if (scene.objects.empty()) text += "warning: the scene has no objects\n  no pixel gets any light back, and every depth is invalid\n";
  return text + warnings(camera);
}

std::string warnings(const Camera& camera) {
  const auto& lights = camera.illumination;
  const auto& sequence = camera.mode.sequence;
  std::string text;
  if (lights.empty())
    text += "warning: the camera has no light source\n  every depth is invalid\n";
  else if (std::none_of(lights.begin(), lights.end(), [](const Illumination& one) { return one.power_w > 0; }))
    text += "warning: the camera's light sources have no power\n  every depth is invalid\n";
  if (std::none_of(sequence.begin(), sequence.end(), [](const RawFrame& one) { return one.lit; }))
    text += fmt::format("warning: the mode {} has no lit raw frame\n  every depth is invalid\n", camera.mode.name);
  return text;
}

SimulatorOptions simulator_options(const Options& options) {
  SimulatorOptions out;
  out.seed = options.seed.value_or(0);
  out.noise = options.noise.value_or(Noise::exact);
  out.threads = options.threads;
  out.backend = options.backend.value_or(Backend::automatic);
  out.device = options.device;
  return out;
}

}  // namespace tofray::app
