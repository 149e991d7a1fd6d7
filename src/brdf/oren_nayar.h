// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "brdf/common.h"

namespace tofray::brdf {

/// Oren–Nayar, the qualitative model of 1994: a matt surface of small facets whose slopes spread by σ.            [theory: oren-nayar]
///
///     f_r = ρ/π·(A + B·max(0, cos(φ_i − φ_r))·sin α·tan β),   A = 1 − σ²/(2(σ² + 0.33)),   B = 0.45·σ²/(σ² + 0.09)
///
/// α is the larger, β the smaller of the angles to light and camera. Without an angle: cos(φ_i − φ_r)·sin θ_i·sin θ_r is l·v − cos θ_i·cos θ_r, so
/// that the second term is B·max(0, l·v − cos θ_i·cos θ_r)/max(cos θ_i, cos θ_r).
struct OrenNayar {
  template <class Said>
  static MaterialView view(const Said& material) {
    const double square = material.roughness_rad * material.roughness_rad;
    const double a = 1 - 0.5 * square / (square + 0.33), b = 0.45 * square / (square + 0.09);
    // The model sends back ρ·(A + B/2) of light that grazes, up to 1.015·ρ: beyond all of it, ρ is held.
    const double most = 1 / (a + 0.5 * b), rho = material.diffuse < most ? material.diffuse : most;
    const auto all = static_cast<float>(rho);
    return {all, {static_cast<float>(rho * a), static_cast<float>(rho * b), 0}, 0, all, 2, -1};
  }
  template <class F>
  TOFRAY_INLINE static F f_r(const Finish<F>& of, const Cosines<F>& cosine) {
    const F across = num::max(num::fnma(cosine.light, cosine.view, cosine.between), F(0.0f));
    const F larger = num::max(num::max(cosine.light, cosine.view), F(1e-6f));
    return num::fma(of.number[1], across / larger, of.number[0]) * F(per_pi);
  }
  /// ∫ f_r·cos θ_i dω over the half space, of a surface that is seen at θ: ρ·(A + B·h(θ)),
  ///
  ///     h = (2/π)·(½·sin θ·(θ − sin θ·cos θ) + ⅓·tan θ·(1 − sin³ θ)).                         [theory: oren-nayar-albedo]
  template <class F>
  TOFRAY_INLINE static F albedo(const Finish<F>& of, F cosine) {
    const F c = num::min(num::max(cosine, F(0.0f)), F(1.0f)), s = num::sqrt(num::fnma(c, c, F(1.0f)));
    const F theta = num::atan2_turns(s, c) * F(6.28318531f);
    // tan θ·(1 − sin³ θ) without the pole: sin θ·cos θ·(1 + sin θ + sin² θ)/(1 + sin θ)
    const F beyond = s * c * num::fma(s, s + F(1.0f), F(1.0f)) / (F(3.0f) * (s + F(1.0f)));
    const F h = F(2 * per_pi) * num::fma(F(0.5f) * s, num::fnma(s, c, theta), beyond);
    return num::fma(of.number[1], h, of.number[0]);
  }
};

}  // namespace tofray::brdf
