// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "shape/common.h"

/// Disk: n·(P − c) = 0 and |P − c| <= R, both sides reflect.
namespace tofray::shape {

/// In axes x, y of its plane, x the way to c across n, and n away from the origin, a ray meets the plane at t = (n·c)/(d·n), which is
/// t·(d·x) − c·x, t·(d·y) from the centre. Times (d·n)/R: the disk is hit where (d·X)² + (d·Y)² <= (d·n)², t > 0, with
/// X = ((n·c)·x − (c·x)·n)/R, at right angles to c, and Y = (n·c)·y/R. No difference of large terms is left, and no division.
struct DiskForm {
  float x[3], y[3], n[3];
  float inverse_distance;  ///< 1/(n·c)
  std::int32_t facet, object;
  Bounds bounds;
};

/// P + t·s meets the plane at t = P·m + c, and there it is P·x + offset[0], P·y + offset[1] from the centre; all times n·s.
struct DiskAlong {
  float m[3], c, x[3], y[3], offset[2], radius_squared;
  std::int32_t object;
  Bounds bounds;  ///< on the light's screen
};

/// For rays from anywhere.
struct DiskFree {
  float c[3], n[3], offset, radius_squared;  ///< n·P + offset = 0
  std::int32_t facet, object;
};

struct Disk {
  using Form = DiskForm;
  using Along = DiskAlong;
  using Free = DiskFree;
  static constexpr int facets = 1;
  static constexpr bool closed = false, curved = false;

  Vec center, normal;
  double radius;

  /// What it turns about.
  template <class Said>
  static Vec center_of(const Said& said) {
    return Placement::vec(said.center);
  }
  /// Its surface as triangles, about what it turns about (shape/list.h says what `to` takes).
  template <class Said, class Sink>
  static void tessellate(const Said& said, Sink& to) {
    to.corner(said.radius, 0), to.corner(0, 0);
    to.turn_about(Placement::vec(said.normal));
  }
  template <class Said>
  static Disk placed(const Said& said, const Placement& at) {
    const Vec center = center_of(said);
    return {at.point(center, center), normalized(at.direction(Placement::vec(said.normal))), said.radius};
  }
};

TOFRAY_INLINE Disk in_frame(const Disk& d, const CoordinateFrame& frame) {
  return {frame.point(d.center), frame.direction(d.normal), d.radius};
}

TOFRAY_INLINE Span span_along(const Disk& d, const Vec& a) { return span_about(dot(d.center, a), d.radius * reach_across(d.normal, a)); }
TOFRAY_INLINE void facet_of(const Disk& d, int, Facet& out) { face(d.normal, out); }

/// A disk that is seen edge-on is hit by no ray.
TOFRAY_INLINE DiskForm seen_from(const Disk& d, const Vec& origin) {
  DiskForm form{};
  form.bounds = nowhere();
  const Vec center = d.center - origin, x = way_across(center, d.normal), y = cross(d.normal, x);
  const double offset = dot(d.normal, center), distance = ::fabs(offset);
  if (distance <= 1e-9 * length(center)) return form;
  const Vec n = (offset < 0 ? -1.0 : 1.0) * d.normal;
  copy((1 / d.radius) * (distance * x - dot(center, x) * n), form.x);
  copy((distance / d.radius) * y, form.y);
  copy(n, form.n);
  form.inverse_distance = single(inverse(distance));
  const Vec along = d.radius * x, across = d.radius * y;
  const Vec corners[4] = {center - along - across, center + along - across, center - along + across, center + along + across};
  form.bounds = bounds_of_points(corners, 4);
  return form;
}

TOFRAY_INLINE bool can_meet(const DiskForm& disk, const Bounds& r) { return overlap(disk.bounds, r); }

template <class F>
TOFRAY_INLINE F inverse_range(const DiskForm& disk, const Ray<F>& ray) {
  const F x = dot(ray, disk.x), y = dot(ray, disk.y), n = dot(ray, disk.n);
  return num::select(num::fma(x, x, y * y) <= n * n, n * F(disk.inverse_distance), F(0.0f));
}

/// Light that travels along it is not stopped: t = 0.
TOFRAY_INLINE DiskAlong seen_along(const Disk& d, const Vec& s) {
  DiskAlong form{};
  const double along = dot(d.normal, s);
  if (::fabs(along) <= 1e-6) return form;
  const Vec way = way_across(s, d.normal), x = along * way - dot(s, way) * d.normal, y = along * cross(d.normal, way);
  copy((-1 / along) * d.normal, form.m);
  form.c = single(dot(d.normal, d.center) / along);
  copy(x, form.x), copy(y, form.y);
  form.offset[0] = single(-dot(d.center, x)), form.offset[1] = single(-dot(d.center, y));
  form.radius_squared = single(along * along * d.radius * d.radius);
  return form;
}

template <class F>
TOFRAY_INLINE Mask<F> blocks(const DiskAlong& disk, const Place<F>& p, const float*, F margin) {
  const F x = affine(p, disk.x, disk.offset[0]), y = affine(p, disk.y, disk.offset[1]);
  return (num::fma(x, x, y * y) <= F(disk.radius_squared)) & (affine(p, disk.m, disk.c) > margin);
}

TOFRAY_INLINE DiskFree free_of(const Disk& d) {
  DiskFree form{};
  copy(d.center, form.c), copy(d.normal, form.n);
  form.offset = single(-dot(d.normal, d.center)), form.radius_squared = single(d.radius * d.radius);
  return form;
}

template <class F>
TOFRAY_INLINE F distance_to(const DiskFree& disk, const FreeRay<F>& ray, F least, Int<F>& facet) {
  facet = Int<F>(0);
  const F along = turned(ray, disk.n), t = -placed(ray, disk.n, disk.offset) * inverse_of(along);
  const F x = num::fma(t, ray.dx, ray.x - F(disk.c[0])), y = num::fma(t, ray.dy, ray.y - F(disk.c[1])),
          z = num::fma(t, ray.dz, ray.z - F(disk.c[2]));
  const auto met = (num::abs(along) > F(1e-6f)) & (t > least) & (flow::square_of(x, y, z) <= F(disk.radius_squared));
  return num::select(met, t, F(never));
}

}  // namespace tofray::shape
