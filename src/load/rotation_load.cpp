// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include "load/rotation_load.h"

#include <cmath>

#include "base/rotation.h"
#include "base/text.h"
#include "load/convert.h"
#include "num/setup_math.h"

namespace tofray::load {

using base::Faults;
using yaml::Value;

namespace {

/// Rz(yaw)·Ry(pitch)·Rx(roll).
Quaternion of_euler(const Value& map) {
  const auto about = [&](const char* key, std::size_t axis) {
    const double half = 0.5 * map[key].number;
    Quaternion q{0, 0, 0, num::setup::cos(half)};
    q[axis] = num::setup::sin(half);
    return q;
  };
  return base::product(about("yaw", 2), base::product(about("pitch", 1), about("roll", 0)));
}

/// @return whether it has its last row, if any
bool good_last_row(const Value& matrix, Faults& faults) {
  if (matrix.items.size() < 4) return true;
  const std::vector<double> last = numbers(matrix.items[3]);
  if (last == std::vector<double>{0, 0, 0, 1}) return true;
  const auto column = [&](std::size_t row) { return matrix.items[row].items[3].number; };
  const bool transposed = column(0) == 0 && column(1) == 0 && column(2) == 0 && last[3] == 1;
  faults.add(
      matrix.items[3].place(), "the last row of a matrix of 4 x 4 is not 0, 0, 0, 1",
      transposed ? "the matrix is transposed: expected the position in the last column, not in the last row" : "expected [0, 0, 0, 1]");
  return false;
}

/// The rotation of a matrix of three rows at least; its fourth column, if any, is a position.
std::optional<Quaternion> of_matrix(const Value& matrix, Vec3* position, Faults& faults) {
  const std::size_t rows = matrix.items.size(), columns = matrix.items[0].items.size();
  for (const Value& row : matrix.items)
    if (row.items.size() != columns || (rows == 4 && columns != 4)) {
      faults.add(row.place(), "the matrix has rows of other lengths than a pose's",
                 "got " + std::to_string(row.items.size()) + " numbers in one of " + std::to_string(rows) +
                     " rows; expected 3 x 3, or 3 x 4 or 4 x 4 with the position in the last column");
      return {};
    }
  if (!good_last_row(matrix, faults)) return {};
  base::Mat3 m{};
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 3; ++j) m[i][j] = matrix.items[i].items[j].number;
    if (columns == 4) (*position)[i] = matrix.items[i].items[3].number;
  }
  const base::NoRotation wrong = base::why_no_rotation(m);
  if (!wrong.what.empty()) {
    faults.add(matrix.place(), wrong.what, wrong.more);
    return {};
  }
  return base::quaternion_of(m);
}

/// What a map says by a quaternion, a matrix or Euler angles; nothing where it does not, or where that is told as a fault.
/// @param position  out: where a matrix has one; none: it may have none
std::optional<Quaternion> said_rotation(const Value& map, Vec3* position, Faults& faults) {
  if (const Value& quaternion = map["quaternion"]; quaternion && quaternion.good) {
    const std::vector<double> parts = numbers(quaternion);
    const Quaternion q{parts[0], parts[1], parts[2], parts[3]};
    const base::NoRotation wrong = base::why_no_rotation(q);
    if (wrong.what.empty()) return base::normalized(q);
    faults.add(quaternion.place(), wrong.what, wrong.more);
  }
  if (const Value& matrix = map["matrix"]; matrix && matrix.good) return of_matrix(matrix, position, faults);
  if (const Value& euler = map["euler"]; euler && euler.good) return of_euler(euler);
  return {};
}

void refuse_two_positions(const Value& map, Faults& faults) {
  const Value& matrix = map["matrix"];
  if (matrix && matrix.good && matrix.items[0].items.size() == 4 && map["position"])
    faults.add(map["position"].place(), "the pose has a position, and its matrix another one",
               "the last column of the matrix is its position; expected 3 x 3, or no position");
}

}  // namespace

Pose pose_in(Scene::Up world_up) {
  Pose pose;
  if (world_up == Scene::Up::z) pose.look_at = {1, 0, 0}, pose.up = {0, 0, 1};
  if (world_up == Scene::Up::y) pose.look_at = {0, 0, -1}, pose.up = {0, 1, 0};
  return pose;
}

Quaternion optical_in(const Value& map) {
  const Value& axes = map["axes"];
  if (axes.text == "body") return {-0.5, 0.5, -0.5, 0.5};
  if (axes.text == "opengl") return {1, 0, 0, 0};
  return {0, 0, 0, 1};
}

Pose mount_of(const Value& map, Faults& faults) {
  Pose out;
  out.position = vector(map["position"]);
  refuse_two_positions(map, faults);
  out.quaternion = base::product(said_rotation(map, &out.position, faults).value_or(Quaternion{0, 0, 0, 1}), optical_in(map));
  return out;
}

void complete_pose(const Value& map, Pose& pose, Faults& faults) {
  const Value& axes = map["axes"];
  if (!map["quaternion"] && !map["matrix"] && !map["euler"]) {
    if (map["look_at"] && axes)
      faults.add(axes.place(), "axes says nothing of look_at", "it is of a quaternion, a matrix or euler; leave it away");
    if (map["look_at"] || !axes) return;
  }
  if (const Value& up = map["up"])
    faults.add(up.place(), "up goes with look_at alone", "quaternion, matrix, euler and axes say what is up in the image; leave it away");
  refuse_two_positions(map, faults);
  const Pose fresh;
  pose.look_at = fresh.look_at, pose.up = fresh.up, pose.quaternion.reset();
  const bool said = map["quaternion"] || map["matrix"] || map["euler"];
  const std::optional<Quaternion> q = said ? said_rotation(map, &pose.position, faults) : Quaternion{0, 0, 0, 1};
  if (q) pose.quaternion = without_minus_zero(axes ? base::product(*q, optical_in(map)) : *q);
}

void complete_rotation(const Value& map, Rotation& rotation, Faults& faults) {
  const Value &axis = map["axis"], &angle = map["angle"];
  if (axis && !angle) faults.add(map.place(), "rotation lacks the key \"angle\"", "angle: how far, as in angle: 30 deg");
  if (angle && !axis && (map["quaternion"] || map["matrix"] || map["euler"]))
    faults.add(angle.place(), "angle goes with axis alone", "quaternion, matrix and euler say how far; leave it away");
  rotation.quaternion.reset();
  if (const auto q = said_rotation(map, nullptr, faults)) rotation.quaternion = without_minus_zero(*q);
}

}  // namespace tofray::load
