// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include "run/mesh_scene.h"

#include <fmt/core.h>

#include <algorithm>
#include <filesystem>
#include <optional>

#include <nlohmann/json.hpp>

#include "assets/gltf_load.h"
#include "assets/mesh_load.h"
#include "base/text.h"
#include "base/vec.h"
#include "mesh/read_mesh.h"
#include "run/mesh_view.h"
#include "tofray/load.h"

namespace tofray::run {

namespace {

using base::operator+;
using base::operator*;

/// −0 becomes 0.
std::string point(const Vec3& p) {
  return fmt::format("[{}, {}, {}]", base::number_text(p[0] + 0.0), base::number_text(p[1] + 0.0), base::number_text(p[2] + 0.0));
}

/// The camera that looks at a mesh alone: what --set makes of the one that scenes have.
Camera camera_of(const std::string& source, const InputRequest& request) {
  load::Settings of_camera;
  for (const auto& one : request.set)
    if (one.first.starts_with("camera.") && !one.first.starts_with("camera.pose") && !one.first.starts_with("camera.keyframes"))
      of_camera.push_back(one);
  const Scene scene = load::scene_from_text("objects: []\n", source, of_camera, {request.root});
  return load_camera(scene, {request.mode, {}, request.root});
}

/// A scene is text in UTF-8, and so is a mesh's name in it.
void refuse_name(const std::string& path) {
  for (std::size_t i = 0; i < path.size();) {
    const std::size_t length = base::utf8_length(path, i);
    if (length == 0)
      throw Error(ErrorKind::bad_input,
                  base::printable(path) + ": error: the file's name is not UTF-8\n  a scene could not name it: call it otherwise");
    i += length;
  }
}

/// Whether --set says where the camera stands.
bool sets_pose(const InputRequest& request) {
  return std::any_of(request.set.begin(), request.set.end(),
                     [](const auto& one) { return one.first.starts_with("camera.pose") || one.first.starts_with("camera.keyframes"); });
}

/// The mesh alone; `more` are lines below it.
std::string text_of(const std::string& path, bool own_materials, const std::string& more) {
  // A name in quotation marks as JSON writes it is a name in YAML, too.
  const std::string file =
      nlohmann::json(std::filesystem::path(path).filename().string()).dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
  return fmt::format("objects:\n  - mesh: {{file: {}{}}}\n{}", file, own_materials ? "" : ", reflectivity: 0.5", more);
}

}  // namespace

bool is_called_like_a_mesh(const std::string& path) {
  const std::string suffix = mesh::suffix_of(path);
  return suffix == ".obj" || suffix == ".ply" || suffix == ".stl" || assets::is_gltf(path);
}

std::string scene_name_of_mesh(const std::string& path) { return std::filesystem::path(path).replace_extension(".yaml").string(); }

MeshScene scene_of_mesh(const std::string& path, const std::string& source, const InputRequest& request) {
  MeshScene out;
  refuse_name(path);
  // What --set makes of the mesh, so that its scale and its axes count; the rest of the scene is not there yet.
  load::Settings of_mesh;
  for (const auto& one : request.set)
    if (one.first.starts_with("objects.0.mesh.") || one.first == "world_up") of_mesh.push_back(one);
  std::string unread;
  const bool own_materials = assets::has_own_materials(std::filesystem::path(path).filename().string(), source, request.root, &unread);
  if (!unread.empty())
    out.remarks.push_back(
        {true, path,
         fmt::format("{} cannot be read: {}; the mesh is grey, of reflectivity 0.5",
                     mesh::suffix_of(path) == ".ply" ? "its picture (comment TextureFile)" : "its file of materials (mtllib)",
                     base::in_quotes(unread)),
         "put the file beside the mesh, or say another reflectivity: --set objects.0.mesh.reflectivity=0.3"});
  const Scene alone = load::scene_from_text(text_of(path, own_materials, ""), source, of_mesh, {request.root});
  const std::optional<Pose> own = assets::camera_in(std::get<Mesh>(alone.objects[0].shape), source, request.root, alone.world_up);
  // A file with a camera is a scene of its own: a second floor would lie in the first.
  if (own) {
    out.text = text_of(path, own_materials,
                       fmt::format("camera: {{pose: {{position: {}, look_at: {}, up: {}}}}}\n", point(own->position), point(own->look_at),
                                   point(own->up)));
    return out;
  }
  const MeshBox box = box_round(alone);
  const MeshView view = view_of_meshes(alone, camera_of(source, request), path);
  out.told_size = view.odd_size && !sets_pose(request);
  if (out.told_size) out.remarks.push_back(*view.odd_size);
  // A little below the mesh: what of it is flat and lies lowest would lie in the floor.
  constexpr double gap = 1e-3;
  const Vec3 up = in_world({0, -1, 0}, alone.world_up);
  Vec3 below = 0.5 * (box.low + box.high);
  for (std::size_t k = 0; k < 3; ++k)
    if (up[k] != 0) below[k] = (up[k] < 0 ? box.high[k] : box.low[k]) - up[k] * gap * box.largest();
  out.text = text_of(path, own_materials,
                     fmt::format("  - plane: {{point: {}, normal: {}, reflectivity: 0.3}}  # a floor\n"
                                 "camera: {{pose: {{position: {}, look_at: {}}}}}\n",
                                 point(below), point(up), point(view.pose.position), point(view.pose.look_at)));
  return out;
}

}  // namespace tofray::run
