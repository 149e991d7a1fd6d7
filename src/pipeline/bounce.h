// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "camera/lens/ray.h"
#include "pipeline/gather.h"
#include "pipeline/neighbor_similarity.h"
#include "pipeline/path_queue.h"
#include "pipeline/rounds.h"

/// Light that goes from surface to surface before it reaches the camera, into the light image.        [theory: bounces]
namespace tofray::pipeline {

/// Paths whose light is summed before it is added to that of others: a sum of some thousand floats would lose digits.
constexpr int paths_together = 64;

/// The light of a step's paths of each pixel: of both halves and many at once where there are lanes to fill, else path by path.
/// @param halves  what the light of either half is added to
template <class F>
TOFRAY_INLINE void follow(const Setup& s, int moment, F area, const power::Wanted& wanted, const Pixels& p, const Vertex<F>& first,
                          F vignetting, const PathsOfStep& paths, flow::Light<F>* halves) {
  const auto together = [&](int from) TOFRAY_LAMBDA { return paths.count - from < paths_together ? paths.count - from : paths_together; };
  if constexpr (num::lanes<F> != 1) {
    const int at_once = PathLights<F>::rows(s, wanted) / 2;
    if (at_once > 0) {
      for (int from = 0; from < paths.count; from += paths_together) {
        flow::Light<F> part[2];
        power::clear(s.phasors, wanted, part[0]), power::clear(s.phasors, wanted, part[1]);
        const int end = from + together(from);
        for (int i = from; i < end; i += at_once) {
          const int these = end - i < at_once ? end - i : at_once;
          follow_paths<F>(s, moment, area, wanted, p, first, vignetting, paths.first + i, these, part);
        }
        for (int h = 0; h < 2; ++h) power::add_light(s.phasors, wanted, part[h], halves[h]);
      }
      return;
    }
  }
  // One half after the other: of sums of both side by side, which it tries to pair, nvcc 13 takes ten minutes and 5 GB for compute capability 12.
  for (int h = 0; h < 2; ++h)
    for (int from = 0; from < paths.count; from += paths_together) {
      flow::Light<F> part;
      power::clear(s.phasors, wanted, part);
      const int end = from + together(from);
      for (int i = from; i < end; ++i) follow_path<F>(s, moment, area, wanted, p, first, vignetting, h, paths.first + i, part);
      power::add_light(s.phasors, wanted, part, halves[h]);
    }
}

/// The lens of a sample within the pixels, or that of their middle.
TOFRAY_INLINE const camera::LensView& lens_of(const Setup& s, int item) {
  return s.subpixel.lens != nullptr ? s.subpixel.lens[item] : s.lens;
}

/// The light of a step's paths, at all times, into the light image.
/// @param item  which step
template <class F>
TOFRAY_INLINE void bounce_pixels(const Setup& s, const Job& job, int item, const Pixels& p) {
  const flow::LightImage& image = job.light;
  const PathsOfStep paths = paths_of_step(s, item);
  const num::Mask<F> active = takes_part<F>(s, image, paths.round, p);
  const Growing whole{image.indirect_before, image.indirect};
  const std::int64_t behind = light_values(s, image.times);
  const Growing apart{whole.before == nullptr ? nullptr : whole.before + behind, whole.values + behind};
  const camera::LensView& lens = lens_of(s, paths.sample);
  const flow::Ray<F> ray = camera::ray<F>(lens, p);
  const F per = ray.inverse_length, area = F(lens.pixel_area) * per * per * per;
  const F vignetting = num::select(active, camera::vignetting<F>(lens, p), F(0.0f));  // what is known well enough sees nothing more
  const int moments = s.scene.moments > 0 ? s.scene.moments : 1, per_time = moments / image.times;
  const float share =
      (s.subpixel.lens != nullptr ? s.subpixel.share[paths.sample] : 1.0f) / (static_cast<float>(paths.all) * static_cast<float>(per_time));
  for (int time = 0; time < image.times; ++time) {
    const Moment now = moment_of(s, time * per_time, moments, false);
    const power::Wanted which = wanted(s, now, false);
    flow::Light<F> half[2];
    power::clear(s.phasors, which, half[0]), power::clear(s.phasors, which, half[1]);
    for (int m = 0; m < per_time; ++m) {
      const int moment = time * per_time + m;
      const Vertex<F> first = first_vertex<F>(s, moment, ray, area, vignetting);
      if (image.guide != nullptr && item == s.subpixel.count / 2 && time == image.times / 2 && m == 0)
        store_guide<F>(s, image, p, first.at);
      if (!num::any(first.at.found)) continue;
      follow<F>(s, moment, area, which, p, first, vignetting, paths, half);
    }
    power::sum_and_difference(s.phasors, which, half[0], half[1]);
    const Adding<F> how{share, item == 0, paths.kept, active};
    gather_light<F>(s, whole, p, image.times, time, half[0], how);
    if (image.halves != 0) gather_light<F>(s, apart, p, image.times, time, half[1], how);
  }
}

}  // namespace tofray::pipeline
