// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include "cli/requests.h"

namespace tofray::app {

InputRequest input_request(const std::string& scene, const Options& options) {
  return {scene, options.set, options.mode, options.root, {}};
}

SimulatorOptions simulator_options(const Options& options) {
  SimulatorOptions out;
  out.seed = options.seed.value_or(0);
  out.noise = options.noise.value_or(Noise::exact);
  out.exposure_samples = options.exposure_samples.value_or(1);
  out.subpixel = options.subpixel.value_or(1);
  out.threads = options.threads;
  out.backend = options.backend.value_or(Backend::automatic);
  out.device = options.device;
  return out;
}

RunRequest run_request(const std::string& scene, const Options& options) {
  RunRequest out;
  if (options.from.empty()) {
    out.inputs = input_request(scene, options);
    out.simulator = simulator_options(options);
    out.frames = options.frames, out.first_frame = options.first_frame;
    out.files = {options.emit,  options.arrays,   options.compress,        options.theme == pictures::Theme::light,
                 options.scale, options.messages, options.mcap_compression};
  } else {
    out = request_of_manifest(options.from);
    out.inputs.root = options.root;
    const SimulatorOptions here = simulator_options(options);
    out.simulator.threads = here.threads, out.simulator.backend = here.backend, out.simulator.device = here.device;
  }
  out.folder = options.output, out.clean = options.clean;
  out.command = options.typed;
  return out;
}

std::vector<std::pair<std::string, std::string>> camera_settings(const Options& options) {
  auto settings = options.set;
  for (auto& [key, value] : settings)
    if (key.starts_with("camera.")) key.erase(0, 7);
  return settings;
}

}  // namespace tofray::app
