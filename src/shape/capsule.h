// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "shape/cylinder.h"
#include "shape/sphere.h"

/// Capsule: within R of the points that are within half of c along the unit vector a. A cylinder's side and two half spheres.
namespace tofray::shape {

/// A ray comes in through the tube's side where that is between the ends' centres, else through the sphere of the end that it is
/// beyond; it goes out likewise. With w = 1/t the place along a is z = (d_a − at·w)/w from the middle.
struct CapsuleForm {
  Tube tube;
  float at, half;                     ///< of the middle along a; half is 0 where an end is seen from within the tube: the side never is
  float end[2][3], inverse_power[2];  ///< of the ends' spheres, as a sphere's
  std::int32_t facet, object;         ///< facet of the side; those of the end along a and of the other one follow
  std::int32_t inside;                ///< 1: the origin is inside the capsule: it sees the far side
  std::int32_t own_blocks;            ///< light's view: 1 where light and camera are on different sides of its surface
  Bounds bounds;
};

struct CapsuleAlong {
  CylinderAlong side;
  SphereAlong end[2];
  std::int32_t object;
  std::int32_t own_blocks;  ///< 1: the camera is inside
  Bounds bounds;            ///< on the light's screen
};

/// For rays from anywhere.
struct CapsuleFree {
  CylinderFree side;
  float end[2][3];
  std::int32_t facet, object, inside;  ///< inside: the camera is
};

struct Capsule {
  using Form = CapsuleForm;
  using Along = CapsuleAlong;
  using Free = CapsuleFree;
  static constexpr int facets = 3;
  static constexpr bool closed = true, curved = true;

  Vec center, axis;
  double radius, half;

  /// What it turns about.
  template <class Said>
  static Vec center_of(const Said& said) {
    return 0.5 * (Placement::vec(said.start) + Placement::vec(said.end));
  }
  /// Its surface as triangles, about what it turns about (shape/list.h says what `to` takes).
  template <class Said, class Sink>
  static void tessellate(const Said& said, Sink& to) {
    const Vec along = Placement::vec(said.end) - Placement::vec(said.start);
    const double half = 0.5 * length(along);
    to.arc(said.radius, -half, 0, 1), to.arc(said.radius, half, 1, 2);
    to.turn_about(along);
  }
  template <class Said>
  static Capsule placed(const Said& said, const Placement& at) {
    const Vec start = Placement::vec(said.start), end = Placement::vec(said.end), center = center_of(said), along = end - start;
    return {at.point(center, center), normalized(at.direction(along)), said.radius, 0.5 * length(along)};
  }

  template <class F>
  TOFRAY_INLINE static Direction<F> normal(const Facet& of, F x, F y, F z) {
    return Cylinder::normal(of, x, y, z);
  }
};

TOFRAY_INLINE Capsule in_frame(const Capsule& c, const CoordinateFrame& frame) {
  return {frame.point(c.center), frame.direction(c.axis), c.radius, c.half};
}

TOFRAY_INLINE Span span_along(const Capsule& c, const Vec& a) {
  return span_about(dot(c.center, a), c.half * ::fabs(dot(c.axis, a)) + c.radius);
}
TOFRAY_INLINE bool inside(const Capsule& c, const Vec& p) {
  const Vec q = p - c.center;
  const double along = dot(q, c.axis), beyond = ::fabs(along) > c.half ? ::fabs(along) - c.half : 0;
  const Vec side = across(q, c.axis);
  return dot(side, side) + beyond * beyond < c.radius * c.radius;
}

/// Of the end along its axis (0), and of the other one.
TOFRAY_INLINE Vec end_of(const Capsule& c, int end) { return c.center + (end == 0 ? c.half : -c.half) * c.axis; }

TOFRAY_INLINE void facet_of(const Capsule& c, int side, Facet& out) {
  if (side == 0) {
    face_round(c.center, c.axis, c.radius, out);
  } else {
    face_round(end_of(c, side - 1), {0, 0, 0}, c.radius, out);
  }
}

TOFRAY_INLINE CapsuleForm seen_from(const Capsule& c, const Vec& origin) {
  CapsuleForm form{};
  const Vec center = c.center - origin;
  form.tube = tube_round(center, c.axis, c.radius);
  form.inside = inside(c, origin);
  form.own_blocks = (form.inside != 0) != inside(c, {0, 0, 0});
  form.at = single(dot(center, c.axis));
  form.half = form.tube.within != 0 && form.inside == 0 ? 0 : single(c.half);
  Bounds bounds[2] = {};
  for (int i = 0; i < 2; ++i) {
    const Vec end = end_of(c, i) - origin;
    copy(end, form.end[i]);
    form.inverse_power[i] = single(inverse(dot(end, end) - c.radius * c.radius));
    bounds[i] = bounds_of_sphere(end, c.radius);
  }
  form.bounds = {num::min(bounds[0].x_min, bounds[1].x_min), num::max(bounds[0].x_max, bounds[1].x_max),
                 num::min(bounds[0].y_min, bounds[1].y_min), num::max(bounds[0].y_max, bounds[1].y_max)};
  return form;
}

TOFRAY_INLINE bool can_meet(const CapsuleForm& capsule, const Bounds& r) { return overlap(capsule.bounds, r); }

/// `side` is 0 for the side, 1 and 2 for the ends. (What misses the tube, w = 0, misses its ends.)
template <class F>
TOFRAY_INLINE F inverse_range(const CapsuleForm& c, const Ray<F>& ray, Int<F>& side) {
  const Crossing<F> tube = crossing(c.tube, ray);
  const F w = c.inside != 0 ? tube.out : tube.in;
  const F along = num::fnma(F(c.at), w, dot(ray, c.tube.a));
  const auto ahead = along > F(0.0f), beyond = num::abs(along) > F(c.half) * w;
  const auto of_end = [&](float one, float other) TOFRAY_LAMBDA { return num::select(ahead, F(one), F(other)); };
  const F b = num::select(ahead, dot(ray, c.end[0]), dot(ray, c.end[1]));
  const F end = sphere_inverse_range(of_end(c.end[0][0], c.end[1][0]), of_end(c.end[0][1], c.end[1][1]), of_end(c.end[0][2], c.end[1][2]),
                                     b, F(c.tube.radius_squared), of_end(c.inverse_power[0], c.inverse_power[1]), c.inside != 0, ray);
  side = num::select(beyond, num::select(ahead, Int<F>(1), Int<F>(2)), Int<F>(0));
  return num::select(beyond, end, w);
}

TOFRAY_INLINE CapsuleAlong seen_along(const Capsule& c, const Vec& s) {
  CapsuleAlong form{};
  form.side = seen_along(Cylinder{c.center, c.axis, c.radius, c.half}, s);
  for (int i = 0; i < 2; ++i) form.end[i] = seen_along(Sphere{end_of(c, i), c.radius}, s);
  form.own_blocks = inside(c, {0, 0, 0});
  return form;
}

template <class F>
TOFRAY_INLINE Mask<F> blocks(const CapsuleAlong& c, const Place<F>& p, const float* s, F margin) {
  return blocks(c.side, p, s, margin) | blocks(c.end[0], p, s, margin) | blocks(c.end[1], p, s, margin);
}

TOFRAY_INLINE CapsuleFree free_of(const Capsule& c) {
  CapsuleFree form{};
  form.side = free_of(Cylinder{c.center, c.axis, c.radius, c.half});
  for (int i = 0; i < 2; ++i) copy(end_of(c, i), form.end[i]);
  return form;
}

/// It is convex and made of three parts: a line comes in where it comes into the first of them, and goes out of the last.
template <class F>
TOFRAY_INLINE Passage<F> passage(const CapsuleFree& c, const FreeRay<F>& ray) {
  Passage<F> all = passage(c.side, ray);
  const auto met = all.in <= all.out;
  all = {num::select(met, all.in, F(never)), num::select(met, all.out, F(-never)), Int<F>(0), Int<F>(0)};
  for (int i = 0; i < 2; ++i) {
    const Passage<F> end = passage(F(c.end[i][0]), F(c.end[i][1]), F(c.end[i][2]), F(c.side.radius_squared), ray, Int<F>(1 + i));
    const auto sooner = end.in<all.in, later = end.out> all.out;
    all = {num::select(sooner, end.in, all.in), num::select(later, end.out, all.out), num::select(sooner, end.in_facet, all.in_facet),
           num::select(later, end.out_facet, all.out_facet)};
  }
  return all;
}

}  // namespace tofray::shape
