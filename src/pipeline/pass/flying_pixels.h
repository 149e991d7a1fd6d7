// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "depth/passes.h"
#include "pipeline/pass/pass.h"
#include "pipeline/store.h"

namespace tofray::pipeline {

/// Flags a flying pixel; z and noise are only read.
TOFRAY_INLINE void flag_flying_pixel(const Setup& s, const Job& job, int x, int y) {
  const int width = s.lens.width, at = y * width + x;
  if (!depth::flies<float>(s.decoder, {job.out.z_m + at, job.out.noise_m + at, width}, 1, y > 0 && y + 1 < s.lens.height,
                           x > 0 && x + 1 < width))
    return;
  job.out.flags[at] = static_cast<std::uint16_t>(job.out.flags[at] | depth::flying_pixel);
}

/// Flags the flying pixels of a row.
template <class F>
TOFRAY_INLINE void flag_flying_row(const Setup& s, const Job& job, int y) {
  const int width = s.lens.width;
  const bool has_rows = y > 0 && y + 1 < s.lens.height;
  const float *z = job.out.z_m + y * width, *noise = job.out.noise_m + y * width;
  std::uint16_t* flags = job.out.flags + y * width;
  flag_flying_pixel(s, job, 0, y);
  if (width > 1) flag_flying_pixel(s, job, width - 1, y);
  for (int x = 1; x < width - 1; x += num::lanes<F>) {
    const int count = width - 1 - x < num::lanes<F> ? width - 1 - x : num::lanes<F>;
    const std::uint32_t first = 0xffffffffu >> (32 - count);
    const auto flying = depth::flies<F>(s.decoder, {z + x, noise + x, width}, count, has_rows, true);
    for (std::uint32_t marks = num::lanes_of(flying) & first; marks != 0; marks &= marks - 1) {  // from one that flies to the next
      std::uint16_t& flag = flags[x + __builtin_ctz(marks)];
      flag = static_cast<std::uint16_t>(flag | depth::flying_pixel);
    }
  }
}

/// Flags of flying pixels.                                                                    [theory: flying-pixel-limit]
struct FlyingPixels {
  static constexpr const char* name = "flying_pixels";
  static constexpr const char* does = "flags of flying pixels";
  static constexpr Over over = Over::rows;
  static constexpr int most_threads = most_block_threads;
  static constexpr When when = When::over_depth;

  static bool wanted(const Setup& s, const Job&, Stage) { return s.decoder.flying_check != 0; }

  template <class F>
  TOFRAY_INLINE static void pixels(const PassWork& w, const Pixels& p) {
    flag_flying_pixel(w.s, w.job, p.index % w.s.lens.width, p.index / w.s.lens.width);
  }
  template <class F>
  TOFRAY_INLINE static void row(const PassWork& w, int y) {
    flag_flying_row<F>(w.s, w.job, y);
  }
};

}  // namespace tofray::pipeline
