// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

#include "base/vec.h"
#include "scene/frozen_scene.h"

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

inline Span span(const scene::Placed::PlacedPlane& p, const Vec3& o, const Vec3& d) {
  const double along = base::dot(p.normal, d), t = (p.offset - base::dot(p.normal, o)) / along;
  return {t, t, std::abs(along) / base::length(d), p.object};
}

inline Span span(const scene::Placed::PlacedSphere& s, const Vec3& o, const Vec3& d) {
  const double a = base::dot(d, d);
  const Vec3 c = s.center - o;
  const double b = base::dot(c, d) / a;
  const Vec3 side = c - b * d;
  const double rest = s.radius * s.radius - base::dot(side, side);
  Span out{1, 0, std::abs(rest) / (s.radius * s.radius), s.object};
  if (rest >= 0) out.enter = b - std::sqrt(rest / a), out.leave = b + std::sqrt(rest / a);
  return out;
}

inline Span span(const scene::Placed::PlacedBox& box, const Vec3& o, const Vec3& d) {
  const Vec3 q = box.axes * (o - box.center), e = box.axes * d;
  const double infinite = std::numeric_limits<double>::infinity();
  Span out{-infinite, infinite, 1, box.object};
  for (std::size_t k = 0; k < 3; ++k) {
    if (e[k] == 0 && std::abs(q[k]) > box.half[k]) return {1, 0, 1, box.object};
    if (e[k] == 0) continue;
    const double a = (-box.half[k] - q[k]) / e[k], b = (box.half[k] - q[k]) / e[k];
    out.enter = std::fmax(out.enter, std::fmin(a, b)), out.leave = std::fmin(out.leave, std::fmax(a, b));
  }
  out.clearance = std::abs(out.leave - out.enter) * base::length(d) / base::length(box.half);
  return out;
}

inline Span span(const scene::Placed::PlacedTriangle& t, const Vec3& o, const Vec3& d) {
  const Vec3 a = t.vertices[1] - t.vertices[0], b = t.vertices[2] - t.vertices[0], s = o - t.vertices[0];
  const Vec3 p = base::cross(d, b), q = base::cross(s, a);
  const double det = base::dot(a, p), u = base::dot(s, p) / det, v = base::dot(d, q) / det;
  const double least = std::fmin(u, std::fmin(v, 1 - u - v));
  const Vec3 n = base::cross(a, b);
  const double along = base::dot(b, q) / det, slant = std::abs(base::dot(n, d)) / (base::length(n) * base::length(d));
  Span out{1, 0, std::fmin(std::abs(least), slant), t.object};
  if (least >= 0) out.enter = out.leave = along;
  return out;
}

/// Spans of all objects.
inline std::vector<Span> spans(const scene::Placed& placed, const Vec3& o, const Vec3& d) {
  std::vector<Span> out;
  for (const auto& p : placed.planes) out.push_back(span(p, o, d));
  for (const auto& s : placed.spheres) out.push_back(span(s, o, d));
  for (const auto& b : placed.boxes) out.push_back(span(b, o, d));
  for (const auto& t : placed.triangles) out.push_back(span(t, o, d));
  return out;
}

/// First crossing in front of o; 0 for none.
inline double first(const Span& s) {
  if (s.enter > s.leave) return 0;
  return s.enter > 0 ? s.enter : std::fmax(s.leave, 0);
}

}  // namespace tofray::test
