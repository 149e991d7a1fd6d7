// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "camera/lens/view.h"
#include "num/elementary.h"

namespace tofray::camera {

/// The radial part g of the model at r² and r'² = r² + c: x·g is what x becomes but for the tangential part.
template <class F>
struct RadialMotion {
  F at;      ///< g(r'²), or g(r²) where `inward`
  F change;  ///< g(r'²) − g(r²)
  num::Mask<F> inward;
};

/// Without a difference of like numbers, of polynomials and their quotient:                       [theory: brown-conrady]
///     p(r'²) − p(r²) = c·(k1 + k2(r² + r'²) + k3(r⁴ + r²r'² + r'⁴))
template <class F>
TOFRAY_INLINE RadialMotion<F> brown_conrady_motion(const ProjectionView& lens, F from, F to, F c) {
  const F squares = num::fma(from, from, num::fma(from, to, to * to)), sum = from + to;
  const F at = num::fma(to, num::fma(to, num::fma(to, F(lens.k3), F(lens.k2)), F(lens.k1)), F(1.0f));
  const F change = c * num::fma(F(lens.k3), squares, num::fma(F(lens.k2), sum, F(lens.k1)));
  const num::Mask<F> never = F(1.0f) < F(0.0f);
  if (lens.k4 == 0 && lens.k5 == 0 && lens.k6 == 0) return {at, change, never};
  const auto below = [&](F square) TOFRAY_LAMBDA {
    return num::fma(square, num::fma(square, num::fma(square, F(lens.k6), F(lens.k5)), F(lens.k4)), F(1.0f));
  };
  const F below_change = c * num::fma(F(lens.k6), squares, num::fma(F(lens.k5), sum, F(lens.k4)));
  const F g = at / below(to);
  // a'/b' − a/b = ((a' − a) − a'/b'·(b' − b))/b
  return {g, num::fnma(g, below_change, change) / below(from), never};
}

/// θ_d = θ(1 + k1θ² + k2θ⁴ + k3θ⁶ + k4θ⁸), g = θ_d/r:                                                    [theory: fisheye]
///     g' − g = ((θ_d' − θ_d)·r − θ_d·(r' − r))/(r·r'),   θ' − θ = atan((r' − r)/(1 + r·r'))
template <class F>
TOFRAY_INLINE RadialMotion<F> fisheye_motion(const ProjectionView& lens, F from, F to, F c) {
  constexpr float turn = 6.2831853f, nothing = 1e-15f;  // so near the axis g is 1
  const F r = num::max(num::sqrt(from), F(nothing)), to_r = num::max(num::sqrt(to), F(nothing));
  const F step = c / (r + to_r), one = F(1.0f);
  const F angle = F(turn) * num::atan2_turns(r, one), to_angle = F(turn) * num::atan2_turns(to_r, one);
  const F turned = F(turn) * num::atan2_turns(step, num::fma(r, to_r, one));
  const F a = angle * angle, b = to_angle * to_angle, cross = angle * to_angle;
  const auto radius = [&](F s, F square) TOFRAY_LAMBDA {
    const F k = num::fma(square, num::fma(square, num::fma(square, F(lens.k4), F(lens.k3)), F(lens.k2)), F(lens.k1));
    return s * num::fma(square, k, one);
  };
  const F distorted = radius(angle, a), to_distorted = radius(to_angle, b);
  // (θ'ⁿ − θⁿ)/(θ' − θ) of n = 3, 5, 7, 9: each is the one before, times θ'², and two more terms
  const F cubes = (a + b) + cross, a2 = a * a, a3 = a2 * a;
  const F fifths = num::fma(cubes, b, a * cross + a2), sevenths = num::fma(fifths, b, a2 * cross + a3);
  const F ninths = num::fma(sevenths, b, a3 * cross + a2 * a2);
  const F slope =
      num::fma(F(lens.k4), ninths, num::fma(F(lens.k3), sevenths, num::fma(F(lens.k2), fifths, num::fma(F(lens.k1), cubes, one))));
  const F change = num::fnma(distorted, step, turned * slope * r) / (r * to_r);
  const num::Mask<F> inward = to < from;
  return {num::select(inward, distorted / r, to_distorted / to_r), change, inward};
}

/// By how much the image of a point moves while the point goes from z·d to z·d + m: project(z·d + m) − project(z·d), u right, v down [px].
///
/// Each term is a product with what x, y or r² change by, so that nothing large cancels: what stands still moves by 0 exactly, and the
/// error within the image is below 3e-7·(1 + z/z')·f·|m|/z', z' = z + m_z, whatever the image's width.
/// With x, y → x', y' = x + a, y + b and r² → r'² = r² + c:
///
///     x'·g(r'²) − x·g(r²) = a·g(r'²) + x·(g(r'²) − g(r²)) = a·g(r²) + x'·(g(r'²) − g(r²))
///     x'y' − xy = x'b + ya
///
/// @return false where it ends behind the camera or outside the lens model; u and v are any number there
template <class F>
TOFRAY_INLINE num::Mask<F> image_motion(const ProjectionView& lens, const flow::Ray<F>& ray, F z, const flow::Direction<F>& m, F& u, F& v) {
  const F depth = z + m.z;
  const auto ahead = depth > F(0.0f);
  const F per_depth = F(1.0f) / num::select(ahead, depth, F(1.0f));
  const F x = ray.x, y = ray.y, a = num::fnma(x, m.z, m.x) * per_depth, b = num::fnma(y, m.z, m.y) * per_depth;
  const F to_x = x + a, to_y = y + b, sum_x = x + to_x, sum_y = y + to_y;
  const F from = num::fma(x, x, y * y), to = num::fma(to_x, to_x, to_y * to_y), c = num::fma(a, sum_x, b * sum_y);
  const RadialMotion<F> g = lens.fisheye != 0 ? fisheye_motion(lens, from, to, c) : brown_conrady_motion(lens, from, to, c);
  const F side_x = num::select(g.inward, to_x, x), side_y = num::select(g.inward, to_y, y);
  const F p1 = F(lens.p1), p2 = F(lens.p2), mixed = F(2.0f) * num::fma(to_x, b, y * a);
  const F across = num::fma(p1, mixed, p2 * num::fma(F(2.0f) * a, sum_x, c)),
          down = num::fma(p2, mixed, p1 * num::fma(F(2.0f) * b, sum_y, c));
  u = F(lens.fx) * (num::fma(a, g.at, side_x * g.change) + across);
  v = F(lens.fy) * (num::fma(b, g.at, side_y * g.change) + down);
  // What comes nearer to the axis was within the model before.
  return ahead & ((to < F(lens.limit)) | (to <= from)) & (num::abs(u) < F(1e30f)) & (num::abs(v) < F(1e30f));
}

}  // namespace tofray::camera
