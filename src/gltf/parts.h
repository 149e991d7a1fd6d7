// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <array>
#include <cstddef>
#include <vector>

#include "gltf/model.h"
#include "gltf/pose.h"

namespace tofray::gltf {

/// One primitive of one node, or of one of its instances, in the world: y up, metres.
///
/// Vertices are those that triangles use, in the order in which they use them: the same at each time. Triangles are counterclockwise as
/// seen from their front. Left out are those with a vertex twice, and, counted, those with a corner beyond the range of float.
struct Part {
  int node = none, material = none;                            ///< of the model
  TriangleMesh mesh;                                           ///< vertices finite
  std::vector<std::array<float, 3>> normals;                   ///< of unit length, or 0 where none is known; empty or one for each vertex
  std::array<std::vector<std::array<float, 2>>, 2> texcoords;  ///< of both sets; empty or one for each vertex
  std::vector<std::array<float, 4>> colors;                    ///< empty or one for each vertex
  std::size_t not_finite = 0;                                  ///< triangles left out
};

/// All that the pose's scene shows: the parts of each node, in the order of nodes and primitives, with morph targets and skins.
std::vector<Part> parts(const Model& model, const Pose& pose);

}  // namespace tofray::gltf
