// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "shape/common.h"

/// Convex polygon of three or four corners in a plane, both sides reflect: what triangle and rectangle share.
namespace tofray::shape {

/// Inside where every d·edge is >= 0; w = d·m. An edge shared by two polygons has exactly opposite numbers in them; edge_low is
/// what rounding took from the unit vector edge.
template <int N>
struct PolygonForm {
  float m[3];
  float edge[N][3], edge_low[N][3];
  std::int32_t facet, object;
  Bounds bounds;
};

/// Inside where every P·edge_i + edge_offset_i is >= 0; t = P·m + c.
template <int N>
struct PolygonAlong {
  float m[3], c, edge[N][3], edge_offset[N];
  std::int32_t object;
  Bounds bounds;  ///< on the light's screen
};

/// For rays from anywhere: the corners.
template <int N>
struct PolygonFree {
  float corner[N][3];
  std::int32_t facet, object;
};

/// The least of what `of` says of each edge.
template <int N, class Of>
TOFRAY_INLINE auto least_of(const Of& of) {
  static_assert(N == 3 || N == 4);
  const auto least = num::min(of(0), num::min(of(1), of(2)));
  if constexpr (N == 3) {
    return least;
  } else {
    return num::min(least, of(3));
  }
}

template <int N>
TOFRAY_INLINE Vec normal_of_corners(const Vec (&v)[N]) {
  return cross(v[1] - v[0], v[2] - v[0]);
}

/// A polygon that is seen edge-on is hit by no ray.
template <int N>
TOFRAY_INLINE PolygonForm<N> polygon_seen_from(const Vec (&corner)[N], const Vec& origin) {
  PolygonForm<N> form{};
  form.bounds = nowhere();
  Vec v[N] = {};
  for (int i = 0; i < N; ++i) v[i] = corner[i] - origin;
  const Vec normal = normal_of_corners(v);
  // The nearest corner gives the plane's offset with the least cancellation.
  int near = 0;
  for (int i = 1; i < N; ++i) near = dot(v[i], v[i]) < dot(v[near], v[near]) ? i : near;
  const double offset = dot(normal, v[near]);
  const double side = offset < 0 ? -1 : 1;
  if (::fabs(offset) <= 1e-9 * length(normal) * length(v[near])) return form;
  copy((1 / offset) * normal, form.m);
  for (int i = 0; i < N; ++i) {
    const Vec across = cross(v[(i + 1) % N], v[(i + 2) % N]);
    const double size = length(across);
    const Vec unit = (size > 0 ? side / size : 0) * across;
    copy(unit, form.edge[i]);
    for (int k = 0; k < 3; ++k) form.edge_low[i][k] = single(unit[k] - static_cast<double>(form.edge[i][k]));
  }
  form.bounds = bounds_of_points(v, N);
  return form;
}

template <int N>
TOFRAY_INLINE bool can_meet(const PolygonForm<N>& polygon, const Bounds& r) {
  bool can = overlap(polygon.bounds, r);
  for (int i = 0; i < N; ++i) can = can && reaches(polygon.edge[i], r);
  return can;
}

/// d·(high + low) with twice the working precision (Ogita, Rump and Oishi 2005).
template <class F>
TOFRAY_INLINE F careful_dot(const Ray<F>& ray, const float* high, const float* low) {
  const F p0 = ray.x * F(high[0]), p1 = ray.y * F(high[1]), p2 = ray.z * F(high[2]);
  const F s1 = p0 + p1, t1 = s1 - p0;
  const F s2 = s1 + p2, t2 = s2 - s1;
  const F error1 = (p0 - (s1 - t1)) + (p1 - t1);
  const F error2 = (s1 - (s2 - t2)) + (p2 - t2);
  const F rounding = num::fma(ray.x, F(high[0]), -p0) + num::fma(ray.y, F(high[1]), -p1) + num::fma(ray.z, F(high[2]), -p2);
  return s2 + ((error1 + error2) + (rounding + dot(ray, low)));
}

/// Inside where no d·edge is negative. Near an edge the sums are taken anew with care, so that neighbours
/// agree about every ray and nothing leaks between them (watertight as in Woop, Benthin and Wald 2013). Where a ray meets a vertex
/// exactly, the signs of all its edges are rounding and may turn round it without end: what is that small (2^-44) counts as inside.
template <int N, class F>
TOFRAY_INLINE F inverse_range(const PolygonForm<N>& polygon, const Ray<F>& ray) {
  F least = least_of<N>([&](int i) TOFRAY_LAMBDA { return dot(ray, polygon.edge[i]); });
  const F doubt = F(0x1p-21f) * (num::abs(ray.x) + num::abs(ray.y) + num::abs(ray.z));
  if (num::any(num::abs(least) < doubt)) {
    least = least_of<N>([&](int i) TOFRAY_LAMBDA { return careful_dot(ray, polygon.edge[i], polygon.edge_low[i]); });
  }
  return num::select(least >= doubt * F(-0x1p-23f), dot(ray, polygon.m), F(0.0f));
}

/// Light from s travels along it, and is not stopped.
TOFRAY_INLINE bool is_along(const Vec& normal, const Vec& s) { return ::fabs(dot(normal, s)) <= 1e-6 * length(normal); }

/// Two edges that rounding has moved outward meet farther out, by one over the sine of their angle: along/(|s × edge|·|s × next|), as the
/// light sees them.
template <int N>
TOFRAY_INLINE double spread_of_corners(const Vec (&v)[N], const Vec& s) {
  const Vec normal = normal_of_corners(v);
  if (is_along(normal, s)) return 1;
  double most = 0;
  for (int i = 0; i < N; ++i) {
    const Vec edge = v[(i + 1) % N] - v[i], next = v[(i + 2) % N] - v[(i + 1) % N];
    most = ::fmax(most, length(cross(s, edge)) * length(cross(s, next)));
  }
  return most / ::fabs(dot(normal, s));
}

/// Where light travels along it, t = 0.
template <int N>
TOFRAY_INLINE PolygonAlong<N> polygon_seen_along(const Vec (&v)[N], const Vec& s) {
  PolygonAlong<N> form{};
  const Vec normal = normal_of_corners(v);
  const double along = dot(normal, s);
  if (is_along(normal, s)) return form;
  copy((-1 / along) * normal, form.m);
  form.c = single(dot(normal, v[0]) / along);
  for (int i = 0; i < N; ++i) {
    const Vec edge = v[(i + 1) % N] - v[i];
    const Vec across = (along < 0 ? -1.0 : 1.0) * cross(s, edge);
    const Vec inward = (1 / length(edge)) * across;
    copy(inward, form.edge[i]);
    form.edge_offset[i] = single(-dot(inward, v[i]));
  }
  return form;
}

template <int N, class F>
TOFRAY_INLINE Mask<F> blocks(const PolygonAlong<N>& polygon, const Place<F>& p, const float*, F margin) {
  const F least = least_of<N>([&](int i) TOFRAY_LAMBDA { return affine(p, polygon.edge[i], polygon.edge_offset[i]); });
  return (least >= F(0.0f)) & (affine(p, polygon.m, polygon.c) > margin);
}

template <int N>
TOFRAY_INLINE PolygonFree<N> polygon_free(const Vec (&v)[N]) {
  PolygonFree<N> form{};
  for (int i = 0; i < N; ++i) copy(v[i], form.corner[i]);
  return form;
}

/// What of three coordinates comes first, second and last when `last` says which one is last.
template <class F>
TOFRAY_INLINE Direction<F> cycled(F x, F y, F z, Int<F> last) {
  const auto of_x = last == Int<F>(0), of_y = last == Int<F>(1);
  const auto pick = [&](F a, F b, F c) TOFRAY_LAMBDA { return num::select(of_x, a, num::select(of_y, b, c)); };
  return {pick(y, z, x), pick(z, x, y), pick(x, y, z)};
}

/// As triangles of meshes are met: sheared along each ray's longest coordinate, the edges' signs are exact, so that polygons which share
/// corners have no gap between them (Woop, Benthin and Wald 2013).
template <int N, class F>
TOFRAY_INLINE F distance_to(const PolygonFree<N>& polygon, const FreeRay<F>& ray, F least, Int<F>& facet) {
  facet = Int<F>(0);
  const F direction[3] = {ray.dx, ray.dy, ray.dz};
  const Int<F> longest = longest_of(direction);
  const Direction<F> d = cycled(ray.dx, ray.dy, ray.dz, longest);
  const F slope_x = d.x / d.z, slope_y = d.y / d.z;
  F x[N], y[N], z[N];
  for (int i = 0; i < N; ++i) {
    const float* c = polygon.corner[i];
    const Direction<F> p = cycled(F(c[0]) - ray.x, F(c[1]) - ray.y, F(c[2]) - ray.z, longest);
    x[i] = num::fnma(slope_x, p.z, p.x), y[i] = num::fnma(slope_y, p.z, p.y), z[i] = p.z;
  }
  F low = F(never), high = F(-never);
  for (int i = 0; i < N; ++i) {
    const int next = (i + 1) % N;
    const F edge = difference_of_products(x[i], y[next], y[i], x[next]);
    low = num::min(low, edge), high = num::max(high, edge);
  }
  // The plane's distance by the first three corners.
  const F u = difference_of_products(x[1], y[2], y[1], x[2]), v = difference_of_products(x[2], y[0], y[2], x[0]),
          w = difference_of_products(x[0], y[1], y[0], x[1]), area = u + v + w;
  const auto inside = ((low >= F(0.0f)) | (high <= F(0.0f))) & (num::abs(area) > F(1e-30f));
  const F t = num::fma(u, z[0], num::fma(v, z[1], w * z[2])) / (num::select(inside, area, F(1.0f)) * d.z);
  return num::select(inside & (t > least), t, F(never));
}

}  // namespace tofray::shape
