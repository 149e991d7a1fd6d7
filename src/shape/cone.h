// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "shape/common.h"

/// Cone with a base: tip T, unit vector a from the base to it, height H, radius R of the base. A point is at h = (T − P)·a below the tip
/// and at ρ from the axis; inside where ρ/R < h/H < 1. With S = R/√(R² + H²) and K = H/√(R² + H²), sine and cosine of its half angle,
/// (K·ρ)² = (S·h)² is the side, and its mirror image above the tip, which no ray may see.
namespace tofray::shape {

/// Axes u, v across the cone and a along it are K·u, K·v and S·a, and so are all coordinates in them: with Q(x, y) = x_u·y_u + x_v·y_v −
/// x_a·y_a a point P is on the side or its image where Q(P − T, P − T) = 0. u is toward the tip.
struct ConeForm {
  float u[3], v[3], a[3];
  float tip[3];
  float line, top, power;  ///< T is at (line, 0, top) in the axes; Q(T, T)
  float near_scale, near_offset, far_scale;
  std::int32_t facet, object;  ///< facet of the side; that of the base follows
  std::int32_t within_side;    ///< 1: the origin is within the side, however high
  std::int32_t inside;         ///< 1: the origin is inside the cone: it sees the far side
  std::int32_t own_blocks;     ///< light's view: 1 where light and camera are on different sides of its surface
  Bounds bounds;
};

/// In such axes, from the tip: p_u = P·u + offset[0] and so on; the light's own coordinates are s_u, 0 and s_a, u being its way. The point
/// nearest to the tip is at t = P·back + offset[3].
struct ConeAlong {
  float u[3], v[3], a[3], back[3], offset[4];
  float light_u, light_a, curve;  ///< curve: A
  float base, inverse_a;
  std::int32_t object;
  std::int32_t own_blocks;  ///< 1: the camera is inside
  Bounds bounds;            ///< on the light's screen
};

/// For rays from anywhere: axes K·u, K·v and S·a, as above.
struct ConeFree {
  float u[3], v[3], a[3], tip[3];
  float base;                          ///< −S·H
  std::int32_t facet, object, inside;  ///< inside: the camera is
};

struct Cone {
  using Form = ConeForm;
  using Along = ConeAlong;
  using Free = ConeFree;
  static constexpr int facets = 2;
  static constexpr bool closed = true, curved = true;

  Vec tip, axis;
  double radius, height;

  /// What it turns about.
  template <class Said>
  static Vec center_of(const Said& said) {
    return Placement::vec(said.base);
  }
  /// Its surface as triangles, about what it turns about (shape/list.h says what `to` takes).
  template <class Said, class Sink>
  static void tessellate(const Said& said, Sink& to) {
    to.corner(0, 0), to.corner(said.radius, 0), to.corner(0, said.height);
    to.turn_about(Placement::vec(said.axis));
  }
  template <class Said>
  static Cone placed(const Said& said, const Placement& at) {
    const Vec base = center_of(said), axis = normalized(at.direction(Placement::vec(said.axis)));
    return {at.point(base, base) + said.height * axis, axis, said.radius, said.height};
  }

  /// Of its side: n = K·(what of P − T is across a, of unit length) + S·a. The tip has none: there it is S·a, the mean of those about it.
  template <class F>
  TOFRAY_INLINE static Direction<F> normal(const Facet& of, F x, F y, F z) {
    const F ax = F(of.number[3]), ay = F(of.number[4]), az = F(of.number[5]), sine = F(of.number[7]);
    const F qx = x - F(of.number[0]), qy = y - F(of.number[1]), qz = z - F(of.number[2]);
    const F along = num::fma(qx, ax, num::fma(qy, ay, qz * az));
    const F ox = num::fnma(along, ax, qx), oy = num::fnma(along, ay, qy), oz = num::fnma(along, az, qz);
    const F scale = F(of.number[6]) / num::sqrt(num::max(flow::square_of(ox, oy, oz), F(1e-30f)));
    return {num::fma(sine, ax, scale * ox), num::fma(sine, ay, scale * oy), num::fma(sine, az, scale * oz)};
  }
};

TOFRAY_INLINE Cone in_frame(const Cone& c, const CoordinateFrame& frame) {
  return {frame.point(c.tip), frame.direction(c.axis), c.radius, c.height};
}

TOFRAY_INLINE Span span_along(const Cone& c, const Vec& a) {
  const double tip = dot(c.tip, a);
  const Span base = span_about(dot(c.tip - c.height * c.axis, a), c.radius * reach_across(c.axis, a));
  return {::fmin(tip, base.low), ::fmax(tip, base.high)};
}
TOFRAY_INLINE bool inside(const Cone& c, const Vec& p) {
  const Vec q = c.tip - p;
  const double below = dot(q, c.axis);
  return below < c.height && length(across(q, c.axis)) * c.height < c.radius * below;
}

TOFRAY_INLINE double sine_of(const Cone& c) { return c.radius / ::sqrt(c.radius * c.radius + c.height * c.height); }
TOFRAY_INLINE double cosine_of(const Cone& c) { return c.height / ::sqrt(c.radius * c.radius + c.height * c.height); }

TOFRAY_INLINE void facet_of(const Cone& c, int side, Facet& out) {
  if (side == 1) {
    face(c.axis, out);
    return;
  }
  copy(c.tip, out.number), copy(c.axis, out.number + 3);
  out.number[6] = single(cosine_of(c)), out.number[7] = single(sine_of(c));
}

TOFRAY_INLINE ConeForm seen_from(const Cone& c, const Vec& origin) {
  ConeForm form{};
  const double sine = sine_of(c), cosine = cosine_of(c);
  const Vec tip = c.tip - origin, base = tip - c.height * c.axis, u = way_across(tip, c.axis), v = cross(c.axis, u);
  const double line = cosine * dot(tip, u), top = sine * dot(tip, c.axis);
  copy(cosine * u, form.u), copy(cosine * v, form.v), copy(sine * c.axis, form.a);
  copy(tip, form.tip);
  form.line = single(line), form.top = single(top), form.power = single((line - top) * (line + top));
  form.within_side = ::fabs(line) < top;
  const double bottom = sine * dot(base, c.axis);
  form.near_scale = bottom < 0 ? 0 : single(inverse(bottom));
  form.near_offset = bottom < 0 ? single(huge) : 0;
  form.far_scale = bottom < 0 ? single(inverse(bottom)) : 0;
  form.inside = inside(c, origin);
  form.own_blocks = (form.inside != 0) != inside(c, {0, 0, 0});
  const Vec along = c.radius * u, aside = c.radius * v;
  const Vec corners[5] = {tip, base - along - aside, base + along - aside, base - along + aside, base + along + aside};
  form.bounds = form.inside != 0 ? unbounded() : bounds_of_points(corners, 5);
  return form;
}

TOFRAY_INLINE bool can_meet(const ConeForm& cone, const Bounds& r) { return overlap(cone.bounds, r); }

/// Where a line is within the side, as if that had no end: between low and high; nowhere where low > high.
template <class F>
struct Between {
  F low, high;
};

/// For x + τ·d, x = T − l being the line's nearest point to the tip: A = Q(d, d), b = Q(l, d), C = Q(l, l), `rest` = b² − A·C. As l is not
/// longer than the cone where it matters, b and C hold no difference of terms that are larger than it is. The discriminant alone
/// would, where the cone is slim: it does not depend on where on the line x is, and with y for any T − x it is
/// (y_u·d_a − y_a·d_u)² + (y_v·d_a − y_a·d_v)² − (y_u·d_v − y_v·d_u)². With y_v = 0, as seen from one point, that is
/// (y_a·d_u − y_u·d_a)² − Q(y, y)·d_v², with d_v = 0, as for a sun, (y_a·d_u − y_u·d_a)² − A·y_v². q = b ± √rest with the sign of b, roots
/// q/A and C/q, of which that is 0 where both are: the line meets the tip.
/// Where A >= 0 the line meets the side twice or its image, which is above the tip: there h·S = l_a − τ·d_a is below 0. Where A < 0 it
/// meets each of them once, and what is within the side ends (d_a > 0) or begins there.
template <class F>
TOFRAY_INLINE Between<F> within_side(F lu, F lv, F la, F u, F v, F a, F rest) {
  const F curve = num::fnma(a, a, num::fma(u, u, v * v)), power = num::fnma(la, la, num::fma(lu, lu, lv * lv));
  const F b = num::fnma(la, a, num::fma(lu, u, lv * v));
  const F q = b + num::copy_sign(num::sqrt(num::max(rest, F(0.0f))), b);
  const F one = q / curve, other = num::select(q == F(0.0f), F(0.0f), power / q);
  const F first = num::min(one, other), last = num::max(one, other), far = F(3e38f);
  const auto twice = curve >= F(0.0f), up = a > F(0.0f);
  const auto met = (rest >= F(0.0f)) & (num::fnma(other, a, la) >= F(0.0f));
  return {num::select(twice, num::select(met, first, far), num::select(up, -far, last)),
          num::select(twice, num::select(met, last, -far), num::select(up, first, far))};
}

template <class F>
TOFRAY_INLINE Crossing<F> crossing(const ConeForm& c, const Ray<F>& ray, F a) {
  const F u = dot(ray, c.u), v = dot(ray, c.v), k = dot(ray, c.tip) * (ray.inverse_length * ray.inverse_length);
  const F e = num::fnma(F(c.line), a, F(c.top) * u), rest = num::fnma(F(c.power) * v, v, e * e);
  const Between<F> side = within_side(num::fnma(k, u, F(c.line)), -(k * v), num::fnma(k, a, F(c.top)), u, v, a, rest);
  const F in = k + side.low, out = F(1.0f) / num::max(k + side.high, F(1e-30f));
  if (c.within_side != 0) return {F(2e30f), out};
  const auto met = (side.low <= side.high) & (in > F(0.0f));
  return {num::select(met, F(1.0f) / in, F(0.0f)), num::select(met, out, F(2e30f))};
}

/// `side` is 0 for the side, 1 for the base.
template <class F>
TOFRAY_INLINE F inverse_range(const ConeForm& c, const Ray<F>& ray, Int<F>& side) {
  const F a = dot(ray, c.a);
  const Crossing<F> base{num::fma(a, F(c.near_scale), F(c.near_offset)), num::max(a * F(c.far_scale), F(0.0f))};
  return meet(crossing(c, ray, a), base, c.inside != 0, side);
}

TOFRAY_INLINE ConeAlong seen_along(const Cone& c, const Vec& s) {
  ConeAlong form{};
  const double sine = sine_of(c), cosine = cosine_of(c);
  const Vec way = way_across(s, c.axis), u = cosine * way, v = cosine * cross(c.axis, way), a = sine * c.axis;
  copy(u, form.u), copy(v, form.v), copy(a, form.a), copy(-1 * s, form.back);
  form.offset[0] = single(-dot(c.tip, u)), form.offset[1] = single(-dot(c.tip, v)), form.offset[2] = single(-dot(c.tip, a));
  form.offset[3] = single(dot(c.tip, s));
  const double light_u = dot(s, u), light_a = dot(s, a);
  form.light_u = single(light_u), form.light_a = single(light_a), form.curve = single((light_u - light_a) * (light_u + light_a));
  form.base = single(-sine * c.height), form.inverse_a = single(inverse(light_a));
  form.own_blocks = inside(c, {0, 0, 0});
  return form;
}

template <class F>
TOFRAY_INLINE Mask<F> blocks(const ConeAlong& c, const Place<F>& p, const float*, F margin) {
  const F u = affine(p, c.u, c.offset[0]), v = affine(p, c.v, c.offset[1]), a = affine(p, c.a, c.offset[2]);
  const F k = affine(p, c.back, c.offset[3]), light_u = F(c.light_u), light_a = F(c.light_a);
  const F e = num::fnma(a, light_u, u * light_a), rest = num::fnma(F(c.curve) * v, v, e * e);
  const Between<F> side = within_side(-num::fma(k, light_u, u), -v, -num::fma(k, light_a, a), light_u, F(0.0f), light_a, rest);
  const F base = (F(c.base) - a) * F(c.inverse_a);
  F enter = num::max(F(0.0f), k + side.low), leave = k + side.high;
  if (c.inverse_a > 0) {
    enter = num::max(enter, base);
  } else {
    leave = num::min(leave, base);
  }
  return leave > enter + margin;
}

TOFRAY_INLINE ConeFree free_of(const Cone& c) {
  ConeFree form{};
  const Vec u = way_across({0, 0, 0}, c.axis), v = cross(c.axis, u);
  copy(cosine_of(c) * u, form.u), copy(cosine_of(c) * v, form.v), copy(sine_of(c) * c.axis, form.a), copy(c.tip, form.tip);
  form.base = single(-sine_of(c) * c.height);
  return form;
}

/// From the line's point that is nearest to the tip, so that no number is larger than what it passes.
template <class F>
TOFRAY_INLINE Passage<F> passage(const ConeFree& c, const FreeRay<F>& ray) {
  const F x = F(c.tip[0]) - ray.x, y = F(c.tip[1]) - ray.y, z = F(c.tip[2]) - ray.z;
  const F k = num::fma(x, ray.dx, num::fma(y, ray.dy, z * ray.dz));
  const F lx = num::fnma(k, ray.dx, x), ly = num::fnma(k, ray.dy, y), lz = num::fnma(k, ray.dz, z);  // to the tip, from there
  const auto across = [&](const float* m) TOFRAY_LAMBDA { return num::fma(lx, F(m[0]), num::fma(ly, F(m[1]), lz * F(m[2]))); };
  const F lu = across(c.u), lv = across(c.v), la = across(c.a), u = turned(ray, c.u), v = turned(ray, c.v), a = turned(ray, c.a);
  const F e = num::fnma(lu, a, la * u), f = num::fnma(lv, a, la * v), g = num::fnma(lu, v, lv * u);
  const F rest = num::fnma(g, g, num::fma(e, e, f * f));
  const Between<F> side = within_side(lu, lv, la, u, v, a, rest);
  // The base is where τ·a = base + la: what is above it is on the tip's side.
  const F base = (F(c.base) + la) * inverse_of(a);
  const auto up = a > F(0.0f);
  const Passage<F> flat{num::select(up, base, F(-never)), num::select(up, F(never), base), Int<F>(1), Int<F>(1)};
  Passage<F> all = common_passage(Passage<F>{side.low, side.high, Int<F>(0), Int<F>(0)}, flat);
  all.in = all.in + k, all.out = all.out + k;
  return all;
}

}  // namespace tofray::shape
