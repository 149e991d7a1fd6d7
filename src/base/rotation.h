// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cmath>
#include <string>

#include "base/vec.h"

/// Rotations as quaternions (x, y, z, w) and as matrices, by + - * / and sqrt alone: the same bits on every machine.
namespace tofray::base {

/// How far a quaternion's length may be from 1, and a matrix's columns from being of unit length and across each other: numbers with three
/// decimals are no nearer.
inline constexpr double rotation_tolerance = 1e-3;

inline double dot(const Quaternion& a, const Quaternion& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2] + a[3] * b[3]; }
inline double length(const Quaternion& q) { return std::sqrt(dot(q, q)); }
inline Quaternion normalized(const Quaternion& q) {
  const double n = length(q);
  return {q[0] / n, q[1] / n, q[2] / n, q[3] / n};
}
/// The rotation back.
inline Quaternion inverse(const Quaternion& q) { return {-q[0], -q[1], -q[2], q[3]}; }
/// First b, then a.
inline Quaternion product(const Quaternion& a, const Quaternion& b) {
  return {a[3] * b[0] + a[0] * b[3] + a[1] * b[2] - a[2] * b[1], a[3] * b[1] - a[0] * b[2] + a[1] * b[3] + a[2] * b[0],
          a[3] * b[2] + a[0] * b[1] - a[1] * b[0] + a[2] * b[3], a[3] * b[3] - a[0] * b[0] - a[1] * b[1] - a[2] * b[2]};
}

/// Its matrix, as rows; the quaternion may have any length but zero. Quarter turns about an axis come out exactly.
inline Mat3 matrix_of(const Quaternion& q) {
  const double x = q[0], y = q[1], z = q[2], w = q[3], n = dot(q, q);
  const double xx = x * x, yy = y * y, zz = z * z, ww = w * w;
  return {{{(ww + xx - yy - zz) / n, 2 * (x * y - z * w) / n, 2 * (x * z + y * w) / n},
           {2 * (x * y + z * w) / n, (ww - xx + yy - zz) / n, 2 * (y * z - x * w) / n},
           {2 * (x * z - y * w) / n, 2 * (y * z + x * w) / n, (ww - xx - yy + zz) / n}}};
}

/// Whether it is one by its quaternion or by its angle.
inline bool turns(const Rotation& rotation) { return rotation.quaternion || rotation.angle_rad != 0; }

/// Of unit length, w or else its largest part not below 0, of a matrix (rows) that is a rotation.
Quaternion quaternion_of(const Mat3& m);

/// Why a matrix (rows) is no rotation, and what helps; `what` is empty where it is one.
struct NoRotation {
  std::string what, more;
};
NoRotation why_no_rotation(const Mat3& m);

/// Why four numbers are no rotation.
NoRotation why_no_rotation(const Quaternion& q);

}  // namespace tofray::base
