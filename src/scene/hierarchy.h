// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <vector>

#include "shape/mesh.h"
#include "tofray/scene.h"

namespace tofray::scene {

/// A mesh as rays want it: its triangles in boxes within boxes (shape/mesh.h walks them).
struct Hierarchy {
  std::vector<shape::MeshNode> nodes;  ///< [0] holds all; never empty
  std::vector<shape::MeshTriangles> triangles;
  std::vector<shape::MeshDetails> details;  ///< one for each block of triangles, or none
  bool has_texcoords = false;               ///< in `details`
  shape::Vec center{}, half{};              ///< of the box round all of them
};

/// Boxes of up to eight children each, cut where the surface area heuristic says (Wald 2007, in 16 bins): the larger a box, the more rays
/// come by it, the fewer triangles it should hold. What a ray hits does not depend on where the cuts are. One thread; the same on every
/// machine.
///
/// Time grows as n·log n, the depth is below shape::most_mesh_levels whatever the triangles.
Hierarchy build_hierarchy(const TriangleMesh& mesh);

}  // namespace tofray::scene
