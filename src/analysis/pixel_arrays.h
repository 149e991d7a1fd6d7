// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstddef>
#include <string>

#include "camera/frozen_camera.h"
#include "tofray/pixel.h"

namespace tofray::analysis {

/// Where a pixel stands in an image. @param where  what messages call the arrays
/// @throws Error (bad_input) where it is outside
std::size_t pixel_index(const PixelArrays& arrays, int u, int v, const std::string& where = "the frame");

/// One pixel's chain by a camera that is frozen already.
/// @param camera  as it was frozen, before it is cut to what is read out
PixelChain chain_of(const PixelArrays& arrays, const Camera& camera, const camera::FrozenCamera& frozen, bool noise_free, int u, int v);

}  // namespace tofray::analysis
