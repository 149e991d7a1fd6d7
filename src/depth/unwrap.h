// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "camera/decoder/view.h"

/// Which cycle: half paths from wrapped phases of one or more modulation frequencies.
///                                                   [theory: half-path, two-frequency-unwrapping, unwrapping, fusion]
namespace tofray::depth {

using num::Mask;

template <class F>
struct HalfPath {
  F value;     ///< [m], in [0, R_0)
  F variance;  ///< [m²] 1/Σ(1/σ_i²)
  F trust;     ///< how likely it is on the right cycle, by its own noise: 0…1
  Mask<F> inconsistent;
};

/// How likely one of several cycles is, all of which are as likely before anything is measured: exp(−χ²/2) over the sum of all.
///                                                                                                               [theory: cycle-likelihood]
template <class F>
class Odds {
 public:
  /// @param square  χ² of the first cycle
  TOFRAY_INLINE explicit Odds(F square) : sum_(F(1.0f)), least_(square) {}
  TOFRAY_INLINE void add(F square) {
    const auto better = square < least_;
    const F ratio = num::exp2(num::abs(square - least_) * F(per_half));
    sum_ = num::select(better, num::fma(sum_, ratio, F(1.0f)), sum_ + ratio);
    least_ = num::select(better, square, least_);
  }
  /// (Where nothing is a number: 0.)
  [[nodiscard]] TOFRAY_INLINE F of(F square) const {
    const bool of_least = num::all(square == least_);  // mostly: then nothing is to be computed
    const F share = (of_least ? F(1.0f) : num::exp2((square - least_) * F(per_half))) / sum_;
    return num::select(share >= F(0.0f), num::min(share, F(1.0f)), F(0.0f));
  }

 private:
  static constexpr float per_half = -0.72134752f;  // −1/(2·ln 2)
  F sum_, least_;
};

/// Half path d_i = R_i(n_i + p_i) of modulation i that lies nearest to `target`.
template <class F>
TOFRAY_INLINE F nearest_half_path(const camera::DecodeModulation& m, F turns, F target) {
  return F(m.half_wave) * (num::round_even(num::fma(target, F(m.per_half_wave), -turns)) + turns);
}

/// χ² of the cycle that the half path d of the reference stands for: Σ w·off² − (Σ w·off)²/Σ w.            [theory: cycle-likelihood]
template <class F>
TOFRAY_INLINE F square_of_cycle(const camera::DecoderView& s, const F* turns, const F* weight, F per_weights, F d) {
  F first = F(0.0f), second = F(0.0f);
  for (int i = 0; i < s.modulations; ++i) {
    if (i == s.reference) continue;
    const F off = nearest_half_path(s.modulation[i], turns[i], d) - d;
    first = num::fma(weight[i], off, first), second = num::fma(weight[i] * off, off, second);
  }
  return num::min(num::max(num::fnma(first * per_weights, first, second), F(0.0f)), F(1e30f));
}
template <class F>
TOFRAY_INLINE F share_of_cycle(const camera::DecoderView& s, const F* turns, const F* weight, F per_weights, F best) {
  const camera::DecodeModulation& reference = s.modulation[s.reference];
  const F half_wave = F(reference.half_wave), first = half_wave * turns[s.reference];
  const F of_first = square_of_cycle(s, turns, weight, per_weights, first);
  F of_best = of_first;  // unless another one is the best
  Odds<F> odds(of_first);
  for (int n = 1; n < static_cast<int>(reference.cycles); ++n) {
    const F d = half_wave * (turns[s.reference] + F(static_cast<float>(n)));
    const F square = square_of_cycle(s, turns, weight, per_weights, d);
    of_best = num::select(d == best, square, of_best);
    odds.add(square);
  }
  return odds.of(of_best);
}
/// How likely the best cycle is. Mostly the next one is so far off that no float tells it from sure: with the misfits m = Σ off²,
/// χ² ≥ m·w_ref·min w/Σ w of the others, and at most m·max w of the best.
/// @param least, next  misfits of the best and of the next one
template <class F>
TOFRAY_INLINE F trust_in_cycle(const camera::DecoderView& s, const F* turns, const F* weight, F per_weights, F best, F least, F next) {
  constexpr float sure = 40;  // e^−20 of all
  F low = F(3e38f), high = F(0.0f);
  for (int i = 0; i < s.modulations; ++i) {
    if (i != s.reference) low = num::min(low, weight[i]), high = num::max(high, weight[i]);
  }
  const Mask<F> is_sure = num::fnma(least, high, next * (low * (weight[s.reference] * per_weights))) > F(sure);
  if (num::all(is_sure)) return F(1.0f);
  return num::select(is_sure, F(1.0f), share_of_cycle<F>(s, turns, weight, per_weights, best));
}

/// Each cycle of the modulation with the fewest is tried: the others' nearest half paths say how well it fits; the best fit wins. For two
/// modulation frequencies of ratio M : N it is the rule k = round(N·p_2 − M·p_1) of the Chinese remainder theorem, for more the closest point.
/// @param turns  p_i = φ_i/2π in [0, 1)
/// @param weight 1/σ_i² of each half path [1/m²]
template <class F>
TOFRAY_INLINE HalfPath<F> unwrap(const camera::DecoderView& s, const F* turns, const F* weight) {
  const camera::DecodeModulation& reference = s.modulation[s.reference];
  F best = F(0.0f), least = F(3e38f), next = F(3e38f);  // next: of the misfits, after the least
  const int cycles = static_cast<int>(reference.cycles);
  for (int n = 0; n < cycles; ++n) {
    const F d = F(reference.half_wave) * (turns[s.reference] + F(static_cast<float>(n)));
    F misfit = F(0.0f);
    for (int i = 0; i < s.modulations; ++i) {
      if (i == s.reference) continue;
      const F off = nearest_half_path(s.modulation[i], turns[i], d) - d;
      misfit = num::fma(off, off, misfit);
    }
    next = num::min(next, num::max(misfit, least));
    best = num::select(misfit < least, d, best);
    least = num::min(misfit, least);
  }
  // weighted mean first, then back into the common range
  F weights = F(0.0f), sum = F(0.0f);
  Mask<F> inconsistent = F(1.0f) < F(0.0f);
  for (int i = 0; i < s.modulations; ++i) {
    const F d = nearest_half_path(s.modulation[i], turns[i], best);
    weights = weights + weight[i];
    sum = num::fma(weight[i], d - best, sum);
    // apart² > k²(σ_i² + σ_ref²), without a division
    const F apart = num::abs(d - best), reference_weight = weight[s.reference];
    const F significance = apart * apart * (weight[i] * reference_weight);
    inconsistent =
        inconsistent | ((apart > F(s.multipath_limit)) & (significance > F(s.multipath_factor) * (weight[i] + reference_weight)));
  }
  const F variance = F(1.0f) / weights;
  F mean = num::fma(sum, variance, best);
  mean = num::fnma(num::floor(mean * F(s.per_common_range)), F(s.common_range), mean);
  mean = num::select(mean < F(0.0f), mean + F(s.common_range), mean);
  mean = num::select(mean >= F(s.common_range), mean - F(s.common_range), mean);
  return {mean, variance, cycles > 1 ? trust_in_cycle(s, turns, weight, variance, best, least, next) : F(1.0f), inconsistent};
}

}  // namespace tofray::depth
