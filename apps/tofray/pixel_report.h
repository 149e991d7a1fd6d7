// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <string>

#include "pixel_bounces.h"

namespace tofray::app {

/// A report on one pixel, for people or as JSON: surface, light, every raw frame, what bounced, phases, depth.
/// @param bounces  of this pixel
/// @throws Error (bad_input) where the pixel is outside the image
std::string pixel_text(const Arrays& arrays, const PixelBounces& bounces, int u, int v);
files::Json pixel_json(const Arrays& arrays, const PixelBounces& bounces, int u, int v);

}  // namespace tofray::app
