// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

#include "base/vec.h"
#include "scene/frozen_scene.h"
#include "support/rays.h"

/// Rays against placed objects in double precision, by the forms of the textbook: what the kernels are measured against.
namespace tofray::test {

using base::operator+;
using base::operator-;
using base::operator*;

/// Crossings of the line o + t·d with one convex body: t in [enter, leave]; flat things have both alike. Empty where enter > leave.
struct Span {
  double enter = 1, leave = 0;
  /// How far the body's outline is from the line, as a share of the body: small where rounding may decide.
  double clearance = 1;
  int object = 0;
};

inline Span span(const shape::Plane& p, const Vec3& o, const Vec3& d) {
  const Vec3 n = base::normalized(vec3(p.normal));
  const double along = base::dot(n, d), t = base::dot(n, vec3(p.point) - o) / along;
  return {t, t, std::abs(along) / base::length(d)};
}

inline Span span(const shape::Sphere& s, const Vec3& o, const Vec3& d) {
  const double a = base::dot(d, d);
  const Vec3 c = vec3(s.center) - o;
  const double b = base::dot(c, d) / a;
  const Vec3 side = c - b * d;
  const double rest = s.radius * s.radius - base::dot(side, side);
  Span out{1, 0, std::abs(rest) / (s.radius * s.radius)};
  if (rest >= 0) out.enter = b - std::sqrt(rest / a), out.leave = b + std::sqrt(rest / a);
  return out;
}

inline Span span(const shape::Box& box, const Vec3& o, const Vec3& d) {
  const base::Mat3 axes{{vec3(box.axes.row[0]), vec3(box.axes.row[1]), vec3(box.axes.row[2])}};
  const Vec3 q = axes * (o - vec3(box.center)), e = axes * d, half = vec3(box.half);
  const double infinite = std::numeric_limits<double>::infinity();
  Span out{-infinite, infinite, 1};
  for (std::size_t k = 0; k < 3; ++k) {
    if (e[k] == 0 && std::abs(q[k]) > half[k]) return {1, 0, 1};
    if (e[k] == 0) continue;
    const double a = (-half[k] - q[k]) / e[k], b = (half[k] - q[k]) / e[k];
    out.enter = std::fmax(out.enter, std::fmin(a, b)), out.leave = std::fmin(out.leave, std::fmax(a, b));
  }
  out.clearance = std::abs(out.leave - out.enter) * base::length(d) / base::length(half);
  return out;
}

inline Span span(const shape::Triangle& t, const Vec3& o, const Vec3& d) {
  const Vec3 corner = vec3(t.vertex[0]);
  const Vec3 a = vec3(t.vertex[1]) - corner, b = vec3(t.vertex[2]) - corner, s = o - corner;
  const Vec3 p = base::cross(d, b), q = base::cross(s, a);
  const double det = base::dot(a, p), u = base::dot(s, p) / det, v = base::dot(d, q) / det;
  const double least = std::fmin(u, std::fmin(v, 1 - u - v));
  const Vec3 n = base::cross(a, b);
  const double along = base::dot(b, q) / det, slant = std::abs(base::dot(n, d)) / (base::length(n) * base::length(d));
  Span out{1, 0, std::fmin(std::abs(least), slant)};
  if (least >= 0) out.enter = out.leave = along;
  return out;
}

inline Span span(const shape::Cylinder& c, const Vec3& o, const Vec3& d) {
  const Vec3 axis = vec3(c.axis), s = o - vec3(c.center), across = s - base::dot(s, axis) * axis, e = d - base::dot(d, axis) * axis;
  const double infinite = std::numeric_limits<double>::infinity(), a = base::dot(e, e), along = base::dot(d, axis), at = base::dot(s, axis);
  const double distance = a > 0 ? base::length(across - (base::dot(across, e) / a) * e) : base::length(across);
  Span out{-infinite, infinite, std::abs(1 - distance / c.radius)};
  if (distance > c.radius || (along == 0 && std::abs(at) > c.half)) return {1, 0, out.clearance};
  if (a > 0) {
    const double b = base::dot(across, e) / a, chord = std::sqrt((c.radius - distance) * (c.radius + distance) / a);
    out.enter = -b - chord, out.leave = -b + chord;
  }
  if (along != 0) {
    const double one = (-c.half - at) / along, other = (c.half - at) / along;
    out.enter = std::fmax(out.enter, std::fmin(one, other)), out.leave = std::fmin(out.leave, std::fmax(one, other));
  }
  const double size = std::fmin(c.radius, c.half), slant = std::fmax(std::abs(along), std::sqrt(a)) / base::length(d);
  out.clearance = std::fmin(out.clearance, slant * std::abs(out.leave - out.enter) * base::length(d) / size);
  return out;
}

inline Span span(const shape::Rectangle& r, const Vec3& o, const Vec3& d) {
  const Vec3 corner = vec3(r.corner[0]), x = vec3(r.corner[1]) - corner, y = vec3(r.corner[3]) - corner;
  const Vec3 n = base::normalized(base::cross(x, y));
  const double along = base::dot(n, d), slant = std::abs(along) / base::length(d), t = base::dot(n, corner - o) / along;
  const Vec3 at = o + t * d - corner;
  const double u = base::dot(at, x) / base::dot(x, x), v = base::dot(at, y) / base::dot(y, y);
  const double least = std::fmin(std::fmin(u, 1 - u), std::fmin(v, 1 - v));
  Span out{1, 0, std::fmin(std::abs(least), slant)};
  if (along != 0 && least >= 0) out.enter = out.leave = t;
  return out;
}

inline Span span(const shape::Disk& disk, const Vec3& o, const Vec3& d) {
  const Vec3 n = vec3(disk.normal);
  const double along = base::dot(n, d), slant = std::abs(along) / base::length(d), t = base::dot(n, vec3(disk.center) - o) / along;
  const double distance = base::length(o + t * d - vec3(disk.center));
  Span out{1, 0, std::fmin(std::abs(1 - distance / disk.radius), 1.0) * slant};
  if (along != 0 && distance <= disk.radius) out.enter = out.leave = t;
  return out;
}

/// The side within the slab of its ends, and of each end's sphere what is beyond.
inline Span span(const shape::Capsule& c, const Vec3& o, const Vec3& d) {
  const Vec3 axis = vec3(c.axis), s = o - vec3(c.center), e = d - base::dot(d, axis) * axis, across = s - base::dot(s, axis) * axis;
  const double dd = base::dot(d, d), infinite = std::numeric_limits<double>::infinity();
  Span out{infinite, -infinite, 1};
  const auto crossed = [&](double t, int piece) {
    const double z = base::dot(s + t * d, axis);
    if (piece == 0 ? std::abs(z) > c.half : piece * z < c.half) return;
    out.enter = std::fmin(out.enter, t), out.leave = std::fmax(out.leave, t);
  };
  const auto roots = [&](double a, double b, double rest, int piece) {
    if (rest < 0 || !(a > 0)) return;
    crossed((-b - std::sqrt(rest)) / a, piece), crossed((-b + std::sqrt(rest)) / a, piece);
  };
  const double a = base::dot(e, e), b = base::dot(across, e);
  const Vec3 off = across - (a > 0 ? b / a : 0) * e;
  roots(a, b, a * (c.radius * c.radius - base::dot(off, off)), 0);
  for (const int end : {1, -1}) {
    const Vec3 from = s - end * c.half * axis;
    const double along = base::dot(from, d);
    const Vec3 side = from - (along / dd) * d;
    roots(dd, along, dd * (c.radius * c.radius - base::dot(side, side)), end);
  }
  // The line's distance from the segment: where along it the two are nearest, held to the ends.
  const double z = base::dot(s, axis), da = base::dot(d, axis);
  const double nearest = a > 1e-20 * dd ? z - da * b / a : 0, held = std::fmin(std::fmax(nearest, -c.half), c.half);
  const Vec3 to = s - held * axis;
  out.clearance = std::abs(1 - base::length(to - (base::dot(to, d) / dd) * d) / c.radius);
  return out;
}

/// By all points where the line crosses the side or the base. They say nothing of how near the outline is: for that, cones a hundredth
/// smaller and larger about the same centroid have to be hit or missed alike, and what is hit not to be grazed.
inline Span span_of_cone(const Vec3& tip, const Vec3& axis, double radius, double height, const Vec3& o, const Vec3& d) {
  const double infinite = std::numeric_limits<double>::infinity(), steep = radius / height;
  const Vec3 s = o - tip, across = s - base::dot(s, axis) * axis, e = d - base::dot(d, axis) * axis;
  const double z = -base::dot(s, axis), dz = -base::dot(d, axis);  // below the tip
  const double a = base::dot(e, e) - steep * steep * dz * dz, b = base::dot(across, e) - steep * steep * z * dz;
  const double c = base::dot(across, across) - steep * steep * z * z, rest = a < 0 ? std::fmax(b * b - a * c, 0) : b * b - a * c;
  Span out{infinite, -infinite, infinite};
  const auto crossed = [&](double t, bool base) {
    const Vec3 side = across + t * e;
    const double below = z + t * dz, from_axis = base::length(side);
    if (base ? from_axis > radius : below < -1e-12 * height || below > height) return;
    const Vec3 n = base ? axis : base::normalized((1 / (steep * from_axis)) * side + axis);
    out.enter = std::fmin(out.enter, t), out.leave = std::fmax(out.leave, t);
    out.clearance = std::fmin(out.clearance, 5e-3 * std::abs(base::dot(n, d)) / base::length(d));
  };
  if (rest >= 0) crossed((-b - std::sqrt(rest)) / a, false), crossed((-b + std::sqrt(rest)) / a, false);
  crossed((height - z) / dz, true);
  return out;
}
inline Span span(const shape::Cone& c, const Vec3& o, const Vec3& d) {
  const Vec3 tip = vec3(c.tip), axis = vec3(c.axis);
  const auto scaled = [&](double scale) {
    return span_of_cone(tip + (scale - 1) * 0.75 * c.height * axis, axis, scale * c.radius, scale * c.height, o, d);
  };
  const Span smaller = scaled(0.99), larger = scaled(1.01);
  Span out = scaled(1);
  out.clearance = std::fmin(out.clearance, 1);
  if ((smaller.enter > smaller.leave) != (larger.enter > larger.leave)) out.clearance = 0;
  return out;
}

template <class T>
void add_spans(const T& shape, const Vec3& o, const Vec3& d, std::vector<Span>& to) {
  to.push_back(span(shape, o, d));
}
/// One for each triangle. (Where a block is not full its last one comes again.)
inline void add_spans(const shape::Mesh& mesh, const Vec3& o, const Vec3& d, std::vector<Span>& to) {
  for (int i = 0; i < mesh.block_count * shape::block_width; ++i) {
    shape::Triangle one;
    for (int c = 0; c < 3; ++c) {
      const auto& corner = mesh.triangles[i / shape::block_width].corner[c];
      const auto coordinate = [&](int k) { return static_cast<double>(corner[k][i % shape::block_width]); };
      const shape::Vec at{coordinate(0), coordinate(1), coordinate(2)};
      one.vertex[c] = back(mesh.axes, at) + mesh.origin;
    }
    to.push_back(span(one, o, d));
  }
}

template <class... T>
std::vector<Span> spans(shape::List<T...>, const scene::FrozenScene& frozen, const Vec3& o, const Vec3& d) {
  std::vector<Span> out;
  const auto add = [&]<class One>(const scene::BodiesOf<One>& bodies) {
    for (int i = 0; i < bodies.count; ++i) {
      const std::size_t first = out.size();
      add_spans(in_frame(bodies.first[i].shape, frozen.view().camera), o, d, out);
      for (std::size_t k = first; k < out.size(); ++k) out[k].object = bodies.first[i].object;
    }
  };
  (add(frozen.view().still.bodies.of<T>()), ...);
  return out;
}

/// Spans of all objects that stand still; the ray is in the camera's frame.
inline std::vector<Span> spans(const scene::FrozenScene& frozen, const Vec3& o, const Vec3& d) {
  return spans(shape::Shapes{}, frozen, o, d);
}

/// First crossing in front of o; 0 for none.
inline double first(const Span& s) {
  if (s.enter > s.leave) return 0;
  return s.enter > 0 ? s.enter : std::fmax(s.leave, 0);
}

}  // namespace tofray::test
