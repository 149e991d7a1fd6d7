// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "depth/filters.h"
#include "pipeline/pass/pass.h"

namespace tofray::pipeline {

/// One pixel by the filter that is on.
TOFRAY_INLINE depth::Filtered filtered(const depth::RangeImage& image, const Job& job, int x, int y) {
  switch (job.filter) {
    case FilterKind::gaussian: return depth::gaussian(image, x, y, job.filter_radius, job.filter_weights);
    case FilterKind::median: return depth::median(image, x, y, job.filter_radius);
    case FilterKind::bilateral:
      return depth::bilateral(image, x, y, job.filter_radius, job.filter_weights, {job.filter_factor, job.filter_range});
    case FilterKind::adaptive: return depth::adaptive(image, x, y, job.filter_radius, job.filter_factor, job.filter_goal);
    case FilterKind::none: break;
  }
  return {image.range[y * image.width + x], image.noise[y * image.width + x]};
}

/// Where a filter is on: filtered range of one pixel and its noise, from `out` to `scratch`. Invalid pixels stay as they are, flying ones
/// among them where they are known already.
TOFRAY_INLINE void filter_pixel(const Setup& s, const Job& job, int x, int y) {
  const depth::RangeImage image{job.out.range_m, job.out.noise_m, job.out.flags, s.lens.width, s.lens.height};
  const int at = y * image.width + x;
  depth::Filtered value{image.range[at], image.noise[at]};
  if (image.valid(x, y)) value = filtered(image, job, x, y);
  job.scratch[at] = value.range, job.scratch[at + image.width * image.height] = value.noise;
}

/// The image filter that is on.
struct RangeFilter {
  static constexpr const char* name = "range_filter";
  static constexpr const char* does = "the image filter";
  static constexpr Over over = Over::rows;
  static constexpr int most_threads = most_block_threads;

  template <class F>
  TOFRAY_INLINE static void pixels(const PassWork& w, const Pixels& p) {
    for (int at = p.index; at < p.index + p.count; ++at) filter_pixel(w.s, w.job, at % w.s.lens.width, at / w.s.lens.width);
  }
};

}  // namespace tofray::pipeline
