// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "base/vec.h"
#include "shape/vector.h"
#include "tofray/scene.h"

/// Where things are at a time, and how they move then.
namespace tofray::scene {

using shape::Vec;

inline Vec vec(const Vec3& a) { return {a[0], a[1], a[2]}; }

/// A rigid motion, in the world, seen at one time: what was at P before it began is at turn·P + shift [theory: rigid-motion], and moves
/// with drift + spin × (its place now) [theory: velocity-field].
struct Motion {
  shape::Mat turn{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
  Vec shift{0, 0, 0};
  Vec drift{0, 0, 0};  ///< [m/s]
  Vec spin{0, 0, 0};   ///< [rad/s]
};

/// Rodrigues' formula, as rows.
shape::Mat rotation_matrix(const Rotation& rotation);
inline shape::Placement placement_of(const Object& object) { return {rotation_matrix(object.rotation), vec(object.position)}; }

shape::Mat product(const shape::Mat& a, const shape::Mat& b);

/// Whether it is not always as `placement_of` puts it.
bool moves(const Object& object);
/// By both velocities, or between two keyframes [theory: keyframes].
/// @param center  what the object turns about, where the scene puts it before it moves
Motion motion_at(const Object& object, const Vec& center, double time_s);

/// Where it is as long after `to` as that is after `from`, if it goes on as it went: turns about one axis keep all their angle.
Keyframe going_on(const Keyframe& from, const Keyframe& to);
CameraKeyframe going_on(const CameraKeyframe& from, const CameraKeyframe& to);

/// Rows: camera x, y, z axes in the world. camera = rotation · (world − position).
struct CameraFrame {
  base::Mat3 rotation;
  Vec3 position;
  bool operator==(const CameraFrame&) const = default;
};
CameraFrame camera_frame(const Pose& pose);

/// The camera's frame and how it moves, in the world.
struct MovingCamera {
  CameraFrame frame;
  Vec velocity{0, 0, 0}, spin{0, 0, 0};
};
/// Its pose, or a mean of two keyframes' [theory: camera-keyframes].
Pose pose_at(const CameraChoice& camera, double time_s);
MovingCamera camera_at(const CameraChoice& camera, double time_s);

}  // namespace tofray::scene
