// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "camera/light/view.h"

/// Radiant intensity of a light source: I(θx, θy) = P·î, ∫î dω = 1.                          [theory: radiant-intensity]
namespace tofray::power {

/// Angles θx = θ·cos ψ = (θ/sin θ)·x, θy = θ·sin ψ of a direction (f-theta) [rad].
template <class F>
struct Angles {
  F x, y;
};
template <class F>
TOFRAY_INLINE Angles<F> f_theta(F x, F y, F z) {
  constexpr float turn = 6.28318531f;
  const F square = num::fma(x, x, y * y);
  const auto near = (z > F(0.0f)) & (square <= z * z);  // θ <= π/4: where a light is aimed
  const F per_z = F(1.0f) / num::select(near, z, F(1.0f));
  F stretch = F(turn) * num::atan_share(square * per_z * per_z) * per_z;
  if (!num::all(near)) {
    const F sine = num::sqrt(square);
    stretch = num::select(near, stretch, num::atan2_turns(sine, z) * F(turn) / num::max(sine, F(1e-30f)));
  }
  return {x * stretch, y * stretch};
}

/// Half its peak at the edges of a rectangle, exp(−ln2·(u⁸ + v⁸)); 0 beyond the table's range.
template <class F>
TOFRAY_INLINE F flat_top_intensity(const camera::PatternView& p, const Angles<F>& theta) {
  const F u = theta.x * F(p.per_half_width), v = theta.y * F(p.per_half_height);
  const F u2 = u * u, v2 = v * v, u4 = u2 * u2, v4 = v2 * v2;
  return F(p.peak) * num::exp2(-num::fma(u4, u4, v4 * v4));
}

/// Bilinear between cell centres, clamped in the outer half cell.
template <class F>
TOFRAY_INLINE F table_intensity(const camera::PatternView& p, const Angles<F>& theta) {
  const F last_x = F(static_cast<float>(p.columns - 1)), last_y = F(static_cast<float>(p.rows - 1));
  const F u = num::min(num::max(num::fma(theta.x + F(p.half_range_x), F(p.per_rad_x), F(-0.5f)), F(0.0f)), last_x);
  const F v = num::min(num::max(num::fma(theta.y + F(p.half_range_y), F(p.per_rad_y), F(-0.5f)), F(0.0f)), last_y);
  const F column = num::min(num::floor(u), last_x - F(1.0f)), row = num::min(num::floor(v), last_y - F(1.0f));
  const num::Int<F> at = num::to_int(row) * num::Int<F>(p.columns) + num::to_int(column);
  const F a = num::gather(p.samples, at), b = num::gather(p.samples + 1, at);
  const F c = num::gather(p.samples + p.columns, at), d = num::gather(p.samples + p.columns + 1, at);
  const F right = u - column, down = v - row;
  const F top = num::fma(right, b - a, a), bottom = num::fma(right, d - c, c);
  return num::fma(down, bottom - top, top);
}

/// I [W/sr] along the direction (x, y, z) in the camera frame, of any length.
template <class F>
TOFRAY_INLINE F intensity(const camera::LightView& light, F x, F y, F z, F inverse_length) {
  F u = x, v = y, w = z;
  if (light.turned != 0) {
    const float(*m)[3] = light.rotation;
    u = num::fma(x, F(m[0][0]), num::fma(y, F(m[0][1]), z * F(m[0][2])));
    v = num::fma(x, F(m[1][0]), num::fma(y, F(m[1][1]), z * F(m[1][2])));
    w = num::fma(x, F(m[2][0]), num::fma(y, F(m[2][1]), z * F(m[2][2])));
  }
  const camera::PatternView& p = light.pattern;
  if (p.kind == camera::PatternView::table || p.kind == camera::PatternView::flat_top) {
    const Angles<F> theta = f_theta(u, v, w);
    // straight back the angle is half a turn, but in no direction: dark, not the axis
    const auto ahead = (w > F(0.0f)) | (num::max(num::abs(u), num::abs(v)) > F(1e-30f));
    const auto within = (num::abs(theta.x) <= F(p.half_range_x)) & (num::abs(theta.y) <= F(p.half_range_y)) & ahead;
    const F inside = p.kind == camera::PatternView::table ? table_intensity(p, theta) : flat_top_intensity(p, theta);
    return num::select(within, inside, F(0.0f));
  }
  const F cosine = w * inverse_length;
  if (p.kind == camera::PatternView::cone) return num::select(cosine >= F(p.cos_half_angle), F(p.peak), F(0.0f));
  // an exponent of 0 shines evenly, but forward only
  return num::select(cosine > F(0.0f), F(p.peak) * num::power(num::max(cosine, F(0.0f)), F(p.exponent)), F(0.0f));
}

}  // namespace tofray::power
