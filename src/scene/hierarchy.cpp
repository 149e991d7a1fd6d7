// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include "scene/hierarchy.h"

#include <algorithm>
#include <array>
#include <utility>

#include "base/content.h"
#include "base/parallel.h"
#include "base/shared.h"
#include "scene/box_tree.h"

namespace tofray::scene {

namespace {

using shape::MeshNode;

void put_box(const Bounds3& bounds, Hierarchy& out) {
  for (int k = 0; k < 3; ++k) {
    const double low = static_cast<double>(bounds.low[k]), high = static_cast<double>(bounds.high[k]);
    out.center[k] = 0.5 * (low + high), out.half[k] = 0.5 * (high - low);
  }
}

/// Calls take(corner, its vertex's number, place) for the corners of a block's triangles.
template <class Take>
void each_corner(const TriangleMesh& mesh, const shape::MeshTriangles& block, const Take& take) {
  for (std::size_t i = 0; i < shape::block_width; ++i) {
    const auto& corners = mesh.triangles[static_cast<std::size_t>(block.number[i])];
    for (std::size_t c = 0; c < 3; ++c) take(c, static_cast<std::size_t>(corners[c]), i);
  }
}

void put_corners(const TriangleMesh& mesh, shape::MeshTriangles& block) {
  each_corner(mesh, block, [&](std::size_t c, std::size_t vertex, std::size_t i) {
    for (std::size_t k = 0; k < 3; ++k) block.corner[c][k][i] = mesh.vertices[vertex][k];
  });
}
void put_normals(const TriangleMesh& mesh, const shape::MeshTriangles& block, shape::MeshDetails& details) {
  each_corner(mesh, block, [&](std::size_t c, std::size_t vertex, std::size_t i) {
    for (std::size_t k = 0; k < 3; ++k) details.normal[c][k][i] = mesh.normals.empty() ? 0 : mesh.normals[vertex][k];
  });
}

void put_details(const TriangleMesh& mesh, const shape::MeshTriangles& block, shape::MeshDetails& details) {
  put_normals(mesh, block, details);
  each_corner(mesh, block, [&](std::size_t c, std::size_t vertex, std::size_t i) {
    for (std::size_t k = 0; k < 2; ++k) details.texcoord[c][k][i] = mesh.texcoords.empty() ? 0 : mesh.texcoords[vertex][k];
    details.shade[c][i] = mesh.shades.empty() ? 1 : mesh.shades[vertex];
  });
}

/// The triangles of each block, after them the last one of it.
void put_blocks(const TriangleMesh& mesh, const BoxTree& tree, int threads, Hierarchy& out) {
  const std::size_t blocks = tree.blocks.size();
  out.triangles.resize(blocks);
  if (!mesh.normals.empty() || !mesh.texcoords.empty() || !mesh.shades.empty()) out.details.resize(blocks);
  constexpr std::size_t chunk = 1024;
  const std::size_t chunks = (blocks + chunk - 1) / chunk;
  base::in_parallel(static_cast<int>(chunks), threads, [&](int c) {
    const std::size_t from = static_cast<std::size_t>(c) * chunk;
    for (std::size_t b = from; b < std::min(from + chunk, blocks); ++b) {
      const BoxBlock block = tree.blocks[b];
      for (std::uint32_t i = 0; i < shape::block_width; ++i)
        out.triangles[b].number[i] = tree.items[block.first + std::min(i, block.count - 1)].number;
      put_corners(mesh, out.triangles[b]);
      if (!out.details.empty()) put_details(mesh, out.triangles[b], out.details[b]);
    }
  });
}

}  // namespace

Hierarchy build_hierarchy(const TriangleMesh& mesh, int threads) {
  Hierarchy out;
  BoxTree tree = build_box_tree(mesh, threads);
  put_blocks(mesh, tree, threads, out);
  out.nodes = std::move(tree.nodes);
  if (!mesh.triangles.empty()) put_box(tree.bounds, out);
  out.has_texcoords = !mesh.texcoords.empty(), out.has_shades = !mesh.shades.empty();
  return out;
}

std::shared_ptr<const Hierarchy> shared_hierarchy(const TriangleMesh& mesh, int threads) {
  base::Content content;
  content.add(mesh.vertices), content.add(mesh.triangles), content.add(mesh.normals);
  content.add(mesh.texcoords), content.add(mesh.shades);
  return base::shared<base::Content, Hierarchy>().get(
      content, [&] { return build_hierarchy(mesh, threads); },
      [](const Hierarchy& made) {
        return made.nodes.size() * sizeof made.nodes[0] + made.triangles.size() * sizeof made.triangles[0] +
               made.details.size() * sizeof made.details[0];
      });
}

void refit(const Hierarchy& from, const TriangleMesh& mesh, Hierarchy& out) {
  out = from;
  for (std::size_t i = 0; i < out.triangles.size(); ++i) {
    put_corners(mesh, out.triangles[i]);
    if (!out.details.empty()) put_normals(mesh, out.triangles[i], out.details[i]);
  }
  // A node's children come behind it.
  std::vector<Bounds3> boxes(out.nodes.size());
  for (std::size_t n = out.nodes.size(); n-- > 0;) {
    MeshNode& node = out.nodes[n];
    for (std::size_t i = 0; i < static_cast<std::size_t>(node.children); ++i) {
      Bounds3 box;
      if (node.child[i] >= 0) {
        box = boxes[static_cast<std::size_t>(node.child[i])];
      } else {
        each_corner(mesh, out.triangles[static_cast<std::size_t>(shape::block_of(node.child[i]))],
                    [&](std::size_t, std::size_t vertex, std::size_t) {
                      const auto& at = mesh.vertices[vertex];
                      box.add(Quad{at[0], at[1], at[2], 0});
                    });
      }
      for (std::size_t k = 0; k < 3; ++k) node.low[k][i] = box.low[k], node.high[k][i] = box.high[k];
      boxes[n].add(box);
    }
  }
  if (!out.triangles.empty()) put_box(boxes[0], out);
}

std::vector<shape::MeshSteps> steps_of(const Hierarchy& of, const TriangleMesh& mesh, const Vertices& before, const Vertices& after,
                                       double apart_s, const Vertices& now, const Vertices& later) {
  std::vector<shape::MeshSteps> out(of.triangles.size());
  for (std::size_t b = 0; b < out.size(); ++b)
    each_corner(mesh, of.triangles[b], [&](std::size_t c, std::size_t vertex, std::size_t i) {
      for (std::size_t k = 0; k < 3; ++k) {
        const auto change = [&](const Vertices& from, const Vertices& to) {
          return static_cast<double>(to[vertex][k]) - static_cast<double>(from[vertex][k]);
        };
        out[b].velocity[c][k][i] = static_cast<float>(change(before, after) / (2 * apart_s));
        out[b].step[c][k][i] = static_cast<float>(change(now, later));
      }
    });
  return out;
}

}  // namespace tofray::scene
