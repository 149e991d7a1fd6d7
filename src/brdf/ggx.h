// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cmath>

#include "brdf/around.h"

namespace tofray::brdf {

/// GGX: small mirrors whose slopes spread by α, over a matt ground.                                        [theory: ggx, ggx-masking]
///
///     f_r = D·V·F + (28/23)·(k_d/π)·(1 − F_0)·(1 − (1 − n·l/2)⁵)·(1 − (1 − n·v/2)⁵)
///
/// With s = l + v, C = (n·s)² and T = |s|² − C, the half vector's D = α²/(π·((n·h)²(α² − 1) + 1)²) is α²·(C + T)²/(π·(α²C + T)²), which
/// loses no digits however narrow the lobe is. V = 1/(2·(n·l·m(n·v) + n·v·m(n·l))) with m(μ) = √(α² + (1 − α²)·μ²) is Smith's masking,
/// correlated in height, over 4·n·l·n·v. F = F_0 + (1 − F_0)·(1 − |s|/2)⁵, since |s|/2 = l·h.
struct Ggx {
  template <class Said>
  static MaterialView view(const Said& material) {
    return view(material.diffuse, material.specular, material.alpha, lobe_reflectivity(material.alpha, material.specular));
  }
  /// @param lobe  lobe_reflectivity() of α and F_0
  static MaterialView view(double diffuse, double f0, double alpha, double lobe) {
    const double ground = 28.0 / 23.0 * (1 - f0) * diffuse;
    // At normal incidence the ground sends back 23/28·(1 − 1/32) of its factor.
    const double matt = ground * 23 / 28 * 31 / 32;
    return {static_cast<float>(matt + lobe),
            {static_cast<float>(ground), static_cast<float>(f0), static_cast<float>(alpha * alpha)},
            0,
            static_cast<float>(matt),
            1,
            -1};
  }
  /// ∫ D·V·F·cosθ dω at normal incidence: over the share u of D's slopes, tan²θ_h = α²·u/(1 − u), it is ∫ 4·F·V·n·l du. Linear in F_0.
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
  template <class F>
  TOFRAY_INLINE static F f_r(const Finish<F>& of, const Cosines<F>& cosine, const Directions<F>& directions) {
    const F ground = of.number[0], square = of.number[2];
    const Half<F> half = half_of(square, cosine, directions);
    const F masks = num::fma(cosine.light, masked(square, cosine.view), cosine.view * masked(square, cosine.light));
    const F d_v = half.density / num::max(masks, F(1e-18f));
    return num::fma(d_v, reflected(of.number[1], F(0.5f) * num::sqrt(half.square)),
                    ground * F(per_pi) * (passed(cosine.light) * passed(cosine.view)));
  }
  /// Ways by the mirrors that the view sees, not masked by others [dupuy2023]: where α is 1, their normals are h ∝ v + c, c even over a
  /// cap of the sphere of directions. Their density is D/(2·(n·v + m(n·v))).
  ///
  /// The share is that of F at the view's own cosine, held to a tenth of the ground's, in what both send back about. [theory: ggx-sampling]
  template <class F>
  TOFRAY_INLINE static F lobe_share(const Finish<F>& of, F cos_view) {
    const F ground = of.number[0] * F(23.0f / 28) * passed(cos_view);
    const F mirrors = num::max(num::max(reflected(of.number[1], cos_view), F(0.1f) * ground), F(1e-6f));
    return mirrors / (mirrors + ground);
  }
  template <class F>
  TOFRAY_INLINE static Direction<F> lobe_way(const Finish<F>& of, const Directions<F>& d, F u, F v) {
    const Axes<F> frame = axes_across(d.normal);
    const F alpha = num::sqrt(of.number[2]);
    // The view where α is 1. What follows of it are sums of what is not negative: no digits are lost.
    const Direction<F> seen = unit(Direction<F>{alpha * inner(d.view, frame.x), alpha * inner(d.view, frame.y), inner(d.view, d.normal)});
    const F aside = num::fma(seen.x, seen.x, seen.y * seen.y), up = F(1.0f) + seen.z, z = (F(1.0f) - u) * up;
    const F ring = num::sqrt(u * num::fma(up, z, aside));
    F sine, cosine;
    num::sincos_turns(v, sine, cosine);
    const F x = alpha * num::fma(ring, cosine, seen.x), y = alpha * num::fma(ring, sine, seen.y);
    return mirrored(d.view, sum_of(z, d.normal, sum_of(x, frame.x, y, frame.y)));
  }
  template <class F>
  TOFRAY_INLINE static F lobe_pdf(const Finish<F>& of, const Cosines<F>& cosine, const Directions<F>& directions) {
    const F square = of.number[2];
    return half_of(square, cosine, directions).density / (cosine.view + masked(square, cosine.view));
  }

 private:
  template <class F>
  struct Half {
    F square;   ///< |s|²
    F density;  ///< D/2
  };
  template <class F>
  TOFRAY_INLINE static Half<F> half_of(F square, const Cosines<F>& cosine, const Directions<F>& directions) {
    const F along = cosine.light + cosine.view, c = along * along, slant = squared_slant(directions, along), sum = c + slant;
    const F spread = sum / num::max(num::fma(square, c, slant), F(1e-18f));
    return {sum, F(0.5f * per_pi) * square * (spread * spread)};
  }
  /// F_0 + (1 − F_0)·(1 − μ)⁵
  template <class F>
  TOFRAY_INLINE static F reflected(F f0, F cosine) {
    return num::fma(F(1.0f) - f0, fifth_power(num::max(F(1.0f) - cosine, F(0.0f))), f0);
  }
  template <class F>
  TOFRAY_INLINE static F masked(F square, F cosine) {
    return num::sqrt(num::fma(F(1.0f) - square, cosine * cosine, square));
  }
  template <class F>
  TOFRAY_INLINE static F passed(F cosine) {
    return F(1.0f) - fifth_power(num::fnma(F(0.5f), cosine, F(1.0f)));
  }
};

}  // namespace tofray::brdf
