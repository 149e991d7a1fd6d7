// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cmath>

#include "brdf/around.h"

namespace tofray::brdf {

/// A retro-reflector, such as a road sign's sheet: Lambert k_d/π, and a lobe of the share k_r back toward the light.
///                                                                                                              [theory: retro-reflector]
///
///     f_r = k_d/π + k_r/(π·w²·(1 + |l − v|²/w²)²·max(n·l, n·v)),   w² = 4·sin²(σ/2)/(√2 − 1)
///
/// σ, the spread, is the angle between light and camera at which half of the peak is left. ∫ dω/(π·w²·(1 + |l − v|²/w²)²) over all
/// directions is 1/(1 + w²/4), so that k_d + k_r of the light comes back at most.
struct Retro {
  template <class Said>
  static MaterialView view(const Said& material) {
    const double half = ::sin(0.5 * material.spread_rad), width = 4 * half * half / 0.41421356237309503;
    const auto diffuse = static_cast<float>(material.diffuse), peak = static_cast<float>(0.31830988618379067 * material.retro / width);
    return {static_cast<float>(material.diffuse + material.retro), {diffuse, peak, static_cast<float>(1 / width)}, 0, diffuse, 1, -1};
  }
  template <class F>
  TOFRAY_INLINE static F f_r(const Finish<F>& of, const Cosines<F>& cosine, const Directions<F>& directions) {
    const F larger = num::max(num::max(cosine.light, cosine.view), F(1e-6f));
    return num::fma(of.number[0], F(per_pi), of.number[1] / (fall(of, directions) * larger));
  }
  /// Ways out of the lobe about the view, of the density (1/w² + ¼)/(π·(1 + |l − v|²/w²)²): |l − v|² = u/((1 − u)/w² + ¼).
  ///                                                                                                [theory: retro-sampling]
  template <class F>
  TOFRAY_INLINE static F lobe_share(const Finish<F>& of, F) {
    const F back = of.number[1] * F(3.14159265f) / (of.number[2] + F(0.25f));  // k_r/(1 + w²/4)
    return back / num::max(of.number[0] + back, F(1e-30f));
  }
  template <class F>
  TOFRAY_INLINE static Direction<F> lobe_way(const Finish<F>& of, const Directions<F>& d, F u, F v) {
    return beside(d.view, u / num::fma(F(1.0f) - u, of.number[2], F(0.25f)), v);
  }
  template <class F>
  TOFRAY_INLINE static F lobe_pdf(const Finish<F>& of, const Cosines<F>&, const Directions<F>& directions) {
    return (of.number[2] + F(0.25f)) * F(per_pi) / fall(of, directions);
  }

 private:
  /// (1 + |l − v|²/w²)²
  template <class F>
  TOFRAY_INLINE static F fall(const Finish<F>& of, const Directions<F>& directions) {
    const F root = num::fma(squared_gap(directions), of.number[2], F(1.0f));
    return root * root;
  }
};

}  // namespace tofray::brdf
