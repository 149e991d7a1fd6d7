// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "raw/charge.h"

/// Stage 3: what the sensor collects in one raw frame.                                                  [theory: eq. 3.6]
namespace tofray::raw {

/// What stays the same for a pixel over all raw frames of a frame, and what is computed once for several of them.
template <class F>
struct Exposure {
  num::Int<F> pixel;
  num::Int<F> column;  ///< where the sensor has column noise
  F gain, offset, delay;
  MergedWords<F> merged_words;
  F most_charge, widest_level;  ///< of the lit raw frames: most charge of a tap, largest distance of a level from the valid codes' middle
};

template <class F>
TOFRAY_FN F pattern(const float* map, const flow::Pixels& p, float otherwise) {
  return map != nullptr ? num::load<F>(map + p.index, p.count) : F(otherwise);
}

template <class F>
TOFRAY_FN Exposure<F> start(const camera::SensorView& s, const flow::Pixels& p) {
  Exposure<F> e;
  e.pixel = num::Int<F>(p.index) + num::lane_index<F>();
  if (s.column_noise > 0) e.column = num::Int<F>(p.index % s.width) + num::lane_index<F>();
  e.gain = pattern<F>(s.gain, p, 1.0f), e.offset = pattern<F>(s.offset, p, 0.0f);
  e.delay = pattern<F>(s.delay, p, 0.0f);
  e.most_charge = F(0.0f), e.widest_level = F(0.0f);
  return e;
}

/// Notes how far a lit raw frame went.
template <class F>
TOFRAY_FN void watch(const camera::SensorView& s, const camera::RawFrameView& frame, const Means<F>& charge, const Taps<F>& taps,
                     Exposure<F>& e) {
  if (frame.lit == 0) return;
  e.most_charge = num::max(e.most_charge, num::max(charge.a, charge.b));
  e.widest_level = num::max(e.widest_level, num::abs(taps.level - F(s.valid_middle)));
}

/// In a lit raw frame a tap clipped, or a code left the valid range: before the ADC held it to its ends, which may be valid codes.
template <class F>
TOFRAY_FN Mask<F> saturated(const camera::SensorView& s, const Exposure<F>& e) {
  return (e.most_charge >= F(s.full_well)) | (e.widest_level > F(s.valid_half));
}

/// The pixel's offset [DN] with that of its column in this raw frame, one draw for all pixels of the column.         [theory: eq. 3.15]
template <class F>
TOFRAY_FN F offset_of(const camera::SensorView& s, int k, FrameIndex index, const Exposure<F>& e) {
  if (!(s.column_noise > 0) || s.noise == Noise::off) return e.offset;
  const num::Random4<F> words = draw<F>(s, e.column, k, index, of_column);
  F z, other;
  num::normal_pair<F>(words.w[0], words.w[1], z, other);
  return num::fma(F(s.column_noise), z, e.offset);
}

/// Mean electrons × (1 + PRNU) → Poisson → reset and read noise → background suppression → full well → column noise, ADC.
/// @param light  as this pixel sees it, its own delay included
/// @param orders of the light's phasors
template <class F>
TOFRAY_FN Taps<F> expose(const camera::SensorView& s, int k, const Light<F>& light, int orders, FrameIndex index, Exposure<F>& e) {
  const camera::RawFrameView& frame = s.frame[k];
  const F rate = frame.lit != 0 ? difference_rate(frame, orders, light) : F(0.0f);
  Means<F> charge = tap_means(frame, light.signal_rate, light.ambient_rate, rate);
  charge.a = charge.a * e.gain, charge.b = charge.b * e.gain;
  if (s.noise == Noise::merged) {
    charge = expose_merged(s, charge, e.pixel, k, index, e.merged_words);
  } else if (s.noise == Noise::apart) {
    charge = expose_apart(s, charge, e.pixel, k, index);
  }
  if (s.suppression_threshold > 0) charge = suppress(s, charge, e.pixel, k, index);
  Taps<F> taps = read_out(s, charge, offset_of(s, k, index, e));
  if (s.noise == Noise::off && frame.lit != 0) {
    // Strong ambient light leaves few places of a float to the difference of the taps; where neither clips it is known better than that.
    const auto whole = (num::max(charge.a, charge.b) < F(s.full_well)) & (num::abs(rate) <= light.signal_rate + light.ambient_rate);
    taps.difference = num::select(whole, held_to_codes(s, rate * F(frame.integration_time) * e.gain, e.offset), taps.difference);
  }
  watch(s, frame, charge, taps, e);
  return taps;
}

}  // namespace tofray::raw
