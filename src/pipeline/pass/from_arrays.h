// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "pipeline/external_input.h"
#include "pipeline/pass/pass.h"

namespace tofray::pipeline {

/// From what came from elsewhere, or is in the light image, to depth.
struct FromArrays {
  static constexpr const char* name = "from_arrays";
  static constexpr const char* does = "given arrays, or the light image, to raw frames and depth";
  static constexpr Over over = Over::tiles;
  static constexpr int most_threads = heavy_block_threads;

  template <class F>
  TOFRAY_INLINE static void pixels(const PassWork& w, const Pixels& p) {
    enter<F>(w.s, w.job, *w.input, p, w.next);
  }
};

}  // namespace tofray::pipeline
