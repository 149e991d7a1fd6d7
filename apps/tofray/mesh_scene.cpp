// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include "mesh_scene.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <limits>
#include <optional>

#include <nlohmann/json.hpp>

#include "base/readout.h"
#include "base/text.h"
#include "base/vec.h"
#include "load/gltf_load.h"
#include "load/mesh_load.h"
#include "mesh/read_mesh.h"
#include "tofray/load.h"

namespace tofray::app {

namespace {

using base::operator+;
using base::operator-;
using base::operator*;

struct Box {
  Vec3 low{}, high{};
};

/// Shows each triangle's corners to `see`; those that triangles share several times.
template <class See>
void for_each_corner(const Scene& scene, const See& see) {
  for (const Object& object : scene.objects) {
    const TriangleMesh& mesh = *std::get<Mesh>(object.shape).triangles;
    for (const auto& triangle : mesh.triangles)
      for (const std::int32_t corner : triangle) {
        const auto& at = mesh.vertices[static_cast<std::size_t>(corner)];
        see(Vec3{static_cast<double>(at[0]), static_cast<double>(at[1]), static_cast<double>(at[2])});
      }
  }
}

constexpr double infinity = std::numeric_limits<double>::infinity();

/// Round all of a scene's meshes, along three directions.
Box box_round(const Scene& scene, const std::array<Vec3, 3>& axes = {{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}}) {
  Box out{{infinity, infinity, infinity}, {-infinity, -infinity, -infinity}};
  for_each_corner(scene, [&](const Vec3& p) {
    for (std::size_t k = 0; k < 3; ++k) {
      const double x = base::dot(axes[k], p);
      out.low[k] = std::min(out.low[k], x), out.high[k] = std::max(out.high[k], x);
    }
  });
  return out;
}

/// −0 becomes 0.
std::string point(const Vec3& p) { return fmt::format("[{:.6g}, {:.6g}, {:.6g}]", p[0] + 0.0, p[1] + 0.0, p[2] + 0.0); }

/// The same with all of its digits: what stands far away looks past all else where it is rounded.
std::string exact(const Vec3& p) { return fmt::format("[{}, {}, {}]", p[0] + 0.0, p[1] + 0.0, p[2] + 0.0); }

/// The camera that looks at a mesh alone: what --set makes of the one that scenes have.
Camera camera_of(const std::string& source, const Options& options) {
  load::Settings of_camera;
  for (const auto& one : options.set)
    if (one.first.starts_with("camera.") && !one.first.starts_with("camera.pose") && !one.first.starts_with("camera.keyframes"))
      of_camera.push_back(one);
  const Scene scene = load::scene_from_text("objects: []\n", source, of_camera, {options.root});
  return load_camera(scene, {options.mode, {}, options.root});
}

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

/// Tangents of the angles that a camera sees on both sides of its axis: to the right and left, up and down.
struct View {
  double x, y;
};

View view_of(const Camera& camera) {
  const Camera read_out = base::as_read_out(camera);
  const Sensor& sensor = read_out.sensor;
  const Lens& lens = read_out.lens;
  const auto half = [](double center, int pixels, double focal) {
    return std::max(0.05, std::min(center + 0.5, pixels - 0.5 - center) / focal);
  };
  return {half(lens.cx_px, sensor.width, lens.fx_px), half(lens.cy_px, sensor.height, lens.fy_px)};
}

/// All of it from before, above and aside, as near as it stays in view with a twentieth of the image to spare on each side.
Pose pose_before(const Scene& scene, const View& view) {
  const Scene::Up up = scene.world_up;
  const Vec3 aside = base::normalized(in_world({0.5, -0.4, -1}, up)), forward = -1.0 * aside;
  const Vec3 right = base::normalized(base::cross(in_world({0, 1, 0}, up), forward)), down = base::cross(forward, right);
  const Box box = box_round(scene, {right, down, forward});
  const Vec3 middle = 0.5 * (box.low + box.high);
  constexpr double used = 0.9;
  double distance = 2e-3;
  for_each_corner(scene, [&](const Vec3& p) {
    const double x = std::abs(base::dot(right, p) - middle[0]), y = std::abs(base::dot(down, p) - middle[1]);
    distance = std::max(distance, std::max(x / view.x, y / view.y) / used - (base::dot(forward, p) - middle[2]));
  });
  const Vec3 seen = middle[0] * right + middle[1] * down + middle[2] * forward;
  return {seen + distance * aside, seen};
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
                   fmt::format("camera: {{pose: {{position: {}, look_at: {}, up: {}}}}}\n", exact(own->position), exact(own->look_at),
                               exact(own->up)));
  const Pose pose = pose_before(alone, view_of(camera_of(source, options)));
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
