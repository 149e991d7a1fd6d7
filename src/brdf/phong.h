// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "brdf/around.h"

namespace tofray::brdf {

/// Lambert k_d/π, and the normalised Phong lobe k_s(n+2)/(2π)·max(0, cos α_r)ⁿ about the mirror direction.      [theory: phong]
struct Phong {
  template <class Said>
  static MaterialView view(const Said& material) {
    const auto diffuse = static_cast<float>(material.diffuse), specular = static_cast<float>(material.specular);
    return {diffuse + specular, {diffuse, specular, static_cast<float>(material.exponent)}, 0, diffuse, 1, -1};
  }
  template <class F>
  TOFRAY_INLINE static F f_r(const Finish<F>& of, const Cosines<F>& cosine) {
    const F diffuse = of.number[0], specular = of.number[1], exponent = of.number[2];
    const F lobe = specular * (exponent + F(2.0f)) * F(0.5f * per_pi) * shine(exponent, cosine);
    return diffuse * F(per_pi) + lobe;
  }
  /// Ways out of cosⁿ about the view's mirror direction m, of the density (n + 1)/(2π)·max(0, l·m)ⁿ: l·m is (1 − u)^(1/(n+1)), and
  /// |l − m|² = 2 − 2·l·m.                                                                           [theory: phong-sampling]
  template <class F>
  TOFRAY_INLINE static F lobe_share(const Finish<F>& of, F) {
    return of.number[1] / num::max(of.number[0] + of.number[1], F(1e-30f));
  }
  template <class F>
  TOFRAY_INLINE static Direction<F> lobe_way(const Finish<F>& of, const Directions<F>& d, F u, F v) {
    const F exponent = num::log(F(1.0f) - u) / (of.number[2] + F(1.0f));
    return beside(mirrored(d.view, d.normal), F(2.0f) * one_minus_exp(exponent), v);
  }
  template <class F>
  TOFRAY_INLINE static F lobe_pdf(const Finish<F>& of, const Cosines<F>& cosine, const Directions<F>&) {
    return (of.number[2] + F(1.0f)) * F(0.5f * per_pi) * shine(of.number[2], cosine);
  }

 private:
  template <class F>
  TOFRAY_INLINE static F shine(F exponent, const Cosines<F>& cosine) {
    // mirror direction of l about n: 2(n·l)n − l; its cosine to v is 2(n·l)(n·v) − l·v
    const F mirror = num::min(num::fma(cosine.light * F(2.0f), cosine.view, -cosine.between), F(1.0f));
    return num::power(num::max(mirror, F(0.0f)), exponent);
  }
  /// 1 − eᵃ for a <= 0, good however small it is: to 2e-7 near 0 and 4e-7 beyond. The series' next term is a⁶/5040 of it.
  template <class F>
  TOFRAY_INLINE static F one_minus_exp(F a) {
    F series = num::fma(a, F(1.0f / 720), F(1.0f / 120));
    series = num::fma(a, series, F(1.0f / 24));
    series = num::fma(a, series, F(1.0f / 6));
    series = num::fma(a, series, F(0.5f));
    series = num::fma(a, series, F(1.0f));
    return num::select(a > F(-0.25f), -a * series, F(1.0f) - num::exp(a));
  }
};

}  // namespace tofray::brdf
