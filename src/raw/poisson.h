// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "effect/list.h"
#include "raw/correlation.h"

/// Poisson counts and read noise, drawn apart.                                  [theory: charge-order, poisson-quantile]
namespace tofray::raw {

using effect::draw;
using effect::FrameIndex;

/// Means below this are drawn by inversion, those above by the quantile expansion.
constexpr float inversion_limit = 16.0f;

/// Poisson count by inversion: the smallest k with P(N <= k) >= u. Lanes that have `mean` 0 are done at once.
template <class F>
TOFRAY_INLINE F poisson_by_inversion(F mean, F u) {
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
/// N = ⌊λ + √λ·z + (z² + 2)/6 − (z + z³/2)/(36√λ)⌋.                                       [theory: poisson-quantile]
template <class F>
TOFRAY_INLINE F poisson_by_expansion(F mean, F z) {
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
TOFRAY_INLINE TapPair<F> expose_apart(const effect::SensorView& s, const TapPair<F>& mean, num::Int<F> pixel, int k, FrameIndex frame) {
  const num::Random4<F> words = draw<F>(s, pixel, k, frame, effect::shot_and_read);
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

}  // namespace tofray::raw
