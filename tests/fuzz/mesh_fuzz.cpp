// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
// Any bytes as a mesh, or as the materials of one; the first says which format: an Error, or triangles of vertices that are there and
// finite with normals and texture coordinates that fit, and a hierarchy of them in which rays find something finite or nothing; or
// reflectivities of 0 to 1.
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string>
#include <string_view>
#include <vector>

#include "fuzz/shown.h"
#include "mesh/mtl.h"
#include "mesh/read_mesh.h"
#include "scene/hierarchy.h"
#include "shape/mesh_search.h"

namespace {

constexpr std::size_t most_built = 2000;  // triangles: more would be slow, not different

/// As the loader does before anything is built: what is beyond the world is not there.
bool is_in_world(const tofray::TriangleMesh& mesh) {
  for (const auto& vertex : mesh.vertices)
    for (const float coordinate : vertex)
      if (std::abs(coordinate) > 1e5f) return false;
  return true;
}

void look_at(const tofray::TriangleMesh& mesh) {
  using namespace tofray;
  const scene::Hierarchy built = scene::build_hierarchy(mesh);
  std::vector<bool> seen(mesh.triangles.size());
  for (const shape::MeshTriangles& block : built.triangles)
    for (const std::int32_t number : block.number) {
      if (number < 0 || static_cast<std::size_t>(number) >= seen.size()) std::abort();
      seen[static_cast<std::size_t>(number)] = true;
    }
  if (std::find(seen.begin(), seen.end(), false) != seen.end()) std::abort();
  const shape::Mesh lying = shape::Mesh::placed(built, {{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}}, {0, 0, 0}});
  const shape::MeshForm form = seen_from(lying, {0.1, -0.2, -1});
  for (std::size_t i = 0; i < 16; ++i) {
    const auto& at = mesh.vertices[i * 7919 % mesh.vertices.size()];
    const flow::Ray<float> ray = flow::make_ray(at[0] - 0.1f, at[1] + 0.2f, at[2] + 1);
    if (!(ray.square > 1e-12f)) continue;
    flow::Hit<float> hit = flow::no_hit<float>();
    nearest_in(form, ray, hit);
    if (!std::isfinite(hit.w) || hit.w < 0 || hit.triangle < 0 ||
        static_cast<std::size_t>(hit.triangle) >= shape::block_width * built.triangles.size())
      std::abort();
  }
}

void check(const tofray::mesh::ReadMesh& read) {
  const auto& [vertices, triangles, normals, texcoords, shades] = read.mesh;
  if (triangles.empty()) std::abort();
  for (const auto& vertex : vertices)
    for (const float coordinate : vertex)
      if (!std::isfinite(coordinate)) std::abort();
  for (const auto& triangle : triangles)
    for (const std::int32_t index : triangle)
      if (index < 0 || static_cast<std::size_t>(index) >= vertices.size()) std::abort();
  if (!normals.empty() && normals.size() != vertices.size()) std::abort();
  if (!texcoords.empty() && texcoords.size() != vertices.size()) std::abort();
  if (!shades.empty() && shades.size() != vertices.size()) std::abort();
  for (const float shade : shades)
    if (!(shade >= 0 && shade <= 1)) std::abort();
  if (!read.material_of.empty() && read.material_of.size() != triangles.size()) std::abort();
  for (const auto& normal : normals) {
    const double square = static_cast<double>(normal[0]) * normal[0] + static_cast<double>(normal[1]) * normal[1] +
                          static_cast<double>(normal[2]) * normal[2];
    if (!(square == 0 || std::abs(square - 1) < 1e-6)) std::abort();
  }
  for (const auto& texcoord : texcoords)
    if (!(std::abs(texcoord[0]) <= 1e6F && std::abs(texcoord[1]) <= 1e6F)) std::abort();
  for (const std::int32_t material : read.material_of)
    if (material < -1 || material >= static_cast<std::int32_t>(read.materials.size())) std::abort();
}

void check(const tofray::mesh::Mtl& read) {
  const auto is_share = [](double a) { return a >= 0 && a <= 1; };
  for (const tofray::mesh::MtlMaterial& one : read.materials) {
    if (!is_share(one.nir_reflectivity.value_or(0))) std::abort();
    for (const double a : one.color.value_or(std::array<double, 3>{}))
      if (!is_share(a)) std::abort();
    if (one.picture && (one.picture->reference.file.empty() || !std::isfinite(one.picture->scale[0] + one.picture->offset[1])))
      std::abort();
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size == 0) return 0;
  constexpr tofray::mesh::Format formats[] = {tofray::mesh::Format::obj, tofray::mesh::Format::ply, tofray::mesh::Format::stl};
  const std::string_view bytes(reinterpret_cast<const char*>(data) + 1, size - 1);
  const std::size_t format = data[0] % 4;
  try {
    if (format == 3) {
      check(tofray::mesh::parse_mtl(bytes, "<fuzz>", 1000));
      return 0;
    }
    const tofray::mesh::ReadMesh read = tofray::mesh::parse(formats[format], bytes, "<fuzz>");
    check(read);
    if (read.mesh.triangles.size() <= most_built && is_in_world(read.mesh)) look_at(read.mesh);
  } catch (const tofray::Error& e) {
    if (e.kind() == tofray::ErrorKind::bug || std::string(e.what()).find(": error: ") == std::string::npos) std::abort();
    if (!tofray::fuzz::may_be_shown(e)) std::abort();
  }
  return 0;
}
