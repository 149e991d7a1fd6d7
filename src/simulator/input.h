// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "pipeline/enter.h"
#include "tofray/camera.h"
#include "tofray/frame.h"
#include "tofray/stages.h"

namespace tofray::simulator {

/// Where the arrays of one's own are, once all of them are seen to be good.
/// @throws Error (bad_input) naming the first array or value that is not
pipeline::Input input_of(const Geometry& seen, const Camera& camera);
pipeline::Input input_of(const PixelLight& light, const Camera& camera);
/// The same of raw data; process() has looked at them.
pipeline::Input input_of(const Raw& raw);

}  // namespace tofray::simulator
