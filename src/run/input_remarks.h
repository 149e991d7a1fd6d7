// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <string>
#include <vector>

#include "tofray/run.h"

/// What is odd about inputs that can be simulated all the same. Each remark names the key and its value, or the file.
namespace tofray::run {

/// A scene without objects.
std::vector<Remark> object_remarks(const Scene& scene);
/// What the files of its meshes have and is not used, or is guessed.
std::vector<Remark> mesh_remarks(const Scene& scene);
/// Keys of light paths where no light bounces.
/// @throws Error (bad_input) where such a key is set on purpose
std::vector<Remark> transport_remarks(const Scene& scene, const InputRequest& request);
/// A lit exposure that is longer than the mode's own.
/// @param mode_integration_time_s  the mode's longest where camera.integration_time sets another; else 0
std::vector<Remark> exposure_remarks(const Camera& camera, double mode_integration_time_s);
/// A camera without light source, power, or lit raw frame.
/// @param before  what stands before the camera's keys: "camera." or nothing
std::vector<Remark> camera_remarks(const Camera& camera, const std::string& before);

/// Longest lit exposure.
double longest_lit(const Camera& camera);

}  // namespace tofray::run
