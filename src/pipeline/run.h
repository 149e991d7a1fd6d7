// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "camera/lens/ray.h"
#include "pipeline/collect.h"
#include "pipeline/find_depth.h"
#include "pipeline/gather.h"

/// The order in which a pixel's stages are computed:
///
///     ray → nearest surface → light that reaches it → raw frames → depth
///
/// or, where a pixel's light is a sum, up to the light image and on from there: which passes a frame takes is plan.h.
///
/// It is the same for scenes that stand still and scenes that move, for a tile of pixels and for one, on every machine, and for who enters
/// later with arrays of their own. What differs is a `Source`, which knows which pixels there are and finds their light:
///
///     moments()                     times at which the scene is looked at: 1, or as many for each raw frame
///     once()                        whether light of one moment for all is kept for the first of the raw frames to which it is alike
///     go_to(now)                    what can be seen, and what can throw a shadow, at one of them
///     packs(), pixels(q)            the pixels, in packs that are computed at once
///     ahead(q)                      those that come after pack q, whose memory may be fetched meanwhile; count 0: none
///     pack(q)                       what a pack keeps from one moment to the next
///     blurs, mean(q)                whether an exposure may see the scene at several times, and where the mean of their light is kept
///     inlined                   whether stages 3 and 4 are to be a part of the source's own code, as fast as can be, or shared with others
///     find_light(now, q, …)         stages 1 and 2 for one pack; false: the light of the moment before is still good
namespace tofray::pipeline {

/// Some pixels, and how the camera looks at them.
template <class F>
struct View {
  Pixels p;
  flow::Ray<F> ray;
  F vignetting;
};

/// Whether the light of a moment is asked for: without raw frames, that of the ground truth alone.
TOFRAY_INLINE bool is_wanted(const Setup& s, const Job& job, const Moment& now) {
  return s.last_stage >= Stage::raw || now.truth || job.out.gt_phase_flow_px != nullptr;
}

/// Whether the light of a raw frame is the mean of several moments', of which this is one.
template <class Source>
TOFRAY_INLINE bool is_averaged(const Moment& now) {
  return Source::blurs && now.samples > 1;
}

/// Stages 1 and 2, the pixels' own delay, and the mean over an exposure.
/// @return whether raw frames are asked for, and their light is complete
template <class F, class Source>
TOFRAY_INLINE bool find_light(const Setup& s, const Job& job, Source& source, const Moment& now, int q, const View<F>& view,
                              PackState<F>& pack) {
  const bool anew = source.find_light(now, q, view.p, view.ray, view.vignetting, pack);
  if (now.truth && job.gather.middle != nullptr)
    compare_sample<F>(s, job.light, job.gather.middle, view.p, job.gather.share, job.gather.first != 0);
  if (s.last_stage < Stage::raw) return false;
  if (anew && s.sensor.delay != nullptr && job.gather.on == 0)
    power::delay_by(s.phasors, wanted(s, now, pack.undisturbed), s.sensor, view.p, pack.light);
  if (!is_averaged<Source>(now)) return true;
  // Light that is the same at all times is a mean of itself, which rounding leaves a last bit beside it.
  const int end = now.whole ? now.samples : now.sample + 1;
  for (int i = now.sample; i < end; ++i) power::blend(s.phasors, wanted(s, now, false), pack.light, i, now.samples, source.mean(q));
  return end == now.samples;
}

/// What a sample within the pixels adds to the light image: at one time, or where something moves at all of them at once.
/// \tparam blurs  as of the source
template <bool blurs, class F>
TOFRAY_INLINE void gather(const Setup& s, const Job& job, const Moment& now, bool once, const Pixels& p, const Pixels& next,
                          const flow::Light<F>& light) {
  const Growing image{job.light.before, job.light.values};
  const Adding<F> how{job.gather.share, job.gather.first != 0, 1.0f, F(0.0f) < F(1.0f), next.count > 0 ? next.index - p.index : 0};
  if (blurs && now.whole && job.light.times > 1) {
    gather_all_times<F>(s, image, p, job.light.times, light, how, once);
  } else {
    gather_light<F>(s, image, p, job.light.times, now.whole ? 0 : now.first, light, how);
  }
}

/// Stages 3 and 4: raw frames of the moment, and depth after the last of them.
template <class F, class Source>
TOFRAY_INLINE void expose(const Setup& s, const Job& job, Source& source, const Moment& now, int q, const View<F>& view,
                          const flow::Light<F>& light, PackState<F>& pack) {
  const Pixels next = source.ahead(q);
  if constexpr (Source::inlined) {
    collect(s, job, view.p, next, now, light, pack);
  } else {
    collect_noinline(s, job, view.p, next, now, light, pack);
  }
  if (now.last < s.sensor.raw_frames || s.last_stage < Stage::depth) return;
  fetch_depth<F>(job.out, next);
  store_overflow(s, job, view.p, pack.exposure);
  const num::Mask<F> clipped = raw::saturated(s.sensor, pack.exposure);
  if constexpr (Source::inlined) {
    find_depth<F>(s, job, view.p, view.ray, pack.difference, clipped, view.vignetting);
  } else {
    find_depth_noinline<F>(s, job, view.p, view.ray, pack.difference, clipped, view.vignetting);
  }
}

/// From rays to depth.
template <class F, class Source>
TOFRAY_INLINE void run_pipeline(const Setup& s, const Job& job, Source& source) {
  const int moments = source.moments();
  for (int moment = 0; moment < moments; ++moment) {
    const Moment now = moment_of(s, moment, moments, Source::blurs);
    if (!is_wanted(s, job, now)) continue;
    source.go_to(now);
    for (int q = 0; q < source.packs(); ++q) {
      const Pixels p = source.pixels(q);
      if (p.count == 0) continue;
      PackState<F>& pack = source.pack(q);
      const View<F> view{p, camera::ray<F>(s.lens, p), camera::vignetting<F>(s.lens, p)};
      if (moment == 0 || s.last_stage < Stage::raw) begin(s, job, p, pack);
      if (!find_light(s, job, source, now, q, view, pack)) continue;  // stages 1 and 2
      const flow::Light<F>& light = is_averaged<Source>(now) ? source.mean(q) : pack.light;
      if (job.gather.on != 0) {
        gather<Source::blurs, F>(s, job, now, source.once(), p, moment == 0 ? source.ahead(q) : Pixels{0, 0}, light);
      } else {
        expose(s, job, source, now, q, view, light, pack);  // stages 3 and 4
      }
    }
  }
}

}  // namespace tofray::pipeline
