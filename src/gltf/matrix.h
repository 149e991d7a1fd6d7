// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <array>
#include <cmath>

#include "base/vec.h"

/// Affine matrices and quaternions of glTF, in double precision.
namespace tofray::gltf {

/// Three rows of four numbers; the fourth row is 0 0 0 1.
using Matrix = std::array<std::array<double, 4>, 3>;
/// x, y, z, w.
using Quaternion = std::array<double, 4>;

inline constexpr Matrix identity{{{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}}};

inline Matrix product(const Matrix& a, const Matrix& b) {
  Matrix out{};
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 4; ++j) out[i][j] = a[i][0] * b[0][j] + a[i][1] * b[1][j] + a[i][2] * b[2][j] + (j == 3 ? a[i][3] : 0.0);
  return out;
}

inline Vec3 point(const Matrix& m, const Vec3& p) {
  const auto row = [&](std::size_t i) { return m[i][0] * p[0] + m[i][1] * p[1] + m[i][2] * p[2] + m[i][3]; };
  return {row(0), row(1), row(2)};
}

/// The cofactors of the linear part, by rows: the inverse transposed, times the determinant.
inline base::Mat3 cofactors(const Matrix& m) {
  const Vec3 a{m[0][0], m[0][1], m[0][2]}, b{m[1][0], m[1][1], m[1][2]}, c{m[2][0], m[2][1], m[2][2]};
  return {base::cross(b, c), base::cross(c, a), base::cross(a, b)};
}

/// Of the linear part.
inline double determinant(const Matrix& m) {
  const Vec3 a{m[0][0], m[0][1], m[0][2]};
  return base::dot(a, cofactors(m)[0]);
}

inline double length(const Quaternion& q) { return std::sqrt(q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3]); }

/// Of any length but zero and infinity.
inline Quaternion normalized(Quaternion q) {
  const double size = length(q);
  for (double& x : q) x /= size;
  return q;
}

/// T · R · S; the quaternion is of unit length.
inline Matrix transform(const Vec3& t, const Quaternion& q, const Vec3& s) {
  const auto [x, y, z, w] = q;
  return {{{(1 - 2 * (y * y + z * z)) * s[0], 2 * (x * y - z * w) * s[1], 2 * (x * z + y * w) * s[2], t[0]},
           {2 * (x * y + z * w) * s[0], (1 - 2 * (x * x + z * z)) * s[1], 2 * (y * z - x * w) * s[2], t[1]},
           {2 * (x * z - y * w) * s[0], 2 * (y * z + x * w) * s[1], (1 - 2 * (x * x + y * y)) * s[2], t[2]}}};
}

}  // namespace tofray::gltf
