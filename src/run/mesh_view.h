// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <optional>
#include <string>

#include "base/vec.h"
#include "tofray/camera.h"
#include "tofray/run.h"
#include "tofray/scene.h"

/// Where a camera stands to see a mesh that is alone.
namespace tofray::run {

/// Round all of a scene's meshes.
struct MeshBox {
  Vec3 low{}, high{};
  [[nodiscard]] double largest() const;
};
MeshBox box_round(const Scene& scene);

/// A direction, x right, y down, z forward, in the world.
Vec3 in_world(const Vec3& v, Scene::Up up);

struct MeshView {
  Pose pose;
  /// Where most of the mesh would have no depth, since it is too large or too small: its size, what the camera can do, and the scale that
  /// would fit.
  std::optional<Remark> odd_size;
};

/// From before, above and aside; as near as all of it stays in the image with a twentieth to spare on each side, but no nearer than where
/// the camera saturates.
/// @param scene  meshes alone
/// @param path   what messages call the mesh
MeshView view_of_meshes(const Scene& scene, const Camera& camera, const std::string& path);

}  // namespace tofray::run
