// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "raw/merged_noise.h"
#include "raw/poisson.h"

/// Stage 3: what the sensor collects in one raw frame.                                             [theory: charge-order]
namespace tofray::raw {

using effect::Chain;
using effect::CodeReach;
using effect::Effects;
using effect::Exposure;
using effect::held_to_codes;
using effect::Noise;
using effect::reach_of_codes;
using effect::read_out;
using flow::Taps;

template <class F>
TOFRAY_INLINE F pattern(const float* map, const flow::Pixels& p, float otherwise) {
  return map != nullptr ? num::load<F>(map + p.index, p.count) : F(otherwise);
}

/// @param line_normals  as effect::LineNoise draws them, where it does
template <class F>
TOFRAY_INLINE Exposure<F> start(const effect::SensorView& s, const flow::Pixels& p, const float* line_normals) {
  Exposure<F> e;
  e.pixel = num::Int<F>(p.index) + num::lane_index<F>();
  e.lines = effect::LineNoise::lines_through(s, p, line_normals);
  e.gain_a = e.gain_b = pattern<F>(s.gain, p, 1.0f), e.offset = pattern<F>(s.offset, p, 0.0f);
  effect::TapMismatch::change_gains(s, e);
  e.reach = reach_of_codes<F>(s, e.offset);
  e.overflow = e.most_charge = F(0.0f), e.widest_level = F(0.0f);
  return e;
}

/// Notes how far a lit raw frame went.
/// @param most  charge of the tap that holds more
template <class F>
TOFRAY_INLINE void watch(const effect::SensorView& s, const effect::RawFrameView& frame, F most, const Taps<F>& taps, Exposure<F>& e) {
  if (frame.lit == 0) return;
  e.most_charge = num::max(e.most_charge, most);
  e.widest_level = num::max(e.widest_level, num::abs(taps.level - F(s.valid_middle)));
}

/// In a lit raw frame a tap clipped, or a code left the valid range: before the ADC held it to its ends, which may be valid codes.
template <class F>
TOFRAY_INLINE Mask<F> saturated(const effect::SensorView& s, const Exposure<F>& e) {
  return (e.most_charge >= F(s.full_well)) | (e.widest_level > F(s.valid_half));
}

/// A−B of a lit raw frame without noise. Strong ambient light leaves few places of a float to the difference of the taps; where neither
/// clips, and what is read is the charge itself, it is known better than that.
/// @param common, rate  electrons per second of both taps together, and of their difference
/// @param most          charge of the tap that holds more
/// @param otherwise     A−B of the taps
/// \tparam plain        as of expose
template <bool plain, class F>
TOFRAY_INLINE F known_difference(const effect::SensorView& s, const effect::RawFrameView& frame, F common, F rate, F most,
                                 const Exposure<F>& e, F otherwise) {
  if (!plain && s.read.cell != nullptr) return otherwise;
  const auto whole = (most < F(s.full_well)) & (num::abs(rate) <= common);
  F difference = rate * F(frame.integration_time) * e.gain_a;
  if (!plain && s.taps_differ != 0) difference = effect::TapMismatch::known_difference(s, frame, common, rate, e);
  return num::select(whole, difference, otherwise);
}

/// PRNU is of light alone: dark charge comes as if there were none.                                     [theory: charge-order]
template <class F>
TOFRAY_INLINE void keep_dark_charge(const effect::SensorView& s, const effect::RawFrameView& frame, const Exposure<F>& e,
                                    TapPair<F>& charge) {
  const TapPair<F> less = effect::TapMismatch::dark_less_in_gain(s, frame, e);
  charge.a = num::max(charge.a + less.a, F(0.0f)), charge.b = num::max(charge.b + less.b, F(0.0f));
}

/// (Light × (1 + PRNU) + dark charge) × (1 ± g/2), as expected in both taps; and A−B per second of the light alone.
template <class F>
struct Expected {
  TapPair<F> charge;
  effect::Rates<F> rates;
};
/// @param light  as this pixel sees it, its own delay included
/// @param orders of the light's phasors
/// \tparam plain true: the sensor has none of its effects, and there is no code for them
template <bool plain, class F>
TOFRAY_INLINE Expected<F> expected(const effect::SensorView& s, const effect::RawFrameView& frame, const Light<F>& light, int orders,
                                   const Exposure<F>& e) {
  Expected<F> out;
  out.rates = {light.ambient_rate, frame.lit != 0 ? difference_rate(frame, orders, light) : F(0.0f)};
  if constexpr (!plain) effect::change_rates(Effects{}, frame, orders, light, out.rates);
  out.charge = tap_means(frame, light.signal_rate, out.rates.ambient, out.rates.difference);
  out.charge.a = out.charge.a * e.gain_a, out.charge.b = out.charge.b * e.gain_b;
  if (s.gain != nullptr) keep_dark_charge(s, frame, e, out.charge);
  return out;
}

/// What the ADC would say without noise, before it rounds: the level of the expected charge, within the codes' range.
///                                                                                                                  [theory: noiseless-raw]
template <class F>
TOFRAY_INLINE F level_without_noise(const effect::SensorView& s, int k, const Light<F>& light, int orders, const Exposure<F>& e) {
  Chain<F> chain{expected<false>(s, s.frame[k], light, orders, e).charge, e.offset};
  effect::change_charge<false>(Effects{}, s, s.frame[k], k, {0, 0}, e, chain);
  effect::change_reading(Effects{}, s, chain.charge);
  const F difference = num::min(chain.charge.a, F(s.full_read)) - num::min(chain.charge.b, F(s.full_read));
  return num::min(num::max(effect::level_of(s, difference, chain.offset), F(0.0f)), F(s.max_code));
}

/// (Light × (1 + PRNU) + dark charge) × (1 ± g/2) → Poisson → reset and read noise → tap offsets → background suppression → full well →
/// nonlinearity → A, B, A−B → column and row noise → ADC.
/// @param light, orders  as of expected
/// \tparam plain         likewise
template <bool plain, class F>
TOFRAY_INLINE Taps<F> expose(const effect::SensorView& s, int k, const Light<F>& light, int orders, FrameIndex index, Exposure<F>& e) {
  const effect::RawFrameView frame = s.frame[k];
  const Expected<F> mean = expected<plain>(s, frame, light, orders, e);
  const F rate = mean.rates.difference, ambient_rate = mean.rates.ambient;
  Chain<F> chain{mean.charge, e.offset};
  if (s.noise == Noise::merged) {
    chain.charge = expose_merged(s, chain.charge, e.pixel, k, index, e.merged_words);
  } else if (s.noise == Noise::apart) {
    chain.charge = expose_apart(s, chain.charge, e.pixel, k, index);
  }
  if constexpr (!plain) effect::change_charge<true>(Effects{}, s, frame, k, index, e, chain);
  const F most = num::max(chain.charge.a, chain.charge.b);
  if constexpr (!plain) effect::change_reading(Effects{}, s, chain.charge);
  // (Without noise there is none of lines either: the codes' reach is that of the offset alone.)
  const Taps<F> taps = read_out(s, chain.charge, chain.offset, e.reach, [&](F difference) TOFRAY_LAMBDA {
    if (frame.lit == 0) return difference;
    return known_difference<plain>(s, frame, light.signal_rate + ambient_rate, rate, most, e, difference);
  });
  watch(s, frame, most, taps, e);
  return taps;
}
template <class F>
TOFRAY_INLINE Taps<F> expose(const effect::SensorView& s, int k, const Light<F>& light, int orders, FrameIndex index, Exposure<F>& e) {
  return s.effects != 0 ? expose<false>(s, k, light, orders, index, e) : expose<true>(s, k, light, orders, index, e);
}

}  // namespace tofray::raw
