// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include <cmath>

#include "num/setup_math.h"
#include "scene/frozen_scene.h"

namespace tofray::scene {

using namespace base;
namespace setup = num::setup;

namespace {

/// Rodrigues' formula, as rows.
Mat3 rotation_matrix(const Rotation& r) {
  if (r.angle_rad == 0) return {{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
  const Vec3 k = normalized(r.axis);
  const double c = setup::cos(r.angle_rad), s = setup::sin(r.angle_rad), v = 1 - c;
  return {{{c + k[0] * k[0] * v, k[0] * k[1] * v - k[2] * s, k[0] * k[2] * v + k[1] * s},
           {k[1] * k[0] * v + k[2] * s, c + k[1] * k[1] * v, k[1] * k[2] * v - k[0] * s},
           {k[2] * k[0] * v - k[1] * s, k[2] * k[1] * v + k[0] * s, c + k[2] * k[2] * v}}};
}

/// Where one object goes: turned by `turn` about its centre, shifted, moved, then seen by the camera.
struct Placer {
  const CameraFrame& camera;
  Mat3 turn;
  Vec3 shift;
  int index;
  Placed& out;

  [[nodiscard]] Vec3 point(const Vec3& p, const Vec3& center) const {
    return camera.rotation * (((turn * (p - center)) + center + shift) - camera.position);
  }
  [[nodiscard]] Vec3 direction(const Vec3& d) const { return camera.rotation * (turn * d); }

  void operator()(const Plane& p) const {
    const Vec3 n = normalized(direction(p.normal));
    out.planes.push_back({n, dot(n, point(p.point, p.point)), index});
  }
  void operator()(const Sphere& s) const { out.spheres.push_back({point(s.center, s.center), s.radius, index}); }
  void operator()(const Box& b) const {
    const Vec3 center = 0.5 * (b.min + b.max);
    const Mat3 axes{{direction({1, 0, 0}), direction({0, 1, 0}), direction({0, 0, 1})}};
    out.boxes.push_back({point(center, center), axes, 0.5 * (b.max - b.min), index});
  }
  void operator()(const Triangle& t) const {
    const auto& v = t.vertices;
    const Vec3 center = (1.0 / 3) * (v[0] + v[1] + v[2]);
    // Without a rotation the vertices keep their exact differences: meshes stay closed.
    const bool turned = turn[0][0] != 1 || turn[1][1] != 1 || turn[2][2] != 1;
    const Vec3 about = turned ? center : Vec3{0, 0, 0};
    out.triangles.push_back({{point(v[0], about), point(v[1], about), point(v[2], about)}, index});
  }
};

}  // namespace

CameraFrame camera_frame(const Pose& pose) {
  const Vec3 forward = normalized(pose.look_at - pose.position);
  const Vec3 down = normalized(dot(pose.up, forward) * forward - pose.up);
  return {{{cross(down, forward), down, forward}}, pose.position};
}

int Placed::facet_count() const {
  return static_cast<int>(planes.size() + spheres.size() + 3 * boxes.size() + triangles.size());
}

Placed place(const Scene& scene, const CameraFrame& camera, Group group, double time_s) {
  Placed placed;
  for (std::size_t i = 0; i < scene.objects.size(); ++i) {
    const Object& object = scene.objects[i];
    const bool moving = dot(object.velocity_m_per_s, object.velocity_m_per_s) > 0;
    if (moving != (group == Group::moving)) continue;
    const Placer placer{camera, rotation_matrix(object.rotation), object.position + time_s * object.velocity_m_per_s, static_cast<int>(i), placed};
    std::visit(placer, object.shape);
  }
  return placed;
}

void append_facets(const Placed& placed, const Scene& scene, std::vector<Facet>& facets) {
  const auto add = [&](const Vec3& flat, double inverse_radius, int object) {
    const int material = scene.objects[static_cast<std::size_t>(object)].material;
    const Material& m = scene.materials[static_cast<std::size_t>(material)];
    facets.push_back({{static_cast<float>(flat[0]), static_cast<float>(flat[1]), static_cast<float>(flat[2])},
                      static_cast<float>(inverse_radius),
                      static_cast<float>(m.diffuse),
                      static_cast<float>(m.specular),
                      static_cast<float>(m.exponent),
                      object,
                      material});
  };
  for (const auto& p : placed.planes) add(p.normal, 0, p.object);
  for (const auto& s : placed.spheres) add((-1 / s.radius) * s.center, 1 / s.radius, s.object);
  for (const auto& b : placed.boxes) {
    for (const Vec3& axis : b.axes) add(axis, 0, b.object);
  }
  for (const auto& t : placed.triangles) {
    add(normalized(cross(t.vertices[1] - t.vertices[0], t.vertices[2] - t.vertices[0])), 0, t.object);
  }
}

}  // namespace tofray::scene
