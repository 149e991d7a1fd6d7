// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <span>

#include "gltf/model.h"

namespace tofray::gltf {

/// Sets `values` (as many as the channel's width) to what the channel says at a time; rotations are of unit length.
void evaluate(const Channel& channel, double time_s, std::span<double> values);

}  // namespace tofray::gltf
