// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include "scene/motion.h"

#include <algorithm>
#include <cmath>

#include "base/constants.h"
#include "base/faults.h"
#include "base/rotation.h"
#include "num/setup_math.h"
#include "tofray/simulator.h"

namespace tofray::scene {

using namespace base;
namespace setup = num::setup;

namespace {

using shape::Mat;

/// The keyframes that a time lies between, and how far it is from the one to the other, 0…1. Beyond the ends both are the same one.
template <class Key>
struct Between {
  const Key *from, *to;
  double share = 0, duration_s = 1;
};

template <class Key>
Between<Key> between(const std::vector<Key>& keys, double time_s) {
  const auto after = std::upper_bound(keys.begin(), keys.end(), time_s, [](double t, const Key& key) { return t < key.time_s; });
  if (after == keys.begin()) return {&keys.front(), &keys.front()};
  if (after == keys.end()) return {&keys.back(), &keys.back()};
  const Key &from = *(after - 1), &to = *after;
  return {&from, &to, (time_s - from.time_s) / (to.time_s - from.time_s), to.time_s - from.time_s};
}

Vec3 mixed(const Vec3& a, const Vec3& b, double share) { return a + share * (b - a); }

/// An axis of unit length and an angle.
struct Turn {
  Vec3 axis{0, 0, 1};
  double angle = 0;
};
Turn turn_of(const Quaternion& q) {
  const Vec3 v{q[0], q[1], q[2]};
  const double sine = length(v);
  if (sine == 0) return {};
  return {(q[3] < 0 ? -1 / sine : 1 / sine) * v, 2 * setup::atan2(sine, std::abs(q[3]))};
}
Turn turn_of(const Rotation& rotation) {
  if (rotation.quaternion) return turn_of(normalized(*rotation.quaternion));
  return rotation.angle_rad == 0 ? Turn{} : Turn{normalized(rotation.axis), rotation.angle_rad};
}

Quaternion quaternion_of(const Rotation& rotation) {
  if (rotation.quaternion) return normalized(*rotation.quaternion);
  const Turn turn = turn_of(rotation);
  const double sine = setup::sin(0.5 * turn.angle);
  return {sine * turn.axis[0], sine * turn.axis[1], sine * turn.axis[2], setup::cos(0.5 * turn.angle)};
}

/// From one rotation to another, by a turn that follows the first. Rotations about one axis, or its opposite, keep all their angle; others go
/// the shortest way, by the quaternion b·a⁻¹, and so does what a quaternion says.
Turn turn_between(const Rotation& from, const Rotation& to) {
  if (from.quaternion || to.quaternion) return turn_of(base::product(quaternion_of(to), inverse(quaternion_of(from))));
  const Turn a = turn_of(from), b = turn_of(to);
  if (a.angle == 0) return b;
  if (b.angle == 0) return {a.axis, -a.angle};
  // Axes are the same where no more than rounding is between them.
  if (length(cross(a.axis, b.axis)) < 1e-14) return {a.axis, (dot(a.axis, b.axis) > 0 ? b.angle : -b.angle) - a.angle};
  const double wa = setup::cos(0.5 * a.angle), wb = setup::cos(0.5 * b.angle);
  const Vec3 va = -setup::sin(0.5 * a.angle) * a.axis, vb = setup::sin(0.5 * b.angle) * b.axis;
  const double w = wa * wb - dot(vb, va);
  const Vec3 v = wb * va + wa * vb + cross(vb, va);
  const double sine = length(v);
  if (sine == 0) return {};
  return {(w < 0 ? -1 / sine : 1 / sine) * v, 2 * setup::atan2(sine, std::abs(w))};
}

/// A steady turn's angle at a time. What is beyond `largest_angle`'s reach loses its whole turns first.
double angle_at(double rate, double time_s) {
  const double angle = rate * time_s;
  return std::abs(angle) < 1e8 ? angle : std::fmod(angle, two_pi);  // fmod is exact on every machine
}

/// How v/|v| changes where v changes by `change`.
Vec3 change_of_direction(const Vec3& v, const Vec3& change) {
  const Vec3 n = normalized(v);
  return (1 / length(v)) * (change - dot(n, change) * n);
}

}  // namespace

Mat product(const Mat& a, const Mat& b) { return {{back(b, a.row[0]), back(b, a.row[1]), back(b, a.row[2])}}; }

Mat rotation_matrix(const Rotation& r) {
  if (r.quaternion) {
    const Mat3 m = matrix_of(*r.quaternion);
    return {{vec(m[0]), vec(m[1]), vec(m[2])}};
  }
  if (r.angle_rad == 0) return {{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
  const Vec3 k = normalized(r.axis);
  const double c = setup::cos(r.angle_rad), s = setup::sin(r.angle_rad), v = 1 - c;
  return {{{c + k[0] * k[0] * v, k[0] * k[1] * v - k[2] * s, k[0] * k[2] * v + k[1] * s},
           {k[1] * k[0] * v + k[2] * s, c + k[1] * k[1] * v, k[1] * k[2] * v - k[0] * s},
           {k[2] * k[0] * v - k[1] * s, k[2] * k[1] * v + k[0] * s, c + k[2] * k[2] * v}}};
}

bool moves(const Object& object) {
  const Vec3 &v = object.velocity_m_per_s, &w = object.angular_velocity_rad_per_s;
  const auto* mesh = std::get_if<Mesh>(&object.shape);
  return dot(v, v) > 0 || dot(w, w) > 0 || !object.keyframes.empty() || (mesh != nullptr && mesh->motion != nullptr);
}

Motion motion_at(const Object& object, const Vec& center, double time_s) {
  Motion out;
  Vec shift = time_s * vec(object.velocity_m_per_s), velocity = vec(object.velocity_m_per_s);
  const double rate = length(object.angular_velocity_rad_per_s);
  bool turns = rate > 0;
  if (turns) {
    out.turn = rotation_matrix({object.angular_velocity_rad_per_s, angle_at(rate, time_s)});
    out.spin = vec(object.angular_velocity_rad_per_s);
  }
  if (!object.keyframes.empty()) {
    const auto keys = between(object.keyframes, time_s);
    const Keyframe &from = *keys.from, &to = *keys.to;
    const Turn turn = turn_between(from.rotation, to.rotation);
    shift = vec(mixed(from.position, to.position, keys.share));
    velocity = (1 / keys.duration_s) * (vec(to.position) - vec(from.position));
    out.turn = product(rotation_matrix({turn.axis, keys.share * turn.angle}), rotation_matrix(from.rotation));
    out.spin = (turn.angle / keys.duration_s) * vec(turn.axis);
    turns = base::turns(from.rotation) || turn.angle != 0;
  }
  out.shift = turns ? center + shift - out.turn * center : shift;
  out.drift = velocity - cross(out.spin, center + shift);
  return out;
}

CameraFrame camera_frame(const Pose& pose) {
  if (pose.quaternion) return {transposed(matrix_of(*pose.quaternion)), pose.position};
  const Vec3 forward = normalized(pose.look_at - pose.position);
  const Vec3 down = normalized(dot(pose.up, forward) * forward - pose.up);
  return {{{cross(down, forward), down, forward}}, pose.position};
}

namespace {
/// Whether the camera turns evenly from one to the other.
bool steady(const Between<CameraKeyframe>& keys) { return keys.from->pose.quaternion || keys.to->pose.quaternion; }

Quaternion quaternion_of(const Pose& pose) {
  return pose.quaternion ? normalized(*pose.quaternion) : base::quaternion_of(transposed(camera_frame(pose).rotation));
}

Turn turn_between(const Pose& from, const Pose& to) { return turn_of(base::product(quaternion_of(to), inverse(quaternion_of(from)))); }
}  // namespace

Keyframe going_on(const Keyframe& from, const Keyframe& to) {
  const Turn turn = turn_between(from.rotation, to.rotation);
  Keyframe out{2 * to.time_s - from.time_s, 2.0 * to.position - from.position, to.rotation};
  if (turn.angle == 0) return out;
  if (!from.rotation.quaternion && !to.rotation.quaternion) {
    const Turn last = turn_of(to.rotation);
    if (last.angle == 0 || length(cross(last.axis, turn.axis)) < 1e-14) {
      const double angle = last.angle == 0 ? 0 : dot(last.axis, turn.axis) > 0 ? last.angle : -last.angle;
      out.rotation = {turn.axis, angle + turn.angle};
      return out;
    }
  }
  const Quaternion again = quaternion_of(Rotation{turn.axis, turn.angle});
  out.rotation = {{0, 0, 1}, 0, base::product(again, quaternion_of(to.rotation))};
  return out;
}

CameraKeyframe going_on(const CameraKeyframe& from, const CameraKeyframe& to) {
  const Turn turn = turn_between(from.pose, to.pose);
  const Quaternion again = quaternion_of(Rotation{turn.axis, turn.angle});
  return {2 * to.time_s - from.time_s,
          {2.0 * to.pose.position - from.pose.position, {0, 0, 1}, {0, -1, 0}, base::product(again, quaternion_of(to.pose))}};
}

Pose pose_at(const CameraChoice& camera, double time_s) {
  if (camera.keyframes.empty()) return camera.pose;
  const auto keys = between(camera.keyframes, time_s);
  const Pose &a = keys.from->pose, &b = keys.to->pose;
  if (steady(keys)) {
    const Turn turn = turn_between(a, b);
    const Quaternion part = quaternion_of(Rotation{turn.axis, keys.share * turn.angle});
    return {mixed(a.position, b.position, keys.share), {0, 0, 1}, {0, -1, 0}, base::product(part, quaternion_of(a))};
  }
  return {mixed(a.position, b.position, keys.share), mixed(a.look_at, b.look_at, keys.share), mixed(a.up, b.up, keys.share)};
}

MovingCamera camera_at(const CameraChoice& camera, double time_s) {
  const Pose now = pose_at(camera, time_s);
  MovingCamera out{camera_frame(now)};
  if (camera.keyframes.empty()) return out;
  const auto keys = between(camera.keyframes, time_s);
  if (keys.from == keys.to) return out;
  const Pose &from = keys.from->pose, &to = keys.to->pose;
  if (steady(keys)) {
    const Turn turn = turn_between(from, to);
    out.velocity = (1 / keys.duration_s) * (vec(to.position) - vec(from.position));
    out.spin = (turn.angle / keys.duration_s) * vec(turn.axis);
    return out;
  }
  // The axes turn as their derivatives say: spin = ½·Σ axis × its change.
  const auto change = [&](const Vec3 Pose::*of) { return (1 / keys.duration_s) * (to.*of - from.*of); };
  const Vec3 view = now.look_at - now.position, forward = out.frame.rotation[2];
  const Vec3 turn = change_of_direction(view, change(&Pose::look_at) - change(&Pose::position)), rise = change(&Pose::up);
  const Vec3 down = dot(now.up, forward) * forward - now.up;
  const Vec3 sink = change_of_direction(down, (dot(rise, forward) + dot(now.up, turn)) * forward + dot(now.up, forward) * turn - rise);
  const Vec3 left = cross(sink, forward) + cross(out.frame.rotation[1], turn);
  const Vec3 spin = 0.5 * (cross(out.frame.rotation[0], left) + cross(out.frame.rotation[1], sink) + cross(forward, turn));
  out.velocity = vec(change(&Pose::position)), out.spin = vec(spin);
  return out;
}

}  // namespace tofray::scene

namespace tofray {

namespace {
std::array<double, 16> camera_to_world(const Pose& one) {
  const scene::CameraFrame frame = scene::camera_frame(one);
  std::array<double, 16> pose{};
  for (std::size_t i = 0; i < 3; ++i) {
    // The frame's rotation takes world to camera: its transpose goes back.
    for (std::size_t j = 0; j < 3; ++j) pose[4 * i + j] = frame.rotation[j][i] + 0.0;
    pose[4 * i + 3] = frame.position[i];
  }
  pose[15] = 1;
  return pose;
}
}  // namespace

std::array<double, 16> pose_matrix(const Pose& pose) {
  if (pose.quaternion) {
    const base::NoRotation wrong = base::why_no_rotation(*pose.quaternion);
    if (!wrong.what.empty()) base::refuse(wrong.what + "\n  " + wrong.more);
  }
  const std::array<double, 16> out = camera_to_world(pose);
  if (!std::all_of(out.begin(), out.end(), [](double part) { return std::isfinite(part); }))
    base::refuse("the pose looks nowhere\n  expected finite numbers, look_at apart from position, and up across the way from there to it");
  return out;
}

std::array<double, 16> camera_pose(const Scene& scene, double time_s) { return camera_to_world(scene::pose_at(scene.camera, time_s)); }

Pose pose_from_matrix(const std::array<double, 16>& camera_to_world) {
  const auto& m = camera_to_world;
  for (std::size_t i = 0; i < m.size(); ++i)
    if (!std::isfinite(m[i]))
      base::refuse("the matrix of a pose has a number that is not finite, at row " + std::to_string(i / 4) + ", column " +
                   std::to_string(i % 4));
  if (m[12] != 0 || m[13] != 0 || m[14] != 0 || m[15] != 1)
    base::refuse(
        "the last row of the matrix of a pose is not 0, 0, 0, 1\n  expected the position in the last column; a transposed matrix has it in "
        "the last row");
  const base::Mat3 turn{{{m[0], m[1], m[2]}, {m[4], m[5], m[6]}, {m[8], m[9], m[10]}}};
  const base::NoRotation wrong = base::why_no_rotation(turn);
  if (!wrong.what.empty()) base::refuse(wrong.what + "\n  " + wrong.more);
  Pose pose;
  pose.position = {m[3], m[7], m[11]}, pose.quaternion = base::quaternion_of(turn);
  return pose;
}

}  // namespace tofray
