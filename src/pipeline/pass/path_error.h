// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "pipeline/pass/pass.h"
#include "pipeline/path_noise.h"

namespace tofray::pipeline {

/// How far the two halves of a pixel's paths are apart.                                               [theory: path-noise]
struct PathError {
  static constexpr const char* name = "path_error";
  static constexpr const char* does = "difference of the two halves of a pixel's paths";
  static constexpr Over over = Over::tiles;
  static constexpr int most_threads = most_block_threads;

  template <class F>
  TOFRAY_INLINE static void pixels(const PassWork& w, const Pixels& p) {
    store_path_error<F>(w.s, w.job.light, w.item, p);
  }
};

}  // namespace tofray::pipeline
