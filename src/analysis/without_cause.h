// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <optional>
#include <string_view>
#include <vector>

#include "tofray/simulator.h"

/// A frame's inputs with one cause of error off.
namespace tofray::analysis {

/// What a frame is simulated from.
struct FrameInputs {
  Scene scene;
  Camera camera;
  SimulatorOptions options;
};

/// Causes that can be switched off by what goes in.
const std::vector<std::string_view>& causes_of_inputs();
/// A frame's inputs with a cause switched off; nothing where they do not have the cause.
/// @param time_s  of the truth, where what moves stands still
std::optional<FrameInputs> without(std::string_view cause, const FrameInputs& in, double time_s);

}  // namespace tofray::analysis
