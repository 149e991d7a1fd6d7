// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <string>

#include "files/json.h"
#include "tofray/pixel.h"

namespace tofray::view {

/// Where a pixel is asked for.
struct PixelInState {
  const std::string& name;  ///< of the scene
  const Scene& scene;
  const Camera& camera;
  const SimulatorOptions& simulated;
  const Frame& frame;     ///< with all arrays
  const Frame& expected;  ///< taps without noise, of direct light
};

/// The answer for a pixel of a frame that lies in a file: what there is of it. @param camera  that made its raw frames; null: the report is empty, and flow,
/// phasors and curve are left out  @param name  of the file
void put_pixel(files::Json& json, const Frame& frame, const Camera* camera, const std::string& name, int u, int v);

/// Adds what a `pixel` message has: report, values, why, flow, phasors, curve.
/// @throws Error (bad_input) where the pixel is outside the image
void put_pixel(files::Json& json, const PixelInState& in, int u, int v);

}  // namespace tofray::view
