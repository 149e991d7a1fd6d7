// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "files/json.h"
#include "tofray/frame.h"
#include "view/control.h"

namespace tofray::view {

/// Adds what a `region` message has: pixels, valid, and rows: the numbers of `tofray quality` of this frame, the median of noise_m, and
/// each flag's share.
/// @throws Error (bad_input) where the region is beyond the image
void put_region(files::Json& json, const Frame& frame, const RegionQuestion& region);

}  // namespace tofray::view
