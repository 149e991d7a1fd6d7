// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "shape/common.h"

/// Sphere: |P − c| = R.
namespace tofray::shape {

/// |t·d − c| = R, in the stable form: the chord's distance from the centre comes from l = c − (d·c/d·d)·d.
struct SphereForm {
  float c[3];
  float radius_squared;
  float inverse_power;  ///< 1 / (|c|² − R²); negative inside
  std::int32_t facet, object;
  std::int32_t inside;      ///< 1: the origin is inside the sphere
  std::int32_t own_blocks;  ///< light's view: 1 where light and camera are on different sides of its surface
  Bounds bounds;
};

struct SphereAlong {
  float c[3], radius_squared;
  std::int32_t object;
  std::int32_t own_blocks;  ///< 1: the camera is inside
  Bounds bounds;            ///< on the light's screen
};

/// For rays from anywhere.
struct SphereFree {
  float c[3], radius_squared;
  std::int32_t facet, object, inside;  ///< inside: the camera is
};

struct Sphere {
  using Form = SphereForm;
  using Along = SphereAlong;
  using Free = SphereFree;
  static constexpr int facets = 1;
  static constexpr bool closed = true, curved = true;

  Vec center;
  double radius;

  /// What it turns about.
  template <class Said>
  static Vec center_of(const Said& said) {
    return Placement::vec(said.center);
  }
  /// Its surface as triangles, about what it turns about (shape/list.h says what `to` takes).
  template <class Said, class Sink>
  static void tessellate(const Said& said, Sink& to) {
    to.arc(said.radius, 0, 0, 2);
    to.turn_about({0, 1, 0});
  }
  template <class Said>
  static Sphere placed(const Said& said, const Placement& at) {
    const Vec center = center_of(said);
    return {at.point(center, center), said.radius};
  }

  /// n = (P − c)/R.
  template <class F>
  TOFRAY_INLINE static Direction<F> normal(const Facet& of, F x, F y, F z) {
    const F curvature = F(of.number[3]);
    return {num::fma(x, curvature, F(of.number[0])), num::fma(y, curvature, F(of.number[1])), num::fma(z, curvature, F(of.number[2]))};
  }
};

TOFRAY_INLINE Sphere in_frame(const Sphere& s, const CoordinateFrame& frame) { return {frame.point(s.center), s.radius}; }
TOFRAY_INLINE Span span_along(const Sphere& s, const Vec& a) { return span_about(dot(s.center, a), s.radius); }
TOFRAY_INLINE bool inside(const Sphere& s, const Vec& p) { return dot(s.center - p, s.center - p) < s.radius * s.radius; }

TOFRAY_INLINE void facet_of(const Sphere& s, int, Facet& out) {
  copy((-1 / s.radius) * s.center, out.number);
  out.number[3] = single(1 / s.radius);
}

/// Tangent planes through the origin: q = x/z on them solves (c_x − q·c_z)² = R²(1 + q²).
TOFRAY_INLINE Bounds bounds_of_sphere(const Vec& c, double radius) {
  if (c.z <= radius * 1.0001) return unbounded();
  double low[2] = {}, high[2] = {};
  for (int k = 0; k < 2; ++k) {
    const double square = c.z * c.z - radius * radius;
    const double root = radius * ::sqrt(c[k] * c[k] + square);
    low[k] = (c[k] * c.z - root) / square, high[k] = (c[k] * c.z + root) / square;
  }
  return {beyond(low[0], -1), beyond(high[0], 1), beyond(low[1], -1), beyond(high[1], 1)};
}

TOFRAY_INLINE SphereForm seen_from(const Sphere& s, const Vec& origin) {
  const Vec c = s.center - origin;
  const bool within = inside(s, origin);
  SphereForm form{};
  copy(c, form.c);
  form.radius_squared = single(s.radius * s.radius);
  form.inverse_power = single(inverse(dot(c, c) - s.radius * s.radius));
  form.inside = within;
  form.own_blocks = within != inside(s, {0, 0, 0});
  form.bounds = within ? unbounded() : bounds_of_sphere(c, s.radius);
  return form;
}

TOFRAY_INLINE float begins_at(const Sphere& s, const Vec& origin) {
  const Vec c = s.center - origin;
  return single(c.z - s.radius - depth_room * (length(c) + s.radius));
}
TOFRAY_INLINE float begins_along(const Sphere& sphere, const Vec& s) {
  return single(-dot(sphere.center, s) - sphere.radius - depth_room * (length(sphere.center) + sphere.radius));
}

TOFRAY_INLINE bool can_meet(const SphereForm& sphere, const Bounds& r) { return overlap(sphere.bounds, r); }

/// The stable form (Hearn and Baker; Haines et al. 2019): with b = d·c and l = c − (b/a)d, a = d·d, the discriminant is
/// a(R² − |l|²) without cancellation; q = b ± √disc with the sign of b; roots t = C/q and q/a, C = |c|² − R².
/// @param b       d·c
/// @param inside  it is the far side that is seen
template <class F>
TOFRAY_INLINE F sphere_inverse_range(F cx, F cy, F cz, F b, F radius_squared, F inverse_power, bool inside, const Ray<F>& ray) {
  const F k = b * (ray.inverse_length * ray.inverse_length);
  const F lx = num::fnma(k, ray.x, cx), ly = num::fnma(k, ray.y, cy), lz = num::fnma(k, ray.z, cz);
  const F rest = radius_squared - num::fma(lx, lx, num::fma(ly, ly, lz * lz));
  const F root = num::sqrt(ray.square * num::max(rest, F(0.0f)));
  const F q = b + num::copy_sign(root, b);
  const F near_w = q * inverse_power;
  if (!inside) return num::select((rest >= F(0.0f)) & (b > F(0.0f)), near_w, F(0.0f));
  // From inside: the far side, t = q/a where d points to the centre, C/q where it points away (q, not b: b is 0 seen from the centre).
  return num::select(q > F(0.0f), ray.square / q, near_w);
}

template <class F>
TOFRAY_INLINE F inverse_range(const SphereForm& sphere, const Ray<F>& ray) {
  return sphere_inverse_range(F(sphere.c[0]), F(sphere.c[1]), F(sphere.c[2]), dot(ray, sphere.c), F(sphere.radius_squared),
                              F(sphere.inverse_power), sphere.inside != 0, ray);
}

TOFRAY_INLINE SphereAlong seen_along(const Sphere& sphere, const Vec&) {
  SphereAlong form{};
  copy(sphere.center, form.c);
  form.radius_squared = single(sphere.radius * sphere.radius);
  form.own_blocks = inside(sphere, {0, 0, 0});
  return form;
}

template <class F>
TOFRAY_INLINE Mask<F> blocks(const SphereAlong& sphere, const Place<F>& p, const float* s, F margin) {
  const F x = F(sphere.c[0]) - p.x, y = F(sphere.c[1]) - p.y, z = F(sphere.c[2]) - p.z;
  const F b = num::fma(x, F(s[0]), num::fma(y, F(s[1]), z * F(s[2])));
  const F lx = num::fnma(b, F(s[0]), x), ly = num::fnma(b, F(s[1]), y), lz = num::fnma(b, F(s[2]), z);
  const F rest = F(sphere.radius_squared) - num::fma(lx, lx, num::fma(ly, ly, lz * lz));
  return (rest > F(0.0f)) & (b + num::sqrt(num::max(rest, F(0.0f))) > margin);
}

TOFRAY_INLINE SphereFree free_of(const Sphere& s) {
  SphereFree form{};
  copy(s.center, form.c);
  form.radius_squared = single(s.radius * s.radius);
  return form;
}

/// In the stable form, from the line's point that is nearest to the centre.
/// @param facet  that its hits name
template <class F>
TOFRAY_INLINE Passage<F> passage(F cx, F cy, F cz, F radius_squared, const FreeRay<F>& ray, Int<F> facet) {
  const F x = cx - ray.x, y = cy - ray.y, z = cz - ray.z;
  const F b = num::fma(x, ray.dx, num::fma(y, ray.dy, z * ray.dz));
  const F lx = num::fnma(b, ray.dx, x), ly = num::fnma(b, ray.dy, y), lz = num::fnma(b, ray.dz, z);
  const F rest = radius_squared - num::fma(lx, lx, num::fma(ly, ly, lz * lz));
  const F half = num::sqrt(num::max(rest, F(0.0f)));
  const auto met = rest >= F(0.0f);
  return {num::select(met, b - half, F(never)), num::select(met, b + half, F(-never)), facet, facet};
}

template <class F>
TOFRAY_INLINE Passage<F> passage(const SphereFree& s, const FreeRay<F>& ray) {
  return passage(F(s.c[0]), F(s.c[1]), F(s.c[2]), F(s.radius_squared), ray, Int<F>(0));
}

}  // namespace tofray::shape
