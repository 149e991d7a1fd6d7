// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
// How light sources spread their power. Section 2.1's numbers.
#include <gtest/gtest.h>

#include <algorithm>

#include "camera/frozen_camera.h"
#include "power/light_source.h"
#include "support/pixels.h"
#include "support/random.h"

using namespace tofray;
using namespace tofray::test;

namespace {

double intensity(const camera::FrozenLight& light, const Vec3& d) {
  const float x = static_cast<float>(d[0]), y = static_cast<float>(d[1]), z = static_cast<float>(d[2]);
  return static_cast<double>(power::intensity(light.view, x, y, z, 1 / std::sqrt(x * x + y * y + z * z)));
}

Illumination source(const Pattern& pattern, double watts, const Vec3& axis = {0, 0, 1}) {
  Illumination light;
  light.pattern = pattern;
  light.power_w = watts;
  light.axis = axis;
  return light;
}

/// ∫ I dω over the whole sphere: equal areas about `axis`, in each ring two points after Gauss.
double total(const camera::FrozenLight& light, const Vec3& axis, int rings, int sectors) {
  Random random(1);
  const Vec3 x = random.across(axis), y = base::cross(axis, x);
  double sum = 0;
  for (int i = 0; i < 2 * rings; ++i) {
    const double z = 1 - (std::floor(i / 2.0) * 2 + 1 + (i % 2 == 0 ? -1 : 1) / std::sqrt(3.0)) / rings, rim = std::sqrt(1 - z * z);
    for (int k = 0; k < sectors; ++k) {
      const double psi = 2 * pi * (k + 0.5) / sectors;
      sum += intensity(light, z * axis + (rim * std::cos(psi)) * x + (rim * std::sin(psi)) * y);
    }
  }
  return sum * 2 * pi / (rings * static_cast<double>(sectors));
}

Pattern lobe(double exponent) {
  Pattern p;
  p.kind = Pattern::Kind::cosine_lobe;
  p.exponent = exponent;
  return p;
}

Pattern flexx() {
  Pattern p;
  p.kind = Pattern::Kind::flat_top;
  p.width_rad = 62 * pi / 180, p.height_rad = 45 * pi / 180;
  p.columns = 172, p.rows = 168;
  p.half_range_x_rad = 43 * pi / 180, p.half_range_y_rad = 42 * pi / 180;
  return p;
}

Pattern table(int columns, int rows, const std::vector<double>& samples) {
  Pattern p;
  p.kind = Pattern::Kind::table;
  p.columns = columns, p.rows = rows;
  p.half_range_x_rad = 0.7, p.half_range_y_rad = 0.5;
  p.samples = samples;
  return p;
}

Vec3 f_theta(double theta_x, double theta_y) {
  const double theta = std::hypot(theta_x, theta_y), share = theta > 0 ? std::sin(theta) / theta : 1;
  return {theta_x * share, theta_y * share, std::cos(theta)};
}

}  // namespace

// On the axis, about 45 degrees, where the formula changes, sideways and almost straight back; of any length.
TEST(light_source, angles_of_a_direction_are_those_of_double_precision) {
  double worst = 0;
  for (int i = 0; i <= 3600; ++i) {
    const double theta = i == 0 ? 1e-6 : i * pi / 3601;
    for (int k = 0; k < 24; ++k) {
      const double length = k % 3 == 0 ? 1e-3 : (k % 3 == 1 ? 1 : 30);
      const auto x = static_cast<float>(length * std::sin(theta) * std::cos(k * pi / 12)),
                 y = static_cast<float>(length * std::sin(theta) * std::sin(k * pi / 12)), z = static_cast<float>(length * std::cos(theta));
      const power::Angles<float> got = power::f_theta(x, y, z);
      const double sine = std::hypot(double{x}, double{y}), angle = std::atan2(sine, double{z});
      worst = std::max(worst, std::hypot(got.x - angle * x / sine, got.y - angle * y / sine) / angle);
    }
  }
  EXPECT_LT(worst, 4e-7);
  for (const auto& [x, z] : {std::pair{1.0f, 1.0f}, {1.0f, std::nextafter(1.0f, 0.0f)}, {1.0f, std::nextafter(1.0f, 2.0f)}}) {
    EXPECT_NEAR(power::f_theta(x, 0.0f, z).x, pi / 4, 1e-6);
    EXPECT_EQ(power::f_theta(x, 0.0f, z).y, 0);
  }
}

// Lobes are the same all around and smooth in z but for the rim at 90 degrees, which lies between two rings.
TEST(light_source, lobes_give_off_their_power) {
  for (const Vec3& axis : {Vec3{0, 0, 1}, base::normalized(Vec3{1, -2, 0.5}), Vec3{0, 0, -1}, Vec3{1, 0, 0}}) {
    for (const double exponent : {1.0, 2.0, 7.5, 20.0}) {
      EXPECT_NEAR(total(camera::freeze_light(source(lobe(exponent), 0.3, axis), 1), axis, 1000, 50), 0.3, 0.3 * 1e-6) << exponent;
    }
    EXPECT_NEAR(total(camera::freeze_light(source({}, 0.3, axis), 1), axis, 1000, 50), 0.3, 0.3 * 1e-6);
  }
}

// A step at the cone's rim: within half a ring, 1/rings of its height.
TEST(light_source, cones_give_off_their_power) {
  for (const double degrees : {5.0, 30.0, 60.0, 90.0, 150.0}) {
    Pattern p;
    p.kind = Pattern::Kind::cone;
    p.half_angle_rad = degrees * pi / 180;
    const double peak = 0.3 / (2 * pi * (1 - std::cos(p.half_angle_rad)));
    const camera::FrozenLight light = camera::freeze_light(source(p, 0.3), 1);
    EXPECT_NEAR(total(light, {0, 0, 1}, 2000, 20), 0.3, 4 * pi * peak / 2000) << degrees;
    const double in = p.half_angle_rad - 0.001, out = p.half_angle_rad + 0.001;
    EXPECT_NEAR(intensity(light, {std::sin(in), 0, std::cos(in)}), peak, 1e-6 * peak);
    EXPECT_EQ(intensity(light, {0, std::sin(out), std::cos(out)}), 0);
  }
}

// Tables: bilinear between cells of half a degree.
TEST(light_source, tables_give_off_their_power) {
  EXPECT_NEAR(total(camera::freeze_light(source(flexx(), 0.2), 1), {0, 0, 1}, 1500, 3000), 0.2, 0.2 * 1e-3);
  Random random(2);
  std::vector<double> samples;
  for (int i = 0; i < 40 * 30; ++i) samples.push_back(1 + std::sin(0.2 * (i % 40)) * std::cos(0.25 * std::floor(i / 40.0)) / 2);
  const Vec3 axis = base::normalized(Vec3{0.3, -0.2, 1});
  EXPECT_NEAR(total(camera::freeze_light(source(table(40, 30, samples), 2, axis), 1), axis, 1500, 3000), 2, 2 * 2e-3);
}

// [theory: radiant-intensity], with an integral of our own over a finer grid.
TEST(light_source, flat_top_has_its_integral_and_axis) {
  double sum = 0;
  const int n = 2000;
  for (int i = 0; i < n; ++i) {
    for (int k = 0; k < n; ++k) {
      const double x = 43 * (2 * (i + 0.5) / n - 1), y = 42 * (2 * (k + 0.5) / n - 1), theta = std::hypot(x, y) * pi / 180;
      sum += std::exp2(-(std::pow(x / 31, 8) + std::pow(y / 22.5, 8))) * std::sin(theta) / theta;
    }
  }
  EXPECT_NEAR(sum * (86.0 / n * pi / 180) * (84.0 / n * pi / 180), 0.805095, 1e-6);
  const camera::FrozenLight light = camera::freeze_light(source(flexx(), 0.2), 1);
  EXPECT_NEAR(intensity(light, {0, 0, 1}), 0.248418, 2e-6);
  // half its peak at the edges of 62 x 45 degrees; bilinear over half a degree bends by 1/8 of the second derivative there
  EXPECT_NEAR(intensity(light, f_theta(31 * pi / 180, 0)) / 0.248418, 0.5, 2e-3);
  EXPECT_NEAR(intensity(light, f_theta(0, -22.5 * pi / 180)) / 0.248418, 0.5, 2e-3);
  EXPECT_EQ(intensity(light, f_theta(43.01 * pi / 180, 0)), 0);
  EXPECT_EQ(intensity(light, f_theta(0, 42.01 * pi / 180)), 0);
  EXPECT_EQ(intensity(light, {0, 0, -1}), 0);
}

// Between centres bilinear, in the outer half cell the outer sample: against f-theta in double.
TEST(light_source, tables_are_read_at_f_theta_angles) {
  Random random(3);
  const int columns = 7, rows = 5;
  std::vector<double> samples;
  for (int i = 0; i < columns * rows; ++i) samples.push_back(random.between(0.5, 2));
  const auto read = [&](double x, double y) {
    const double u = std::fmin(std::fmax((x + 0.7) / 1.4 * columns - 0.5, 0), columns - 1);
    const double v = std::fmin(std::fmax((y + 0.5) * rows - 0.5, 0), rows - 1);
    const int c = std::min(static_cast<int>(u), columns - 2), r = std::min(static_cast<int>(v), rows - 2);
    const auto at = [&](int row, int column) { return samples[static_cast<std::size_t>(row * columns + column)]; };
    const double right = u - c, down = v - r;
    const auto across = [&](int row) { return (1 - right) * at(row, c) + right * at(row, c + 1); };
    return (1 - down) * across(r) + down * across(r + 1);
  };
  double integral = 0;  // 100 × 100 middles in each cell: right to 1e-6
  const int n = 100;
  for (int k = 0; k < n * rows; ++k) {
    for (int i = 0; i < n * columns; ++i) {
      const double x = 0.7 * ((2 * i + 1.0) / (n * columns) - 1), y = 0.5 * ((2 * k + 1.0) / (n * rows) - 1), theta = std::hypot(x, y);
      integral += read(x, y) * std::sin(theta) / theta * (1.4 / (n * columns)) * (1.0 / (n * rows));
    }
  }
  const camera::FrozenLight light = camera::freeze_light(source(table(columns, rows, samples), 1), 1);
  for (int i = 0; i < 20000; ++i) {
    const double x = random.between(-0.6999, 0.6999), y = random.between(-0.4999, 0.4999);
    ASSERT_NEAR(intensity(light, f_theta(x, y)), read(x, y) / integral, 1e-5) << x << " " << y;
  }
}

// A table with one bright cell lights the pixel that looks there: x right, y down. Light at the camera's place.
TEST(light_source, the_bright_cell_of_a_table_lands_in_its_own_quadrant) {
  for (int quadrant = 0; quadrant < 4; ++quadrant) {
    const int column = quadrant % 2 == 0 ? 4 : 15, row = quadrant < 2 ? 3 : 10;  // of 20 x 14
    std::vector<double> samples(20 * 14);
    samples[static_cast<std::size_t>(row * 20 + column)] = 1;
    Camera camera = lit_camera(101, 81, 60);
    camera.illumination[0].pattern = table(20, 14, samples);
    const Truth t = truth(wall(2), camera);
    std::size_t best = 0;
    for (std::size_t i = 0; i < t.power_w.size(); ++i) best = t.irradiance_w_m2[i] > t.irradiance_w_m2[best] ? i : best;
    const Vec3 d = f_theta(0.7 * ((2 * column + 1) / 20.0 - 1), 0.5 * ((2 * row + 1) / 14.0 - 1));
    EXPECT_NEAR(static_cast<double>(best % 101), 50 + 60 * d[0] / d[2], 1) << quadrant;
    EXPECT_NEAR(std::floor(static_cast<double>(best) / 101), 40 + 60 * d[1] / d[2], 1) << quadrant;
    // and no light beyond the neighbouring cells
    for (std::size_t i = 0; i < t.power_w.size(); ++i) {
      const bool right = i % 101 > 50, low = i / 101 > 40;
      const bool own = right == (column > 9) && low == (row > 6);
      ASSERT_TRUE(own || t.irradiance_w_m2[i] == 0) << quadrant << " " << i;
    }
  }
}

// A source that is turned keeps its x axis as near to the camera's as it goes: the table turns with it, unmirrored.
TEST(light_source, a_turned_table_is_not_mirrored) {
  std::vector<double> samples(20 * 14);
  samples[3 * 20 + 15] = 1;  // to the right and up
  const double c = std::cos(0.3), s = std::sin(0.3);
  const camera::FrozenLight light = camera::freeze_light(source(table(20, 14, samples), 1, {0, s, c}), 1);  // tipped downward
  const Vec3 own = f_theta(0.7 * (31 / 20.0 - 1), 0.5 * (7 / 14.0 - 1));
  // own axes: x stays, y is turned about x with the axis
  const Vec3 d{own[0], c * own[1] + s * own[2], -s * own[1] + c * own[2]};
  EXPECT_GT(intensity(light, d), 1);
  EXPECT_EQ(intensity(light, {-d[0], d[1], d[2]}), 0);
}
