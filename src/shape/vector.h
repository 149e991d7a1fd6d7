// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "num/num.h"

/// Three-vectors in double precision, for the set-up of forms: the same text on the processor and on the GPU.
namespace tofray::shape {

struct Vec {
  double x, y, z;
  TOFRAY_INLINE double& operator[](int k) { return k == 0 ? x : k == 1 ? y : z; }
  TOFRAY_INLINE double operator[](int k) const { return k == 0 ? x : k == 1 ? y : z; }
  bool operator==(const Vec&) const = default;
};

TOFRAY_INLINE Vec operator+(const Vec& a, const Vec& b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
TOFRAY_INLINE Vec operator-(const Vec& a, const Vec& b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
TOFRAY_INLINE Vec operator*(double s, const Vec& a) { return {s * a.x, s * a.y, s * a.z}; }
TOFRAY_INLINE double dot(const Vec& a, const Vec& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
/// Exactly antisymmetric: cross(b, a) has the same bits as −cross(a, b). Watertight edges rest on it.
TOFRAY_INLINE Vec cross(const Vec& a, const Vec& b) { return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x}; }
TOFRAY_INLINE double length(const Vec& a) { return ::sqrt(dot(a, a)); }
TOFRAY_INLINE Vec normalized(const Vec& a) { return (1 / length(a)) * a; }

/// What of p is across the unit vector `axis`.
TOFRAY_INLINE Vec across(const Vec& p, const Vec& axis) { return p - dot(p, axis) * axis; }
/// Its direction; any one across the axis where p has none.
TOFRAY_INLINE Vec way_across(const Vec& p, const Vec& axis) {
  const Vec side = across(p, axis);
  if (length(side) > 1e-12 * length(p)) return normalized(across(side, axis));
  const double x = ::fabs(axis.x), y = ::fabs(axis.y), z = ::fabs(axis.z);
  return normalized(cross(axis, x <= y && x <= z ? Vec{1, 0, 0} : y <= z ? Vec{0, 1, 0} : Vec{0, 0, 1}));
}

/// Rows of a rotation matrix.
struct Mat {
  Vec row[3];
  bool operator==(const Mat&) const = default;
};
TOFRAY_INLINE Vec operator*(const Mat& m, const Vec& a) { return {dot(m.row[0], a), dot(m.row[1], a), dot(m.row[2], a)}; }
/// The transposed matrix times a.
TOFRAY_INLINE Vec back(const Mat& m, const Vec& a) {
  return {m.row[0].x * a.x + m.row[1].x * a.y + m.row[2].x * a.z, m.row[0].y * a.x + m.row[1].y * a.y + m.row[2].y * a.z,
          m.row[0].z * a.x + m.row[1].z * a.y + m.row[2].z * a.z};
}

/// A frame of axes in the world (rows) about a point. What is at P in the world is at axes·(P − origin) in it.
struct CoordinateFrame {
  Mat axes;
  Vec origin;
  TOFRAY_INLINE Vec point(const Vec& p) const { return axes * (p - origin); }
  TOFRAY_INLINE Vec direction(const Vec& d) const { return axes * d; }
  bool operator==(const CoordinateFrame&) const = default;
};

/// Where the user puts a thing: turned about its own centre, then shifted. `said` is a vector of the public structs.
struct Placement {
  Mat turn;
  Vec shift;
  template <class Said>
  static Vec vec(const Said& said) {
    return {said[0], said[1], said[2]};
  }
  [[nodiscard]] bool turns() const { return turn.row[0].x != 1 || turn.row[1].y != 1 || turn.row[2].z != 1; }
  [[nodiscard]] Vec point(const Vec& p, const Vec& center) const { return (turn * (p - center)) + center + shift; }
  [[nodiscard]] Vec direction(const Vec& d) const { return turn * d; }
};

}  // namespace tofray::shape
