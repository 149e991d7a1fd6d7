// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "camera/lens/ray.h"
#include "depth/confidence.h"
#include "depth/decode.h"
#include "pipeline/store.h"

/// Stage 4: from raw frames to depth.
namespace tofray::pipeline {

/// Pixels that are computed for the light and charge that come from them alone.
template <class F>
TOFRAY_INLINE num::Mask<F> beside_region(const Setup& s, const Pixels& p) {
  using Int = num::Int<F>;
  const Region& r = s.region;
  if (r.width == 0) return F(1.0f) < F(0.0f);
  const int y = p.index / s.lens.width;
  if (y < r.top || y >= r.top + r.height) return F(0.0f) < F(1.0f);
  const Int x = Int(p.index % s.lens.width) + num::lane_index<F>();
  return (Int(r.left) > x) | (x > Int(r.left + r.width - 1));
}

/// Whether values by modulation frequency are wanted.
TOFRAY_INLINE bool wants_frequencies(const flow::FrameView& out) {
  return out.amplitude_by_frequency_e != nullptr || out.range_by_frequency_m != nullptr || out.cycle_by_frequency != nullptr;
}
/// Stores it.
template <class F>
TOFRAY_NOINLINE void store_frequencies(const Setup& s, const flow::FrameView& out, const Pixels& p, const flow::Ray<F>& ray,
                                       const F* difference) {
  depth::OfFrequency<F> found[flow::max_modulation_frequencies];
  depth::each_frequency(s.decoder, difference, ray, p, found);
  for (int i = 0; i < s.decoder.modulations; ++i) {
    const Pixels at{p.index + i * s.lens.width * s.lens.height, p.count};
    store(out.amplitude_by_frequency_e, at, found[i].amplitude);
    store(out.range_by_frequency_m, at, num::select(found[i].known, found[i].range, nan<F>()));
    if (out.cycle_by_frequency == nullptr) continue;
    num::store(out.cycle_by_frequency + at.index, num::select(found[i].known, found[i].cycle, num::Int<F>(-1)), p.count);
  }
}

/// Stage 4.
template <class F>
TOFRAY_INLINE void find_depth(const Setup& s, const Job& job, const Pixels& p, const flow::Ray<F>& ray, const F* difference,
                              num::Mask<F> clipped, F vignetting) {
  const auto outside = (!(vignetting > F(0.0f))) | beside_region<F>(s, p);
  const flow::Depth<F> found = depth::decode<F>(s.decoder, difference, clipped, outside, ray, p);
  store(job.out.amplitude_e, p, found.amplitude);
  store(job.out.ambient_e, p, found.ambient);
  store_range(job.out, p, ray, found.range, depth::confidence(s.decoder, found.noise, found.trust), found.flags);
  if (job.filter != FilterKind::none) num::store(trust_in(s, job) + p.index, found.trust, p.count);
  if (wants_frequencies(job.out)) store_frequencies<F>(s, job.out, p, ray, difference);
  store(job.out.noise_m, p, num::select((found.flags & num::Int<F>(depth::no_return)) == num::Int<F>(0), found.noise, nan<F>()));
}

/// Stage 4, not inlined: for sources that are not inlined, and for recordings.
template <class F>
TOFRAY_NOINLINE void find_depth_noinline(const Setup& s, const Job& job, const Pixels& p, const flow::Ray<F>& ray, const F* difference,
                                         const num::Mask<F>& clipped, const F& vignetting) {
  find_depth<F>(s, job, p, ray, difference, clipped, vignetting);
}

}  // namespace tofray::pipeline
