// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "brdf/common.h"

namespace tofray::brdf {

/// Lambert k_d/π, and the normalised Phong lobe k_s(n+2)/(2π)·max(0, cos α_r)ⁿ about the mirror direction.    [theory: eq. 2.4]
struct Phong {
  template <class Said>
  static MaterialView view(const Said& material) {
    const auto diffuse = static_cast<float>(material.diffuse), specular = static_cast<float>(material.specular);
    return {diffuse + specular, {diffuse, specular, static_cast<float>(material.exponent)}, 0, diffuse, 1, -1};
  }
  template <class F>
  TOFRAY_FN static F f_r(const Finish<F>& of, const Cosines<F>& cosine) {
    const F diffuse = of.number[0], specular = of.number[1], exponent = of.number[2];
    // mirror direction of l about n: 2(n·l)n − l; its cosine to v is 2(n·l)(n·v) − l·v
    const F mirror = num::min(num::fma(cosine.light * F(2.0f), cosine.view, -cosine.between), F(1.0f));
    const F lobe = specular * (exponent + F(2.0f)) * F(0.159154943f) * num::power(num::max(mirror, F(0.0f)), exponent);
    return diffuse * F(per_pi) + lobe;
  }
};

}  // namespace tofray::brdf
