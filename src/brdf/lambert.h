// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "brdf/common.h"

namespace tofray::brdf {

/// Lambert: f_r = ρ/π in every direction.                                                                  [theory: lambert]
struct Lambert {
  template <class Said>
  static MaterialView view(const Said& material) {
    const auto rho = static_cast<float>(material.diffuse);
    return {rho, {}, 0, rho, 0, -1};
  }
  template <class F>
  TOFRAY_INLINE static F f_r(const Finish<F>& of, const Cosines<F>&) {
    return of.reflectivity * F(per_pi);
  }
};

}  // namespace tofray::brdf
