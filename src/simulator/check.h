// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <span>
#include <string>

#include "tofray/camera.h"
#include "tofray/scene.h"
#include "tofray/simulator.h"

/// What the readers check of files, for scenes and cameras built in code: every number that is used is finite and within its range.
/// Behind these checks no arithmetic meets NaN or infinity from outside.
namespace tofray::simulator {

/// @throws Error (bad_input; limit for counts) naming the member
void check(const Camera& camera);
void check(const Scene& scene);
void check(const Pose& pose, const std::string& path = "camera.pose");
void check(std::span<const FrameRequest> requests);
void check(const SimulatorOptions& options);

}  // namespace tofray::simulator
