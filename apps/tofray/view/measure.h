// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "files/json.h"
#include "tofray/frame.h"
#include "tofray/scene.h"
#include "view/control.h"

namespace tofray::view {

/// Adds what a `measure` message has: a, b, measured_m, true_m, sigma_m.
///
/// The measured points are the frame's, along their rays r̂; their noise is along these, so that the distance's is
///
///     σ² = (ê·r̂_a)²·σ_a² + (ê·r̂_b)²·σ_b²,   ê from the one to the other
///
/// @throws Error (bad_input) where a pixel is outside the image
void put_measure(files::Json& json, const Frame& frame, const Scene& scene, const Measure& measure);

}  // namespace tofray::view
