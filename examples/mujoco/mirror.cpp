// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include "mirror.h"

#include <array>
#include <cmath>
#include <memory>
#include <stdexcept>
#include <utility>

namespace {

using tofray::Vec3;

std::string name_of(const mjModel* model, int type, int id, const std::string& else_called) {
  const char* const name = id < 0 ? nullptr : mj_id2name(model, type, id);
  return name != nullptr ? name : else_called;
}

/// @param matrix  row by row, from the thing's frame to the world's
tofray::Rotation rotation_of(const mjtNum* matrix) {
  mjtNum q[4];
  mju_mat2Quat(q, matrix);
  tofray::Rotation out;
  out.quaternion = tofray::Quaternion{q[1], q[2], q[3], q[0]};
  return out;
}

Vec3 point(const mjtNum* p) { return {p[0], p[1], p[2]}; }

tofray::Mesh mesh_of(tofray::TriangleMesh triangles) {
  tofray::Mesh out;
  out.triangles = std::make_shared<const tofray::TriangleMesh>(std::move(triangles));
  return out;
}

/// Flat pieces of 3° of an ellipsoid, its normals those of the round one.
tofray::Mesh ellipsoid(const Vec3& radii) {
  constexpr int around = 120, down = 60;
  tofray::TriangleMesh out;
  for (int i = 0; i <= down; ++i)
    for (int j = 0; j < around; ++j) {
      const double polar = mjPI * i / down, azimuth = 2 * mjPI * j / around;
      const Vec3 on_ball{std::sin(polar) * std::cos(azimuth), std::sin(polar) * std::sin(azimuth), std::cos(polar)};
      const Vec3 n{on_ball[0] / radii[0], on_ball[1] / radii[1], on_ball[2] / radii[2]};
      const double length = std::sqrt(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]);
      std::array<float, 3> vertex{}, normal{};
      for (std::size_t k = 0; k < 3; ++k)
        vertex[k] = static_cast<float>(radii[k] * on_ball[k]), normal[k] = static_cast<float>(n[k] / length);
      out.vertices.push_back(vertex), out.normals.push_back(normal);
      if (i == down) continue;
      const int here = i * around + j, right = i * around + (j + 1) % around;
      if (i > 0) out.triangles.push_back({here, right, here + around});
      if (i + 1 < down) out.triangles.push_back({right, right + around, here + around});
    }
  return mesh_of(std::move(out));
}

tofray::Mesh mesh(const mjModel* model, int id) {
  tofray::TriangleMesh out;
  const float* const vertex = model->mesh_vert + 3 * model->mesh_vertadr[id];
  const int* const face = model->mesh_face + 3 * model->mesh_faceadr[id];
  for (int i = 0; i < model->mesh_vertnum[id]; ++i) out.vertices.push_back({vertex[3 * i], vertex[3 * i + 1], vertex[3 * i + 2]});
  for (int i = 0; i < model->mesh_facenum[id]; ++i) out.triangles.push_back({face[3 * i], face[3 * i + 1], face[3 * i + 2]});
  return mesh_of(std::move(out));
}

/// A geom's shape about its own zero, where tofray's shapes turn. MuJoCo's sizes are halves.
decltype(tofray::Object::shape) shape_of(const mjModel* model, int geom) {
  const mjtNum* const size = model->geom_size + 3 * geom;
  switch (model->geom_type[geom]) {
    case mjGEOM_PLANE:
      if (size[0] > 0 && size[1] > 0) return tofray::Rectangle{{0, 0, 0}, {2 * size[0], 2 * size[1]}};
      return tofray::Plane{{0, 0, 0}, {0, 0, 1}};
    case mjGEOM_SPHERE: return tofray::Sphere{{0, 0, 0}, size[0]};
    case mjGEOM_CAPSULE: return tofray::Capsule{{0, 0, -size[1]}, {0, 0, size[1]}, size[0]};
    case mjGEOM_CYLINDER: return tofray::Cylinder{{0, 0, 0}, {0, 0, 1}, size[0], 2 * size[1]};
    case mjGEOM_BOX: return tofray::Box{{-size[0], -size[1], -size[2]}, point(size)};
    case mjGEOM_ELLIPSOID: return ellipsoid(point(size));
    case mjGEOM_MESH: return mesh(model, model->geom_dataid[geom]);
    default:
      throw std::runtime_error(
          name_of(model, mjOBJ_GEOM, geom, "geom." + std::to_string(geom)) +
          " is a height field or of an unknown type: expected planes, spheres, capsules, cylinders, boxes, ellipsoids, meshes");
  }
}

double linear(double screen) { return screen <= 0.04045 ? screen / 12.92 : std::pow((screen + 0.055) / 1.055, 2.4); }

tofray::Pose pose_of(const mjData* data, int camera) {
  const mjtNum* const m = data->cam_xmat + 9 * camera;
  const mjtNum* const p = data->cam_xpos + 3 * camera;
  // Columns: right, up and backward become right, down and forward.
  return tofray::pose_from_matrix({m[0], -m[1], -m[2], p[0], m[3], -m[4], -m[5], p[1], m[6], -m[7], -m[8], p[2], 0, 0, 0, 1});
}

}  // namespace

Mirror::Mirror(const mjModel* model, const std::string& camera, const Materials& materials)
    : model_(model), camera_(mj_name2id(model, mjOBJ_CAMERA, camera.c_str())) {
  if (camera_ < 0) throw std::runtime_error("the model has no camera \"" + camera + "\"");
  const auto moves = [&](int body) { return model->body_weldid[body] != 0 || model->body_mocapid[body] >= 0; };
  camera_moves_ = moves(model->cam_bodyid[camera_]) || model->cam_mode[camera_] != mjCAMLIGHT_FIXED;
  const std::unique_ptr<mjData, void (*)(mjData*)> data(mj_makeData(model), mj_deleteData);
  mj_forward(model, data.get());
  scene_.name = "mujoco";
  scene_.camera.pose = pose_of(data.get(), camera_);
  for (int geom = 0; geom < model->ngeom; ++geom) {
    const int paint = model->geom_matid[geom];
    if ((paint >= 0 ? model->mat_rgba[4 * paint + 3] : model->geom_rgba[4 * geom + 3]) == 0) continue;
    tofray::Object object;
    object.name = name_of(model, mjOBJ_GEOM, geom, "geom." + std::to_string(geom));
    object.shape = shape_of(model, geom);
    object.material = material_of(geom, materials);
    if (moves(model->geom_bodyid[geom])) {
      moving_.push_back(scene_.objects.size());
    } else {
      object.position = point(data->geom_xpos + 3 * geom);
      object.rotation = rotation_of(data->geom_xmat + 9 * geom);
    }
    geoms_.push_back(geom);
    scene_.objects.push_back(std::move(object));
  }
}

int Mirror::material_of(int geom, const Materials& materials) {
  const int paint = model_->geom_matid[geom];
  auto known = materials.find(name_of(model_, mjOBJ_GEOM, geom, ""));
  if (known == materials.end()) known = materials.find(name_of(model_, mjOBJ_MATERIAL, paint, ""));
  tofray::Material out;
  if (known != materials.end()) {
    out = known->second;
  } else {
    const float* const rgba = paint >= 0 ? model_->mat_rgba + 4 * paint : model_->geom_rgba + 4 * geom;
    for (int k = 0; k < 3; ++k) out.diffuse += linear(static_cast<double>(rgba[k])) / 3;
  }
  scene_.materials.push_back(out);
  return static_cast<int>(scene_.materials.size()) - 1;
}

void Mirror::look(const mjData* data) {
  seen_.resize(moving_.size());
  for (std::size_t i = 0; i < moving_.size(); ++i) {
    const int geom = geoms_[moving_[i]];
    seen_[i].name = scene_.objects[moving_[i]].name;
    seen_[i].keyframes.push_back({data->time, point(data->geom_xpos + 3 * geom), rotation_of(data->geom_xmat + 9 * geom)});
  }
  if (camera_moves_) camera_seen_.push_back({data->time, pose_of(data, camera_)});
}

tofray::FrameRequest Mirror::request(std::uint64_t index, double start_time_s) {
  tofray::FrameRequest out;
  out.index = index, out.start_time_s = start_time_s;
  out.objects = std::exchange(seen_, {}), out.camera = std::exchange(camera_seen_, {});
  return out;
}
