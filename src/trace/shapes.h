// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "flow/flow.h"
#include "scene/forms.h"

/// One ray of a common origin against one shape: the inverse range w = 1/t of the first hit along d, 0 or less for none.
/// Forms are explained in scene/forms.h.
namespace tofray::trace {

using flow::Ray;
using num::Mask;

template <class F>
TOFRAY_FN F dot(const Ray<F>& ray, const float* m) {
  return num::fma(ray.x, F(m[0]), num::fma(ray.y, F(m[1]), ray.z * F(m[2])));
}

/// Plane: w = d·m with m = n/(n·p).
template <class F>
TOFRAY_FN F inverse_range(const scene::PlaneForm& plane, const Ray<F>& ray) {
  const F w = dot(ray, plane.m);
  return num::select(w > F(plane.horizon), w, F(0.0f));
}

/// Sphere in the stable form (Hearn and Baker; Haines et al. 2019): with b = d·c and l = c − (b/a)d, a = d·d, the discriminant is
/// a(R² − |l|²) without cancellation; q = b ± √disc with the sign of b; roots t = C/q and q/a, C = |c|² − R².
template <class F>
TOFRAY_FN F inverse_range(const scene::SphereForm& sphere, const Ray<F>& ray) {
  const F b = dot(ray, sphere.c);
  const F k = b * (ray.inverse_length * ray.inverse_length);
  const F lx = num::fnma(k, ray.x, F(sphere.c[0])), ly = num::fnma(k, ray.y, F(sphere.c[1])), lz = num::fnma(k, ray.z, F(sphere.c[2]));
  const F rest = F(sphere.radius_squared) - num::fma(lx, lx, num::fma(ly, ly, lz * lz));
  const F root = num::sqrt(ray.square * num::max(rest, F(0.0f)));
  const F q = b + num::copy_sign(root, b);
  const F near_w = q * F(sphere.inverse_power);
  if (sphere.inside == 0) return num::select((rest >= F(0.0f)) & (b > F(0.0f)), near_w, F(0.0f));
  // From inside: the far side, t = q/a where d points to the centre, C/q where it points away (q, not b: b is 0 seen from the centre).
  return num::select(q > F(0.0f), ray.square / q, near_w);
}

/// Box by slabs in w; `axis` says through which pair of sides the hit goes.
template <class F>
TOFRAY_FN F inverse_range(const scene::BoxForm& box, const Ray<F>& ray, num::Int<F>& axis) {
  F enter = F(2e30f), leave = F(-2e30f);
  num::Int<F> enter_axis(0), leave_axis(0);
  for (int k = 0; k < 3; ++k) {
    const F d = dot(ray, box.axis[k]);
    const F in = num::fma(d, F(box.near_scale[k]), F(box.near_offset[k]));
    const F out = num::max(d * F(box.far_scale[k][0]), d * F(box.far_scale[k][1]));
    enter_axis = num::select(in < enter, num::Int<F>(k), enter_axis);
    enter = num::min(enter, in);
    leave_axis = num::select(out > leave, num::Int<F>(k), leave_axis);
    leave = num::max(leave, out);
  }
  if (box.inside != 0) {
    axis = leave_axis;
    return leave;
  }
  axis = enter_axis;
  return num::select(enter >= leave, enter, F(0.0f));
}

/// d·(high + low) with twice the working precision (Ogita, Rump and Oishi 2005).
template <class F>
TOFRAY_FN F careful_dot(const Ray<F>& ray, const float* high, const float* low) {
  const F p0 = ray.x * F(high[0]), p1 = ray.y * F(high[1]), p2 = ray.z * F(high[2]);
  const F s1 = p0 + p1, t1 = s1 - p0;
  const F s2 = s1 + p2, t2 = s2 - s1;
  const F error1 = (p0 - (s1 - t1)) + (p1 - t1);
  const F error2 = (s1 - (s2 - t2)) + (p2 - t2);
  const F rounding = num::fma(ray.x, F(high[0]), -p0) + num::fma(ray.y, F(high[1]), -p1) + num::fma(ray.z, F(high[2]), -p2);
  return s2 + ((error1 + error2) + (rounding + dot(ray, low)));
}

/// Triangle: inside where the three d·edge are not negative. Near an edge the sums are taken anew with care, so that neighbours
/// agree about every ray and nothing leaks between them (watertight as in Woop, Benthin and Wald 2013). Where a ray meets a vertex
/// exactly, the signs of all its edges are rounding and may turn round it without end: what is that small (2^-44) counts as inside.
template <class F>
TOFRAY_FN F inverse_range(const scene::TriangleForm& triangle, const Ray<F>& ray) {
  F least = num::min(dot(ray, triangle.edge[0]), num::min(dot(ray, triangle.edge[1]), dot(ray, triangle.edge[2])));
  const F doubt = F(0x1p-21f) * (num::abs(ray.x) + num::abs(ray.y) + num::abs(ray.z));
  if (num::any(num::abs(least) < doubt)) {
    const F e0 = careful_dot(ray, triangle.edge[0], triangle.edge_low[0]);
    const F e1 = careful_dot(ray, triangle.edge[1], triangle.edge_low[1]);
    const F e2 = careful_dot(ray, triangle.edge[2], triangle.edge_low[2]);
    least = num::min(e0, num::min(e1, e2));
  }
  return num::select(least >= doubt * F(-0x1p-23f), dot(ray, triangle.m), F(0.0f));
}

}  // namespace tofray::trace
