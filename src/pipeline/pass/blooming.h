// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "camera/lens/ray.h"
#include "pipeline/pass/pass.h"
#include "pipeline/store.h"

namespace tofray::pipeline {

/// A pixel that gets more than the limit of what its neighbours' wells cannot hold is flagged as saturated.  [theory: blooming]
TOFRAY_INLINE void bloom_pixel(const Setup& s, const Job& job, int x, int y) {
  const int width = s.lens.width, at = y * width + x;
  const float* const over = overflow_in(s, job);
  float spilled = 0;
  if (x > 0) spilled = spilled + over[at - 1];
  if (x + 1 < width) spilled = spilled + over[at + 1];
  if (y > 0) spilled = spilled + over[at - width];
  if (y + 1 < s.lens.height) spilled = spilled + over[at + width];
  if (!effect::Blooming::flags(s.sensor, spilled)) return;
  const Pixels p{at, 1};
  const std::int32_t flags = job.out.flags[at] | depth::saturated;
  store_range<float>(job.out, p, camera::ray<float>(s.lens, p), 0.0f, 0, flags);
}

/// Flags of pixels into which full wells spill.
struct Blooming {
  static constexpr const char* name = "blooming";
  static constexpr const char* does = "flags of pixels into which full wells spill";
  static constexpr Over over = Over::rows;
  static constexpr int most_threads = most_block_threads;
  static constexpr When when = When::after_pixels;

  static bool wanted(const Setup& s, const Job&, Stage entry) { return s.sensor.blooms != 0 && entry != Stage::depth; }

  template <class F>
  TOFRAY_INLINE static void pixels(const PassWork& w, const Pixels& p) {
    for (int at = p.index; at < p.index + p.count; ++at) bloom_pixel(w.s, w.job, at % w.s.lens.width, at / w.s.lens.width);
  }
};

}  // namespace tofray::pipeline
