// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "scene/motion.h"

/// A scene as triangles, for those who draw it.
namespace tofray::analysis {

using scene::Vec;

/// Where an object is at a time: what is at P in its own frame is at turn·P + origin in the world. Its own frame has the world's axes before
/// the object turns, and its zero is what the object turns about.
struct ObjectPose {
  Vec origin{};
  shape::Mat turn{};
};
ObjectPose pose_of(const Object& object, double time_s);
/// How an object has turned and how far it has gone at a time by its velocities alone, whatever its placement and centre.
ObjectPose gone_by(const Object& object, double time_s);
/// The turn about an axis.
shape::Mat turn_about(const Vec3& axis, double angle_rad);
/// What an object turns about, before it is placed: of a sphere its center.
Vec center_of(const Object& object);

/// How much of an object is drawn.
enum class Drawn : std::uint8_t {
  shape,
  box,  ///< what holds it: its own triangles would be too many
  none,
};

struct SceneTriangles {
  std::vector<std::array<float, 9>> corners;  ///< x, y, z of each of three, in the object's own frame
  std::vector<std::uint32_t> objects;         ///< whose each triangle is, as index in Scene::objects, ascending
  std::vector<Drawn> drawn;                   ///< by object
};

/// The objects at a time: meshes as they are, round shapes by 64 sides with their corners on the surface, of a plane a square about its
/// point, large enough for all else in the scene.
/// @param most  triangles: the objects with the most of them become boxes, and where these are too many still, the last ones nothing
SceneTriangles scene_triangles(const Scene& scene, double time_s, std::size_t most = 300'000);

/// The corners of one object in its own frame. @param patch_m  half the side of the square that a plane becomes
std::vector<std::array<float, 9>> object_triangles(const Object& object, double time_s, double patch_m);

}  // namespace tofray::analysis
