// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "pipeline/pass/pass.h"
#include "pipeline/path_noise.h"

namespace tofray::pipeline {

/// The standard error of a pixel's light, by its own error and its neighbours', and who needs more paths.  [theory: path-noise]
struct PathNoise {
  static constexpr const char* name = "path_noise";
  static constexpr const char* does = "standard error of bounced light, and who needs more paths";
  static constexpr Over over = Over::tiles;
  static constexpr int most_threads = most_block_threads;

  template <class F>
  TOFRAY_INLINE static void pixels(const PassWork& w, const Pixels& p) {
    store_path_noise<F>(w.s, w.job.light, w.item, p);
  }
};

}  // namespace tofray::pipeline
