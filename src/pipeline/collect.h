// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "pipeline/light_up.h"
#include "pipeline/store.h"
#include "raw/expose.h"

/// Stage 3: from light to raw frames.
namespace tofray::pipeline {

/// What a pack of pixels keeps from one moment to the next.
template <class F>
struct PackState {
  flow::Light<F> light;
  bool undisturbed;       ///< `light` is that of what stands still, nothing that moves came between
  flow::Place<F> before;  ///< where shadow rays end then
  effect::Exposure<F> exposure;
  F difference[flow::max_raw_frames];  ///< A−B of each raw frame [e⁻]
};

/// Before the first moment, or before each one where nothing is kept from one to the next.
template <class F>
TOFRAY_INLINE void begin(const Setup& s, const Job& job, const Pixels& p, PackState<F>& pack) {
  pack.exposure = raw::start<F>(s.sensor, p, line_normals_in(s, job)), pack.undisturbed = false;
}

/// Raw frames as they would be without noise, before the ADC rounds.
/// @param first, last  of them, without the last
template <class F>
TOFRAY_NOINLINE void store_levels(const Setup& s, float* to, const Pixels& p, int first, int last, const flow::Light<F>& light,
                                  const effect::Exposure<F>& exposure) {
  for (int k = first; k < last; ++k) {
    num::store(to + p.index + k * s.lens.width * s.lens.height, raw::level_without_noise(s.sensor, k, light, s.phasors.orders, exposure),
               p.count);
  }
}

/// Stage 3 for the raw frames of one moment: A−B as depth takes it.
/// @param next    pixels that come after these
/// \tparam plain  as of raw::expose
template <bool plain, class F>
TOFRAY_INLINE void collect(const Setup& s, const Job& job, const Pixels& p, const Pixels& next, const Moment& now,
                           const flow::Light<F>& light, PackState<F>& pack) {
  const effect::FrameIndex index{job.index_low, job.index_high};
  for (int k = now.first; k < now.last; ++k) {
    const flow::Taps<F> taps = raw::expose<plain>(s.sensor, k, light, s.phasors.orders, index, pack.exposure);
    fetch_taps<F>(s.lens.width * s.lens.height, job.out, next, k, job.tap_stores);
    store_taps(s.lens.width * s.lens.height, job.out, p, k, taps, job.tap_stores);
    pack.difference[k] = taps.difference;
  }
}
template <class F>
TOFRAY_INLINE void collect(const Setup& s, const Job& job, const Pixels& p, const Pixels& next, const Moment& now,
                           const flow::Light<F>& light, PackState<F>& pack) {
  if (s.sensor.effects != 0) {
    collect<false>(s, job, p, next, now, light, pack);
  } else {
    collect<true>(s, job, p, next, now, light, pack);
  }
  if (job.out.gt_raw_dn != nullptr) store_levels<F>(s, job.out.gt_raw_dn, p, now.first, now.last, light, pack.exposure);
  if (job.out.gt_signal_e == nullptr) return;
  for (int k = now.first; k < now.last; ++k) {
    const F signal = s.sensor.frame[k].lit != 0 ? light.signal_rate * F(s.sensor.frame[k].integration_time) : F(0.0f);
    num::store(job.out.gt_signal_e + p.index + k * s.lens.width * s.lens.height, signal, p.count);
  }
}
/// Stage 3, not inlined: for sources that are not inlined.
template <class F>
TOFRAY_NOINLINE void collect_noinline(const Setup& s, const Job& job, const Pixels& p, const Pixels& next, const Moment& now,
                                      const flow::Light<F>& light, PackState<F>& pack) {
  collect(s, job, p, next, now, light, pack);
}

/// Charge above full well, for the pass Blooming, which looks at neighbours.
template <class F>
TOFRAY_INLINE void store_overflow(const Setup& s, const Job& job, const Pixels& p, const effect::Exposure<F>& exposure) {
  if (s.sensor.blooms != 0) num::store(overflow_in(s, job) + p.index, exposure.overflow, p.count);
}

}  // namespace tofray::pipeline
