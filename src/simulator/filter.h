// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "pipeline/setup.h"
#include "tofray/camera.h"

namespace tofray::simulator {

/// The decoder's image filter as the passes want it.
/// Its numbers were checked: see check.h.
void set_filter(const ImageFilter& filter, pipeline::Job& job);
/// How many values `Job::filtered` has room for.
std::size_t filter_scratch(const pipeline::Job& job, const pipeline::Setup& setup);

}  // namespace tofray::simulator
