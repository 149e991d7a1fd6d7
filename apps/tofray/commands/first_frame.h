// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "run/inputs.h"
#include "tofray/frame.h"

namespace tofray::app {

/// Frame 0 of a scene, with progress as it is computed.
Frame first_frame(const run::Loaded& in, SimulatorOptions wanted);

}  // namespace tofray::app
