// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "raw/line_noise.h"

/// Stage 3: what the sensor collects in one raw frame.                                                  [theory: eq. 3.6]
namespace tofray::raw {

/// What stays the same for a pixel over all raw frames of a frame, and what is computed once for several of them.
template <class F>
struct Exposure {
  num::Int<F> pixel;
  LineNoise lines;
  F gain_a, gain_b, offset;
  CodeReach<F> reach;  ///< with that offset
  TapWords<F> merged_words, suppression_words;
  F overflow;                   ///< of the lit raw frames: most charge for which both wells have no room, where that spills
  F most_charge, widest_level;  ///< of the lit raw frames: most charge of a tap, largest distance of a level from the valid codes' middle
};

template <class F>
TOFRAY_FN F pattern(const float* map, const flow::Pixels& p, float otherwise) {
  return map != nullptr ? num::load<F>(map + p.index, p.count) : F(otherwise);
}

/// One tap collects 1 + g/2 of what it should, the other 1 − g/2.                                            [theory: eq. 3.16]
template <class F>
TOFRAY_FN void unlike_gains(const camera::SensorView& s, Exposure<F>& e) {
  e.gain_a = num::fma(e.gain_a, F(s.half_gain_mismatch), e.gain_a);
  e.gain_b = num::fnma(e.gain_b, F(s.half_gain_mismatch), e.gain_b);
}

/// PRNU is of light alone: dark charge comes as if there were none.                                          [theory: eq. 3.6]
template <class F>
TOFRAY_FN Means<F> dark_less_in_gain(const camera::SensorView& s, const camera::RawFrameView& frame, const Exposure<F>& e) {
  const F half = F(s.half_gain_mismatch), dark = F(frame.dark);
  return {dark * ((F(1.0f) + half) - e.gain_a), dark * ((F(1.0f) - half) - e.gain_b)};
}
template <class F>
TOFRAY_FN void keep_dark_charge(const camera::SensorView& s, const camera::RawFrameView& frame, const Exposure<F>& e, Means<F>& charge) {
  const Means<F> less = dark_less_in_gain(s, frame, e);
  charge.a = num::max(charge.a + less.a, F(0.0f)), charge.b = num::max(charge.b + less.b, F(0.0f));
}

/// @param line_normals  as line_noise.h draws them, where it does
template <class F>
TOFRAY_FN Exposure<F> start(const camera::SensorView& s, const flow::Pixels& p, const float* line_normals) {
  Exposure<F> e;
  e.pixel = num::Int<F>(p.index) + num::lane_index<F>();
  e.lines = lines_through(s, p, line_normals);
  e.gain_a = e.gain_b = pattern<F>(s.gain, p, 1.0f), e.offset = pattern<F>(s.offset, p, 0.0f);
  if (s.half_gain_mismatch != 0) unlike_gains(s, e);
  e.reach = reach_of_codes(s, e.offset);
  e.overflow = e.most_charge = F(0.0f), e.widest_level = F(0.0f);
  return e;
}

/// Charge of both taps for which their wells have no room.                                                   [theory: eq. 3.32]
template <class F>
TOFRAY_FN F overflow_of(const camera::SensorView& s, const Means<F>& charge) {
  return num::max(charge.a - F(s.full_well), F(0.0f)) + num::max(charge.b - F(s.full_well), F(0.0f));
}

/// Notes how far a lit raw frame went.
/// @param most  charge of the tap that holds more
template <class F>
TOFRAY_FN void watch(const camera::SensorView& s, const camera::RawFrameView& frame, F most, const Taps<F>& taps, Exposure<F>& e) {
  if (frame.lit == 0) return;
  e.most_charge = num::max(e.most_charge, most);
  e.widest_level = num::max(e.widest_level, num::abs(taps.level - F(s.valid_middle)));
}

/// In a lit raw frame a tap clipped, or a code left the valid range: before the ADC held it to its ends, which may be valid codes.
template <class F>
TOFRAY_FN Mask<F> saturated(const camera::SensorView& s, const Exposure<F>& e) {
  return (e.most_charge >= F(s.full_well)) | (e.widest_level > F(s.valid_half));
}

/// A−B of a lit raw frame without noise. Strong ambient light leaves few places of a float to the difference of the taps; where neither
/// clips, and what is read is the charge itself, it is known better than that.
/// @param common, rate  electrons per second of both taps together, and of their difference
/// @param most          charge of the tap that holds more
/// @param otherwise     A−B of the taps
/// \tparam plain        as of expose
template <bool plain, class F>
TOFRAY_FN F known_difference(const camera::SensorView& s, const camera::RawFrameView& frame, F common, F rate, F most, const Exposure<F>& e,
                             F otherwise) {
  if (!plain && s.read.cell != nullptr) return otherwise;
  const auto whole = (most < F(s.full_well)) & (num::abs(rate) <= common);
  F difference = rate * F(frame.integration_time) * e.gain_a;
  if (!plain && s.taps_differ != 0) {
    const F of_rate = F(0.5f * frame.integration_time) * rate * (e.gain_a + e.gain_b);
    const F each = num::fma(common, F(0.5f * frame.integration_time), F(frame.dark));
    difference = num::fma(each, e.gain_a - e.gain_b, of_rate) + F(2 * s.half_offset_mismatch);
    if (s.gain != nullptr) {
      const Means<F> less = dark_less_in_gain(s, frame, e);
      difference = difference + (less.a - less.b);
    }
  }
  return num::select(whole, difference, otherwise);
}

/// (Light × (1 + PRNU) + dark charge) × (1 ± g/2), as expected in both taps; and A−B per second of the light alone.
template <class F>
struct Expected {
  Means<F> charge;
  F rate, ambient_rate;
};
/// @param light  as this pixel sees it, its own delay included
/// @param orders of the light's phasors
/// \tparam plain true: the sensor has none of its effects, and there is no code for them
template <bool plain, class F>
TOFRAY_FN Expected<F> expected(const camera::SensorView& s, const camera::RawFrameView& frame, const Light<F>& light, int orders,
                               const Exposure<F>& e) {
  Expected<F> out;
  out.rate = frame.lit != 0 ? difference_rate(frame, orders, light) : F(0.0f), out.ambient_rate = light.ambient_rate;
  if (!plain && frame.other != nullptr) add_other_camera(frame, orders, light, out.ambient_rate, out.rate);
  out.charge = tap_means(frame, light.signal_rate, out.ambient_rate, out.rate);
  out.charge.a = out.charge.a * e.gain_a, out.charge.b = out.charge.b * e.gain_b;
  if (s.gain != nullptr) keep_dark_charge(s, frame, e, out.charge);
  return out;
}

/// What the ADC would say without noise, before it rounds: the level of the expected charge, within the codes' range.     [theory: eq. 3.35]
template <class F>
TOFRAY_FN F level_without_noise(const camera::SensorView& s, int k, const Light<F>& light, int orders, const Exposure<F>& e) {
  Means<F> charge = expected<false>(s, s.frame[k], light, orders, e).charge;
  if (s.half_offset_mismatch != 0) charge = with_unlike_offsets(s, charge);
  if (s.suppression_threshold > 0) {
    const F removed = removed_by_suppression(s, charge);
    charge = {charge.a - removed, charge.b - removed};
  }
  if (s.read.cell != nullptr) charge = read_charges(s, charge);
  const F difference = num::min(charge.a, F(s.full_read)) - num::min(charge.b, F(s.full_read));
  return num::min(num::max(level_of(s, difference, e.offset), F(0.0f)), F(s.max_code));
}

/// (Light × (1 + PRNU) + dark charge) × (1 ± g/2) → Poisson → reset and read noise → tap offsets → background suppression → full well →
/// non-linearity → A, B, A−B → column and row noise → ADC.
/// @param light, orders  as of expected
/// \tparam plain         likewise
template <bool plain, class F>
TOFRAY_FN Taps<F> expose(const camera::SensorView& s, int k, const Light<F>& light, int orders, FrameIndex index, Exposure<F>& e) {
  const camera::RawFrameView frame = s.frame[k];
  const Expected<F> mean = expected<plain>(s, frame, light, orders, e);
  const F rate = mean.rate, ambient_rate = mean.ambient_rate;
  Means<F> charge = mean.charge;
  if (s.noise == Noise::merged) {
    charge = expose_merged(s, charge, e.pixel, k, index, e.merged_words);
  } else if (s.noise == Noise::apart) {
    charge = expose_apart(s, charge, e.pixel, k, index);
  }
  F most = num::max(charge.a, charge.b), offset = e.offset;
  if constexpr (!plain) {
    offset_and_suppress(s, e.pixel, k, index, e.suppression_words, charge), offset = with_line_noise(s, k, e.lines, e.offset);
    most = num::max(charge.a, charge.b);
    if (s.blooms != 0 && frame.lit != 0) e.overflow = num::max(e.overflow, overflow_of(s, charge));
    if (s.read.cell != nullptr) charge = read_charges(s, charge);
  }
  // (Without noise there is none of lines either: the codes' reach is that of the offset alone.)
  const Taps<F> taps = read_out(
      s, charge, offset, e.reach, [&](F difference) __attribute__((always_inline)) {
        if (frame.lit == 0) return difference;
        return known_difference<plain>(s, frame, light.signal_rate + ambient_rate, rate, most, e, difference);
      });
  watch(s, frame, most, taps, e);
  return taps;
}
template <class F>
TOFRAY_FN Taps<F> expose(const camera::SensorView& s, int k, const Light<F>& light, int orders, FrameIndex index, Exposure<F>& e) {
  return s.effects != 0 ? expose<false>(s, k, light, orders, index, e) : expose<true>(s, k, light, orders, index, e);
}

}  // namespace tofray::raw
