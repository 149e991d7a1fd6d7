// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <algorithm>

#include "support/seen.h"

/// Rotations one after the other, by quaternions, and scenes that stand where one in motion is at a time.
namespace tofray::test {

struct Quaternion {
  double w;
  Vec3 v;
};
inline double dot(const Quaternion& a, const Quaternion& b) { return a.w * b.w + base::dot(a.v, b.v); }

inline Quaternion quaternion(const Rotation& by) {
  if (by.angle_rad == 0) return {1, {0, 0, 0}};
  return {std::cos(0.5 * by.angle_rad), std::sin(0.5 * by.angle_rad) * base::normalized(by.axis)};
}
inline Rotation rotation(const Quaternion& q) {
  const double sine = base::length(q.v);
  if (sine == 0) return {};
  return {q.v, 2 * std::atan2(sine, q.w)};
}
/// The second after the first.
inline Rotation after(const Rotation& first, const Rotation& second) {
  const Quaternion a = quaternion(first), b = quaternion(second);
  return rotation(Quaternion{b.w * a.w - base::dot(b.v, a.v), b.w * a.v + a.w * b.v + base::cross(b.v, a.v)});
}

/// Halfway and so on between two rotations, the shortest way.
inline Rotation slerp(const Rotation& from, const Rotation& to, double share) {
  const Quaternion a = quaternion(from), b = quaternion(to);
  const double sign = dot(a, b) < 0 ? -1 : 1, angle = std::acos(std::min(1.0, sign * dot(a, b)));
  if (angle < 1e-9) return from;
  const double one = std::sin((1 - share) * angle) / std::sin(angle), other = sign * std::sin(share * angle) / std::sin(angle);
  return rotation(Quaternion{one * a.w + other * b.w, one * a.v + other * b.v});
}

/// An object that stands where a moving one is at a time. Its keyframes turn by less than half a turn from one to the next.
inline Object standing(Object object, double time_s) {
  const Vec3 spin = object.angular_velocity_rad_per_s;
  if (object.keyframes.empty()) {
    object.position = object.position + time_s * object.velocity_m_per_s;
    object.rotation = after(object.rotation, {spin, time_s * base::length(spin)});
  } else {
    std::size_t k = 0;
    const std::vector<Keyframe>& keys = object.keyframes;
    while (k + 1 < keys.size() && keys[k + 1].time_s <= time_s) ++k;
    const Keyframe &from = keys[k], &to = keys[std::min(k + 1, keys.size() - 1)];
    const double share = &from == &to || time_s < from.time_s ? 0 : (time_s - from.time_s) / (to.time_s - from.time_s);
    object.position = from.position + share * (to.position - from.position);
    object.rotation = slerp(from.rotation, to.rotation, share);
  }
  object.velocity_m_per_s = object.angular_velocity_rad_per_s = {0, 0, 0};
  object.keyframes.clear();
  return object;
}

/// A whole scene, with its camera, as it stands at a time.
inline Scene standing(Scene scene, double time_s) {
  for (Object& object : scene.objects) object = standing(object, time_s);
  const std::vector<CameraKeyframe> keys = scene.camera.keyframes;
  if (keys.empty()) return scene;
  std::size_t k = 0;
  while (k + 1 < keys.size() && keys[k + 1].time_s <= time_s) ++k;
  const CameraKeyframe &from = keys[k], &to = keys[std::min(k + 1, keys.size() - 1)];
  const double share = &from == &to || time_s < from.time_s ? 0 : (time_s - from.time_s) / (to.time_s - from.time_s);
  const auto mixed = [&](const Vec3& a, const Vec3& b) { return a + share * (b - a); };
  scene.camera.pose = {mixed(from.pose.position, to.pose.position), mixed(from.pose.look_at, to.pose.look_at),
                       mixed(from.pose.up, to.pose.up)};
  scene.camera.keyframes.clear();
  return scene;
}

}  // namespace tofray::test
