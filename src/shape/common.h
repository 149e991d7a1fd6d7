// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "flow/flow.h"
#include "shape/vector.h"

/// What the shapes share.
///
/// For rays P = o + t·d of one common origin o the inverse range w = 1/t along d is linear in d for planes and triangles, and so
/// are the edges of a triangle and the sides of a box: no division is left in the test, and the nearest surface is the largest w.
/// A shape's Form holds what such rays need to know of it, in single precision; seen_from() makes it in double. Coordinates are the
/// camera frame's; a form's are relative to o. Each form knows the facet that its hit names, and the object it belongs to.
namespace tofray::shape {

/// Rectangle that holds every direction in which a shape can be hit; infinite where it reaches z <= 0.
using flow::Bounds;
using flow::Direction;
using flow::Place;
using flow::Ray;
using num::Int;
using num::Mask;
using num::single;

/// Stands for an infinite inverse length: d·huge is finite for every direction, and 0·huge is 0.
TOFRAY_CONSTANT double huge = 1e30;

TOFRAY_INLINE void copy(const Vec& from, float to[3]) { to[0] = single(from.x), to[1] = single(from.y), to[2] = single(from.z); }
TOFRAY_INLINE double inverse(double a) { return ::fabs(a) < 1 / huge ? ::copysign(huge, a) : 1 / a; }

TOFRAY_INLINE Bounds unbounded() { return {-3.402823466e38f, 3.402823466e38f, -3.402823466e38f, 3.402823466e38f}; }
/// Of what no ray hits.
TOFRAY_INLINE Bounds nowhere() { return {1, -1, 1, -1}; }

/// A little wider than computed, so that rounding in single precision never cuts a hit off.
TOFRAY_INLINE float beyond(double a, double sign) { return single(a + sign * (1e-5 + 1e-5 * ::fabs(a))); }

TOFRAY_INLINE Bounds bounds_of_points(const Vec* points, int count) {
  double low[2] = {1e300, 1e300}, high[2] = {-1e300, -1e300};
  for (int i = 0; i < count; ++i) {
    if (points[i].z < 1e-6 * length(points[i])) return unbounded();
    for (int k = 0; k < 2; ++k) {
      const double q = points[i][k] / points[i].z;
      low[k] = q < low[k] ? q : low[k], high[k] = q > high[k] ? q : high[k];
    }
  }
  return {beyond(low[0], -1), beyond(high[0], 1), beyond(low[1], -1), beyond(high[1], 1)};
}

TOFRAY_INLINE bool overlap(const Bounds& a, const Bounds& b) {
  return (a.x_min <= b.x_max) & (a.x_max >= b.x_min) & (a.y_min <= b.y_max) & (a.y_max >= b.y_min);
}

/// False where no ray of the rectangle has d·m >= 0: the largest value of x·m0 + y·m1 + m2 over it, and room for rounding.
TOFRAY_INLINE bool reaches(const float* m, const Bounds& r) {
  const float largest = (m[0] > 0 ? r.x_max : r.x_min) * m[0] + (m[1] > 0 ? r.y_max : r.y_min) * m[1] + m[2];
  const float x = num::max(num::abs(r.x_min), num::abs(r.x_max)), y = num::max(num::abs(r.y_min), num::abs(r.y_max));
  return largest + 1e-5f * (x * num::abs(m[0]) + y * num::abs(m[1]) + num::abs(m[2])) >= 0;
}

template <class F>
TOFRAY_INLINE F dot(const Ray<F>& ray, const float* m) {
  return num::fma(ray.x, F(m[0]), num::fma(ray.y, F(m[1]), ray.z * F(m[2])));
}

/// From where to where a shape reaches along a unit vector.
struct Span {
  double low, high;
};
TOFRAY_INLINE double farthest(const Span& span) { return ::fmax(::fabs(span.low), ::fabs(span.high)); }
TOFRAY_INLINE Span span_about(double middle, double half) { return {middle - half, middle + half}; }
TOFRAY_INLINE Span span_of_points(const Vec* points, int count, const Vec& a) {
  Span out{1e300, -1e300};
  for (int i = 0; i < count; ++i) {
    const double q = dot(points[i], a);
    out = {q < out.low ? q : out.low, q > out.high ? q : out.high};
  }
  return out;
}
/// How far a circle of radius 1 across the axis reaches along a.
TOFRAY_INLINE double reach_across(const Vec& axis, const Vec& a) {
  const double along = dot(axis, a), square = 1 - along * along;
  return square > 0 ? ::sqrt(square) : 0;
}

/// Two unit vectors across parallel light and each other: the coordinates of a screen that it falls on.
struct Screen {
  Vec u, v;
};
TOFRAY_INLINE Screen screen_of(const Vec& s) {
  const Vec u = way_across(s.x * s.x < 0.5 ? Vec{1, 0, 0} : Vec{0, 1, 0}, s);
  return {u, cross(s, u)};
}

/// Share of a distance by which rectangles on a screen are wider.
TOFRAY_CONSTANT double screen_room = 1e-5;

/// How much farther than rounding goes a shadow that has suffered from it.
template <class T>
TOFRAY_INLINE double spread(const T&, const Vec&) {
  return 1;
}
/// Rectangle on the screen that holds a shape's shadow: wider than computed by more than rounding in single precision takes off its way
/// there, which goes as the distances do.
template <class T>
TOFRAY_INLINE Bounds bounds_along(const T& shape, const Vec& s) {
  const Screen screen = screen_of(s);
  const Span u = span_along(shape, screen.u), v = span_along(shape, screen.v), w = span_along(shape, s);
  const double room = screen_room * spread(shape, s) * (1 + ::fmax(farthest(u), ::fmax(farthest(v), farthest(w))));
  return {single(u.low - room), single(u.high + room), single(v.low - room), single(v.high + room)};
}
/// False where the form keeps parallel light off no point of the rectangle on its screen. What has no end has no bounds.
template <class Along>
TOFRAY_INLINE bool can_shade(const Along& form, const Bounds& r) {
  if constexpr (requires { form.bounds; }) {
    return overlap(form.bounds, r);
  } else {
    return true;
  }
}

/// Rays from the origin meet the shape nowhere before this z, also as it is computed in single precision. Only shapes whose inverse range is
/// right to some roundings know one: a plane that is almost seen from its edge may be met far before all of its points.
template <class T>
TOFRAY_INLINE float begins_at(const T&, const Vec&) {
  return -3e38f;
}
/// The shape keeps light from the direction s off no point P whose −P·s is below this.
template <class T>
TOFRAY_INLINE float begins_along(const T&, const Vec&) {
  return -3e38f;
}
/// Room for more than rounding, as a share of how far away a shape is.
TOFRAY_CONSTANT double depth_room = 1e-5;

/// P·m + offset in the camera frame.
template <class F>
TOFRAY_INLINE F affine(const Place<F>& p, const float* m, float offset) {
  return num::fma(p.x, F(m[0]), num::fma(p.y, F(m[1]), num::fma(p.z, F(m[2]), F(offset))));
}

/// Where a ray comes into a body that is convex, as inverse ranges: 2e30 where it begins within, 0 where it never comes to the border.
template <class F>
struct Crossing {
  F in, out;
};

/// What is within a round side (facet 0) and between flat ends (facet 1): the later way in and the earlier way out.
/// @param inside  the origin is inside: it sees where the ray goes out
template <class F>
TOFRAY_INLINE F meet(const Crossing<F>& side, const Crossing<F>& ends, bool inside, Int<F>& facet) {
  const F leave = num::max(side.out, ends.out);
  if (inside) {
    facet = num::select(ends.out > side.out, Int<F>(1), Int<F>(0));
    return leave;
  }
  const F enter = num::min(side.in, ends.in);
  facet = num::select(ends.in < side.in, Int<F>(1), Int<F>(0));
  return num::select(enter >= leave, enter, F(0.0f));
}

struct MeshTriangles;
struct MeshDetails;
struct MeshSteps;

/// Where light lands: which way the surface faces there, what it belongs to, what it is made of. (All of a camera frame.)
struct Facet {
  float number[9];      ///< flat: the unit normal; else what its shape's normal() reads
  std::int32_t curved;  ///< 0: flat; else 1 + the shape's place in the list
  std::int32_t object, material;
  const MeshTriangles* triangles;  ///< of a mesh, one of which the hit names
  union {
    const MeshDetails* details;  ///< of a mesh's first, or null: what its corners say besides their place
    const MeshSteps* steps;      ///< of its second, or null: how they move
  };
};

/// A flat facet's numbers. (Adding 0 leaves one kind of zero.)
TOFRAY_INLINE void face(const Vec& normal, Facet& out) {
  copy(normal, out.number);
  for (int k = 0; k < 3; ++k) out.number[k] += 0.0f;
  out.curved = 0;
}

/// Calls take(facet, its lanes) for each facet that some of the lanes name: mostly one, seldom more than three, so that each is read once and
/// nothing lane by lane.
template <class F, class Take>
TOFRAY_INLINE void for_each_facet(const Facet* table, Int<F> which, Mask<F> lanes, const Take& take) {
  for (Mask<F> left = lanes; num::any(left);) {
    const std::int32_t one = num::first_of(left, which);
    const Mask<F> its = lanes & (which == Int<F>(one));
    left = left & (!its);
    take(table[one], its);
  }
}

/// A ray from anywhere: P = o + t·d, d of unit length; t is the distance.
template <class F>
struct FreeRay {
  F x, y, z, dx, dy, dz;
};
/// The distance to what is never met.
TOFRAY_CONSTANT float never = 3e38f;

/// d·m, and o·m + offset.
template <class F>
TOFRAY_INLINE F turned(const FreeRay<F>& ray, const float* m) {
  return num::fma(ray.dx, F(m[0]), num::fma(ray.dy, F(m[1]), ray.dz * F(m[2])));
}
template <class F>
TOFRAY_INLINE F placed(const FreeRay<F>& ray, const float* m, float offset) {
  return num::fma(ray.x, F(m[0]), num::fma(ray.y, F(m[1]), num::fma(ray.z, F(m[2]), F(offset))));
}
/// 1/a with a's sign; huge where a is next to nothing.
template <class F>
TOFRAY_INLINE F inverse_of(F a) {
  return F(1.0f) / num::copy_sign(num::max(num::abs(a), F(1e-30f)), a);
}

/// Where a line is within a convex body: from `in` to `out`, through these facets of it; nowhere where in > out.
template <class F>
struct Passage {
  F in, out;
  Int<F> in_facet, out_facet;
};
template <class F>
TOFRAY_INLINE Passage<F> common_passage(const Passage<F>& a, const Passage<F>& b) {
  const auto later = b.in > a.in, earlier = b.out < a.out;
  return {num::select(later, b.in, a.in), num::select(earlier, b.out, a.out), num::select(later, b.in_facet, a.in_facet),
          num::select(earlier, b.out_facet, a.out_facet)};
}
/// Where a line is between two parallel planes, ±half from `place` along a coordinate that it goes along by `step`.
template <class F>
TOFRAY_INLINE Passage<F> between_planes(F place, F step, F half, Int<F> facet) {
  const F inverse = inverse_of(step);
  const F one = (-half - place) * inverse, other = (half - place) * inverse;
  return {num::min(one, other), num::max(one, other), facet, facet};
}

/// a·b − c·d to 1.5 units in the last place, its sign as without any rounding (Kahan; Jeannerod, Louvet and Muller 2013).
template <class F>
TOFRAY_INLINE F difference_of_products(F a, F b, F c, F d) {
  const F product = c * d;
  const F rounding = num::fnma(c, d, product);
  return num::fms(a, b, product) + rounding;
}

/// Which coordinate of the direction is the longest.
template <class F>
TOFRAY_INLINE Int<F> longest_of(const F (&direction)[3]) {
  const F x = num::abs(direction[0]), y = num::abs(direction[1]), z = num::abs(direction[2]);
  return num::select((x > y) & (x > z), Int<F>(0), num::select(y > z, Int<F>(1), Int<F>(2)));
}

}  // namespace tofray::shape
