// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "pipeline/pass/pass.h"

namespace tofray::pipeline {

/// From rays to depth, or as far as a plan's part goes: run.h, by the tiles of a processor (tile.h) or the warps of a GPU
/// (backend/cuda/pixel.h), which look at the scene together.
struct FromRays {
  static constexpr const char* name = "from_rays";
  static constexpr const char* does = "rays to light, raw frames and depth";
  static constexpr Over over = Over::tiles;
  static constexpr int most_threads = most_block_threads;
};

}  // namespace tofray::pipeline
