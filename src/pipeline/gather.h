// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "pipeline/store.h"
#include "power/phasors.h"

/// The light image: what stages 1 and 2 add to it, and what stage 3 reads from it.                      [theory: light-image]
namespace tofray::pipeline {

/// Modulation frequencies of which the image keeps something at each of its times, and planes of a time.
TOFRAY_INLINE int kept_modulations(const Setup& s, int times) { return times == 1 ? s.phasors.modulations : 1; }
TOFRAY_INLINE int planes_of_modulation(const camera::PhasorView& s) { return s.sums_alone != 0 ? 2 : 2 * s.orders; }
TOFRAY_INLINE int light_planes(const Setup& s, int times) { return 2 + kept_modulations(s, times) * planes_of_modulation(s.phasors); }

TOFRAY_INLINE std::int64_t light_place(const Setup& s, const Pixels& p, int times, int time, int plane) {
  const std::int64_t pixels = std::int64_t{s.lens.width} * s.lens.height;
  return (std::int64_t{time} * light_planes(s, times) + plane) * pixels + p.index;
}

/// Calls visit(plane, value) for all that the image keeps of a light at a time: of raw frame number `time`, or of all.
template <class F, class L, class Visit>
TOFRAY_INLINE void each_plane(const Setup& s, int times, int time, L& light, const Visit& visit) {
  visit(0, light.signal_rate), visit(1, light.ambient_rate);
  const int kept = kept_modulations(s, times), planes = planes_of_modulation(s.phasors), orders = s.phasors.orders;
  if (times > 1 && s.sensor.frame[time].lit == 0) return;
  for (int i = 0; i < kept; ++i) {
    const int j = times > 1 ? s.sensor.frame[time].modulation : i, first = 2 + i * planes;
    if (s.phasors.sums_alone != 0) {
      visit(first, light.in_phase[j]), visit(first + 1, light.quarter[j]);
      continue;
    }
    for (int h = 0; h < orders; ++h) {
      visit(first + h, light.real[j * orders + h]), visit(first + orders + h, light.imaginary[j * orders + h]);
    }
  }
}

/// Where light was, and where it will be once more is added.
struct Growing {
  const float* before;
  float* values;
};
/// How a share of a light is added to the image.
template <class F>
struct Adding {
  float share;
  bool first;              ///< nothing was added before: the share is all there is
  float kept;              ///< what the light that was there before counts
  num::Mask<F> active;     ///< pixels that get more; the others keep what they have
  std::int32_t ahead = 0;  ///< how far from these pixels those are that come next; 0: not known
};
template <class F>
TOFRAY_NOINLINE void gather_planes(const Setup& s, const Growing& image, const Pixels& p, std::int64_t at, const F* values, int planes,
                                   const Adding<F>& how) {
  const std::int64_t pixels = std::int64_t{s.lens.width} * s.lens.height;
  for (int plane = 0; plane < planes; ++plane, at += pixels) {
    F sum = values[plane] * F(how.share);
    if (!how.first) {
      const F before = num::load<F>(image.before + at, p.count);
      sum = num::select(how.active, num::fma(values[plane], F(how.share), before * F(how.kept)), before);
    }
    num::store(image.values + at, sum, p.count);
    if (how.ahead != 0) num::fetch_to<F>(image.values + at + how.ahead, 0, p.count);
  }
}
/// Adds a share of a light to the image. (What is handed to a function lies in memory: that is what the image keeps, and not all of a
/// light's kilobytes.)
template <class F>
TOFRAY_INLINE void gather_light(const Setup& s, const Growing& image, const Pixels& p, int times, int time, const flow::Light<F>& light,
                                const Adding<F>& how) {
  F values[2 + 2 * flow::max_modulation_frequencies * flow::max_harmonics];
  int planes = 0;
  each_plane<F>(s, times, time, light, [&](int plane, F value) TOFRAY_LAMBDA {
    values[plane] = value;
    ++planes;
  });
  gather_planes<F>(s, image, p, light_place(s, p, times, time, 0), values, planes, how);
}

/// The first raw frame to which light that stays the same is what it is to raw frame number `time`: of the same modulation frequency.
TOFRAY_INLINE int first_alike(const Setup& s, int time) {
  const effect::RawFrameView& frame = s.sensor.frame[time];
  int k = 0;
  while ((s.sensor.frame[k].lit != 0) != (frame.lit != 0) || (frame.lit != 0 && s.sensor.frame[k].modulation != frame.modulation)) ++k;
  return k;
}

/// Adds a share of a light that is the same at all times to the image.
/// @param once  to the first raw frame of each modulation frequency alone: spread_alike does the rest, once all samples are there
template <class F>
TOFRAY_INLINE void gather_all_times(const Setup& s, const Growing& image, const Pixels& p, int times, const flow::Light<F>& light,
                                    const Adding<F>& how, bool once) {
  for (int time = 0; time < times; ++time)
    if (!once || first_alike(s, time) == time) gather_light<F>(s, image, p, times, time, light, how);
}

/// Gives all raw frames the light of the first one of their modulation frequency.
template <class F>
TOFRAY_NOINLINE void spread_alike(const Setup& s, float* values, const Pixels& p, int times) {
  const std::int64_t pixels = std::int64_t{s.lens.width} * s.lens.height;
  for (int time = 0; time < times; ++time) {
    const int first = first_alike(s, time), planes = s.sensor.frame[time].lit != 0 ? light_planes(s, times) : 2;
    if (first == time) continue;
    std::int64_t from = light_place(s, p, times, first, 0), to = light_place(s, p, times, time, 0);
    for (int plane = 0; plane < planes; ++plane, from += pixels, to += pixels)
      num::store(values + to, num::load<F>(values + from, p.count), p.count);
  }
}

/// Values of all planes at all times.
TOFRAY_INLINE std::int64_t light_values(const Setup& s, int times) {
  return std::int64_t{times} * light_planes(s, times) * s.lens.width * s.lens.height;
}

/// Reads the light of the pixels at a time.
/// @param values  the whole image's
template <class F>
TOFRAY_INLINE void load_light(const Setup& s, const float* values, const Pixels& p, int times, int time, flow::Light<F>& light) {
  each_plane<F>(s, times, time, light,
                [&](int plane, F& value) TOFRAY_LAMBDA { value = num::load<F>(values + light_place(s, p, times, time, plane), p.count); });
  if (s.phasors.sums_alone != 0 || (times > 1 && s.sensor.frame[time].lit == 0)) return;
  const int j = times > 1 ? s.sensor.frame[time].modulation : 0;
  power::add_up(s.phasors, power::Wanted{j, j + kept_modulations(s, times)}, light);
}
/// Reads the light that reaches the pixels at a time.
template <class F>
TOFRAY_INLINE void load_light(const Setup& s, const flow::LightImage& image, const Pixels& p, int time, flow::Light<F>& light) {
  load_light(s, image.scattered != nullptr ? image.scattered : image.values, p, image.times, time, light);
}

/// The light of all ways, once the direct and the indirect part of it are there.
template <class F>
TOFRAY_INLINE void sum_light(const Setup& s, const flow::LightImage& image, const Pixels& p) {
  const std::int64_t pixels = std::int64_t{s.lens.width} * s.lens.height;
  const int planes = image.times * light_planes(s, image.times), compared = image.object != nullptr ? flow::compared_planes : 0;
  for (int i = 0; i < planes + compared; ++i) {
    const std::int64_t at = i * pixels + p.index;
    F sum = num::load<F>(image.before + at, p.count);
    if (i < planes) sum = sum + num::load<F>(image.indirect + at, p.count);
    num::store(image.values + at, sum, p.count);
  }
}

/// Place of what comparing the samples gives, behind the light.
TOFRAY_INLINE std::int64_t compared_place(const Setup& s, const flow::LightImage& image, const Pixels& p, int plane) {
  return light_place(s, p, image.times, image.times, plane);
}

/// Notes what a sample within the pixels sees beside what their middle sees.
/// @param middle  [height][width] object that the middle sees, −1: none
template <class F>
TOFRAY_NOINLINE void compare_sample(const Setup& s, const flow::LightImage& image, const std::int32_t* middle, const Pixels& p, float share,
                                    bool first) {
  using Int = num::Int<F>;
  const Int object = num::load_int<F>(image.object + p.index, p.count);
  const F range = num::load<F>(image.range + p.index, p.count);
  const auto found = object > Int(-1);
  const auto before = [&](int plane, float otherwise) TOFRAY_LAMBDA {
    return first ? F(otherwise) : num::load<F>(image.before + compared_place(s, image, p, plane), p.count);
  };
  const auto put = [&](int plane, F value) TOFRAY_LAMBDA { num::store(image.values + compared_place(s, image, p, plane), value, p.count); };
  const F same = before(0, 0.0f), nearest = before(1, 3e38f), farthest = before(2, 0.0f);
  put(0, same + num::select(object == num::load_int<F>(middle + p.index, p.count), F(share), F(0.0f)));
  put(1, num::select(found, num::min(nearest, range), nearest));
  put(2, num::select(found, num::max(farthest, range), farthest));
}

constexpr float mixed_range = 0.05f;  ///< [m] of ranges within a pixel that make it a mixed one

/// The ground truth that comes of it: samples see more than one object, or ranges further apart than mixed_range.
template <class F>
TOFRAY_INLINE void store_mixed(const Setup& s, const flow::FrameView& out, const flow::LightImage& image, const Pixels& p) {
  if (image.object == nullptr) return;
  const auto load = [&](int plane) TOFRAY_LAMBDA { return num::load<F>(image.values + compared_place(s, image, p, plane), p.count); };
  const F sum = load(0), spread = load(2) - load(1);
  const F same = num::select(sum > F(0.99999f), F(1.0f), sum);  // shares add up to 1 but for rounding
  const auto mixed = (same < F(1.0f)) | (spread > F(mixed_range));
  if (out.gt_mixed != nullptr) num::store(out.gt_mixed + p.index, num::select(mixed, num::Int<F>(1), num::Int<F>(0)), p.count);
  store(out.gt_object_share, p, same);
}

}  // namespace tofray::pipeline
