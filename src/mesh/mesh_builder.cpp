// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include "mesh/mesh_builder.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "base/faults.h"
#include "base/srgb.h"

namespace tofray::mesh {
namespace {

using Vertex = std::array<float, 3>;
using Triangle = std::array<std::int32_t, 3>;

constexpr float farthest_texcoord = 1e6F;

bool finite_vertex(const Vertex& v) { return std::isfinite(v[0]) && std::isfinite(v[1]) && std::isfinite(v[2]); }

/// Keeps the rows whose new place is not -1; there may be none at all.
template <class Row>
void keep(const std::vector<std::int32_t>& place, std::vector<Row>& rows) {
  std::size_t kept = 0;
  for (std::size_t i = 0; i < rows.size(); ++i)
    if (place[i] >= 0) rows[kept++] = rows[i];
  rows.resize(kept);
}

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

void MeshBuilder::note_material() {
  read_.material_of.resize(read_.mesh.triangles.size() - 1, -1);
  read_.material_of.push_back(material_);
}

std::array<float, 3> MeshBuilder::unit_normal(const std::array<float, 3>& direction) {
  if (!finite_vertex(direction)) {
    ++mended_normals_;
    return {0, 0, 0};
  }
  const double x = static_cast<double>(direction[0]), y = static_cast<double>(direction[1]), z = static_cast<double>(direction[2]);
  const double length = std::sqrt(x * x + y * y + z * z);
  if (!(length > 0)) return {0, 0, 0};
  return {static_cast<float>(x / length), static_cast<float>(y / length), static_cast<float>(z / length)};
}

std::array<float, 2> MeshBuilder::place_in_picture(float u, float v) {
  const float down = 1 - v;
  if (std::abs(u) <= farthest_texcoord && std::abs(down) <= farthest_texcoord) return {u, down};
  ++mended_texcoords_;
  return {0, 0};
}

float MeshBuilder::shade_of(const std::array<double, 3>& red_green_blue) {
  std::array<double, 3> linear{};
  bool good = true;
  for (std::size_t k = 0; k < 3; ++k) {
    good = good && red_green_blue[k] >= 0 && red_green_blue[k] <= 1;
    linear[k] = base::linear_of_srgb(red_green_blue[k] > 0 ? std::min(red_green_blue[k], 1.0) : 0.0);
  }
  if (!good) ++mended_colors_;
  return static_cast<float>(base::luminance(linear[0], linear[1], linear[2]));
}

void MeshBuilder::color(const std::array<double, 3>& red_green_blue) {
  std::vector<float>& shades = read_.mesh.shades;
  shades.resize(read_.mesh.vertices.size() - 1, 1);
  shades.push_back(shade_of(red_green_blue));
}

void MeshBuilder::drop_not_finite() {
  TriangleMesh& mesh = read_.mesh;
  if (std::all_of(mesh.vertices.begin(), mesh.vertices.end(), finite_vertex)) return;
  std::vector<std::int32_t> place(mesh.vertices.size(), -1);
  std::int32_t next = 0;
  for (std::size_t i = 0; i < place.size(); ++i)
    if (finite_vertex(mesh.vertices[i])) place[i] = next++;
  keep(place, mesh.vertices);
  keep(place, mesh.normals);
  keep(place, mesh.texcoords);
  if (!mesh.shades.empty()) keep(place, mesh.shades);
  std::size_t kept = 0;
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    Triangle moved{};
    for (std::size_t k = 0; k < 3; ++k) moved[k] = place[static_cast<std::size_t>(mesh.triangles[i][k])];
    if (*std::min_element(moved.begin(), moved.end()) < 0) continue;
    if (!read_.material_of.empty()) read_.material_of[kept] = read_.material_of[i];
    mesh.triangles[kept++] = moved;
  }
  read_.not_finite += mesh.triangles.size() - kept;
  mesh.triangles.resize(kept);
  if (!read_.material_of.empty()) read_.material_of.resize(kept);
}

void MeshBuilder::tell_of_mended() {
  if (mended_normals_ > 0) read_.notices.push_back(fmt::format("normals that are not finite ({}) become 0: flat", mended_normals_));
  if (mended_texcoords_ > 0)
    read_.notices.push_back(fmt::format("texture coordinates that are not finite, or beyond 1e6 ({}), become 0", mended_texcoords_));
  if (mended_colors_ > 0) read_.notices.push_back(fmt::format("colours beyond 0 to 1 ({}) are held there", mended_colors_));
}

ReadMesh MeshBuilder::finish() {
  const std::size_t vertices = read_.mesh.vertices.size();
  if (!read_.mesh.shades.empty()) read_.mesh.shades.resize(vertices, 1);
  drop_not_finite();
  std::vector<Vertex>& normals = read_.mesh.normals;
  if (std::all_of(normals.begin(), normals.end(), [](const Vertex& n) { return n == Vertex{0, 0, 0}; })) normals = {};
  tell_of_mended();
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
