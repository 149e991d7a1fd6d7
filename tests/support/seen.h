// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "scene/frozen_scene.h"
#include "support/pixels.h"

/// Where a pixel's surface point is, in double and by the words of the user's scene.
namespace tofray::test {

inline Vec3 vector_at(const std::vector<float>& array, std::size_t i) {
  return {static_cast<double>(array[3 * i]), static_cast<double>(array[3 * i + 1]), static_cast<double>(array[3 * i + 2])};
}

/// Rodrigues' formula.
inline Vec3 turned(const Rotation& by, const Vec3& a) {
  if (by.angle_rad == 0) return a;
  const Vec3 k = base::normalized(by.axis);
  return std::cos(by.angle_rad) * a + std::sin(by.angle_rad) * base::cross(k, a) + (1 - std::cos(by.angle_rad)) * base::dot(k, a) * k;
}

/// From the camera's frame into the world.
inline Vec3 in_world(const Pose& pose, const Vec3& p) {
  const scene::CameraFrame camera = scene::camera_frame(pose);
  return p[0] * camera.rotation[0] + p[1] * camera.rotation[1] + p[2] * camera.rotation[2] + camera.position;
}

/// From the camera's frame into the one in which an object's shape is written.
inline Vec3 in_object(const Scene& scene, const Object& object, const Vec3& p, double time_s) {
  const Vec3 there = in_world(scene.camera.pose, p) - object.position - time_s * object.velocity_m_per_s;
  return turned({object.rotation.axis, -object.rotation.angle_rad}, there);
}

}  // namespace tofray::test
