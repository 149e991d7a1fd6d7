// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
// Retro-reflectors: the printed form, half the peak at the spread, reciprocity, and no more light than arrives.
#include <gtest/gtest.h>

#include <algorithm>

#include "brdf_of.h"
#include "printed_brdf.h"
#include "support/random.h"

using namespace tofray;
using brdf_test::apart;
using brdf_test::at_angle;
using brdf_test::printed_f_r;
using tofray::base::dot;
using tofray::test::pi;
using tofray::test::Random;

namespace {

Material sheet(double diffuse, double retro, double spread) {
  Material out{"sheet", Material::Brdf::retro, diffuse};
  out.retro = retro, out.spread_rad = spread;
  return out;
}

/// What of the light comes back, by directions drawn about it: a ring holds the lobe's share u, |l − v|² = w²·u/(1 − u).
double sheet_lobe_albedo(const Material& m, double light_angle) {
  const double width = brdf_test::retro_width(m);
  const Vec3 l = at_angle(light_angle, 0);
  const int steps = 500;
  double sum = 0;
  for (int i = 0; i < steps; ++i) {
    const double u = (i + 0.5) / steps, square = width * u / (1 - u);
    if (square > 4) break;
    const double off = 2 * std::asin(std::sqrt(square) / 2), pdf = std::pow(1 - u, 2) / (pi * width);
    for (int k = 0; k < steps; ++k) {
      const Vec3 about = at_angle(off, (k + 0.5) / steps * 2 * pi);  // z there is l here
      const double c = std::cos(light_angle), s = std::sin(light_angle);
      const Vec3 v{c * about[0] + s * about[2], about[1], c * about[2] - s * about[0]};
      if (v[2] > 0) sum += brdf_test::f_r(m, l, v) * v[2] / pdf;
    }
  }
  return sum / steps / steps;
}

}  // namespace

TEST(retro, is_the_printed_form) {
  Random random(1);
  for (int i = 0; i < 100000; ++i) {
    const Material m = sheet(random.between(0, 0.5), random.between(0, 0.5), random.scale(0.001, 0.7));
    const double angle = random.between(0, 1.5), off = random.scale(1e-4, 1);
    const Vec3 light = at_angle(angle, 0), camera = at_angle(std::min(angle + off, 1.5), random.between(-off, off));
    ASSERT_NEAR(brdf_test::f_r(m, light, camera), printed_f_r(m, light, camera),
                printed_f_r(m, light, camera) * (2e-6 + 1e-6 / m.spread_rad))
        << i;
  }
}

TEST(retro, half_of_the_peak_is_left_at_the_spread) {
  for (const double spread : {0.001, 0.01, 0.1, pi / 4}) {
    const Material m = sheet(0, 0.3, spread);
    const double peak = brdf_test::f_r(m, {0, 0, 1}, {0, 0, 1});
    EXPECT_NEAR(brdf_test::f_r(m, {0, 0, 1}, at_angle(spread, 2)), peak / 2, peak * 1e-3) << spread;
    EXPECT_NEAR(peak, 0.3 * (std::sqrt(2.0) - 1) / (pi * apart(spread)), peak * 1e-5) << spread;
  }
}

TEST(retro, is_the_same_with_light_and_camera_exchanged) {
  Random random(3);
  for (int i = 0; i < 100000; ++i) {
    const Material m = sheet(random.between(0, 0.5), random.between(0, 0.5), random.scale(0.001, 0.7));
    const Vec3 light = at_angle(random.between(0, 1.57), 0), camera = at_angle(random.between(0, 1.57), random.between(0, 0.1));
    const double forth = brdf_test::f_r(m, light, camera);
    ASSERT_NEAR(brdf_test::f_r(m, camera, light), forth, 1e-6 * forth) << i;
  }
}

TEST(retro, sends_back_its_share_at_most) {
  for (const double spread : {0.001, 0.01, 0.1, pi / 4}) {
    for (const double angle : {0.0, 0.7, 1.2, 1.5}) {
      const double back = sheet_lobe_albedo(sheet(0, 1, spread), angle);
      EXPECT_LE(back, 1 + 1e-3) << spread << " " << angle;
      if (spread <= 0.01 && angle < 1.3) {
        EXPECT_NEAR(back, 1, 0.02) << spread << " " << angle;
      }
    }
  }
  EXPECT_NEAR(static_cast<double>(brdf::view_of(sheet(0.1, 0.3, 0.01)).reflectivity), 0.4, 1e-6);
}
