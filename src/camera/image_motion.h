// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "camera/views.h"

namespace tofray::camera {

/// By how much the image of a point moves while the point goes from z·d to z·d + m: project(z·d + m) − project(z·d), u right, v down [px].
///
/// Each term is a product with what x, y or r² change by, so that nothing large cancels: what stands still moves by 0 exactly, and the
/// error within the image is below 3e-7·(1 + z/z')·f·|m|/z', z' = z + m_z, whatever the image's width.
/// With x, y → x', y' = x + a, y + b and r² → r'² = r² + c:
///
///     x'·g(r'²) − x·g(r²) = a·g(r'²) + x·c·(k1 + k2(r² + r'²) + k3(r⁴ + r²r'² + r'⁴)),   g(s) = 1 + k1·s + k2·s² + k3·s³
///     x'y' − xy = x'b + ya
///
/// @return false where it ends behind the camera or outside the lens model; u and v are any number there
template <class F>
TOFRAY_FN num::Mask<F> image_motion(const ProjectionView& lens, const flow::Ray<F>& ray, F z, const flow::Direction<F>& m, F& u, F& v) {
  const F depth = z + m.z;
  const auto ahead = depth > F(0.0f);
  const F per_depth = F(1.0f) / num::select(ahead, depth, F(1.0f));
  const F x = ray.x, y = ray.y, a = num::fnma(x, m.z, m.x) * per_depth, b = num::fnma(y, m.z, m.y) * per_depth;
  const F to_x = x + a, to_y = y + b, sum_x = x + to_x, sum_y = y + to_y;
  const F from = num::fma(x, x, y * y), to = num::fma(to_x, to_x, to_y * to_y), c = num::fma(a, sum_x, b * sum_y);
  const F k1 = F(lens.k1), k2 = F(lens.k2), k3 = F(lens.k3), p1 = F(lens.p1), p2 = F(lens.p2);
  const F radial = num::fma(to, num::fma(to, num::fma(to, k3, k2), k1), F(1.0f));
  const F squares = num::fma(from, from, num::fma(from, to, to * to));
  const F more = c * num::fma(k3, squares, num::fma(k2, from + to, k1));
  const F mixed = F(2.0f) * num::fma(to_x, b, y * a);
  const F across = num::fma(p1, mixed, p2 * num::fma(F(2.0f) * a, sum_x, c)),
          down = num::fma(p2, mixed, p1 * num::fma(F(2.0f) * b, sum_y, c));
  u = F(lens.fx) * (num::fma(a, radial, x * more) + across);
  v = F(lens.fy) * (num::fma(b, radial, y * more) + down);
  // What comes nearer to the axis was within the model before.
  return ahead & ((to < F(lens.limit)) | (to <= from)) & (num::abs(u) < F(1e30f)) & (num::abs(v) < F(1e30f));
}

}  // namespace tofray::camera
