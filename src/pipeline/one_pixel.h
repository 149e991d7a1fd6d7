// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "camera/ray.h"
#include "pipeline/gather.h"
#include "pipeline/light_up.h"
#include "pipeline/store.h"
#include "raw/expose.h"

/// The pipeline, and the only place that knows its order:
///
///     ray → nearest surface → light that reaches it → raw frames → depth
///
/// or, where a pixel's light is a sum, up to the light image and on from there (steps.h).
///
/// It is the same for scenes that stand still and scenes that move, for a tile of pixels and for one, on every machine, and for who enters
/// later with arrays of their own. What differs is a `Walk`, which knows which pixels there are and finds their light:
///
///     moments()                     times at which the scene is looked at: 1, or as many for each raw frame
///     go_to(now)                    what can be seen, and what can throw a shadow, at one of them
///     packs(), pixels(q)            the pixels, in packs that are computed at once
///     ahead(q)                      those that come after pack q, whose memory may be fetched meanwhile; count 0: none
///     pack(q)                       what a pack keeps from one moment to the next
///     blurs, mean(q)                whether an exposure may see the scene at several times, and where the mean of their light is kept
///     written_out                   whether stages 3 and 4 are to be a part of the walk's own code, as fast as can be, or shared with others
///     find_light(now, q, …)         stages 1 and 2 for one pack; false: the light of the moment before is still good
namespace tofray::pipeline {

/// What a pack of pixels keeps from one moment to the next.
template <class F>
struct Pack {
  flow::Light<F> light;
  bool undisturbed;  ///< `light` is that of what stands still, nothing that moves came between
  raw::Exposure<F> exposure;
  F difference[flow::max_raw_frames];  ///< A−B of each raw frame [e⁻]
};

/// Raw frames as they would be without noise, before the ADC rounds.
/// @param first, last  of them, without the last
template <class F>
TOFRAY_APART void store_levels(const Setup& s, float* to, const Pixels& p, int first, int last, const flow::Light<F>& light,
                               const raw::Exposure<F>& exposure) {
  for (int k = first; k < last; ++k) {
    num::store(to + p.index + k * s.lens.width * s.lens.height, raw::level_without_noise(s.sensor, k, light, s.phasors.orders, exposure),
               p.count);
  }
}

/// Stage 3 for the raw frames of one moment: A−B as depth takes it.
/// @param next    pixels that come after these
/// \tparam plain  as of raw::expose
template <bool plain, class F>
TOFRAY_FN void collect(const Setup& s, const Job& job, const Pixels& p, const Pixels& next, const Moment& now, const flow::Light<F>& light,
                       Pack<F>& pack) {
  const raw::FrameIndex index{job.index_low, job.index_high};
  for (int k = now.first; k < now.last; ++k) {
    const flow::Taps<F> taps = raw::expose<plain>(s.sensor, k, light, s.phasors.orders, index, pack.exposure);
    fetch_taps<F>(s.lens.width * s.lens.height, job.out, next, k, job.tap_stores);
    store_taps(s.lens.width * s.lens.height, job.out, p, k, taps, job.tap_stores);
    pack.difference[k] = taps.difference;
  }
}
template <class F>
TOFRAY_FN void collect(const Setup& s, const Job& job, const Pixels& p, const Pixels& next, const Moment& now, const flow::Light<F>& light,
                       Pack<F>& pack) {
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
/// … compiled once, for walks that are not written out.
template <class F>
TOFRAY_APART void collect_once(const Setup& s, const Job& job, const Pixels& p, const Pixels& next, const Moment& now,
                               const flow::Light<F>& light, Pack<F>& pack) {
  collect(s, job, p, next, now, light, pack);
}

/// For the pass `bloom`, which looks at neighbours.
template <class F>
TOFRAY_FN void store_overflow(const Setup& s, const Job& job, const Pixels& p, const raw::Exposure<F>& exposure) {
  if (s.sensor.blooms != 0) num::store(overflow_in(s, job) + p.index, exposure.overflow, p.count);
}

/// Pixels that are computed for the light and charge that come from them alone.
template <class F>
TOFRAY_FN num::Mask<F> beside_region(const Setup& s, const Pixels& p) {
  using Int = num::Int<F>;
  const Region& r = s.region;
  if (r.width == 0) return F(1.0f) < F(0.0f);
  const int y = p.index / s.lens.width;
  if (y < r.top || y >= r.top + r.height) return F(0.0f) < F(1.0f);
  const Int x = Int(p.index % s.lens.width) + num::lane_index<F>();
  return (Int(r.left) > x) | (x > Int(r.left + r.width - 1));
}

/// Whether anybody wants to know what each modulation frequency says.
TOFRAY_FN bool wants_frequencies(const flow::FrameView& out) {
  return out.amplitude_by_frequency_e != nullptr || out.range_by_frequency_m != nullptr || out.cycle_by_frequency != nullptr;
}
/// Stores it.
template <class F>
TOFRAY_APART void store_frequencies(const Setup& s, const flow::FrameView& out, const Pixels& p, const flow::Ray<F>& ray,
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
TOFRAY_FN void find_depth(const Setup& s, const Job& job, const Pixels& p, const flow::Ray<F>& ray, const F* difference,
                          num::Mask<F> clipped, F vignetting) {
  const auto outside = (!(vignetting > F(0.0f))) | beside_region<F>(s, p);
  const flow::Depth<F> found = depth::decode<F>(s.decoder, difference, clipped, outside, ray, p);
  store(job.out.amplitude_e, p, found.amplitude);
  store(job.out.ambient_e, p, found.ambient);
  store_range(job.out, p, ray, found.range, confidence(s.decoder, found.noise, found.trust), found.flags);
  if (job.filter != Filter::none) num::store(trust_in(s, job) + p.index, found.trust, p.count);
  if (wants_frequencies(job.out)) store_frequencies<F>(s, job.out, p, ray, difference);
  store(job.out.noise_m, p, num::select((found.flags & num::Int<F>(depth::no_return)) == num::Int<F>(0), found.noise, nan<F>()));
}

/// … compiled once, for walks that are not written out, and for recordings.
template <class F>
TOFRAY_APART void find_depth_once(const Setup& s, const Job& job, const Pixels& p, const flow::Ray<F>& ray, const F* difference,
                                  const num::Mask<F>& clipped, const F& vignetting) {
  find_depth<F>(s, job, p, ray, difference, clipped, vignetting);
}

/// What a sample within the pixels adds to the light image, or all of them at once.
template <class F>
TOFRAY_FN void gather(const Setup& s, const Job& job, int time, const Pixels& p, const flow::Light<F>& light) {
  const num::Mask<F> every = F(0.0f) < F(1.0f);
  gather_light<F>(s, {job.light.before, job.light.values}, p, job.light.times, time, light,
                  {job.gather.share, job.gather.first != 0, 1.0f, every});
}

/// From rays to depth.
template <class F, class Walk>
TOFRAY_FN void run_pipeline(const Setup& s, const Job& job, Walk& walk) {
  const int moments = walk.moments();
  for (int moment = 0; moment < moments; ++moment) {
    const Moment now = moment_of(s, moment, moments);
    if (s.last_stage < Stage::raw && !now.truth && job.out.gt_phase_flow_px == nullptr) continue;
    const bool first = moment == 0 || s.last_stage < Stage::raw;  // nothing is kept from one moment to the next then
    walk.go_to(now);
    for (int q = 0; q < walk.packs(); ++q) {
      const Pixels p = walk.pixels(q);
      if (p.count == 0) continue;
      Pack<F>& pack = walk.pack(q);
      const flow::Ray<F> ray = camera::ray<F>(s.lens, p);
      const F vignetting = camera::vignetting<F>(s.lens, p);
      if (first) pack.exposure = raw::start<F>(s.sensor, p, line_normals_in(s, job)), pack.undisturbed = false;
      const bool anew = walk.find_light(now, q, p, ray, vignetting, pack);  // stages 1 and 2
      if (now.truth && job.gather.middle != nullptr)
        compare_sample<F>(s, job.light, job.gather.middle, p, job.gather.share, job.gather.first != 0);
      if (s.last_stage < Stage::raw) continue;
      if (anew && s.sensor.delay != nullptr && job.gather.on == 0)
        power::delay_by(s.phasors, wanted(s, now, pack.undisturbed), s.sensor, p, pack.light);
      const bool several = Walk::blurs && now.samples > 1;
      if (several) power::blend(s.phasors, wanted(s, now, false), pack.light, now.sample, now.samples, walk.mean(q));
      if (several && now.sample + 1 < now.samples) continue;
      const flow::Light<F>& light = several ? walk.mean(q) : pack.light;
      if (job.gather.on != 0) {
        gather<F>(s, job, moments == 1 ? 0 : now.first, p, light);
        continue;
      }
      const Pixels next = walk.ahead(q);
      if constexpr (Walk::written_out) {
        collect(s, job, p, next, now, light, pack);  // stage 3
      } else {
        collect_once(s, job, p, next, now, light, pack);
      }
      if (now.last < s.sensor.raw_frames || s.last_stage < Stage::depth) continue;
      fetch_depth<F>(job.out, next);
      store_overflow(s, job, p, pack.exposure);
      const num::Mask<F> clipped = raw::saturated(s.sensor, pack.exposure);
      if constexpr (Walk::written_out) {
        find_depth<F>(s, job, p, ray, pack.difference, clipped, vignetting);  // stage 4
      } else {
        find_depth_once<F>(s, job, p, ray, pack.difference, clipped, vignetting);
      }
    }
  }
}

}  // namespace tofray::pipeline
