// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include "load/mesh_load.h"

#include <algorithm>
#include <cmath>

#include "base/limits.h"
#include "base/range.h"
#include "base/text.h"
#include "files/sha256.h"
#include "files/text_file.h"
#include "mesh/read_mesh.h"

namespace tofray::load {

namespace {

using Corner = std::array<float, 3>;

/// In double, rounded once.
Corner in_world(const Corner& p, double scale, Mesh::Up up) {
  const auto scaled = [&](float a) { return static_cast<float>(scale * static_cast<double>(a)); };
  if (up == Mesh::Up::y) return {scaled(p[0]), scaled(-p[1]), scaled(-p[2])};
  if (up == Mesh::Up::z) return {scaled(p[0]), scaled(-p[2]), scaled(p[1])};
  return {scaled(p[0]), scaled(p[1]), scaled(p[2])};
}

bool is_in_world(const Corner& p) {
  return std::all_of(p.begin(), p.end(), [](float a) { return std::abs(a) <= base::farthest_m; });  // NaN: no
}

/// Leaves out the triangles that have a corner beyond the world. @return how many
std::size_t keep_in_world(TriangleMesh& mesh) {
  std::vector<bool> good;
  good.reserve(mesh.vertices.size());
  for (Corner& p : mesh.vertices) {
    good.push_back(is_in_world(p));
    if (!good.back()) p = {0, 0, 0};
  }
  return std::erase_if(mesh.triangles, [&](const auto& triangle) {
    return !std::all_of(triangle.begin(), triangle.end(), [&](std::int32_t i) { return good[static_cast<std::size_t>(i)]; });
  });
}

}  // namespace

MeshReader::MeshReader(const std::string& source, const MeshFiles& files)
    : folder_(source.starts_with("<") ? "." : files::folder_of(source)), files_(files) {}

void MeshReader::read(const base::Place& place, Mesh& mesh) {
  const std::tuple key{mesh.file, mesh.scale, mesh.up};
  auto known = known_.find(key);
  if (known == known_.end()) known = known_.emplace(key, from_file(place, mesh)).first;
  mesh.triangles = known->second.triangles, mesh.sha256 = known->second.sha256, mesh.left_out = known->second.left_out;
}

MeshReader::Known MeshReader::from_file(const base::Place& place, const Mesh& wanted) {
  const mesh::Format format = mesh::format_of(wanted.file, place);
  std::string path;
  const std::string bytes = files::read_reference(wanted.file, folder_, files_.root, place, path, base::limit::mesh_bytes);
  const std::string sha256 = files::sha256_hex(bytes);
  if (files_.expected) {
    const auto expected = files_.expected->find(wanted.file);
    if (expected == files_.expected->end() || expected->second != sha256)
      base::fail(place, base::in_quotes(path, 200) + " is not the mesh that it was",
                 "its SHA-256 is not the one that the manifest has; expected the same file in the same place");
  }
  auto [mesh, left_out] = mesh::parse(format, bytes, path);
  count(place, mesh);
  const Mesh::Up automatic = format == mesh::Format::obj ? Mesh::Up::y : Mesh::Up::z;
  for (Corner& p : mesh.vertices) p = in_world(p, wanted.scale, wanted.up == Mesh::Up::automatic ? automatic : wanted.up);
  left_out += keep_in_world(mesh);
  if (mesh.triangles.empty())
    base::fail(place, "no triangle of " + base::in_quotes(path, 200) + " is in the world",
               "all have a corner beyond " + base::number_text(base::farthest_m) + " m; is its scale right?");
  return {std::make_shared<const TriangleMesh>(std::move(mesh)), sha256, static_cast<int>(left_out)};
}

void MeshReader::count(const base::Place& place, const TriangleMesh& mesh) {
  vertices_ += mesh.vertices.size(), triangles_ += mesh.triangles.size();
  const auto check = [&](std::size_t got, const base::Limit& limit, const char* what) {
    if (got > static_cast<std::size_t>(limit.value))
      base::fail(
          place, std::string("the scene's meshes have too many ") + what,
          "got more than " + std::to_string(limit.value) + " in all (`tofray --limits`); objects of one file, scale and up share theirs",
          ErrorKind::limit);
  };
  check(vertices_, base::limit::mesh_vertices, "vertices");
  check(triangles_, base::limit::mesh_triangles, "triangles");
}

}  // namespace tofray::load
