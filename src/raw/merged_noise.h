// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "effect/list.h"
#include "raw/correlation.h"

/// Shot and read noise in one draw.                                                                [theory: merged-noise]
namespace tofray::raw {

using effect::FrameIndex;
using effect::TapWords;

/// Shot and read noise of a tap in one normal z: Cornish and Fisher's expansion of the quantile of Poisson(λ) + Normal(0, σ²), whose third and
/// fourth cumulants are λ. With V = λ + σ² and r = λ/V,
/// N = λ + √V·z + r·((z² − 1)/6 + (z/√V)·((z² − 3)/24 − r·(2z² − 5)/36)).                     [theory: merged-noise]
template <class F>
TOFRAY_INLINE F merged_normal(const effect::SensorView& s, F mean, F z) {
  const F variance = mean + F(s.read_variance), root = num::sqrt(variance), per_root = num::inverse_root(variance, root);
  const F share = mean * (per_root * per_root), square = z * z;
  const F skew = num::fma(square, F(1.0f / 6.0f), F(-1.0f / 6.0f));
  const F skew_squared = num::fma(square, F(1.0f / 18.0f), F(-5.0f / 36.0f));
  const F excess = num::fma(square, F(1.0f / 24.0f), F(-1.0f / 8.0f));
  const F shape = num::fma(z * per_root, num::fnma(share, skew_squared, excess), skew);
  return num::fma(root, z, num::fma(share, shape, mean));
}

template <class F>
TOFRAY_INLINE TapPair<F> expose_merged(const effect::SensorView& s, const TapPair<F>& mean, num::Int<F> pixel, int k, FrameIndex frame,
                                       TapWords<F>& words) {
  const TapPair<F> normal = effect::tap_normals<F>(s, pixel, k, frame, effect::merged, words);
  return {merged_normal(s, mean.a, normal.a), merged_normal(s, mean.b, normal.b)};
}

}  // namespace tofray::raw
