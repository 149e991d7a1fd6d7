// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "camera/lens/ray.h"
#include "depth/confidence.h"
#include "pipeline/pass/pass.h"
#include "pipeline/store.h"

namespace tofray::pipeline {

/// Four flags at a time, since few pixels fly.
TOFRAY_INLINE bool any_flying(const std::uint16_t* flags, int count) {
  std::uint64_t found = 0;
  int i = 0;
  for (; i + 4 <= count; i += 4) {
    std::uint64_t four;
    std::memcpy(&four, flags + i, sizeof four);
    found |= four;
  }
  for (; i < count; ++i) found |= flags[i];
  return (found & 0x0001000100010001u * depth::flying_pixel) != 0;
}

/// The flags that a filter leaves: of what is too noisy still, and of a range that is no longer the pixel's own.
TOFRAY_INLINE std::int32_t flags_of_filter(const Setup& s, const Job& job, std::int32_t at, float range, float noise) {
  if (noise > s.decoder.filtered_noise_threshold) return depth::low_signal;
  return range < job.out.range_m[at] || range > job.out.range_m[at] ? depth::filtered : 0;
}
TOFRAY_INLINE std::int32_t filter_flags_at(const Setup& s, const Job& job, std::int32_t at) {
  return flags_of_filter(s, job, at, job.scratch[at], job.scratch[at + s.lens.width * s.lens.height]);
}

/// Range of some pixels → z, point, confidence; flying pixels become invalid.
/// @param item  of_filter: the range that the filter left, and its noise; else that of `out`, which goes where pixels fly
template <class F>
TOFRAY_INLINE void write_depth(const Setup& s, const Job& job, const Pixels& p, std::int32_t item) {
  if (item != of_filter && !any_flying(job.out.flags + p.index, p.count)) return;
  std::int32_t flags[num::lanes<F>] = {};
  for (int i = 0; i < p.count; ++i) {
    flags[i] = job.out.flags[p.index + i];
    if (item == of_filter) flags[i] |= filter_flags_at(s, job, p.index + i);
  }
  const float* const range = item == of_filter ? job.scratch : job.out.range_m;
  const float* const noise_of = item == of_filter ? job.scratch + s.lens.width * s.lens.height : job.out.noise_m;
  const F noise = num::load<F>(noise_of + p.index, p.count);
  num::Int<F> sure(0);
  if (item == of_filter) {
    sure = depth::confidence(s.decoder, noise, num::load<F>(trust_in(s, job) + p.index, p.count));
  } else if (job.out.confidence != nullptr) {
    std::int32_t before[num::lanes<F>] = {};
    for (int i = 0; i < p.count; ++i) before[i] = job.out.confidence[p.index + i];
    sure = num::load_int<F>(before, p.count);
  }
  store_range(job.out, p, camera::ray<F>(s.lens, p), num::load<F>(range + p.index, p.count), sure, num::load_int<F>(flags, p.count));
  if (item == of_filter) num::store(job.out.noise_m + p.index, noise, p.count);
}
/// The range that is left, to z, point and confidence.
struct WriteDepth {
  static constexpr const char* name = "write_depth";
  static constexpr const char* does = "range to z, points and confidence";
  static constexpr Over over = Over::rows;
  static constexpr int most_threads = most_block_threads;

  template <class F>
  TOFRAY_INLINE static void pixels(const PassWork& w, const Pixels& p) {
    write_depth<F>(w.s, w.job, p, w.item);
  }
};

}  // namespace tofray::pipeline
