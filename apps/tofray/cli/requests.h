// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <string>
#include <utility>
#include <vector>

#include "cli/options.h"
#include "run/inputs.h"
#include "tofray/run.h"

/// What the user typed, as the library takes it.
namespace tofray::app {

/// @param scene  a file or a built-in name
InputRequest input_request(const std::string& scene, const Options& options);
SimulatorOptions simulator_options(const Options& options);
/// All of it; without --output the folder is left to the run.
/// @param scene  as above; empty with --from, whose manifest says it
RunRequest run_request(const std::string& scene, const Options& options);

/// --set where there is no scene: keys of the camera, with or without "camera." before them.
std::vector<std::pair<std::string, std::string>> camera_settings(const Options& options);

}  // namespace tofray::app
