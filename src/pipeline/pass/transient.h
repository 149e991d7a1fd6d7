// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "pipeline/pass/pass.h"
#include "pipeline/transient.h"

namespace tofray::pipeline {

/// Histograms of light by the length of its path.                                                      [theory: transient]
struct TransientHistogram {
  static constexpr const char* name = "transient";
  static constexpr const char* does = "histograms of light by path length";
  static constexpr Over over = Over::tiles;
  static constexpr int most_threads = heavy_block_threads;

  TOFRAY_INLINE static std::int64_t rays(const Setup& s, int) {
    return 1 + std::int64_t{paths_after(s, s.bounces.rounds - 1)} * s.bounces.most;
  }
  template <class F>
  TOFRAY_INLINE static void pixels(const PassWork& w, const Pixels& p) {
    find_transient<F>(w.s, w.job, p);
  }
};

}  // namespace tofray::pipeline
