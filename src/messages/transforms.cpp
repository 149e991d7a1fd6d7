// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>

#include "messages/parts.h"

namespace tofray::messages {

namespace {

/// Rotations by rows.
using Matrix = std::array<double, 9>;

Matrix product(const Matrix& a, const Matrix& b) {
  Matrix out{};
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j) out[3 * i + j] = a[3 * i] * b[j] + a[3 * i + 1] * b[3 + j] + a[3 * i + 2] * b[6 + j];
  return out;
}
Matrix transposed(const Matrix& m) { return {m[0], m[3], m[6], m[1], m[4], m[7], m[2], m[5], m[8]}; }

/// x, y, z, w with w not negative, by the largest of the four, so that no small number is divided by.
std::array<double, 4> quaternion_of(const Matrix& m) {
  const double trace = m[0] + m[4] + m[8];
  const std::array<double, 4> squares = {1 + m[0] - m[4] - m[8], 1 - m[0] + m[4] - m[8], 1 - m[0] - m[4] + m[8], 1 + trace};  // 4·q²
  const std::size_t largest = static_cast<std::size_t>(std::max_element(squares.begin(), squares.end()) - squares.begin());
  std::array<double, 4> q{};
  const double twice = std::sqrt(squares[largest]);  // 2·|q| of the largest
  q[largest] = 0.5 * twice;
  const double by = 0.5 / twice;
  const double xy = m[1] + m[3], xz = m[2] + m[6], yz = m[5] + m[7];  // 4·q_i·q_j
  const double wx = m[7] - m[5], wy = m[2] - m[6], wz = m[3] - m[1];
  switch (largest) {
    case 0: q[1] = by * xy, q[2] = by * xz, q[3] = by * wx; break;
    case 1: q[0] = by * xy, q[2] = by * yz, q[3] = by * wy; break;
    case 2: q[0] = by * xz, q[1] = by * yz, q[3] = by * wz; break;
    default: q[0] = by * wx, q[1] = by * wy, q[2] = by * wz; break;
  }
  if (q[3] < 0)
    for (double& one : q) one = -one;
  return q;
}

/// Optical axes in the link's: x right = −y, y down = −z, z forward = x.
constexpr Matrix optical_axes = {0, 0, 1, -1, 0, 0, 0, -1, 0};

/// The world's axes on the map, whose z is up.
Matrix world_axes(Scene::Up up) {
  switch (up) {
    case Scene::Up::z: return {1, 0, 0, 0, 1, 0, 0, 0, 1};
    case Scene::Up::y: return {1, 0, 0, 0, 0, -1, 0, 1, 0};
    case Scene::Up::minus_y: break;
  }
  return optical_axes;
}

}  // namespace

Stand optical_in_link() { return {{0, 0, 0}, quaternion_of(optical_axes)}; }

Stand link_on_map(const std::array<double, 16>& p, Scene::Up world_up) {
  const Matrix world = world_axes(world_up), pose = {p[0], p[1], p[2], p[4], p[5], p[6], p[8], p[9], p[10]};
  Stand out;
  for (std::size_t i = 0; i < 3; ++i) out.position[i] = world[3 * i] * p[3] + world[3 * i + 1] * p[7] + world[3 * i + 2] * p[11];
  out.rotation = quaternion_of(product(product(world, pose), transposed(optical_axes)));
  return out;
}

void put_transforms(std::string& out, std::int64_t stamp_ns, const std::vector<NamedStand>& all) {
  Cdr cdr(out);
  cdr.count(all.size());
  for (const NamedStand& one : all) {
    put_header(cdr, {stamp_ns, one.parent}).text(one.child);
    cdr.items(one.stand.position).items(one.stand.rotation);
  }
}

}  // namespace tofray::messages
