// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "camera/read_curve.h"
#include "num/philox.h"
#include "raw/correlation.h"

/// From expected electrons to noisy charge.                                                   [theory: eq. 3.6, 3.10, 3.11]
namespace tofray::raw {

using flow::Taps;

using camera::Noise;
using camera::Purpose;
using enum camera::Purpose;

struct FrameIndex {
  std::uint32_t low, high;
};

template <class F>
TOFRAY_FN num::Random4<F> draw(const camera::SensorView& s, num::Int<F> pixel, int raw_frame, FrameIndex frame, Purpose purpose) {
  return num::philox<F>(num::to_uint(pixel), static_cast<std::uint32_t>(raw_frame) | (static_cast<std::uint32_t>(purpose) << 16), frame.low,
                        frame.high, s.keys);
}

/// Means below this are drawn by inversion, those above by the quantile expansion.
constexpr float inversion_limit = 16.0f;

/// Poisson count by inversion: the smallest k with P(N <= k) >= u. Lanes that have `mean` 0 are done at once.
template <class F>
TOFRAY_FN F poisson_by_inversion(F mean, F u) {
  F term = num::exp(-mean), sum = term, count = F(0.0f);
  for (int k = 1; k < 80; ++k) {
    const auto more = u > sum;
    if (!num::any(more)) break;
    count = num::select(more, F(static_cast<float>(k)), count);
    term = term * mean * F(1.0f / static_cast<float>(k));
    sum = sum + term;
  }
  return count;
}

/// Poisson count from a standard normal: Cornish and Fisher's expansion of the quantile with the correction for whole numbers,
/// N = ⌊λ + √λ·z + (z² + 2)/6 − (z + z³/2)/(36√λ)⌋.                                                       [eq. 3.10]
template <class F>
TOFRAY_FN F poisson_by_expansion(F mean, F z) {
  const F held = num::max(mean, F(inversion_limit));
  const F root = num::sqrt(held);
  const F square = z * z;
  const F first = num::fma(root, z, mean) + num::fma(square, F(1.0f / 6.0f), F(1.0f / 3.0f));
  // 1/√λ to 0.2 %, enough for a term below 0.1: a first guess from the exponent, one step of Newton's
  const F guess = num::from_bits(num::to_uint(num::Int<F>(0x5f3759df) - num::to_signed(num::bits(held) >> 1)));
  const F per_root = guess * num::fnma(F(0.5f) * held, guess * guess, F(1.5f));
  const F second = z * num::fma(square, F(-1.0f / 72.0f), F(-1.0f / 36.0f)) * per_root;
  return num::max(num::floor(first + second), F(0.0f));
}

template <class F>
TOFRAY_FN Means<F> expose_apart(const camera::SensorView& s, const Means<F>& mean, num::Int<F> pixel, int k, FrameIndex frame) {
  const num::Random4<F> words = draw<F>(s, pixel, k, frame, shot_and_read);
  F shot_a, shot_b, read_a, read_b;
  num::normal_pair<F>(words.w[0], words.w[1], shot_a, shot_b);
  num::normal_pair<F>(words.w[2], words.w[3], read_a, read_b);
  F a = poisson_by_expansion(mean.a, shot_a), b = poisson_by_expansion(mean.b, shot_b);
  const auto small_a = mean.a < F(inversion_limit), small_b = mean.b < F(inversion_limit);
  // Uniform words: where both counts are small the normals' words are free; where one is, it takes the 28 bits that the normals left.
  const num::Uint<F> left = (words.w[0] << 24) | ((words.w[1] & num::Uint<F>(0x3fu)) << 18) | ((words.w[2] & num::Uint<F>(0xffu)) << 10) |
                            ((words.w[3] & num::Uint<F>(0x3fu)) << 4);
  const auto both = small_a & small_b;
  if (__builtin_expect(num::any(small_a), 1)) {
    const F u = num::uniform<F>(num::select(both, words.w[0], left));
    a = num::select(small_a, poisson_by_inversion<F>(num::select(small_a, mean.a, F(0.0f)), u), a);
  }
  if (__builtin_expect(num::any(small_b), 1)) {
    const F u = num::uniform<F>(num::select(both, words.w[1], left));
    b = num::select(small_b, poisson_by_inversion<F>(num::select(small_b, mean.b, F(0.0f)), u), b);
  }
  return {num::fma(F(s.read_noise), read_a, a), num::fma(F(s.read_noise), read_b, b)};
}

/// Shot and read noise of a tap in one normal z: Cornish and Fisher's expansion of the quantile of Poisson(λ) + Normal(0, σ²), whose third and
/// fourth cumulants are λ. With V = λ + σ² and r = λ/V,
/// N = λ + √V·z + r·((z² − 1)/6 + (z/√V)·((z² − 3)/24 − r·(2z² − 5)/36)).                                 [eq. 3.11]
template <class F>
TOFRAY_FN F merged_normal(const camera::SensorView& s, F mean, F z) {
  const F variance = mean + F(s.read_variance), root = num::sqrt(variance), per_root = num::inverse_root(variance, root);
  const F share = mean * (per_root * per_root), square = z * z;
  const F skew = num::fma(square, F(1.0f / 6.0f), F(-1.0f / 6.0f));
  const F skew_squared = num::fma(square, F(1.0f / 18.0f), F(-5.0f / 36.0f));
  const F excess = num::fma(square, F(1.0f / 24.0f), F(-1.0f / 8.0f));
  const F shape = num::fma(z * per_root, num::fnma(share, skew_squared, excess), skew);
  return num::fma(root, z, num::fma(share, shape, mean));
}

/// Random words of a pixel that serve three raw frames, the first of which has a number that three divides. (No zeros for `block`: they would
/// cost 3 to 5 % of a frame.)
template <class F>
struct TapWords {
  num::Random4<F> block;
  std::int32_t first = -1;  ///< of these raw frames; below 0: nothing is drawn yet
};

/// A normal for each tap of raw frame k. Each of three words has a radius of 24 bits and 8 of an angle, the fourth ten more for each angle.
template <class F>
TOFRAY_FN Means<F> tap_normals(const camera::SensorView& s, num::Int<F> pixel, int k, FrameIndex frame, Purpose purpose,
                               TapWords<F>& words) {
  const int place = k % 3;
  if (words.first != k - place) words.block = draw<F>(s, pixel, k - place, frame, purpose), words.first = k - place;
  const num::Uint<F> radius = words.block.w[place], more = ((words.block.w[3] << (10 * place)) >> 8) & num::Uint<F>(0x00ffc000u);
  Means<F> out;
  num::normal_pair<F>(radius, (radius << 24) | more, out.a, out.b);
  return out;
}

template <class F>
TOFRAY_FN Means<F> expose_merged(const camera::SensorView& s, const Means<F>& mean, num::Int<F> pixel, int k, FrameIndex frame,
                                 TapWords<F>& words) {
  const Means<F> normal = tap_normals<F>(s, pixel, k, frame, merged, words);
  return {merged_normal(s, mean.a, normal.a), merged_normal(s, mean.b, normal.b)};
}

/// Taps of which one holds more than the other before any charge comes.                                     [eq. 3.16]
template <class F>
TOFRAY_FN Means<F> with_unlike_offsets(const camera::SensorView& s, const Means<F>& charge) {
  return {charge.a + F(s.half_offset_mismatch), charge.b - F(s.half_offset_mismatch)};
}

/// Equal charge off both taps: x = min(budget, max(0, min(A, B) − threshold)).                              [eq. 3.7]
template <class F>
TOFRAY_FN F removed_by_suppression(const camera::SensorView& s, const Means<F>& charge) {
  const F excess = num::max(num::min(charge.a, charge.b) - F(s.suppression_threshold), F(0.0f));
  return num::min(excess, F(s.suppression_budget));
}
/// Takes it off; each removal adds its own variance factor²·x.                                             [eq. 3.7]
template <class F>
TOFRAY_FN Means<F> suppress(const camera::SensorView& s, const Means<F>& charge, num::Int<F> pixel, int k, FrameIndex frame,
                            TapWords<F>& words) {
  const F removed = removed_by_suppression(s, charge);
  Means<F> left{charge.a - removed, charge.b - removed};
  if (s.noise != Noise::off && s.suppression_noise > 0 && num::any(removed > F(0.0f))) {
    const Means<F> normal = tap_normals<F>(s, pixel, k, frame, suppression, words);
    const F sigma = F(s.suppression_noise) * num::sqrt(removed);
    left.a = num::fma(sigma, normal.a, left.a), left.b = num::fma(sigma, normal.b, left.b);
  }
  return left;
}

/// A−B of the least and of the most code [e⁻]; the pixel's offset pattern is not in it.
template <class F>
struct CodeReach {
  F least, most;
};
template <class F>
TOFRAY_FN CodeReach<F> reach_of_codes(const camera::SensorView& s, F offset) {
  const F zero = F(s.mid_code) + offset;
  return {-zero * F(s.step), (F(s.max_code) - zero) * F(s.step)};
}
/// A−B without rounding, held to what the codes reach.                                                     [eq. 3.13]
template <class F>
TOFRAY_FN F held_to_codes(const CodeReach<F>& reach, F difference) {
  return num::min(num::max(difference, reach.least), reach.most);
}

/// Full well per tap, and what is read of it. The well comes first: it holds charge, and the curve is that of the amplifier behind. [eq. 3.18]
template <class F>
TOFRAY_FN Means<F> read_charges(const camera::SensorView& s, const Means<F>& charge) {
  return {camera::read_charge(s.read, num::min(charge.a, F(s.full_well))).value,
          camera::read_charge(s.read, num::min(charge.b, F(s.full_well))).value};
}

/// What the taps hold after tap offsets and background suppression, as far as the sensor has them.
template <class F>
TOFRAY_FN void offset_and_suppress(const camera::SensorView& s, num::Int<F> pixel, int k, FrameIndex frame, TapWords<F>& words,
                                   Means<F>& charge) {
  if (s.half_offset_mismatch != 0) charge = with_unlike_offsets(s, charge);
  if (s.suppression_threshold > 0) charge = suppress(s, charge, pixel, k, frame, words);
}

/// The ADC's level of A−B before it is rounded: (A−B)/s + mid + offset.                                     [eq. 3.8]
template <class F>
TOFRAY_FN F level_of(const camera::SensorView& s, F difference, F offset) {
  return num::fma(difference, F(s.per_step), F(s.mid_code) + offset);
}

/// Full well per tap, then A−B through the ADC: DN = round((A−B)/s + mid + offset), held to the code range.   [eq. 3.8]
/// @param charge  what is read of both taps
/// @param reach   of the codes, offset included; asked for where noise is off
/// @param known   a function that says of the taps' difference what it is without noise
template <class F, class Known>
TOFRAY_FN Taps<F> read_out(const camera::SensorView& s, const Means<F>& charge, F offset, const CodeReach<F>& reach, const Known& known) {
  Taps<F> out;
  out.a = num::min(charge.a, F(s.full_read)), out.b = num::min(charge.b, F(s.full_read));
  const F difference = out.a - out.b;
  out.level = num::round_even(level_of(s, difference, offset));
  out.code = num::min(num::max(out.level, F(0.0f)), F(s.max_code));
  out.difference = s.noise == Noise::off ? held_to_codes(reach, known(difference)) : (out.code - F(s.mid_code)) * F(s.step);
  return out;
}

template <class F>
TOFRAY_FN Taps<F> read_out(const camera::SensorView& s, const Means<F>& charge, F offset) {
  return read_out(
      s, charge, offset, reach_of_codes(s, offset), [](F difference) __attribute__((always_inline)) { return difference; });
}

}  // namespace tofray::raw
