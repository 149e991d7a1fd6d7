// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cmath>

#include "base/vec.h"
#include "brdf/list.h"
#include "support/pi.h"
#include "tofray/scene.h"

namespace tofray::brdf_test {

using test::pi;

inline Vec3 at_angle(double theta, double phi) {
  return {std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi), std::cos(theta)};
}

/// f_r as kernels compute it, of a surface whose normal is z.
inline double f_r(const flow::Finish<float>& finish, const Vec3& to_light, const Vec3& to_camera) {
  const auto single = [](const Vec3& a) {
    return flow::Direction<float>{static_cast<float>(a[0]), static_cast<float>(a[1]), static_cast<float>(a[2])};
  };
  const flow::Direction<float> light = single(to_light), camera = single(to_camera);
  const float between = light.x * camera.x + light.y * camera.y + light.z * camera.z;
  const auto directions = [&] { return brdf::Directions<float>{{0, 0, 1}, light, camera}; };
  return static_cast<double>(brdf::reflection<float>(finish, {light.z, camera.z, between}, directions));
}

inline flow::Finish<float> finish_of(const Material& material) {
  const brdf::MaterialView m = brdf::view_of(material);
  return {m.reflectivity, {m.number[0], m.number[1], m.number[2]}, m.brdf};
}
inline double f_r(const Material& material, const Vec3& to_light, const Vec3& to_camera) {
  return f_r(finish_of(material), to_light, to_camera);
}

/// ∫ f_r cosθ dω over the hemisphere: what of the light at this angle comes back; midpoint rule.
inline double albedo(const flow::Finish<float>& surface, double light_angle, int rings = 300, int sectors = 300) {
  const Vec3 light = at_angle(light_angle, 0);
  double sum = 0;
  for (int i = 0; i < rings; ++i) {
    const double theta = (i + 0.5) / rings * pi / 2;
    double ring = 0;
    for (int k = 0; k < sectors; ++k) ring += f_r(surface, light, at_angle(theta, (k + 0.5) / sectors * 2 * pi));
    sum += ring * std::sin(theta) * std::cos(theta);
  }
  return sum * (pi / 2 / rings) * (2 * pi / sectors);
}
inline double albedo(const Material& material, double light_angle, int rings = 300, int sectors = 300) {
  return albedo(finish_of(material), light_angle, rings, sectors);
}

}  // namespace tofray::brdf_test
