// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstdint>

#include "tofray/analysis.h"

namespace tofray::analysis {

/// Which bit of the flags explains best why a pixel is invalid; for one that got nothing back is also weak and noisy.
NoDepth reason_by_flags(std::uint16_t flags);

}  // namespace tofray::analysis
