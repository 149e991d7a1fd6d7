// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cmath>

#include "brdf/common.h"

namespace tofray::brdf {

/// GGX: small mirrors whose slopes spread by α, over a matt ground.                                          [theory: eq. 2.16, 2.17]
///
///     f_r = D·V·F + (28/23)·(k_d/π)·(1 − F_0)·(1 − (1 − n·l/2)⁵)·(1 − (1 − n·v/2)⁵)
///
/// With s = l + v, C = (n·s)² and T = |s|² − C, the half vector's D = α²/(π·((n·h)²(α² − 1) + 1)²) is α²·(C + T)²/(π·(α²C + T)²), which
/// loses no digits however narrow the lobe is. V = 1/(2·(n·l·m(n·v) + n·v·m(n·l))) with m(μ) = √(α² + (1 − α²)·μ²) is Smith's masking,
/// correlated in height, over 4·n·l·n·v. F = F_0 + (1 − F_0)·(1 − |s|/2)⁵, since |s|/2 = l·h.
struct Ggx {
  template <class Said>
  static MaterialView view(const Said& material) {
    const double alpha = material.alpha, f0 = material.specular, ground = 28.0 / 23.0 * (1 - f0) * material.diffuse;
    // At normal incidence the ground sends back 23/28·(1 − 1/32) of its factor.
    const double matt = ground * 23 / 28 * 31 / 32, all = matt + lobe_reflectivity(alpha, f0);
    return {static_cast<float>(all),
            {static_cast<float>(ground), static_cast<float>(f0), static_cast<float>(alpha * alpha)},
            0,
            static_cast<float>(matt),
            1,
            -1};
  }
  template <class F>
  TOFRAY_FN static F f_r(const Finish<F>& of, const Cosines<F>& cosine, const Directions<F>& directions) {
    const F ground = of.number[0], f0 = of.number[1], square = of.number[2], along = cosine.light + cosine.view;
    const F c = along * along, slant = squared_slant(directions, along), sum = c + slant;
    const F spread = sum / num::max(num::fma(square, c, slant), F(1e-18f));
    const F masks = num::fma(cosine.light, masked(square, cosine.view), cosine.view * masked(square, cosine.light));
    const F d_v = F(0.5f * per_pi) * square * (spread * spread) / num::max(masks, F(1e-18f));
    const F fresnel = num::fma(F(1.0f) - f0, fifth_power(num::max(num::fnma(F(0.5f), num::sqrt(sum), F(1.0f)), F(0.0f))), f0);
    return num::fma(d_v, fresnel, ground * F(per_pi) * (passed(cosine.light) * passed(cosine.view)));
  }

 private:
  template <class F>
  TOFRAY_FN static F masked(F square, F cosine) {
    return num::sqrt(num::fma(F(1.0f) - square, cosine * cosine, square));
  }
  template <class F>
  TOFRAY_FN static F passed(F cosine) {
    return F(1.0f) - fifth_power(num::fnma(F(0.5f), cosine, F(1.0f)));
  }
  /// ∫ D·V·F·cosθ dω at normal incidence: over the share u of D's slopes, tan²θ_h = α²·u/(1 − u), it is ∫ 4·F·V·n·l du.
  static double lobe_reflectivity(double alpha, double f0) {
    const int steps = 2000;
    const double square = alpha * alpha;
    double sum = 0;
    for (int i = 0; i < steps; ++i) {
      const double u = (i + 0.5) / steps, slope = square * u / (1 - u), light = (1 - slope) / (1 + slope);
      if (light <= 0) break;
      const double fresnel = f0 + (1 - f0) * fifth_power(1 - 1 / ::sqrt(1 + slope));
      sum += 2 * fresnel * light / (light + ::sqrt(square + (1 - square) * light * light));
    }
    return sum / steps;
  }
};

}  // namespace tofray::brdf
