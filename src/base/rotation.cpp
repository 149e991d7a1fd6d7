// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include "base/rotation.h"

#include <fmt/core.h>

#include <algorithm>

namespace tofray::base {

namespace {

/// Four digits tell how far off it is.
std::string in_short(double value) { return fmt::format("{:.4g}", value); }

double determinant(const Mat3& m) { return dot(m[0], cross(m[1], m[2])); }

}  // namespace

Quaternion quaternion_of(const Mat3& m) {
  // Four times the quaternion times one of its parts, which is the largest: no digits are lost.
  const double trace = m[0][0] + m[1][1] + m[2][2];
  const double squares[] = {1 + 2 * m[0][0] - trace, 1 + 2 * m[1][1] - trace, 1 + 2 * m[2][2] - trace, 1 + trace};
  const auto largest = static_cast<std::size_t>(std::max_element(std::begin(squares), std::end(squares)) - std::begin(squares));
  Quaternion q{};
  if (largest == 3) {
    q = {m[2][1] - m[1][2], m[0][2] - m[2][0], m[1][0] - m[0][1], squares[3]};
  } else {
    const std::size_t i = largest, j = (i + 1) % 3, k = (i + 2) % 3;
    q[i] = squares[i], q[j] = m[j][i] + m[i][j], q[k] = m[k][i] + m[i][k], q[3] = m[k][j] - m[j][k];
  }
  q = normalized(q);
  const double sign = q[3] < 0 ? -1 : 1;
  for (double& part : q) part = sign * part + 0.0;  // no −0
  return q;
}

NoRotation why_no_rotation(const Mat3& m) {
  const Mat3 columns = transposed(m);
  const double det = determinant(m);
  const std::string lengths =
      in_short(length(columns[0])) + ", " + in_short(length(columns[1])) + " and " + in_short(length(columns[2])) + " long";
  const std::string got = "got columns that are " + lengths + ", determinant " + in_short(det);
  const bool unit =
      std::all_of(columns.begin(), columns.end(), [](const Vec3& column) { return std::abs(length(column) - 1) <= rotation_tolerance; });
  if (!unit) {
    const double size = length(columns[0]);
    const bool scaled = size > 0 && std::abs(length(columns[1]) / size - 1) <= rotation_tolerance &&
                        std::abs(length(columns[2]) / size - 1) <= rotation_tolerance;
    return {scaled ? "the matrix scales: it is no rotation" : "the matrix is no rotation",
            got + "; expected 1" + (scaled ? "; divide its 3 x 3 by " + in_short(size) + ", or take the scale out where it was made" : "")};
  }
  const double across[] = {dot(columns[0], columns[1]), dot(columns[1], columns[2]), dot(columns[2], columns[0])};
  if (!std::all_of(std::begin(across), std::end(across), [](double part) { return std::abs(part) <= 2 * rotation_tolerance; }))
    return {"the matrix shears: its columns are not across each other", got + "; expected a determinant of 1"};
  if (!(det > 0))
    return {"the matrix mirrors: its determinant is " + in_short(det),
            "expected 1; its columns are x, y and z axes in the world, and one is turned round; between the camera axes of OpenGL or "
            "Blender\nand those of OpenCV two are, y and z (axes: opengl at a camera's pose)"};
  return {};
}

NoRotation why_no_rotation(const Quaternion& q) {
  const double size = length(q);
  if (std::abs(size - 1) <= rotation_tolerance) return {};  // NaN: no
  return {"the quaternion is not of unit length",
          "got a length of " + in_short(size) + ", expected 1; its order is x, y, z, w: no rotation at all is [0, 0, 0, 1]"};
}

}  // namespace tofray::base
