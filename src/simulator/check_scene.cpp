// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include "base/limits.h"
#include "base/text.h"
#include "base/vec.h"
#include "simulator/check.h"
#include "simulator/checks.h"

namespace tofray::simulator {

using namespace base;

namespace {

struct ShapeCheck {
  std::string path;

  void operator()(const Plane& plane) const {
    within(plane.point, range::coordinate_m, path + ".point");
    direction(plane.normal, path + ".normal");
  }
  void operator()(const Sphere& sphere) const {
    within(sphere.center, range::coordinate_m, path + ".center");
    within(sphere.radius, range::radius_m, path + ".radius");
  }
  void operator()(const Box& box) const {
    within(box.min, range::coordinate_m, path + ".min");
    within(box.max, range::coordinate_m, path + ".max");
    for (std::size_t k = 0; k < 3; ++k) {
      if (!(box.max[k] - box.min[k] >= range::shortest_m)) {
        refuse(path + ".min is not below its max in " + "xyz"[k],
               "got " + number_text(box.min[k]) + " and " + number_text(box.max[k]) + ", expected a thickness of at least 1e-06");
      }
    }
  }
  /// One without an area is good: no ray hits it.
  void operator()(const Triangle& triangle) const {
    for (const Vec3& vertex : triangle.vertices) within(vertex, range::coordinate_m, path + ".vertices");
  }
};

void check_ambient(const Ambient& ambient) {
  const Range& range = ambient.quantity == Ambient::Quantity::level            ? range::ambient_level
                       : ambient.quantity == Ambient::Quantity::illuminance_lx ? range::illuminance_lx
                                                                               : range::band_irradiance_w_per_m2;
  within(ambient.amount, range, "ambient.amount");
  if (ambient.direction) direction(*ambient.direction, "ambient.direction");
  if (ambient.spectrum != Ambient::Spectrum::table) return;
  at_most(ambient.table_wavelength_m.size(), limit::curve_points.value, "samples of ambient.table_wavelength_m");
  samples(ambient.table_wavelength_m, range::wavelength_m, ambient.table_irradiance_w_per_m3, range::spectral_irradiance_w_per_m3, 2,
          "ambient.table_wavelength_m");
}

void check_material(const Material& material, const std::string& path) {
  within(material.diffuse, range::share, path + ".diffuse");
  within(material.specular, range::share, path + ".specular");
  within(material.exponent, range::phong_exponent, path + ".exponent");
  if (material.diffuse + material.specular > 1 + 1e-12) {
    refuse(path + ": diffuse + specular is more than 1", "a surface cannot send back more light than it gets");
  }
}

}  // namespace

void check(const Pose& pose, const std::string& path) {
  within(pose.position, range::coordinate_m, path + ".position");
  within(pose.look_at, range::coordinate_m, path + ".look_at");
  direction(pose.up, path + ".up");
  const Vec3 view = pose.look_at - pose.position;
  if (length(view) < range::shortest_m) refuse(path + " looks at the point where it stands", "look_at has to differ from position");
  if (length(cross(view, pose.up)) < 1e-6 * length(view) * length(pose.up)) {
    refuse(path + ".up is the direction of view", "expected another direction, such as {0, -1, 0}");
  }
}

void check(std::span<const FrameRequest> requests) {
  for (std::size_t i = 0; i < requests.size(); ++i) {
    if (requests[i].pose) check(*requests[i].pose, "requests[" + std::to_string(i) + "].pose");
  }
}

void check(const Scene& scene) {
  at_most(scene.objects.size(), limit::objects.value, "objects");
  at_most(scene.materials.size(), limit::materials.value + limit::objects.value, "materials");
  check(scene.camera.pose);
  check_ambient(scene.ambient);
  for (std::size_t i = 0; i < scene.materials.size(); ++i) check_material(scene.materials[i], "materials[" + std::to_string(i) + "]");
  for (std::size_t i = 0; i < scene.objects.size(); ++i) {
    const Object& object = scene.objects[i];
    const std::string path = "objects[" + std::to_string(i) + "]";
    if (object.material < 0 || static_cast<std::size_t>(object.material) >= scene.materials.size()) {
      refuse(path + " names a material that the scene has not",
             "got index " + std::to_string(object.material) + " of " + std::to_string(scene.materials.size()) + " materials");
    }
    within(object.position, range::coordinate_m, path + ".position");
    within(object.velocity_m_per_s, range::velocity_m_per_s, path + ".velocity_m_per_s");
    within(object.rotation.angle_rad, range::rotation_rad, path + ".rotation.angle_rad");
    if (object.rotation.angle_rad != 0) direction(object.rotation.axis, path + ".rotation.axis");
    std::visit(ShapeCheck{path}, object.shape);
  }
}

}  // namespace tofray::simulator
