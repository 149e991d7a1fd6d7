// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
// Where light comes from and where it goes: mirror directions, light from everywhere, things that stand close to a surface.
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "support/pixels.h"
#include "support/random.h"

using namespace tofray;
using namespace tofray::test;
using base::dot;
using base::normalized;

namespace {

double at(const std::vector<float>& array, std::size_t i) { return static_cast<double>(array.at(i)); }

/// 5 × 5 pixels that look up to 45 degrees aside, and a light of the same intensity in all directions.
Camera wide_camera() {
  Camera camera = lit_camera(5, 5, 2);
  camera.illumination[0].pattern.half_angle_rad = pi;
  camera.illumination[0].power_w = 4 * pi;
  return camera;
}

/// The direction of pixel i of 5 × 5, z = 1.
Vec3 way_of(std::size_t i) { return {(static_cast<double>(i % 5) - 2) / 2, (std::floor(static_cast<double>(i) / 5) - 2) / 2, 1}; }

}  // namespace

// f_r of the closed form, k_d/π + k_s(n + 2)/(2π)·cosⁿ α_r: the view direction against light thrown back by a mirror, −l + 2(n·l)n.
TEST(glossy_wall, throws_light_back_about_the_mirror_direction) {
  Random random(1);
  int compared = 0, bright = 0;
  for (int trial = 0; trial < 200; ++trial) {
    const Vec3 normal = normalized(Vec3{random.between(-0.6, 0.6), random.between(-0.6, 0.6), -1});
    const Vec3 lamp{random.between(-2, 2), random.between(-2, 2), random.between(-0.5, 1)};
    const double diffuse = random.between(0, 0.4), specular = random.between(0.2, 0.6), exponent = random.scale(1, 30);
    Scene scene = wall(2);
    scene.materials[0] = {"gloss", Material::Brdf::phong, diffuse, specular, exponent};
    scene.objects[0].shape = Plane{{0, 0, 2}, normal};
    Camera camera = wide_camera();
    camera.illumination[0].position = lamp;
    const Truth t = truth(scene, camera);
    for (std::size_t i = 0; i < 25; ++i) {
      const Vec3 way = way_of(i), p = 2 * normal[2] / dot(normal, way) * way;
      const Vec3 to_light = normalized(lamp - p), to_camera = normalized(Vec3{0, 0, 0} - p);
      if (t.object_id[i] != 0 || !(dot(normal, to_light) > 0.05) || !(dot(normal, to_camera) > 0.05)) continue;
      const Vec3 mirrored = 2 * dot(normal, to_light) * normal - to_light;
      const double cosine = std::fmax(dot(mirrored, to_camera), 0);
      const double f_r = diffuse / pi + specular * (exponent + 2) / (2 * pi) * std::pow(cosine, exponent);
      // the cosine's few roundings, times the exponent
      ASSERT_NEAR(at(t.radiance_w_m2_sr, i) / at(t.irradiance_w_m2, i), f_r, f_r * 2e-6 + 3e-6 * exponent * specular) << trial << " " << i;
      ++compared, bright += cosine > 0.8;
    }
  }
  EXPECT_GT(compared, 2000);
  EXPECT_GT(bright, 300);
}

// B = ρE_B/π through lens and pixel [theory: ambient-light], the same however the surface leans and whatever stands beside it; 850 ± 0.1
// nm, so that QE·λ is that of 850 nm to 1e-4.
TEST(light_from_everywhere, is_the_same_on_every_surface) {
  Camera camera = wide_camera();
  camera.illumination.clear();
  camera.mode.sequence = {{false, 0, 0, 1e-3}};
  camera.filter.half_width_m = 0.1e-9;
  const double per_radiance = pi / (4 * 0.9 * 0.9) * 17.5e-6 * 17.5e-6, per_joule = 850e-9 * 0.4 / (6.62607015e-34 * 299792458.0);
  for (const double lean : {0.0, 0.5, -1.0}) {
    Scene scene = wall(2);
    scene.materials[0] = {"gloss", Material::Brdf::phong, 0.5, 0.2, 7};
    scene.objects[0].shape = Plane{{0, 0, 2}, {std::sin(lean), 0, -std::cos(lean)}};
    scene.objects.push_back(object(Sphere{{0, 0, 1}, 0.1}));
    scene.ambient = {Ambient::Spectrum::equal_energy, Ambient::Quantity::band_irradiance_w_per_m2, 0.3, {}, {}, {}};
    const Frame frame = expected_frame(scene, camera);
    for (std::size_t i = 0; i < 25; ++i) {
      const Vec3 way = way_of(i);
      const double cos4 = 1 / (dot(way, way) * dot(way, way));
      const double expected = frame.truth.object_id[i] < 0 ? 0 : 0.7 * 0.3 / pi * per_radiance * cos4 * 1e-3 * per_joule;
      EXPECT_NEAR(at(frame.raw.tap_a, i), expected, 2e-4 * expected) << lean << " " << i;  // an unlit raw frame rests on tap A
    }
  }
}

namespace {

/// Irradiance of the lamp, or electrons of the sun, on the point (0, 0, 2) of a wall with something at its side.
double on_wall(const Object& beside, bool sun) {
  Scene scene = wall(2);
  scene.objects.push_back(beside);
  Camera camera = lit_camera();
  camera.illumination[0].pattern.half_angle_rad = pi;
  camera.illumination[0].position = {2, 0, 1};
  if (sun) {
    scene.ambient = {Ambient::Spectrum::sun_am15, Ambient::Quantity::level, 1, {}, {}, Vec3{-2, 0, 1}};
    camera.mode.sequence = {{false, 0, 0, 1e-3}};
  }
  const Frame frame = expected_frame(scene, camera);
  EXPECT_EQ(frame.truth.object_id[0], 0) << "the camera sees the wall";
  return sun ? at(frame.raw.tap_a, 0) : at(frame.truth.irradiance_w_m2, 0);
}

/// What stands upright on the wall at x, as thin as can be.
std::vector<Object> uprights(double x) {
  return {object(Plane{{x, 0, 0}, {1, 0, 0}}), object(Triangle{{Vec3{x, -1, 2.5}, Vec3{x, 1, 2.5}, Vec3{x, 0, -3}}}),
          object(Box{{x, -1, 0.5}, {x + 2e-6, 1, 2.5}})};
}

}  // namespace

// What stands as near as 10 µm keeps the light of a lamp 2 m aside off the wall, and that of the sun.
TEST(shadow, is_cast_by_what_stands_close_to_a_surface) {
  for (const double x : {1e-5, 1e-4, 1e-3})
    for (const bool sun : {false, true})
      for (const Object& near : uprights(x)) EXPECT_EQ(on_wall(near, sun), 0) << near.shape.index() << " " << x;
  EXPECT_GT(on_wall(uprights(-1e-3)[1], false), 0);
  EXPECT_GT(on_wall(uprights(-1e-3)[1], true), 0);
}
