// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <string>

#include "files/json.h"
#include "results/file_arrays.h"
#include "tofray/pixel.h"

namespace tofray::app {

/// A report on one pixel of a file, for people or as JSON: surface, light, every raw frame, what bounced, phases, depth.
std::string pixel_text(const results::Arrays& arrays, const PixelChain& chain, const PixelBounces& bounces);
/// @param file  what the report calls the frame
/// @param meta  as of its file
files::Json pixel_json(const std::string& file, const files::Json& meta, const PixelChain& chain, const PixelBounces& bounces);

}  // namespace tofray::app
