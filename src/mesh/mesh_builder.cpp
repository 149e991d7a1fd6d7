// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include "mesh/mesh_builder.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "base/faults.h"

namespace tofray::mesh {
namespace {

using Vertex = std::array<float, 3>;
using Triangle = std::array<std::int32_t, 3>;

bool finite_vertex(const Vertex& v) { return std::isfinite(v[0]) && std::isfinite(v[1]) && std::isfinite(v[2]); }

}  // namespace

void MeshBuilder::too_many_vertices() const {
  base::fail(base::whole(name_), fmt::format("the mesh has more than {} vertices", most_vertices),
             "expected a simpler mesh, or several (`tofray --limits`)", ErrorKind::limit);
}

void MeshBuilder::too_many_triangles() const {
  base::fail(base::whole(name_), fmt::format("the mesh has more than {} triangles", most_triangles),
             "expected a simpler mesh, or several (`tofray --limits`)", ErrorKind::limit);
}

void MeshBuilder::expect_vertices(std::uint64_t count) {
  if (count > most_vertices) too_many_vertices();
  read_.mesh.vertices.reserve(static_cast<std::size_t>(count));
}

void MeshBuilder::expect_triangles(std::uint64_t count) {
  if (count > most_triangles) too_many_triangles();
  read_.mesh.triangles.reserve(static_cast<std::size_t>(count));
}

void MeshBuilder::drop_not_finite() {
  auto& vertices = read_.mesh.vertices;
  auto& triangles = read_.mesh.triangles;
  if (std::all_of(vertices.begin(), vertices.end(), finite_vertex)) return;
  std::vector<std::int32_t> place(vertices.size(), -1);
  std::size_t kept = 0;
  for (std::size_t i = 0; i < vertices.size(); ++i) {
    if (!finite_vertex(vertices[i])) continue;
    place[i] = static_cast<std::int32_t>(kept);
    vertices[kept++] = vertices[i];
  }
  vertices.resize(kept);
  kept = 0;
  for (const Triangle& triangle : triangles) {
    Triangle moved{};
    for (std::size_t k = 0; k < 3; ++k) moved[k] = place[static_cast<std::size_t>(triangle[k])];
    if (*std::min_element(moved.begin(), moved.end()) >= 0) triangles[kept++] = moved;
  }
  read_.not_finite += triangles.size() - kept;
  triangles.resize(kept);
}

ReadMesh MeshBuilder::finish() {
  const std::size_t vertices = read_.mesh.vertices.size();
  drop_not_finite();
  if (read_.mesh.triangles.empty()) {
    const std::string expected = "expected a mesh of triangles or polygons";
    if (read_.not_finite > 0)
      base::fail(base::whole(name_), fmt::format("each of the {} triangles has a corner that is not a finite number", read_.not_finite),
                 expected + " with coordinates within the range of float");
    if (vertices > 0)
      base::fail(base::whole(name_), fmt::format("the mesh has vertices ({}), but no faces", vertices),
                 expected + "; a cloud of points has no surface");
    base::fail(base::whole(name_), "the mesh is empty", "got neither vertices nor faces, " + expected);
  }
  return std::move(read_);
}

}  // namespace tofray::mesh
