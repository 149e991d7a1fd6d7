// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <array>
#include <cstdint>
#include <limits>
#include <vector>

#include "shape/mesh.h"
#include "tofray/scene.h"

namespace tofray::scene {

/// Four numbers of which x, y and z count: a processor takes them at once.
using Quad = float __attribute__((vector_size(16)));

/// Boxes by their corners. An empty one is the wrong way round.
struct Bounds3 {
  Quad low, high;
  Bounds3() {
    constexpr float all = std::numeric_limits<float>::infinity();
    low = Quad{all, all, all, all}, high = -low;
  }
  void add(const Quad& at_low, const Quad& at_high) {
    low = at_low < low ? at_low : low;
    high = high < at_high ? at_high : high;
  }
  void add(const Quad& p) { add(p, p); }
  void add(const Bounds3& other) { add(other.low, other.high); }
  [[nodiscard]] float half_area() const {
    const Quad size = high - low;
    return size[0] < 0 ? 0 : size[0] * size[1] + size[1] * size[2] + size[2] * size[0];
  }
};

/// A triangle's box, and its number in the mesh.
struct alignas(16) BoxItem {
  float low[3];
  std::int32_t number;
  float high[3];
  float padding = 0;
};

/// A leaf's items.
struct BoxBlock {
  std::uint32_t first, count;
};

/// Boxes of up to eight children each around the triangles of a mesh, which lie in blocks.
struct BoxTree {
  std::vector<shape::MeshNode> nodes;  ///< [0] holds all; never empty; a node's children come behind it
  std::vector<BoxItem> items;
  std::vector<BoxBlock> blocks;  ///< in the order in which nodes name them
  Bounds3 bounds;                ///< around all of them
};

/// Boxes cut where the surface area heuristic says (Wald 2007, in 16 bins): the larger a box, the more rays come by it, the fewer triangles
/// it should hold. The same on every machine and with any number of threads. Time grows as n·log n, the depth is below
/// shape::most_mesh_levels whatever the triangles.
/// @param threads  at most; 0: one per core. Small meshes take one
BoxTree build_box_tree(const TriangleMesh& mesh, int threads);

}  // namespace tofray::scene
