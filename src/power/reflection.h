// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "flow/flow.h"

/// How a surface sends light on.                                                                     [theory: eq. 2.3, 2.4]
namespace tofray::power {

/// f_r [1/sr]: Lambert k_d/π, and the normalised Phong lobe k_s(n+2)/(2π)·max(0, cos α_r)ⁿ about the mirror direction.
/// @param cos_light, cos_view  cosines of the directions to light and camera against the normal
/// @param cos_between          cosine of the angle between these two directions
template <class F>
TOFRAY_FN F reflection(F diffuse, F specular, F exponent, F cos_light, F cos_view, F cos_between) {
  F f_r = diffuse * F(0.318309886f);
  if (num::any(specular > F(0.0f))) {
    // mirror direction of l about n: 2(n·l)n − l; its cosine to v is 2(n·l)(n·v) − l·v
    const F cos_mirror = num::min(num::fma(cos_light * F(2.0f), cos_view, -cos_between), F(1.0f));
    const F lobe = specular * (exponent + F(2.0f)) * F(0.159154943f) * num::power(num::max(cos_mirror, F(0.0f)), exponent);
    f_r = f_r + num::select(specular > F(0.0f), lobe, F(0.0f));
  }
  return f_r;
}

}  // namespace tofray::power
