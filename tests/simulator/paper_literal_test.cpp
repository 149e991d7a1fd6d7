// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
// The paper's printed formula: what it gives, and that it is not what one gets unasked.
#include <gtest/gtest.h>

#include <algorithm>

#include "support/pixels.h"

using namespace tofray;
using namespace tofray::test;

namespace {

Camera flexx(PowerModel model) {
  Camera camera = load_camera("pico-flexx");
  camera.power_model = model;
  return camera;
}

/// The formula as printed, in double, for one pixel of a wall that faces the camera. Lengths in mm where the paper has them so.
double printed_power(const Camera& camera, const std::vector<double>& table, double x_mm, double y_mm, double z_mm, double reflectivity) {
  const double lx = 15.47 - x_mm, ly = 0 - y_mm, lz = -z_mm, r_mm = std::sqrt(lx * lx + ly * ly + lz * lz);
  const double inclination = std::atan(lz / std::sqrt(lx * lx + ly * ly)), azimuth = std::atan(lx / ly);
  const double row = std::trunc(inclination * std::sin(azimuth) * 180 * (168 / (2 * 43.0)) / pi);
  const double column = std::trunc(inclination * std::cos(azimuth) * 180 * (172 / (2 * 42.0)) / pi);
  if (!(row >= 0 && row < 168 && column >= 0 && column < 172)) return 0;
  const double intensity = table[static_cast<std::size_t>(row) * 172 + static_cast<std::size_t>(column)];
  const double r = r_mm / 1000, cos_theta = z_mm / r_mm, cos_alpha = z_mm / std::sqrt(x_mm * x_mm + y_mm * y_mm + z_mm * z_mm);
  const double radiance = reflectivity * intensity * cos_theta / (pi * r * r), f_mm = 2.544, n = camera.lens.f_number;
  const double irradiance = radiance * pi / (n * n) * std::pow(cos_alpha, 4) / (4 * f_mm * f_mm);
  return irradiance * camera.sensor.pixel_pitch_m * camera.sensor.pixel_pitch_m * camera.sensor.fill_factor;
}

/// flat_top of 62 x 45 degrees, 0.2 W, 172 x 168 samples over ±43 x ±42 degrees.
std::vector<double> flat_top() {
  std::vector<double> table;
  double sum = 0;
  for (int row = 0; row < 168; ++row) {
    for (int column = 0; column < 172; ++column) {
      const double x = (column - 85.5) / 2, y = (row - 83.5) / 2, theta = std::hypot(x, y) * pi / 180;
      table.push_back(std::exp2(-(std::pow(x / 31, 8) + std::pow(y / 22.5, 8))));
      sum += table.back() * std::sin(theta) / theta * std::pow(pi / 360, 2);
    }
  }
  for (double& value : table) value *= 0.2 / sum;
  return table;
}

}  // namespace

// Theory 2.8: the azimuth loses its quadrant and no origin is added, so that nearly all indices fall outside the table.
TEST(paper_literal, lights_80_of_38528_pixels_of_a_wall) {
  const Truth t = truth(wall(1, 0.8), flexx(PowerModel::paper_literal));
  ASSERT_EQ(t.power_w.size(), 38528u);
  EXPECT_EQ(std::count_if(t.power_w.begin(), t.power_w.end(), [](float w) { return w > 0; }), 80);
}

// Pixels whose index is within 1e-4 of a whole number may fall into the neighbouring cell: the table hardly differs there, so they
// count where both are lit.
TEST(paper_literal, is_the_printed_formula) {
  const Camera camera = flexx(PowerModel::paper_literal);
  const std::vector<double> table = flat_top();
  // From close by, directions are of all kinds: other rows and columns.
  for (const double z_m : {1.0, 0.03, 0.008}) {
    const Truth t = truth(wall(z_m, 0.8), camera);
    int lit = 0, different = 0;
    for (std::size_t i = 0; i < t.power_w.size(); ++i) {
      const double x = 1e3 * static_cast<double>(t.position_m[3 * i]), y = 1e3 * static_cast<double>(t.position_m[3 * i + 1]);
      const double expected = printed_power(camera, table, x, y, 1e3 * z_m, 0.8), got = static_cast<double>(t.power_w[i]);
      lit += expected > 1e-30;
      different += std::abs(got - expected) > 1e-4 * expected + 1e-30;
    }
    if (z_m == 1) {
      EXPECT_EQ(lit, 80);
    }
    EXPECT_GE(lit, 80) << z_m;
    EXPECT_LE(different, 2 + lit / 100) << z_m;
  }
}

TEST(paper_literal, is_not_the_default_and_never_meant_by_tofray) {
  EXPECT_EQ(load_camera("pico-flexx").power_model, PowerModel::tofray);
  const Truth t = truth(wall(1, 0.8), flexx(PowerModel::tofray));
  EXPECT_EQ(std::count_if(t.power_w.begin(), t.power_w.end(), [](float w) { return w > 0; }), 38528);
}

// In the row of the light's own height the azimuth is a quarter turn, which a quotient by 0 is, too.
TEST(paper_literal, has_a_quarter_turn_at_the_height_of_the_light) {
  Camera camera = flexx(PowerModel::paper_literal);
  camera.sensor.height = 3, camera.lens.cy_px = 1;
  const Truth t = truth(wall(1, 0.8), camera);
  const std::vector<double> table = flat_top();
  int lit = 0;
  for (std::size_t i = 224; i < 448; ++i) {
    const double x = 1e3 * static_cast<double>(t.position_m[3 * i]);
    ASSERT_EQ(t.position_m[3 * i + 1], 0);
    const double expected = printed_power(camera, table, x, 0, 1000, 0.8), got = static_cast<double>(t.power_w[i]);
    lit += expected > 1e-30;
    EXPECT_NEAR(got, expected, 1e-3 * expected + 1e-35) << i;
  }
  EXPECT_GT(lit, 20);
}

// Its irradiance is 1/f² [mm] of the right one, and T is missing: 0.1545 at 2.544 mm.
TEST(paper_literal, divides_by_the_focal_length_squared_once_more) {
  const Truth t = truth(wall(1, 0.8), flexx(PowerModel::paper_literal));
  const double right = pi * 1 * 144e-12 * 0.8 / (4 * 1.6 * 1.6);
  for (std::size_t i = 0; i < t.power_w.size(); ++i) {
    if (!(t.power_w[i] > 0)) continue;
    const double cosine = static_cast<double>(t.z_m[i]) / static_cast<double>(t.range_m[i]);
    const double radiance = static_cast<double>(t.radiance_w_m2_sr[i]);
    EXPECT_NEAR(static_cast<double>(t.power_w[i]) / (radiance * right * std::pow(cosine, 4)), 0.1545, 5e-5);
  }
}

// It has nothing to look up in a cone.
TEST(paper_literal, is_refused_for_light_without_a_table) {
  Camera camera = flexx(PowerModel::paper_literal);
  camera.illumination[0].pattern = {};
  try {
    Simulator simulator(wall(1), camera);
    FAIL();
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::bad_input);
    EXPECT_NE(std::string(error.what()).find("paper_literal"), std::string::npos);
  }
}
