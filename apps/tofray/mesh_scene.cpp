// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include "mesh_scene.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>

#include <nlohmann/json.hpp>

#include "base/vec.h"
#include "mesh/read_mesh.h"

namespace tofray::app {

namespace {

using base::operator+;
using base::operator-;
using base::operator*;

struct Box {
  Vec3 low{}, high{};
};

Box box_round(const Mesh& mesh) {
  Box out;
  out.low.fill(std::numeric_limits<double>::infinity()), out.high.fill(-std::numeric_limits<double>::infinity());
  for (const auto& triangle : mesh.triangles->triangles)
    for (const std::int32_t corner : triangle)
      for (std::size_t k = 0; k < 3; ++k) {
        const auto x = static_cast<double>(mesh.triangles->vertices[static_cast<std::size_t>(corner)][k]);
        out.low[k] = std::min(out.low[k], x), out.high[k] = std::max(out.high[k], x);
      }
  return out;
}

std::string point(const Vec3& p) { return fmt::format("[{:.6g}, {:.6g}, {:.6g}]", p[0], p[1], p[2]); }

/// The mesh alone; `more` are lines below it.
std::string text_of(const std::string& path, const std::string& more) {
  // A name in quotation marks as JSON writes it is a name in YAML, too.
  const std::string file =
      nlohmann::json(std::filesystem::path(path).filename().string()).dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
  return fmt::format("objects:\n  - mesh: {{file: {}, reflectivity: 0.5}}\n{}", file, more);
}

}  // namespace

bool is_called_like_a_mesh(const std::string& path) {
  const std::string suffix = mesh::suffix_of(path);
  return suffix == ".obj" || suffix == ".ply" || suffix == ".stl" || suffix == ".glb" || suffix == ".gltf";
}

std::string scene_name_of_mesh(const std::string& path) { return std::filesystem::path(path).replace_extension(".yaml").string(); }

std::string scene_of_mesh(const std::string& path, const std::string& source, const Options& options) {
  // What --set makes of the mesh, so that its scale and its axes count; the rest of the scene is not there yet.
  load::Settings of_mesh;
  for (const auto& one : options.set)
    if (one.first.starts_with("objects.0.mesh.")) of_mesh.push_back(one);
  const Scene alone = load::scene_from_text(text_of(path, ""), source, of_mesh, {options.root});
  const Box box = box_round(std::get<Mesh>(alone.objects[0].shape));
  const Vec3 middle = 0.5 * (box.low + box.high);
  const double radius = std::max(0.5 * base::length(box.high - box.low), 1e-3);
  // So far away the ball round it fits into the 45 degrees that most such cameras see from top to bottom.
  const Vec3 from = middle + 2.7 * radius * base::normalized(Vec3{0.5, -0.4, -1});
  return text_of(path, fmt::format("  - plane: {{point: {}, normal: [0, -1, 0], reflectivity: 0.3}}  # a floor\n"
                                   "camera: {{pose: {{position: {}, look_at: {}}}}}\n",
                                   point({middle[0], box.high[1], middle[2]}), point(from), point(middle)));
}

}  // namespace tofray::app
