// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "pipeline/setup.h"
#include "tofray/camera.h"

namespace tofray::simulator {

/// The decoder's image filter as the passes want it.
/// Its numbers were checked: see check.h.
void set_filter(const ImageFilter& filter, pipeline::Job& job);

}  // namespace tofray::simulator
