// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include "camera/light/emitters.h"

#include <cmath>

#include "base/constants.h"
#include "camera/light/area_points.h"
#include "num/setup_math.h"

namespace tofray::camera {

using namespace base;

Mat3 source_axes(const Vec3& direction) {
  const Vec3 axis = normalized(direction);
  const Vec3 aside = std::abs(axis[0]) < 0.9 ? Vec3{1, 0, 0} : Vec3{0, 1, 0};
  const Vec3 x = normalized(aside - dot(aside, axis) * axis);
  return {{x, cross(axis, x), axis}};
}

namespace {

/// The points of an area at each LED of a ring, or the one source that there is.      [theory: led-ring, rectangle-light, disk-light]
void append_emitters(const Illumination& light, std::vector<Illumination>& out) {
  const Mat3 axes = source_axes(light.axis);
  const std::vector<Vec3> points = points_of(light.area);
  for (int i = 0; i < light.ring_leds; ++i) {
    const double turn = 2 * pi * i / light.ring_leds;
    const Vec3 middle =
        light.position + (light.ring_radius_m * num::setup::cos(turn)) * axes[0] + (light.ring_radius_m * num::setup::sin(turn)) * axes[1];
    for (const Vec3& point : points) {
      Illumination one = light;
      one.position = middle + transposed(axes) * point;
      one.power_w = light.power_w / (light.ring_leds * static_cast<double>(points.size()));
      one.ring_leds = 1, one.ring_radius_m = 0, one.area = {};
      out.push_back(one);
    }
  }
}

}  // namespace

std::vector<Illumination> emitters_of(const Camera& camera) {
  std::vector<Illumination> out;
  for (const Illumination& light : camera.illumination) append_emitters(light, out);
  return out;
}

}  // namespace tofray::camera
