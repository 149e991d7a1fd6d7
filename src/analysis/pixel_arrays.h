// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstddef>
#include <string>

#include "tofray/pixel.h"

namespace tofray::analysis {

/// Where a pixel stands in an image. @param where  what messages call the arrays
/// @throws Error (bad_input) where it is outside
std::size_t pixel_index(const PixelArrays& arrays, int u, int v, const std::string& where = "the frame");

}  // namespace tofray::analysis
