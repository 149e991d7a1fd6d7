// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "camera/light/view.h"

/// The printed formula of "Time optimization for simulation of PMD 3D camera", for comparison only; docs/theory lists its faults.
namespace tofray::power {

/// L = ρ·I·cosθ/(π r²) with the table looked up from the wrong side: the direction is that from surface to light, the azimuth loses its
/// quadrant, no origin is added to the indices, and those outside the table count as dark.       [theory: paper-formula]
template <class F>
TOFRAY_INLINE F paper_radiance(const camera::LightView& light, const flow::Surface<F>& p, num::Mask<F> lit) {
  const camera::PatternView& table = light.pattern;
  const F x = F(light.position[0]) - p.x, y = F(light.position[1]) - p.y, z = F(light.position[2]) - p.z;
  const F square = num::fma(x, x, num::fma(y, y, z * z));
  const F per_length = F(1.0f) / num::sqrt(num::max(square, F(1e-18f)));
  const F cosine = num::fma(p.nx, x, num::fma(p.ny, y, p.nz * z)) * per_length;
  // arctan of a quotient: a quarter turn where the divisor is 0, NaN (dark) where both are
  const F across = num::sqrt(num::fma(x, x, y * y));
  const F inclination = num::copy_sign(num::atan2_turns(num::abs(z), across), z) * F(360.0f);
  const F azimuth_magnitude = num::atan2_turns(num::abs(x), num::abs(y));
  const F azimuth = num::copy_sign(azimuth_magnitude, num::copy_sign(F(1.0f), x) * num::copy_sign(F(1.0f), y));
  F sine, cosine_azimuth;
  num::sincos_turns(azimuth, sine, cosine_azimuth);
  const F row = inclination * sine * F(168.0f / (2.0f * 43.0f)), column = inclination * cosine_azimuth * F(172.0f / (2.0f * 42.0f));
  const F last_row = F(static_cast<float>(table.rows - 1)), last_column = F(static_cast<float>(table.columns - 1));
  const auto within = (row > F(-1.0f)) & (row < last_row + F(1.0f)) & (column > F(-1.0f)) & (column < last_column + F(1.0f)) &
                      ((num::abs(x) > F(0.0f)) | (num::abs(y) > F(0.0f)));
  const num::Int<F> r = num::to_int(num::min(num::max(row, F(0.0f)), last_row));
  const num::Int<F> c = num::to_int(num::min(num::max(column, F(0.0f)), last_column));
  const F radiant = num::gather(table.samples, r * num::Int<F>(table.columns) + c);
  const F radiance = p.finish.reflectivity * F(0.318309886f) * radiant * num::max(cosine, F(0.0f)) * (per_length * per_length);
  return num::select(lit & within, num::min(radiance, F(flow::max_irradiance)), F(0.0f));
}

}  // namespace tofray::power
