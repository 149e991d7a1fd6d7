// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
// GGX over a matt ground: the printed form, reciprocity, the white furnace, and no more light than arrives.
#include <gtest/gtest.h>

#include <algorithm>

#include "brdf_of.h"
#include "printed_brdf.h"
#include "support/random.h"

using namespace tofray;
using brdf_test::at_angle;
using brdf_test::printed_ggx;
using tofray::base::dot;
using tofray::test::pi;
using tofray::test::Random;

namespace {

Material ggx(double diffuse, double f0, double alpha) {
  Material out{"ggx", Material::Brdf::ggx, diffuse, f0};
  out.alpha = alpha;
  return out;
}

/// What of the light comes back, by directions of the camera drawn about the lobe: good however narrow it is. tan²θ_h = α²u/(1 − u).
double ggx_lobe_albedo(const Material& m, double light_angle) {
  const Vec3 l = at_angle(light_angle, 0);
  const double a2 = m.alpha * m.alpha;
  const flow::Finish<float> finish = brdf_test::finish_of(m);
  const int steps = 200;
  double sum = 0;
  for (int i = 0; i < steps; ++i) {
    const double u = (i + 0.5) / steps, tan2 = a2 * u / (1 - u), angle = std::atan(std::sqrt(tan2));
    const double cos = std::cos(angle), d = 1 / (pi * a2 * std::pow(cos, 4) * (1 + tan2 / a2) * (1 + tan2 / a2));
    for (int k = 0; k < steps; ++k) {
      const Vec3 h = at_angle(angle, (k + 0.5) / steps * 2 * pi);
      const double lh = dot(l, h);
      const Vec3 v{2 * lh * h[0] - l[0], 2 * lh * h[1] - l[1], 2 * lh * h[2] - l[2]};
      if (lh > 0 && v[2] > 1e-6) sum += brdf_test::f_r(finish, l, v) * v[2] * 4 * lh / (d * cos);
    }
  }
  return sum / steps / steps;
}

}  // namespace

TEST(ggx, is_the_printed_form) {
  Random random(1);
  for (int i = 0; i < 20000; ++i) {
    const Material m = ggx(random.between(0, 1), random.between(0, 1), random.scale(0.001, 1));
    const Vec3 light = at_angle(random.between(0, 1.5), 0), camera = at_angle(random.between(0, 1.5), random.between(0, 2 * pi));
    // Directions are rounded to 2^-24: where the lobe is steep, the half vector's slope is good to that much of α.
    ASSERT_NEAR(brdf_test::f_r(m, light, camera), printed_ggx(m, light, camera), printed_ggx(m, light, camera) * (2e-6 + 1e-6 / m.alpha))
        << i;
  }
}

// At and beside the mirror's direction, where a cosine's last digit is more than all of the lobe.
TEST(ggx, keeps_its_digits_in_the_narrowest_lobe) {
  const Material m = ggx(0, 0.9, 1e-3);
  for (const double angle : {0.0, 0.5, 1.4}) {
    for (const double off : {0.0, 5e-4, 2e-3, 1e-2}) {
      const Vec3 light = at_angle(angle, pi), camera = at_angle(angle + off, 0);
      EXPECT_NEAR(brdf_test::f_r(m, light, camera), printed_ggx(m, light, camera), printed_ggx(m, light, camera) * 2e-3)
          << angle << " " << off;
    }
  }
}

TEST(ggx, is_the_same_with_light_and_camera_exchanged) {
  Random random(3);
  flow::Finish<float> finish{};
  for (int i = 0; i < 100000; ++i) {
    if (i % 100 == 0) finish = brdf_test::finish_of(ggx(random.between(0, 1), random.between(0, 1), random.scale(0.001, 1)));
    const Vec3 light = at_angle(random.between(0, 1.57), 0), camera = at_angle(random.between(0, 1.57), random.between(0, 6));
    const double forth = brdf_test::f_r(finish, light, camera);
    ASSERT_NEAR(brdf_test::f_r(finish, camera, light), forth, 1e-6 * forth) << i;
  }
}

// All mirrors perfect: what is missing was sent from one to another, which the model leaves out. Values: numerical integration in
// double, of the printed form. (Masking of light and camera by themselves would give 0.7391, 0.6860, 0.6830, 0.6879.)
TEST(ggx, white_furnace) {
  const Material m = ggx(0, 1, 0.5);
  const double known[][2] = {{0.2, 0.789929}, {0.5, 0.698251}, {0.9, 0.683961}, {1, 0.687849}};
  for (const auto& [cosine, back] : known) {
    EXPECT_NEAR(brdf_test::albedo(m, std::acos(cosine), 500, 400), back, 1e-4) << cosine;
    EXPECT_NEAR(ggx_lobe_albedo(m, std::acos(cosine)), back, 3e-3) << cosine;
  }
}

TEST(ggx, sends_back_all_light_at_most) {
  double most = 0;
  for (const double alpha : {0.001, 0.01, 0.1, 0.3, 0.6, 1.0}) {
    for (const double f0 : {0.0, 0.04, 0.3, 0.9, 1.0}) {
      for (const double angle : {0.0, 0.7, 1.2, 1.45, 1.55}) {
        // The ground by the hemisphere; the lobe, which may be narrow, by itself.
        const double back = brdf_test::albedo(ggx(1, f0, 1), angle, 100, 50) - brdf_test::albedo(ggx(0, f0, 1), angle, 100, 50) +
                            ggx_lobe_albedo(ggx(0, f0, alpha), angle);
        EXPECT_LE(back, 1 + 1e-3) << alpha << " " << f0 << " " << angle;
        most = std::max(most, back);
      }
    }
  }
  EXPECT_GT(most, 0.999);
}

// What truth shows as reflectivity.
TEST(ggx, reflectivity_is_what_comes_back_at_normal_incidence) {
  for (const double alpha : {0.2, 0.5, 1.0}) {
    const Material m = ggx(0.7, 0.3, alpha);
    EXPECT_NEAR(static_cast<double>(brdf::view_of(m).reflectivity), brdf_test::albedo(m, 0, 500, 10), 2e-4) << alpha;
  }
  EXPECT_NEAR(static_cast<double>(brdf::view_of(ggx(0, 0.9, 0.001)).reflectivity), 0.9, 1e-3);
  EXPECT_NEAR(static_cast<double>(brdf::view_of(ggx(1, 0, 0.001)).reflectivity), 31.0 / 32, 1e-3);
}
