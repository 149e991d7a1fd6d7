// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <string>

#include "tofray/frame.h"

namespace tofray::results {

/// cloud.ply: binary little endian, one vertex per valid pixel in the order of the rows: x y z [m] float in the camera's frame,
/// amplitude [e] float, confidence uchar.
std::string cloud_ply(const Depth& depth);

}  // namespace tofray::results
