// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "camera/pixel/pixel_delay.h"
#include "depth/unwrap.h"
#include "effect/nonlinearity.h"
#include "tofray/flags.h"

/// Stage 4: from raw frames to range.                                                                   (docs/theory/04-depth.md)
namespace tofray::depth {

using flow::Depth;

/// As tofray::Flag.
enum Bits : std::int32_t {
#define TOFRAY_BIT(name, bit, ...) name = bit,
  TOFRAY_FLAGS(TOFRAY_BIT)
#undef TOFRAY_BIT
      invalid = flags_invalid,
};

/// Ẑ = (2/N)Σ D_k e^{−iτ_k} of one modulation frequency.                                   [theory: phase-estimate]
template <class F>
struct Phasor {
  F real, imaginary;
};
template <class F>
TOFRAY_INLINE Phasor<F> phasor(const camera::DecoderView& s, const camera::DecodeModulation& m, const F* difference) {
  F real = F(0.0f), imaginary = F(0.0f);
  for (int j = 0; j < m.count; ++j) {
    const int k = m.raw_frame[j];
    real = num::fma(difference[k], F(s.frame[k].cosine), real);
    imaginary = num::fnma(difference[k], F(s.frame[k].sine), imaginary);
  }
  return {real, imaginary};
}

/// Its phase and amplitude: φ̂ = arg Ẑ, Â = |Ẑ|.                                           [theory: phase-estimate]
template <class F>
struct Estimate {
  F real, imaginary;  ///< Ẑ [e⁻]
  F turns;            ///< φ̂/2π in [0, 1)
  F amplitude;        ///< Â [e⁻]
};

template <class F>
TOFRAY_INLINE Estimate<F> estimate(const camera::DecoderView& s, const camera::DecodeModulation& m, const F* difference) {
  const auto [real, imaginary] = phasor(s, m, difference);
  const F turns = num::atan2_turns(imaginary, real);
  const F positive = num::select(turns < F(0.0f), turns + F(1.0f), turns);
  return {real, imaginary, num::select(positive >= F(1.0f), F(0.0f), positive), num::sqrt(num::fma(real, real, imaginary * imaginary))};
}

/// What a measured phase stands for: harmonics bend the phase, and the amplitude likewise.
template <class F>
struct Unwiggled {
  F turns;  ///< φ/2π                                                                    [theory: wiggling-correction]
  F slope;  ///< dφ/dφ̂
  F light;  ///< S/Â: electrons of light for each one of Â                                    [theory: noise-estimate]
};
/// By the table of the modulation frequency, on straight lines from node to node.
template <class F>
TOFRAY_INLINE Unwiggled<F> unwiggle(const camera::DecoderView& s, const camera::DecodeModulation& m, F turns) {
  const F nodes = F(static_cast<float>(s.wiggling_nodes)), place = turns * nodes;
  const F node = num::min(num::floor(place), F(static_cast<float>(s.wiggling_nodes - 1))), part = place - node;
  const auto [correction, step, light, light_step] = num::gather_four(m.wiggling, num::to_int(node)).value;
  return {turns + num::fma(part, step, correction), num::fma(step, nodes, F(1.0f)), num::fma(part, light_step, light)};
}

/// Electrons of ambient light in the unlit raw frames together, at least 0: their A−B, or the charge of which this is read: all of the light is in
/// A, and dark charge below it.                                                   [theory: noise-estimate, noise-as-read]
/// \tparam plain  as of decode
template <bool plain, class F>
TOFRAY_INLINE F grey_sum(const camera::DecoderView& s, const F* difference) {
  F sum = F(0.0f);
  if (!plain && s.read.cell != nullptr) {
    const F dark_read = effect::read_charge(s.read, F(s.grey_dark)).value;
    for (int j = 0; j < s.grey_frames; ++j) sum = sum + effect::charge_of(s.read, difference[s.grey_frame[j]] + dark_read) - F(s.grey_dark);
    return num::max(sum, F(0.0f));
  }
  for (int j = 0; j < s.grey_frames; ++j) sum = sum + difference[s.grey_frame[j]];
  return num::max(sum, F(0.0f));
}

/// Opposite reference phases must cancel: |D_k + D_k'| > max(limit, k√(2V̂)) says that something moved.
template <class F>
TOFRAY_INLINE Mask<F> phases_disagree(const camera::DecoderView& s, const camera::DecodeModulation& m, const F* difference, F variance) {
  F most = F(0.0f);
  for (int j = 0; j < m.pairs; ++j) most = num::max(most, num::abs(difference[m.pair[2 * j]] + difference[m.pair[2 * j + 1]]));
  return most * most > num::max(F(s.asymmetry_factor) * variance, F(s.asymmetry_square));
}

/// What background suppression took off each tap of raw frame k: about x_k = min(budget, ½(collected − |D_k|) − threshold).
///                                                                                                            [theory: suppression-noise]
/// @param collected   electrons of both taps together
/// @param difference  D_k [e⁻]
template <class F>
TOFRAY_INLINE F suppressed(const camera::DecoderView& s, F difference, F collected) {
  const F excess = F(0.5f) * (collected - num::abs(difference)) - F(s.suppression_threshold);
  return num::min(num::max(excess, F(0.0f)), F(s.suppression_budget));
}

/// What background suppression adds to the variance, as if to each raw frame: its noise turns the phase by the part that stands across Ẑ.
/// @param collected   electrons of both taps together                                    [theory: suppression-noise]
/// @param per_slope   electrons of each one that is read
template <class F>
TOFRAY_INLINE F suppression_variance(const camera::DecoderView& s, const camera::DecodeModulation& m, const F* difference,
                                     const Estimate<F>& e, F collected, F per_slope) {
  F across = F(0.0f);
  for (int j = 0; j < m.count; ++j) {
    const int k = m.raw_frame[j];
    const F removed = suppressed(s, difference[k] * per_slope, collected);
    const F turn = num::fma(e.imaginary, F(s.frame[k].cosine), e.real * F(s.frame[k].sine));  // (2/N)·Â·sin(φ̂ + τ_k)
    across = num::fma(removed, turn * turn, across);
  }
  const F square = num::max(e.amplitude * e.amplitude, F(1e-6f));
  return across / square * F(s.suppression_variance * 0.5f * static_cast<float>(m.count));
}

/// Charge of a tap when it is read, the mean over both taps and a modulation's raw frames.   [theory: noise-as-read]
template <class F>
TOFRAY_INLINE F charge_left(const camera::DecoderView& s, const camera::DecodeModulation& m, const F* difference, F collected,
                            F per_slope) {
  const F charge = F(0.5f) * collected;
  if (!(s.suppression_threshold > 0)) return charge;
  F removed = F(0.0f);
  for (int j = 0; j < m.count; ++j) removed = removed + suppressed(s, difference[m.raw_frame[j]] * per_slope, collected);
  return num::fnma(removed, F(1.0f / static_cast<float>(m.count)), charge);
}

/// Variance with a nonlinear readout: charge variance × (slope of the readout curve)². Only the
/// signal is small enough to go by the slope; it and the slope are found in turns, from no signal on, and held to what the taps hold.
///                                                                                                                  [theory: noise-as-read]
/// @param light  electrons of light for each one of Â
/// @param known  electrons of both taps that are no signal: ambient light and dark current
template <class F>
TOFRAY_INLINE F variance_as_read(const camera::DecoderView& s, const camera::DecodeModulation& m, const F* difference, const Estimate<F>& e,
                                 F light, F known) {
  constexpr int turns = 6;
  const F both_full = F(2 * s.read.most);
  F collected = num::min(known, both_full), slope = F(1.0f), per_slope = F(1.0f);
  for (int turn = 0; turn < turns; ++turn) {
    const F before = slope;
    slope = effect::read_charge(s.read, charge_left(s, m, difference, collected, per_slope)).slope;
    slope = num::max(slope, F(1e-12f));                // a spline may fall between two samples that rise
    if (turn > 0 && num::all(slope == before)) break;  // it is of straight lines: all that follows would stay
    per_slope = F(1.0f) / slope;
    collected = num::min(num::fma(e.amplitude * per_slope, light, known), both_full);
  }
  F variance = collected + F(s.noise_floor - s.output_floor);
  if (s.suppression_threshold > 0) variance = variance + suppression_variance(s, m, difference, e, collected, per_slope);
  return num::fma(slope * slope, variance, F(s.output_floor));
}

/// V̂ = Â·S/Â(φ̂) + B̂ + dark + 2σ_r² + s²/12, and what suppression adds.                       [theory: noise-estimate]
/// @param light   electrons of light for each one of Â
/// \tparam plain  as of decode
template <bool plain = false, class F>
TOFRAY_INLINE F variance_of(const camera::DecoderView& s, const camera::DecodeModulation& m, const F* difference, const Estimate<F>& e,
                            F light, F ambient) {
  const float dark = s.dark_rate_both * m.integration_time;
  if (!plain && s.read.cell != nullptr) return variance_as_read(s, m, difference, e, light, ambient + F(dark));
  const F electrons = num::fma(e.amplitude, light, ambient);
  const F variance = electrons + F(s.noise_floor + dark);
  if (plain || !(s.suppression_threshold > 0)) return variance;
  return variance + suppression_variance(s, m, difference, e, electrons + F(dark), F(1.0f));
}

/// 1/σ² of the half path that one modulation frequency says [1/m²]: σ_φ² = (2V̂/N)/Â²·(dφ/dφ̂)².  [theory: noise-estimate]
template <class F>
TOFRAY_INLINE F inverse_variance(const camera::DecodeModulation& m, const Estimate<F>& e, F variance, F slope) {
  const F signal = num::max(e.amplitude, F(1e-3f));
  return signal * signal / (variance * F(m.variance_factor) * (slope * slope));
}

/// Exact inverse of ℓ = |P − L| + |P| along the unit view ray u: range = (ℓ² − |L|²)/(2(ℓ − u·L)).  [theory: path-to-range]
template <class F>
struct Inverse {
  F range;
  F slope;  ///< of the range over half the path: 2(ℓ − range)/(ℓ − u·L)                  [theory: range-slope]
};
template <class F>
TOFRAY_INLINE Inverse<F> range_from_path(const camera::DecoderView& s, F path_length, F ux, F uy, F uz) {
  const F along = num::fma(ux, F(s.light[0]), num::fma(uy, F(s.light[1]), uz * F(s.light[2])));
  const F per_length = F(1.0f) / (path_length - along);
  const F range = F(0.5f) * num::fma(path_length, path_length, F(-s.light_square)) * per_length;
  return {range, F(2.0f) * (path_length - range) * per_length};
}

template <class F>
TOFRAY_INLINE num::Int<F> bit(Mask<F> m, Bits value) {
  return num::select(m, num::Int<F>(value), num::Int<F>(0));
}

/// What was a warning makes the depth invalid, where the camera was told so.
template <class F>
TOFRAY_INLINE num::Int<F> rejected_bit(const camera::DecoderView& s, num::Int<F> flags) {
  const num::Int<F> none(0);
  return num::select((flags & num::Int<F>(s.rejected)) == none, none, num::Int<F>(rejected));
}

/// φ/2π in [0, 1) of one modulation frequency: without what the pixel's own delay adds.
/// @param i       its number
/// @param phi     φ/2π as the wiggling table has it
/// \tparam plain  as of decode
template <bool plain, class F>
TOFRAY_INLINE F wrapped_turns(const camera::DecoderView& s, int i, F phi, const flow::Pixels& p) {
  if (!plain && s.delay != nullptr) phi = num::fnma(camera::late_by<F>(s, i, p), F(s.modulation[i].frequency), phi);
  return phi - num::floor(phi);
}

/// What one modulation frequency says.
template <class F>
struct OfFrequency {
  F amplitude;        ///< Â [e⁻]
  F range;            ///< [m] of its own half path d_i = R_i(n_i + p_i)
  num::Int<F> cycle;  ///< n_i: that in which d_i is nearest to the half path of all; below 0 or past the last one at the ends of the range
  Mask<F> known;      ///< it has light, and a half path longer than the way between light and lens
};
/// What each says alone, in the cycle that unwrapping found for all of them.         [theory: half-path, single-frequency]
template <class F>
TOFRAY_INLINE void each_frequency(const camera::DecoderView& s, const F* difference, const flow::Ray<F>& ray, const flow::Pixels& p,
                                  OfFrequency<F>* out) {
  F turns[flow::max_modulation_frequencies], weight[flow::max_modulation_frequencies];
  const F grey = grey_sum<false>(s, difference);
  for (int i = 0; i < s.modulations; ++i) {
    const camera::DecodeModulation& m = s.modulation[i];
    const Estimate<F> e = estimate(s, m, difference);
    const Unwiggled<F> known = unwiggle(s, m, e.turns);
    turns[i] = wrapped_turns<false>(s, i, known.turns, p);
    weight[i] = inverse_variance(m, e, variance_of<false>(s, m, difference, e, known.light, grey * F(m.ambient_scale)), known.slope);
    out[i].amplitude = e.amplitude;
  }
  const HalfPath<F> half = unwrap(s, turns, weight);
  const F per_length = ray.inverse_length;
  for (int i = 0; i < s.modulations; ++i) {
    const camera::DecodeModulation& m = s.modulation[i];
    const F cycle = num::round_even(num::fma(half.value, F(m.per_half_wave), -turns[i]));
    const F path_length = F(2.0f * m.half_wave) * (cycle + turns[i]);
    out[i].range = range_from_path(s, path_length, ray.x * per_length, ray.y * per_length, ray.z * per_length).range;
    out[i].cycle = num::to_int(cycle);
    out[i].known = (out[i].amplitude >= F(1.0f)) & (path_length > F(0.0f)) & (path_length * path_length > F(s.light_square));
  }
}

/// @param difference  A−B of each raw frame [e⁻]
/// @param p           the pixels, for what is known of each
/// \tparam plain      true: the sensor has none of the effects that depth knows of, and there is no code for them
template <bool plain, class F>
TOFRAY_INLINE Depth<F> decode(const camera::DecoderView& s, const F* difference, Mask<F> clipped, Mask<F> outside, const flow::Ray<F>& ray,
                              const flow::Pixels& p) {
  F turns[flow::max_modulation_frequencies], weight[flow::max_modulation_frequencies];
  F amplitude = F(0.0f), ambient = F(0.0f), weakest = F(3e38f);
  Mask<F> moved = F(1.0f) < F(0.0f);
  const F grey = grey_sum<plain>(s, difference);
  for (int i = 0; i < s.modulations; ++i) {
    const camera::DecodeModulation& m = s.modulation[i];
    const Estimate<F> e = estimate(s, m, difference);
    const Unwiggled<F> known = unwiggle(s, m, e.turns);
    turns[i] = wrapped_turns<plain>(s, i, known.turns, p);
    const F light = grey * F(m.ambient_scale);
    const F variance = variance_of<plain>(s, m, difference, e, known.light, light);
    weight[i] = inverse_variance(m, e, variance, known.slope);
    moved = moved | phases_disagree<F>(s, m, difference, variance);
    amplitude = amplitude + e.amplitude;
    ambient = ambient + light;
    weakest = num::min(weakest, e.amplitude);
  }
  const F per_count = F(1.0f / static_cast<float>(s.modulations));
  const HalfPath<F> half = unwrap(s, turns, weight);
  const F path_length = half.value + half.value;
  const F per_length = ray.inverse_length;
  const Inverse<F> inverse = range_from_path(s, path_length, ray.x * per_length, ray.y * per_length, ray.z * per_length);
  const F sigma = num::abs(inverse.slope) * num::sqrt(half.variance);
  Depth<F> out;
  out.range = inverse.range;
  out.amplitude = amplitude * per_count;
  out.ambient = ambient * per_count;
  out.noise = sigma, out.trust = half.trust;
  const auto nothing = (weakest < F(1.0f)) | (!(path_length * path_length > F(s.light_square)));
  const auto weak = (sigma > F(s.noise_threshold)) | (out.amplitude < F(s.amplitude_threshold)) | (half.trust < F(s.least_trust));
  out.flags = bit<F>(clipped, saturated) | bit<F>(weak, low_signal) | bit<F>(nothing, no_return) | bit<F>(outside, outside_lens) |
              bit<F>(moved, inconsistent_phases) | bit<F>(half.inconsistent, inconsistent_frequencies);
  if (s.rejected != 0) out.flags = out.flags | rejected_bit<F>(s, out.flags);
  return out;
}
template <class F>
TOFRAY_INLINE Depth<F> decode(const camera::DecoderView& s, const F* difference, Mask<F> clipped, Mask<F> outside, const flow::Ray<F>& ray,
                              const flow::Pixels& p) {
  return s.effects != 0 ? decode<false>(s, difference, clipped, outside, ray, p) : decode<true>(s, difference, clipped, outside, ray, p);
}

}  // namespace tofray::depth
