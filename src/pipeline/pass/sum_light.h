// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "pipeline/gather.h"
#include "pipeline/pass/pass.h"

namespace tofray::pipeline {

/// Direct and indirect light of the image, together.                                                [theory: light-image]
struct SumLight {
  static constexpr const char* name = "sum_light";
  static constexpr const char* does = "direct and bounced light together";
  static constexpr Over over = Over::tiles;
  static constexpr int most_threads = most_block_threads;

  template <class F>
  TOFRAY_INLINE static void pixels(const PassWork& w, const Pixels& p) {
    sum_light<F>(w.s, w.job.light, p);
  }
};

}  // namespace tofray::pipeline
