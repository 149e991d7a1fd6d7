// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "shape/common.h"

/// Plane: n·(P − p) = 0, both sides reflect.
namespace tofray::shape {

/// w = d·m; hit where w > horizon (|n·d| >= 1e-6).
struct PlaneForm {
  float m[3];
  float horizon;
  std::int32_t facet, object;
};

/// For light from the unit direction s: a point P is in shadow where the ray P + t·s hits, at t = P·m + c.
struct PlaneAlong {
  float m[3], c;
  std::int32_t object;
};

/// For rays from anywhere.
struct PlaneFree {
  float n[3], offset;  ///< n·P + offset = 0
  std::int32_t facet, object;
};

struct Plane {
  using Form = PlaneForm;
  using Along = PlaneAlong;
  using Free = PlaneFree;
  static constexpr int facets = 1;
  static constexpr bool closed = false, curved = false;

  Vec point, normal;

  /// What it turns about.
  template <class Said>
  static Vec center_of(const Said& said) {
    return Placement::vec(said.point);
  }
  /// Its surface as triangles, about what it turns about (shape/list.h says what `to` takes).
  template <class Said, class Sink>
  static void tessellate(const Said& said, Sink& to) {
    const Vec normal = normalized(Placement::vec(said.normal)), u = to.patch_m * way_across({0, 0, 0}, normal);
    const Vec v = cross(normal, u), origin{0, 0, 0};
    to.quad(origin - u - v, u - v, u + v, v - u);
  }
  template <class Said>
  static Plane placed(const Said& said, const Placement& at) {
    const Vec point = center_of(said);
    return {at.point(point, point), at.direction(Placement::vec(said.normal))};
  }
};

/// Its normal is of unit length from here on.
TOFRAY_INLINE Plane in_frame(const Plane& p, const CoordinateFrame& frame) {
  return {frame.point(p.point), normalized(frame.direction(p.normal))};
}

TOFRAY_INLINE void facet_of(const Plane& p, int, Facet& out) { face(p.normal, out); }

/// m = n/(n·p). A plane through the origin is never seen.
TOFRAY_INLINE PlaneForm seen_from(const Plane& p, const Vec& origin) {
  const double distance = dot(p.normal, p.point) - dot(p.normal, origin);
  PlaneForm form{};
  if (!(::fabs(distance) > 1 / huge)) return form;
  copy(inverse(distance) * p.normal, form.m);
  form.horizon = single(1e-6 * ::fabs(inverse(distance)));
  return form;
}

TOFRAY_INLINE bool can_meet(const PlaneForm& plane, const Bounds& r) { return reaches(plane.m, r); }

template <class F>
TOFRAY_INLINE F inverse_range(const PlaneForm& plane, const Ray<F>& ray) {
  const F w = dot(ray, plane.m);
  return num::select(w > F(plane.horizon), w, F(0.0f));
}

/// Light that travels along the plane is not stopped: t = 0.
TOFRAY_INLINE PlaneAlong seen_along(const Plane& p, const Vec& s) {
  const double along = dot(p.normal, s);
  PlaneAlong form{};
  if (::fabs(along) < 1e-6) return form;
  copy((-1 / along) * p.normal, form.m);
  form.c = single(dot(p.normal, p.point) / along);
  return form;
}

template <class F>
TOFRAY_INLINE Mask<F> blocks(const PlaneAlong& plane, const Place<F>& p, const float*, F margin) {
  return affine(p, plane.m, plane.c) > margin;
}

TOFRAY_INLINE PlaneFree free_of(const Plane& p) {
  PlaneFree form{};
  copy(p.normal, form.n);
  form.offset = single(-dot(p.normal, p.point));
  return form;
}

/// Rays along it never meet it.
template <class F>
TOFRAY_INLINE F distance_to(const PlaneFree& plane, const FreeRay<F>& ray, F least, Int<F>& facet) {
  facet = Int<F>(0);
  const F along = turned(ray, plane.n), t = -placed(ray, plane.n, plane.offset) * inverse_of(along);
  return num::select((num::abs(along) > F(1e-6f)) & (t > least), t, F(never));
}

}  // namespace tofray::shape
