// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "camera/readout/image_camera.h"
#include "tofray/camera.h"
#include "tofray/scene.h"
#include "tofray/simulator.h"

namespace tofray::pipeline {
struct Setup;
}

/// What the readers check of files, for what a program hands in.
namespace tofray::simulator {

/// @throws Error (bad_input; limit for counts) naming the member
void check(const Camera& camera);
void check(const Scene& scene);
void check(const SimulatorOptions& options);
/// Checks that what is derived of things that move fits into memory.
/// @param camera  rings and areas of light taken apart
void check_moving_views(const Scene& scene, const Camera& camera, const SimulatorOptions& options);
/// Checks that the triangles of meshes that change their shape are within their limit.
void check_changing_triangles(const Scene& scene, const Camera& camera, const SimulatorOptions& options);
/// Checks that the light image, and the rays of samples within pixels, are within their limits.
void check_light_image(const Scene& scene, const camera::ImageCamera& camera, const SimulatorOptions& options);
/// Checks that the histograms of light by path length are within their limit.
void check_transient(const Scene& scene, const camera::ImageCamera& camera);
/// Checks that light of all sources may stand in one histogram: as pixels see it, they have one waveform.
void check_one_waveform(const pipeline::Setup& setup);

}  // namespace tofray::simulator
