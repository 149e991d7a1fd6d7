// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "shape/common.h"

/// Triangle of three vertices, both sides reflect.
namespace tofray::shape {

/// Inside where the three d·edge are >= 0; w = d·m. An edge shared by two triangles has exactly opposite numbers in them; edge_low is
/// what rounding took from the unit vector edge.
struct TriangleForm {
  float m[3];
  float edge[3][3], edge_low[3][3];
  std::int32_t facet, object;
  Bounds bounds;
};

/// Inside where P·edge_i + edge_offset_i >= 0; t = P·m + c.
struct TriangleAlong {
  float m[3], c, edge[3][3], edge_offset[3];
  std::int32_t object;
};

struct Triangle {
  using Form = TriangleForm;
  using Along = TriangleAlong;
  static constexpr int facets = 1;
  static constexpr bool closed = false, curved = false;

  Vec vertex[3];

  template <class Said>
  static Triangle placed(const Said& said, const Placement& at) {
    const Vec v[3] = {Placement::vec(said.vertices[0]), Placement::vec(said.vertices[1]), Placement::vec(said.vertices[2])};
    // Without a rotation the vertices keep their exact differences: meshes stay closed.
    const Vec about = at.turns() ? (1.0 / 3) * (v[0] + v[1] + v[2]) : Vec{0, 0, 0};
    return {{at.point(v[0], about), at.point(v[1], about), at.point(v[2], about)}};
  }
};

TOFRAY_FN Triangle in_frame(const Triangle& t, const Frame& frame) {
  return {{frame.point(t.vertex[0]), frame.point(t.vertex[1]), frame.point(t.vertex[2])}};
}

TOFRAY_FN void facet_of(const Triangle& t, int, Facet& out) {
  face(normalized(cross(t.vertex[1] - t.vertex[0], t.vertex[2] - t.vertex[0])), out);
}

/// A triangle that is seen edge-on is hit by no ray.
TOFRAY_FN TriangleForm seen_from(const Triangle& t, const Vec& origin) {
  TriangleForm form{};
  form.bounds = nowhere();
  const Vec v[3] = {t.vertex[0] - origin, t.vertex[1] - origin, t.vertex[2] - origin};
  const Vec normal = cross(v[1] - v[0], v[2] - v[0]);
  // The nearest vertex gives the plane's offset with the least cancellation.
  const double far[3] = {dot(v[0], v[0]), dot(v[1], v[1]), dot(v[2], v[2])};
  const int near = far[0] <= far[1] ? (far[0] <= far[2] ? 0 : 2) : (far[1] <= far[2] ? 1 : 2);
  const double offset = dot(normal, v[near]);
  const double side = offset < 0 ? -1 : 1;
  if (::fabs(offset) <= 1e-9 * length(normal) * length(v[near])) return form;
  copy((1 / offset) * normal, form.m);
  for (int i = 0; i < 3; ++i) {
    const Vec across = cross(v[(i + 1) % 3], v[(i + 2) % 3]);
    const double size = length(across);
    const Vec unit = (size > 0 ? side / size : 0) * across;
    copy(unit, form.edge[i]);
    for (int k = 0; k < 3; ++k) form.edge_low[i][k] = single(unit[k] - static_cast<double>(form.edge[i][k]));
  }
  form.bounds = bounds_of_points(v, 3);
  return form;
}

TOFRAY_FN bool can_meet(const TriangleForm& t, const Bounds& r) {
  return overlap(t.bounds, r) && reaches(t.edge[0], r) && reaches(t.edge[1], r) && reaches(t.edge[2], r);
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

/// Inside where the three d·edge are not negative. Near an edge the sums are taken anew with care, so that neighbours
/// agree about every ray and nothing leaks between them (watertight as in Woop, Benthin and Wald 2013). Where a ray meets a vertex
/// exactly, the signs of all its edges are rounding and may turn round it without end: what is that small (2^-44) counts as inside.
template <class F>
TOFRAY_FN F inverse_range(const TriangleForm& triangle, const Ray<F>& ray) {
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

/// Light that travels along it is not stopped: t = 0.
TOFRAY_FN TriangleAlong seen_along(const Triangle& t, const Vec& s) {
  TriangleAlong form{};
  const Vec* v = t.vertex;
  const Vec normal = cross(v[1] - v[0], v[2] - v[0]);
  const double along = dot(normal, s);
  if (::fabs(along) <= 1e-6 * length(normal)) return form;
  copy((-1 / along) * normal, form.m);
  form.c = single(dot(normal, v[0]) / along);
  for (int i = 0; i < 3; ++i) {
    const Vec edge = v[(i + 1) % 3] - v[i];
    const Vec across = (along < 0 ? -1.0 : 1.0) * cross(s, edge);
    const Vec inward = (1 / length(edge)) * across;
    copy(inward, form.edge[i]);
    form.edge_offset[i] = single(-dot(inward, v[i]));
  }
  return form;
}

template <class F>
TOFRAY_FN Mask<F> blocks(const TriangleAlong& t, const Surface<F>& p, const float*, F margin) {
  F least = affine(p, t.edge[0], t.edge_offset[0]);
  least = num::min(least, affine(p, t.edge[1], t.edge_offset[1]));
  least = num::min(least, affine(p, t.edge[2], t.edge_offset[2]));
  return (least >= F(0.0f)) & (affine(p, t.m, t.c) > margin);
}

}  // namespace tofray::shape
