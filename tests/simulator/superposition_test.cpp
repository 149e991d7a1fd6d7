// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
// Lights add up; light and camera may change places.
#include <gtest/gtest.h>

#include "support/pixels.h"
#include "support/random.h"
#include "support/sanitizers.h"

using namespace tofray;
using namespace tofray::test;

namespace {

Scene some_things() {
  Scene scene = wall(3, 0.6);
  scene.materials.push_back({"paint", Material::Brdf::phong, 0.4, 0.3, 20});
  scene.objects.push_back(object(Sphere{{0.2, 0.1, 1.6}, 0.35}, 1));
  scene.objects.push_back(object(Box{{-0.9, -0.5, 1.4}, {-0.4, 0.3, 1.9}}, 1));
  scene.objects.push_back(object(Triangle{{{{0.5, 0.6, 1.2}, {1.0, 0.5, 1.8}, {0.4, -0.6, 2.2}}}}, 0));
  return scene;
}

Illumination some_light(Random& random) {
  Illumination light = one_watt_per_steradian(random.point(0.4));
  light.axis = base::normalized(Vec3{0, 0, 1} + random.point(0.3));
  light.pattern.kind = random.uniform() < 0.5 ? Pattern::Kind::lambertian : Pattern::Kind::cosine_lobe;
  light.pattern.exponent = 4;
  light.power_w = random.between(0.1, 2);
  return light;
}

}  // namespace

// Sums of eight floats, against sums in double.
TEST(superposition, of_eight_lights_is_the_sum_of_each_alone) {
  Random random(1);
  const Scene scene = some_things();
  Camera all = plain_camera(64, 48, 40);
  for (int i = 0; i < 8; ++i) all.illumination.push_back(some_light(random));
  const Truth together = truth(scene, all);
  std::vector<double> irradiance(64 * 48), radiance(64 * 48), power(64 * 48), signal(together.signal_e.size());
  for (const Illumination& light : all.illumination) {
    Camera one = all;
    one.illumination = {light};
    const Truth t = truth(scene, one);
    for (std::size_t i = 0; i < power.size(); ++i) {
      irradiance[i] += static_cast<double>(t.irradiance_w_m2[i]), radiance[i] += static_cast<double>(t.radiance_w_m2_sr[i]);
      power[i] += static_cast<double>(t.power_w[i]);
    }
    for (std::size_t i = 0; i < signal.size(); ++i) signal[i] += static_cast<double>(t.signal_e[i]);
  }
  for (std::size_t i = 0; i < power.size(); ++i) {
    ASSERT_NEAR(static_cast<double>(together.irradiance_w_m2[i]), irradiance[i], 1e-5 * irradiance[i]);
    ASSERT_NEAR(static_cast<double>(together.radiance_w_m2_sr[i]), radiance[i], 1e-5 * radiance[i]);
    ASSERT_NEAR(static_cast<double>(together.power_w[i]), power[i], 1e-5 * power[i]);
  }
  for (std::size_t i = 0; i < signal.size(); ++i) ASSERT_NEAR(static_cast<double>(together.signal_e[i]), signal[i], 1e-5 * signal[i]);
}

// In the raw frames A − B is linear in the lights, each with a path of its own.
TEST(superposition, holds_for_raw_frames) {
  Random random(2);
  const Scene scene = some_things();
  Camera all = plain_camera(40, 30, 25);
  for (int i = 0; i < 3; ++i) all.illumination.push_back(some_light(random));
  const Raw together = expected_frame(scene, all).raw;
  std::vector<double> a(together.tap_a.size()), b(together.tap_b.size());
  for (const Illumination& light : all.illumination) {
    Camera one = all;
    one.illumination = {light};
    const Raw raw = expected_frame(scene, one).raw;
    for (std::size_t i = 0; i < a.size(); ++i) a[i] += static_cast<double>(raw.tap_a[i]), b[i] += static_cast<double>(raw.tap_b[i]);
  }
  for (std::size_t i = 0; i < a.size(); ++i) {
    ASSERT_NEAR(static_cast<double>(together.tap_a[i]), a[i], 1e-5 * (a[i] + b[i]) + 1e-6);
    ASSERT_NEAR(static_cast<double>(together.tap_b[i]), b[i], 1e-5 * (a[i] + b[i]) + 1e-6);
  }
}

// A small patch seen from C and lit from L sends as much through a small hole at C as the other way round:
// L·cos_C/r_C² is the same with both exchanged.
TEST(reciprocity, light_and_camera_may_change_places) {
  Random random(3);
  const auto through = [](const Scene& scene, const Vec3& camera_at, const Vec3& light_at, const Vec3& up) {
    Scene seen = scene;
    seen.camera.pose = {camera_at, {0, 0, 0}, up};
    Camera camera = lit_camera();
    camera.illumination[0].pattern.half_angle_rad = pi;  // 1 W/sr in all directions
    camera.illumination[0].power_w = 4 * pi;
    // camera frame: the light relative to the camera
    const Vec3 forward = base::normalized(-1.0 * camera_at), down = base::normalized(base::dot(up, forward) * forward - up);
    const base::Mat3 rows{{base::cross(down, forward), down, forward}};
    camera.illumination[0].position = rows * (light_at - camera_at);
    const Truth t = truth(seen, camera);
    const Vec3 n{static_cast<double>(t.normal[0]), static_cast<double>(t.normal[1]), static_cast<double>(t.normal[2])};
    return static_cast<double>(t.radiance_w_m2_sr[0]) * -n[2] / base::dot(camera_at, camera_at);
  };
  for (int i = 0; i < often(1000); ++i) {
    Scene scene;
    const double diffuse = random.between(0, 0.6), specular = random.between(0, 0.4), exponent = random.scale(1, 50);
    scene.materials.push_back({"paint", Material::Brdf::phong, diffuse, specular, exponent});
    const Vec3 n = random.direction();
    scene.objects.push_back(object(Plane{{0, 0, 0}, n}));
    const auto above = [&] {
      Vec3 v = random.direction();
      while (base::dot(v, n) < 0.1) v = random.direction();
      const double far = random.between(0.5, 3);
      return far * v;
    };
    const Vec3 a = above(), b = above();
    const Vec3 up = random.across(base::normalized(a)), other_up = random.across(base::normalized(b));
    const double forth = through(scene, a, b, up), back = through(scene, b, a, other_up);
    ASSERT_GT(forth, 0);
    // rounding in the angles counts n times in the lobe
    ASSERT_NEAR(back, forth, forth * (2e-6 + 4e-7 * exponent)) << i;
  }
}
