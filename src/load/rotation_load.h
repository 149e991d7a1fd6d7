// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "tofray/scene.h"
#include "yaml/reader.h"

/// Rotations as ROS, OpenCV, OpenGL and Blender write them: quaternions, matrices, Euler angles, about a camera's optical axes or others.
namespace tofray::load {

/// Where a camera that says nothing stands in a world with that axis up: it looks along z where −y is up, along x where z is, along −z where
/// y is.
Pose pose_in(Scene::Up world_up);

/// What a pose's map says beside look_at and up, as the pose's position and quaternion.
void complete_pose(const yaml::Value& map, Pose& pose, base::Faults& faults);
/// What an object's rotation says beside axis and angle, as its quaternion.
void complete_rotation(const yaml::Value& map, Rotation& rotation, base::Faults& faults);

/// Zero has no sign in what readers hand on.
inline Quaternion without_minus_zero(const Quaternion& q) { return {q[0] + 0.0, q[1] + 0.0, q[2] + 0.0, q[3] + 0.0}; }

/// Where a camera is on what carries it: what a map says by position, quaternion, matrix or euler, and axes. Not turned unless it says so.
Pose mount_of(const yaml::Value& map, base::Faults& faults);

/// From the camera's optical axes to those that `axes` in a map of the scene says: optical, body, opengl.
Quaternion optical_in(const yaml::Value& map);

}  // namespace tofray::load
