// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "camera/views.h"

/// Which cycle: half paths from wrapped phases of one or more modulation frequencies.            [theory: eq. 4.4–4.7]
namespace tofray::depth {

using num::Mask;

template <class F>
struct HalfPath {
  F value;     ///< [m], in [0, R_0)
  F variance;  ///< [m²] 1/Σ(1/σ_i²)
  F trust;     ///< how likely it is on the right cycle, by its own noise: 0…1
  Mask<F> inconsistent;
};

/// How likely one of several cycles is, all of which are as likely before anything is measured: exp(−χ²/2) over the sum of all.    [eq. 4.31]
template <class F>
class Odds {
 public:
  TOFRAY_FN void add(F square) {
    const auto better = square < least_;
    const F ratio = num::exp2(num::abs(square - least_) * F(per_half));
    sum_ = num::select(better, num::fma(sum_, ratio, F(1.0f)), sum_ + ratio);
    least_ = num::select(better, square, least_);
  }
  /// (Where nothing is a number: 0.)
  [[nodiscard]] TOFRAY_FN F of(F square) const {
    const F share = num::exp2((square - least_) * F(per_half)) / sum_;
    return num::select(share >= F(0.0f), num::min(share, F(1.0f)), F(0.0f));
  }

 private:
  static constexpr float per_half = -0.72134752f;  // −1/(2·ln 2)
  F sum_ = F(0.0f), least_ = F(1e30f);
};

/// Half path d_i = R_i(n_i + p_i) of modulation i that lies nearest to `target`.
template <class F>
TOFRAY_FN F nearest_half_path(const camera::DecodeModulation& m, F turns, F target) {
  return F(m.half_wave) * (num::round_even(num::fma(target, F(m.per_half_wave), -turns)) + turns);
}

/// Each cycle of the modulation with the fewest is tried: the others' nearest half paths say how well it fits; the best fit wins. For two
/// modulation frequencies of ratio M : N it is the rule k = round(N·p_2 − M·p_1) of the Chinese remainder theorem, for more the closest point.
/// @param turns  p_i = φ_i/2π in [0, 1)
/// @param weight 1/σ_i² of each half path [1/m²]
template <class F>
TOFRAY_FN HalfPath<F> unwrap(const camera::DecoderView& s, const F* turns, const F* weight) {
  const camera::DecodeModulation& reference = s.modulation[s.reference];
  F best = F(0.0f), least = F(3e38f), square_of_best = F(0.0f);
  Odds<F> odds;
  F all_weights = F(0.0f);
  for (int i = 0; i < s.modulations; ++i) all_weights = all_weights + weight[i];
  const F per_weights = F(1.0f) / all_weights;
  const int cycles = static_cast<int>(reference.cycles);
  for (int n = 0; n < cycles; ++n) {
    const F d = F(reference.half_wave) * (turns[s.reference] + F(static_cast<float>(n)));
    F misfit = F(0.0f), first = F(0.0f), second = F(0.0f);  // second: of the squares, weighted; χ² = Σ w·off² − (Σ w·off)²/Σ w
    for (int i = 0; i < s.modulations; ++i) {
      if (i == s.reference) continue;
      const F off = nearest_half_path(s.modulation[i], turns[i], d) - d;
      misfit = num::fma(off, off, misfit);
      first = num::fma(weight[i], off, first), second = num::fma(weight[i] * off, off, second);
    }
    const F square = num::max(num::fnma(first * per_weights, first, second), F(0.0f));
    if (cycles > 1) odds.add(num::min(square, F(1e30f)));
    square_of_best = num::select(misfit < least, square, square_of_best);
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
  return {mean, variance, cycles > 1 ? odds.of(num::min(square_of_best, F(1e30f))) : F(1.0f), inconsistent};
}

}  // namespace tofray::depth
