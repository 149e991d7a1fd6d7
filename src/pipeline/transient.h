// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "pipeline/bounce.h"

/// Light by the length of its path, as a histogram for each pixel.                                       [theory: transient]
///
/// A pass of its own, which frames without histograms do not have. It goes the ways that the light of stages 1 and 2 goes, by the same
/// functions: to what each pixel sees, straight from the lights, and from surface to surface with the same random numbers.
namespace tofray::pipeline {

/// The histograms of a pack of pixels.
struct Histograms {
  TransientView view;
  float* values;  ///< [bin][height][width], or null
  float* lost;    ///< [height][width] light of paths that no bin is for, or null
  std::int64_t pixels;
  Pixels p;
};

template <class F>
TOFRAY_INLINE void clear(const Histograms& to) {
  for (int k = 0; k < to.view.bins && to.values != nullptr; ++k) num::store(to.values + k * to.pixels + to.p.index, F(0.0f), to.p.count);
  if (to.lost != nullptr) num::store(to.lost + to.p.index, F(0.0f), to.p.count);
}

/// Adds light of rate S and length ℓ: with x = (ℓ − first)/width and k = ⌊x + ½⌋, the share x + ½ − k of it goes to bin k and the rest to
/// bin k − 1; what the first or the last one would share with a bin that is not there, it keeps.
template <class F>
TOFRAY_INLINE void add_light(const Histograms& to, F rate, F length) {
  if (!num::any(rate > F(0.0f))) return;
  const F x = (length - F(to.view.first)) * F(to.view.per_metre), bins = F(static_cast<float>(to.view.bins));
  const auto inside = (x >= F(0.0f)) & (x < bins);
  if (to.lost != nullptr) {
    const F lost = num::load<F>(to.lost + to.p.index, to.p.count);
    num::store(to.lost + to.p.index, lost + num::select(inside, F(0.0f), rate), to.p.count);
  }
  if (to.values == nullptr) return;
  const F edge = num::select(inside, x + F(0.5f), F(0.0f)), upper = num::floor(edge);
  const F far_part = rate * (edge - upper), near_part = rate - far_part;
  const num::Int<F> last = num::to_int(num::min(upper, bins - F(1.0f))), first = num::to_int(num::max(upper - F(1.0f), F(0.0f)));
  constexpr int lanes = num::lanes<F>;
  float there[lanes], near_of[lanes], far_of[lanes];
  std::int32_t first_of[lanes], last_of[lanes];
  num::store(there, num::select(inside, rate, F(0.0f)), to.p.count);
  num::store(near_of, near_part, to.p.count), num::store(far_of, far_part, to.p.count);
  num::store(first_of, first, to.p.count), num::store(last_of, last, to.p.count);
  for (int i = 0; i < to.p.count; ++i) {
    if (!(there[i] > 0)) continue;
    float* const pixel = to.values + to.p.index + i;
    pixel[first_of[i] * to.pixels] += near_of[i];
    pixel[last_of[i] * to.pixels] += far_of[i];
  }
}

/// Light that comes straight back from what the pixels see.
template <class F>
TOFRAY_INLINE void add_direct(const Setup& s, const camera::LensView& lens, int moment, float share, const Histograms& to) {
  const flow::Ray<F> ray = camera::ray<F>(lens, to.p);
  const F vignetting = camera::vignetting<F>(lens, to.p);
  flow::Hit<F> hit = trace::nearest(trace::Uncut{s.scene.camera_still()}, ray, flow::no_hit<F>());
  if (s.scene.moments > 0) hit = trace::nearest(trace::Uncut{s.scene.camera_moving(moment)}, ray, hit);
  const flow::Surface<F> surface = surface_seen(s, lens, ray, hit, vignetting);
  each_light<F>(s, moment, surface, ray, surface.range, vignetting,
                [&](int, const flow::Path<F>& path) TOFRAY_LAMBDA { add_light<F>(to, path.rate * F(share), path.length); });
}

/// Light that has met several surfaces, by as many paths as the light image has.
/// @param sample  which one within the pixels
template <class F>
TOFRAY_INLINE void add_bounced(const Setup& s, const flow::LightImage& image, const camera::LensView& lens, int moment, int sample,
                               float share, const Histograms& to) {
  const flow::Ray<F> ray = camera::ray<F>(lens, to.p);
  const F vignetting = camera::vignetting<F>(lens, to.p), per = ray.inverse_length, area = F(lens.pixel_area) * per * per * per;
  Vertex<F> first = first_vertex<F>(s, moment, ray, area, vignetting);
  const num::Mask<F> found = first.at.found;
  const int rounds = image.goal != nullptr ? s.bounces.rounds : 1;
  const F each = F(share * static_cast<float>(s.subpixel.count)) / num::to_float(paths_known<F>(s, image, rounds - 1, to.p));
  const auto meet = [&](int, const Vertex<F>& v, F weight) TOFRAY_LAMBDA {
    each_light<F>(s, moment, v.at, ray_to(v), v.step, weight,
                  [&](int, const flow::Path<F>& path) TOFRAY_LAMBDA { add_light<F>(to, path.rate * each, path.length); });
  };
  for (int round = 0; round < rounds; ++round) {
    const PathsOfStep paths = paths_of_step(s, round * s.subpixel.count + sample);
    first.at.found = found & takes_part<F>(s, image, round, to.p);
    if (!num::any(first.at.found)) return;
    for (int i = 0; i < 2 * paths.count; ++i)
      each_vertex<F>(s, moment, area, to.p, first, vignetting, i % 2, paths.first + i / 2, s.bounces.most, meet);
  }
}

/// The histograms of a pack, of the light at the time of the ground truth.
template <class F>
TOFRAY_INLINE void find_transient(const Setup& s, const Job& job, const Pixels& p) {
  const Histograms to{s.transient, job.out.transient_e_per_s, job.out.transient_lost_e_per_s, std::int64_t{s.lens.width} * s.lens.height,
                      p};
  const int moment = truth_moment(s);
  clear<F>(to);
  for (int item = 0; item < s.subpixel.count; ++item) {
    const camera::LensView& lens = lens_of(s, item);
    const float share = s.subpixel.lens != nullptr ? s.subpixel.share[item] : 1.0f;
    add_direct<F>(s, lens, moment, share, to);
    if (s.bounces.most > 0) add_bounced<F>(s, job.light, lens, moment, item, share, to);
  }
}

}  // namespace tofray::pipeline
