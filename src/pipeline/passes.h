// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "camera/ray.h"
#include "depth/filters.h"
#include "depth/passes.h"
#include "pipeline/setup.h"
#include "pipeline/store.h"

/// The passes over whole images that follow the pixels: flying pixels, filters, and the range that is left.
namespace tofray::pipeline {

/// A pixel that gets more than the limit of what its neighbours' wells cannot hold is flagged as saturated.  [theory: eq. 3.32]
TOFRAY_FN void bloom_pixel(const Setup& s, const Job& job, int x, int y) {
  const int width = s.lens.width, at = y * width + x;
  const float* const over = overflow_in(s, job);
  float spilled = 0;
  if (x > 0) spilled = spilled + over[at - 1];
  if (x + 1 < width) spilled = spilled + over[at + 1];
  if (y > 0) spilled = spilled + over[at - width];
  if (y + 1 < s.lens.height) spilled = spilled + over[at + width];
  if (!(spilled * s.sensor.blooming_share > s.sensor.blooming_limit)) return;
  const Pixels p{at, 1};
  const std::int32_t flags = job.out.flags[at] | depth::saturated;
  store_range<float>(job.out, p, camera::ray<float>(s.lens, p), 0.0f, 0, flags);
}
TOFRAY_FN void bloom_row(const Setup& s, const Job& job, int y) {
  for (int x = 0; x < s.lens.width; ++x) bloom_pixel(s, job, x, y);
}

/// Pass 1: flags a flying pixel; z and noise are only read.
TOFRAY_FN void flag_flying_pixel(const Setup& s, const Job& job, int x, int y) {
  const int width = s.lens.width, at = y * width + x;
  if (!depth::flies<float>(s.decoder, {job.out.z_m + at, job.out.noise_m + at, width}, 1, y > 0 && y + 1 < s.lens.height,
                           x > 0 && x + 1 < width))
    return;
  job.out.flags[at] = static_cast<std::uint16_t>(job.out.flags[at] | depth::flying_pixel);
}

/// The same for one row.
template <class F>
TOFRAY_FN void flag_flying_row(const Setup& s, const Job& job, int y) {
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

/// One pixel by the filter that is on.
TOFRAY_FN depth::Filtered filtered(const depth::RangeImage& image, const Job& job, int x, int y) {
  switch (job.filter) {
    case Filter::gaussian: return depth::gaussian(image, x, y, job.filter_radius, job.filter_weights);
    case Filter::median: return depth::median(image, x, y, job.filter_radius);
    case Filter::bilateral:
      return depth::bilateral(image, x, y, job.filter_radius, job.filter_weights, {job.filter_factor, job.filter_range});
    case Filter::adaptive: return depth::adaptive(image, x, y, job.filter_radius, job.filter_factor, job.filter_goal);
    case Filter::none: break;
  }
  return {image.range[y * image.width + x], image.noise[y * image.width + x]};
}

/// Where a filter is on: filtered range of one pixel and its noise, from `out` to `scratch`. Invalid pixels stay as they are, flying ones
/// among them where they are known already.
TOFRAY_FN void filter_pixel(const Setup& s, const Job& job, int x, int y) {
  const depth::RangeImage image{job.out.range_m, job.out.noise_m, job.out.flags, s.lens.width, s.lens.height};
  const int at = y * image.width + x;
  depth::Filtered value{image.range[at], image.noise[at]};
  if (image.valid(x, y)) value = filtered(image, job, x, y);
  job.scratch[at] = value.range, job.scratch[at + image.width * image.height] = value.noise;
}
TOFRAY_FN void filter_row(const Setup& s, const Job& job, int y) {
  for (int x = 0; x < s.lens.width; ++x) filter_pixel(s, job, x, y);
}

/// Four flags at a time, since few pixels fly.
TOFRAY_FN bool any_flying(const std::uint16_t* flags, int count) {
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
TOFRAY_FN std::int32_t flags_of_filter(const Setup& s, const Job& job, std::int32_t at, float range, float noise) {
  if (noise > s.decoder.filtered_noise_threshold) return depth::low_signal;
  return range < job.out.range_m[at] || range > job.out.range_m[at] ? depth::filtered : 0;
}
TOFRAY_FN std::int32_t filter_flags_at(const Setup& s, const Job& job, std::int32_t at) {
  return flags_of_filter(s, job, at, job.scratch[at], job.scratch[at + s.lens.width * s.lens.height]);
}

/// Range of some pixels → z, point, confidence; flying pixels become invalid.
/// @param item  of_filter: the range that the filter left, and its noise; else that of `out`, which goes where pixels fly
template <class F>
TOFRAY_FN void settle(const Setup& s, const Job& job, const Pixels& p, std::int32_t item) {
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
    sure = confidence(s.decoder, noise, num::load<F>(trust_in(s, job) + p.index, p.count));
  } else if (job.out.confidence != nullptr) {
    std::int32_t before[num::lanes<F>] = {};
    for (int i = 0; i < p.count; ++i) before[i] = job.out.confidence[p.index + i];
    sure = num::load_int<F>(before, p.count);
  }
  store_range(job.out, p, camera::ray<F>(s.lens, p), num::load<F>(range + p.index, p.count), sure, num::load_int<F>(flags, p.count));
  if (item == of_filter) num::store(job.out.noise_m + p.index, noise, p.count);
}
template <class F>
TOFRAY_FN void settle_row(const Setup& s, const Job& job, int y, std::int32_t item) {
  const int width = s.lens.width;
  for (int x = 0; x < width; x += num::lanes<F>) {
    settle<F>(s, job, Pixels{y * width + x, width - x < num::lanes<F> ? width - x : num::lanes<F>}, item);
  }
}

}  // namespace tofray::pipeline
