// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
// Oren and Nayar's qualitative model: the printed form with its angles, its limits, reciprocity and energy.
#include <gtest/gtest.h>

#include <algorithm>

#include "brdf_of.h"
#include "printed_brdf.h"
#include "support/random.h"

using namespace tofray;
using brdf_test::at_angle;
using tofray::test::pi;
using tofray::test::Random;

namespace {

Material rough(double rho, double sigma) { return {"rough", Material::Brdf::oren_nayar, rho, 0, 1, sigma}; }
double f_r(double rho, double sigma, const Vec3& to_light, const Vec3& to_camera) {
  return brdf_test::f_r(rough(rho, sigma), to_light, to_camera);
}
double albedo(double rho, double sigma, double light_angle) { return brdf_test::albedo(rough(rho, sigma), light_angle); }

}  // namespace

// The printed form. l·v and the product of the cosines are rounded to 2^-24 each; their difference is divided by the larger cosine.
TEST(oren_nayar, is_the_printed_form_with_its_angles) {
  Random random(1);
  for (int i = 0; i < 100000; ++i) {
    const Material m = rough(random.between(0, 0.95), random.between(0, pi / 2));
    const double theta_i = random.between(0, 1.5), theta_r = random.between(0, 1.5);
    const Vec3 light = at_angle(theta_i, 0), camera = at_angle(theta_r, random.between(0, 2 * pi));
    ASSERT_NEAR(brdf_test::f_r(m, light, camera), brdf_test::printed_f_r(m, light, camera),
                3e-7 * (1 + 1 / std::cos(std::min(theta_i, theta_r))))
        << i;
  }
}

TEST(oren_nayar, without_roughness_is_lambert) {
  Random random(2);
  for (int i = 0; i < 10000; ++i) {
    const double rho = random.uniform();
    ASSERT_NEAR(f_r(rho, 0, at_angle(random.between(0, 1.5), 0), at_angle(random.between(0, 1.5), 1)), rho / pi, 1e-7 * rho) << i;
  }
}

TEST(oren_nayar, is_the_same_with_light_and_camera_exchanged) {
  Random random(3);
  for (int i = 0; i < 100000; ++i) {
    const Vec3 light = at_angle(random.between(0, 1.57), 0), camera = at_angle(random.between(0, 1.57), random.between(0, 6));
    const double sigma = random.between(0, 1.5);
    ASSERT_EQ(f_r(0.7, sigma, light, camera), f_r(0.7, sigma, camera, light)) << i;
  }
}

// At grazing incidence the model itself sends back ρ·(A + B/2), up to 1.015·ρ at σ = 0.2; tofray holds ρ there.
TEST(oren_nayar, sends_back_all_light_at_most) {
  double most = 0;
  for (const double sigma : {0.05, 0.1, 0.2, 0.3, 0.6, 1.2}) {
    for (const double angle : {0.0, 0.7, 1.2, 1.45, 1.53, 1.56}) {
      const double back = albedo(1, sigma, angle);
      EXPECT_LE(back, 1 + 1e-4) << sigma << " " << angle;
      most = std::fmax(most, back);
    }
    EXPECT_LT(albedo(0.5, sigma, 0), 0.5) << sigma;
  }
  EXPECT_GT(most, 0.98);
}

// A rough surface is brighter toward the light than away from it, and flatter than a matt one toward the rim of a full moon.
// Reciprocal: what a surface seen at θ sends on of light from everywhere is what it sends everywhere of light at θ.
TEST(oren_nayar, albedo_at_the_view_is_the_integral) {
  for (const double sigma : {0.1, 0.5, 1.2})
    for (const double angle : {0.0, 0.3, 0.8, 1.3, 1.5}) {
      const double said =
          static_cast<double>(brdf::albedo<float>(brdf_test::finish_of(rough(0.6, sigma)), static_cast<float>(std::cos(angle))));
      EXPECT_NEAR(said, albedo(0.6, sigma, angle), 3e-5) << sigma << " " << angle;
    }
  // Of the others it is their reflectivity.
  EXPECT_EQ(brdf::albedo<float>(brdf_test::finish_of({"matt", Material::Brdf::lambert, 0.6, 0, 1}), 0.3F), 0.6F);
}

TEST(oren_nayar, is_brighter_toward_the_light) {
  EXPECT_GT(f_r(0.8, 0.5, at_angle(1.2, 0), at_angle(1.2, 0)), 1.5 * f_r(0.8, 0.5, at_angle(1.2, 0), at_angle(1.2, pi)));
  EXPECT_NEAR(f_r(0.8, 0.5, at_angle(1.2, 0), at_angle(1.2, pi)), f_r(0.8, 0.5, {0, 0, 1}, {0, 0, 1}), 1e-7);
}
