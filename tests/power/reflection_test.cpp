// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
// Lambert and Phong: the closed form, reciprocity and energy.
#include <gtest/gtest.h>

#include "brdf_of.h"
#include "support/random.h"

using namespace tofray;
using tofray::base::dot;
using tofray::test::Random;

namespace {

const double turn = 2 * std::acos(-1.0);

flow::Finish<float> glossy(double diffuse, double specular, double exponent) {
  return brdf::lambert_and_lobe(static_cast<float>(diffuse), static_cast<float>(specular), static_cast<float>(exponent));
}
double f_r(double diffuse, double specular, double exponent, const Vec3& to_light, const Vec3& to_camera) {
  return brdf_test::f_r(glossy(diffuse, specular, exponent), to_light, to_camera);
}
double albedo(double diffuse, double specular, double exponent, double light_angle) {
  return brdf_test::albedo(glossy(diffuse, specular, exponent), light_angle, 500, 400);
}

Vec3 upward(Random& random) {
  Vec3 d = random.direction();
  d[2] = std::abs(d[2]);
  return d;
}

}  // namespace

// 100,000 pairs of Lambert and as many of Phong with a wide lobe; of narrow ones, too, where the mirror direction's cosine, rounded twice
// to 2^-24 each, counts n times. (Phong's original form, with 1/cos, is not the same: no material has it.)
TEST(reflection, is_the_same_with_light_and_camera_exchanged) {
  Random random(1);
  for (int i = 0; i < 300000; ++i) {
    const double diffuse = random.between(0, 0.5), specular = i % 3 == 0 ? 0 : random.between(0, 0.5), exponent = random.scale(1, 100);
    const Vec3 light = upward(random), camera = upward(random);
    const double forth = f_r(diffuse, specular, exponent, light, camera), back = f_r(diffuse, specular, exponent, camera, light);
    const double mirror = std::fmax(2 * light[2] * camera[2] - dot(light, camera), 0.01);
    ASSERT_NEAR(back, forth, forth * (1e-6 + exponent * 0x1p-22 / mirror)) << i;
  }
}

// The closed form, in double.
TEST(reflection, is_lambert_plus_the_normalised_lobe) {
  Random random(2);
  for (int i = 0; i < 100000; ++i) {
    const double diffuse = random.between(0, 0.5), specular = random.between(0.1, 0.5), exponent = random.scale(1, 100);
    const Vec3 light = upward(random), camera = upward(random);
    const Vec3 mirror{-light[0], -light[1], light[2]};
    const double cosine = std::fmax(dot(mirror, camera), 0);
    const double expected = diffuse / (turn / 2) + specular * (exponent + 2) / turn * std::pow(cosine, exponent);
    const double tolerance = 1e-6 + expected * exponent * 1e-6 / std::fmax(cosine, 0.05);
    ASSERT_NEAR(f_r(diffuse, specular, exponent, light, camera), expected, tolerance) << i;
  }
}

// What of the light comes back.
TEST(reflection, sends_back_all_light_at_most) {
  for (const double exponent : {1.0, 10.0, 50.0}) EXPECT_NEAR(albedo(0, 1, exponent, 0), 1, 1e-4) << exponent;
  EXPECT_NEAR(albedo(0, 1, 1, turn / 6), 0.608998, 1e-4);
  EXPECT_NEAR(albedo(0, 1, 10, turn / 6), 0.504736, 1e-4);
  EXPECT_NEAR(albedo(0, 1, 50, turn / 6), 0.500002, 1e-4);
  EXPECT_NEAR(albedo(0.5, 0, 1, turn / 6), 0.5, 1e-4);
  for (const double degrees : {15.0, 30.0, 45.0, 75.0, 85.0}) {
    for (const double exponent : {1.0, 5.0, 50.0}) {
      EXPECT_LE(albedo(0.5, 0.5, exponent, degrees * turn / 360), 1 + 1e-4) << degrees << " " << exponent;
    }
  }
}

TEST(reflection, of_a_matt_surface_has_no_lobe) {
  EXPECT_EQ(f_r(0.6, 0, 5, {0, 0, 1}, {0, 0, 1}), f_r(0.6, 0, 1, {0.6, 0, 0.8}, {0, 0.8, 0.6}));
}
