// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "pipeline/setup.h"
#include "tofray/camera.h"

namespace tofray::simulator {

/// The decoder's image filter as the passes want it.
/// @throws Error (bad_input) for a width that makes no sense
void set_filter(const ImageFilter& filter, pipeline::Job& job);

}  // namespace tofray::simulator
