// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "shape/common.h"

/// Cylinder with caps: within R of the line through c along the unit vector a, and within half of c along a.
namespace tofray::shape {

/// A cylinder without ends. In axes u, v across it, u toward its line, and a along it: the line is at (line, 0), its side where
/// (t·d_u − line)² + (t·d_v)² = R².
struct Tube {
  float u[3], v[3], a[3];
  float line, radius_squared;
  float power, inverse_power;  ///< C = line² − R², and 1/C; negative within the side
  std::int32_t within;         ///< 1: the origin is nearer to the line than R
};

/// The caps are a slab as a box has.
struct CylinderForm {
  Tube tube;
  float near_scale, near_offset, far_scale[2];
  std::int32_t facet, object;  ///< facet of the side; that of the caps follows
  std::int32_t inside;         ///< 1: the origin is inside the cylinder: it sees the far side
  std::int32_t own_blocks;     ///< light's view: 1 where light and camera are on different sides of its surface
  Bounds bounds;
};

/// In axes u, v across the cylinder, u the way of the light, and a along it, from the centre: p_u = P·u + offset[0] and so on.
struct CylinderAlong {
  float u[3], v[3], a[3], offset[3];
  float radius_squared, half;
  float inverse_u, inverse_a;
  std::int32_t object;
  std::int32_t own_blocks;  ///< 1: the camera is inside
  Bounds bounds;            ///< on the light's screen
};

/// For rays from anywhere.
struct CylinderFree {
  float c[3], a[3];
  float at, half, radius_squared;      ///< at: −c·a
  std::int32_t facet, object, inside;  ///< inside: the camera is
};

struct Cylinder {
  using Form = CylinderForm;
  using Along = CylinderAlong;
  using Free = CylinderFree;
  static constexpr int facets = 2;
  static constexpr bool closed = true, curved = true;

  Vec center, axis;
  double radius, half;

  /// What it turns about.
  template <class Said>
  static Vec center_of(const Said& said) {
    return Placement::vec(said.center);
  }
  /// Its surface as triangles, about what it turns about (shape/list.h says what `to` takes).
  template <class Said, class Sink>
  static void tessellate(const Said& said, Sink& to) {
    const double half = 0.5 * said.height;
    to.corner(0, -half), to.corner(said.radius, -half), to.corner(said.radius, half), to.corner(0, half);
    to.turn_about(Placement::vec(said.axis));
  }
  template <class Said>
  static Cylinder placed(const Said& said, const Placement& at) {
    const Vec center = center_of(said);
    return {at.point(center, center), normalized(at.direction(Placement::vec(said.axis))), said.radius, 0.5 * said.height};
  }

  /// Of its side: n = ((P − c) − a·((P − c)·a))/R.
  template <class F>
  TOFRAY_INLINE static Direction<F> normal(const Facet& of, F x, F y, F z) {
    const F curvature = F(of.number[3]), ax = F(of.number[4]), ay = F(of.number[5]), az = F(of.number[6]);
    const F along = num::fma(x, ax, num::fma(y, ay, z * az));
    return {num::fma(num::fnma(along, ax, x), curvature, F(of.number[0])), num::fma(num::fnma(along, ay, y), curvature, F(of.number[1])),
            num::fma(num::fnma(along, az, z), curvature, F(of.number[2]))};
  }
};

TOFRAY_INLINE Cylinder in_frame(const Cylinder& c, const CoordinateFrame& frame) {
  return {frame.point(c.center), frame.direction(c.axis), c.radius, c.half};
}

TOFRAY_INLINE Span span_along(const Cylinder& c, const Vec& a) {
  return span_about(dot(c.center, a), c.half * ::fabs(dot(c.axis, a)) + c.radius * reach_across(c.axis, a));
}
TOFRAY_INLINE bool inside(const Cylinder& c, const Vec& p) {
  const Vec q = p - c.center, side = across(q, c.axis);
  return dot(side, side) < c.radius * c.radius && ::fabs(dot(q, c.axis)) < c.half;
}

/// The numbers of normal() for the side about a line through c; of a sphere about c where the axis is 0.
TOFRAY_INLINE void face_round(const Vec& c, const Vec& axis, double radius, Facet& out) {
  copy((-1 / radius) * across(c, axis), out.number);
  out.number[3] = single(1 / radius);
  copy(axis, out.number + 4);
}

TOFRAY_INLINE void facet_of(const Cylinder& c, int side, Facet& out) {
  if (side == 1) {
    face(c.axis, out);
    return;
  }
  face_round(c.center, c.axis, c.radius, out);
}

/// @param center  of what the tube is round, from the origin
TOFRAY_INLINE Tube tube_round(const Vec& center, const Vec& axis, double radius) {
  Tube tube{};
  const Vec u = way_across(center, axis), v = cross(axis, u);
  const double line = dot(center, u), power = (line - radius) * (line + radius);
  copy(u, tube.u), copy(v, tube.v), copy(axis, tube.a);
  tube.line = single(line), tube.radius_squared = single(radius * radius);
  tube.power = single(power), tube.inverse_power = single(inverse(power));
  tube.within = power < 0;
  return tube;
}

TOFRAY_INLINE CylinderForm seen_from(const Cylinder& c, const Vec& origin) {
  CylinderForm form{};
  const Vec center = c.center - origin, u = way_across(center, c.axis), v = cross(c.axis, u);
  form.tube = tube_round(center, c.axis, c.radius);
  const double at = dot(center, c.axis), low = at - c.half, high = at + c.half;
  const bool between = low < 0 && high > 0;
  const double near_side = low >= 0 ? low : high, far_side = low >= 0 ? high : low;
  // Seen from the very plane of a cap, the slab is where the axis points away from it: the sign does not come from a zero.
  form.near_scale = between ? 0 : single(low >= 0 ? inverse(::fabs(low)) : -inverse(::fabs(high)));
  form.near_offset = between ? single(huge) : 0;
  form.far_scale[0] = single(inverse(far_side));
  form.far_scale[1] = between ? single(inverse(near_side)) : form.far_scale[0];
  form.inside = inside(c, origin);
  form.own_blocks = (form.inside != 0) != inside(c, {0, 0, 0});
  Vec corners[8] = {};  // of a box round it
  for (int i = 0; i < 8; ++i) {
    corners[i] = center + ((i & 1 ? 1 : -1) * c.radius) * u + ((i & 2 ? 1 : -1) * c.radius) * v + ((i & 4 ? 1 : -1) * c.half) * c.axis;
  }
  form.bounds = form.inside != 0 ? unbounded() : bounds_of_points(corners, 8);
  return form;
}

TOFRAY_INLINE bool can_meet(const CylinderForm& cylinder, const Bounds& r) { return overlap(cylinder.bounds, r); }

/// With A = d_u² + d_v², b = d_u·line, C = line² − R² the discriminant b² − A·C is R²·d_u² − C·d_v² without cancellation of large terms;
/// q = b ± √disc with the sign of b; roots t = C/q and q/A.
template <class F>
TOFRAY_INLINE Crossing<F> crossing(const Tube& tube, const Ray<F>& ray) {
  const F u = dot(ray, tube.u), v = dot(ray, tube.v);
  const F rest = num::fnma(F(tube.power) * v, v, F(tube.radius_squared) * u * u);
  const F b = u * F(tube.line);
  const F q = b + num::copy_sign(num::sqrt(num::max(rest, F(0.0f))), b);
  const F first = q * F(tube.inverse_power), second = num::fma(u, u, v * v) / q;
  if (tube.within != 0) return {F(2e30f), num::select(q > F(0.0f), second, first)};
  const auto met = (rest >= F(0.0f)) & (b > F(0.0f));
  return {num::select(met, first, F(0.0f)), num::select(met, second, F(2e30f))};
}

/// `side` is 0 for the side, 1 for the caps.
template <class F>
TOFRAY_INLINE F inverse_range(const CylinderForm& c, const Ray<F>& ray, Int<F>& side) {
  const F a = dot(ray, c.tube.a);
  const Crossing<F> caps{num::fma(a, F(c.near_scale), F(c.near_offset)), num::max(a * F(c.far_scale[0]), a * F(c.far_scale[1]))};
  return meet(crossing(c.tube, ray), caps, c.inside != 0, side);
}

TOFRAY_INLINE CylinderAlong seen_along(const Cylinder& c, const Vec& s) {
  CylinderAlong form{};
  const Vec u = way_across(s, c.axis), v = cross(c.axis, u);
  copy(u, form.u), copy(v, form.v), copy(c.axis, form.a);
  form.offset[0] = single(-dot(c.center, u)), form.offset[1] = single(-dot(c.center, v)), form.offset[2] = single(-dot(c.center, c.axis));
  form.radius_squared = single(c.radius * c.radius), form.half = single(c.half);
  form.inverse_u = single(inverse(dot(s, u))), form.inverse_a = single(inverse(dot(s, c.axis)));
  form.own_blocks = inside(c, {0, 0, 0});
  return form;
}

template <class F>
TOFRAY_INLINE Mask<F> blocks(const CylinderAlong& c, const Place<F>& p, const float*, F margin) {
  const F u = affine(p, c.u, c.offset[0]), v = affine(p, c.v, c.offset[1]), a = affine(p, c.a, c.offset[2]);
  const F rest = num::fnma(v, v, F(c.radius_squared)), chord = num::sqrt(num::max(rest, F(0.0f)));
  const F one = (-chord - u) * F(c.inverse_u), other = (chord - u) * F(c.inverse_u);
  const F low = (F(-c.half) - a) * F(c.inverse_a), high = (F(c.half) - a) * F(c.inverse_a);
  const F enter = num::max(num::max(F(0.0f), num::min(one, other)), num::min(low, high));
  const F leave = num::min(num::max(one, other), num::max(low, high));
  return (rest > F(0.0f)) & (leave > enter + margin);
}

TOFRAY_INLINE CylinderFree free_of(const Cylinder& c) {
  CylinderFree form{};
  copy(c.center, form.c), copy(c.axis, form.a);
  form.at = single(-dot(c.center, c.axis)), form.half = single(c.half), form.radius_squared = single(c.radius * c.radius);
  return form;
}

/// Where a line is within R of another line: from its point that is nearest to it, R² less the square of their distance says how far. A line
/// along the other is within it everywhere, or nowhere.
template <class F>
TOFRAY_INLINE Passage<F> within_side(const CylinderFree& c, const FreeRay<F>& ray, F place, F step, Int<F> facet) {
  const F px = num::fnma(place, F(c.a[0]), ray.x - F(c.c[0])), py = num::fnma(place, F(c.a[1]), ray.y - F(c.c[1])),
          pz = num::fnma(place, F(c.a[2]), ray.z - F(c.c[2]));
  const F ex = num::fnma(step, F(c.a[0]), ray.dx), ey = num::fnma(step, F(c.a[1]), ray.dy), ez = num::fnma(step, F(c.a[2]), ray.dz);
  const F square = num::max(flow::square_of(ex, ey, ez), F(1e-20f));
  const F middle = -num::fma(px, ex, num::fma(py, ey, pz * ez)) / square;
  const F lx = num::fma(middle, ex, px), ly = num::fma(middle, ey, py), lz = num::fma(middle, ez, pz);
  const F rest = F(c.radius_squared) - flow::square_of(lx, ly, lz), half = num::sqrt(num::max(rest, F(0.0f)) / square);
  const auto met = rest >= F(0.0f);
  return {num::select(met, middle - half, F(never)), num::select(met, middle + half, F(-never)), facet, facet};
}

template <class F>
TOFRAY_INLINE Passage<F> passage(const CylinderFree& c, const FreeRay<F>& ray) {
  const F place = placed(ray, c.a, c.at), step = turned(ray, c.a);
  return common_passage(within_side(c, ray, place, step, Int<F>(0)), between_planes(place, step, F(c.half), Int<F>(1)));
}

}  // namespace tofray::shape
