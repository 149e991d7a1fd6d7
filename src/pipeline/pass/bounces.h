// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "pipeline/bounce.h"
#include "pipeline/pass/pass.h"

namespace tofray::pipeline {

/// Light from surface to surface, into the light image.                                                 [theory: bounces]
struct Bounces {
  static constexpr const char* name = "bounces";
  static constexpr const char* does = "light from surface to surface";
  static constexpr Over over = Over::tiles;
  static constexpr int most_threads = heavy_block_threads;

  TOFRAY_INLINE static std::int64_t rays(const Setup& s, int item) {
    return 1 + 2 * std::int64_t{paths_of_step(s, item).count} * s.bounces.most;
  }
  template <class F>
  TOFRAY_INLINE static void pixels(const PassWork& w, const Pixels& p) {
    bounce_pixels<F>(w.s, w.job, w.item, p);
  }
};

}  // namespace tofray::pipeline
