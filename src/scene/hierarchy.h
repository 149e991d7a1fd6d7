// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <array>
#include <memory>
#include <vector>

#include "shape/mesh.h"
#include "tofray/scene.h"

namespace tofray::scene {

/// A mesh as rays want it: its triangles in boxes within boxes (shape/mesh.h walks them).
struct Hierarchy {
  std::vector<shape::MeshNode> nodes;  ///< [0] holds all; never empty
  std::vector<shape::MeshTriangles> triangles;
  std::vector<shape::MeshDetails> details;  ///< one for each block of triangles, or none
  bool has_texcoords = false;               ///< whether `details` has texture coordinates
  bool has_shades = false;                  ///< whether `details` has shades
  shape::Vec center{}, half{};              ///< of the box round all of them
};

/// Boxes around a mesh's triangles (scene/box_tree.h), and these in blocks. What a ray hits does not depend on where the boxes are cut.
/// @param threads  at most; 0: one per core
Hierarchy build_hierarchy(const TriangleMesh& mesh, int threads = 0);

/// The one for all meshes with the same contents
std::shared_ptr<const Hierarchy> shared_hierarchy(const TriangleMesh& mesh, int threads);

/// A hierarchy with its boxes fitted to the same triangles, whose vertices have moved.
/// @param from  was built of the same triangles
/// @param mesh  the vertices, and normals where it has any; the rest does not count
void refit(const Hierarchy& from, const TriangleMesh& mesh, Hierarchy& out);

/// How the corners of its triangles move: by `before`, `after` and `later`, the vertices `apart_s` seconds before and after the time, and
/// one frame later than `now`.
using Vertices = std::vector<std::array<float, 3>>;
std::vector<shape::MeshSteps> steps_of(const Hierarchy& of, const TriangleMesh& mesh, const Vertices& before, const Vertices& after,
                                       double apart_s, const Vertices& now, const Vertices& later);

}  // namespace tofray::scene
