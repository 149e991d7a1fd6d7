// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include "mesh_scene.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>
#include <optional>

#include <nlohmann/json.hpp>

#include "base/text.h"
#include "base/vec.h"
#include "load/gltf_load.h"
#include "load/mesh_load.h"
#include "mesh/read_mesh.h"

namespace tofray::app {

namespace {

using base::operator+;
using base::operator-;
using base::operator*;

struct Box {
  Vec3 low{}, high{};
};

void widen(Box& box, const TriangleMesh& mesh) {
  for (const auto& triangle : mesh.triangles)
    for (const std::int32_t corner : triangle)
      for (std::size_t k = 0; k < 3; ++k) {
        const auto x = static_cast<double>(mesh.vertices[static_cast<std::size_t>(corner)][k]);
        box.low[k] = std::min(box.low[k], x), box.high[k] = std::max(box.high[k], x);
      }
}

Box box_round(const Scene& scene) {
  Box out;
  out.low.fill(std::numeric_limits<double>::infinity()), out.high.fill(-std::numeric_limits<double>::infinity());
  for (const Object& object : scene.objects) widen(out, *std::get<Mesh>(object.shape).triangles);
  return out;
}

/// −0 becomes 0.
std::string point(const Vec3& p) { return fmt::format("[{:.6g}, {:.6g}, {:.6g}]", p[0] + 0.0, p[1] + 0.0, p[2] + 0.0); }

/// The mesh alone; `more` are lines below it.
std::string text_of(const std::string& path, bool own_materials, const std::string& more) {
  // A name in quotation marks as JSON writes it is a name in YAML, too.
  const std::string file =
      nlohmann::json(std::filesystem::path(path).filename().string()).dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
  return fmt::format("objects:\n  - mesh: {{file: {}{}}}\n{}", file, own_materials ? "" : ", reflectivity: 0.5", more);
}

/// A direction, x right, y down, z forward, in the world.
Vec3 in_world(const Vec3& v, Scene::Up up) {
  if (up == Scene::Up::y) return {v[0], -v[1], -v[2]};
  if (up == Scene::Up::z) return {v[0], v[2], -v[1]};
  return v;
}

/// All of it from before, above and aside.
Pose pose_before(const Box& box, Scene::Up up) {
  const Vec3 middle = 0.5 * (box.low + box.high);
  const double radius = std::max(0.5 * base::length(box.high - box.low), 1e-3);
  // So far away the ball round it fits into the 45 degrees that most such cameras see from top to bottom.
  return {middle + 2.7 * radius * base::normalized(in_world({0.5, -0.4, -1}, up)), middle};
}

}  // namespace

bool is_called_like_a_mesh(const std::string& path) {
  const std::string suffix = mesh::suffix_of(path);
  return suffix == ".obj" || suffix == ".ply" || suffix == ".stl" || load::is_gltf(path);
}

std::string scene_name_of_mesh(const std::string& path) { return std::filesystem::path(path).replace_extension(".yaml").string(); }

std::string scene_of_mesh(const std::string& path, const std::string& source, const Options& options, std::string& warnings) {
  // What --set makes of the mesh, so that its scale and its axes count; the rest of the scene is not there yet.
  load::Settings of_mesh;
  for (const auto& one : options.set)
    if (one.first.starts_with("objects.0.mesh.") || one.first == "world_up") of_mesh.push_back(one);
  std::string unread;
  const bool own_materials = load::has_own_materials(std::filesystem::path(path).filename().string(), source, options.root, &unread);
  if (!unread.empty())
    warnings += fmt::format(
        "{}: warning: its file of materials (mtllib) cannot be read: {}; the mesh is grey, of reflectivity 0.5\n"
        "  put the file beside the mesh, or say another reflectivity: --set objects.0.mesh.reflectivity=0.3\n",
        path, base::in_quotes(unread));
  const Scene alone = load::scene_from_text(text_of(path, own_materials, ""), source, of_mesh, {options.root});
  const Box box = box_round(alone);
  const std::optional<Pose> own = load::camera_in(std::get<Mesh>(alone.objects[0].shape), source, options.root, alone.world_up);
  // A file with a camera is a scene of its own: a second floor would lie in the first.
  if (own)
    return text_of(path, own_materials,
                   fmt::format("camera: {{pose: {{position: {}, look_at: {}, up: {}}}}}\n", point(own->position), point(own->look_at),
                               point(own->up)));
  const Pose pose = pose_before(box, alone.world_up);
  const Vec3 up = in_world({0, -1, 0}, alone.world_up);
  Vec3 below = 0.5 * (box.low + box.high);
  for (std::size_t k = 0; k < 3; ++k)
    if (up[k] != 0) below[k] = up[k] < 0 ? box.high[k] : box.low[k];
  return text_of(path, own_materials,
                 fmt::format("  - plane: {{point: {}, normal: {}, reflectivity: 0.3}}  # a floor\n"
                             "camera: {{pose: {{position: {}, look_at: {}}}}}\n",
                             point(below), point(up), point(pose.position), point(pose.look_at)));
}

}  // namespace tofray::app
