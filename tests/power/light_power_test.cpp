// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
// For every pattern with a rectangle: what shines, summed up direction by direction, is the source's power.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "camera/frozen_camera.h"
#include "power/light_source.h"
#include "support/pixels.h"
#include "support/random.h"

using namespace tofray;
using namespace tofray::test;

namespace {

const double degree = pi / 180;

camera::FrozenLight frozen(const Pattern& pattern, double watts) {
  Illumination light;
  light.pattern = pattern;
  light.power_w = watts;
  return camera::freeze_light(light, 1);
}

double intensity(const camera::FrozenLight& light, double x, double y, double z) {
  const float a = static_cast<float>(x), b = static_cast<float>(y), c = static_cast<float>(z);
  return static_cast<double>(power::intensity(light.view, a, b, c, 1 / std::sqrt(a * a + b * b + c * c)));
}

/// ∫ I dω by the middles of n × n cells over θx, θy within ±half_x × ±half_y and θ <= π.
double power_within(const camera::FrozenLight& light, double half_x, double half_y, int n) {
  half_x = std::min(half_x, pi), half_y = std::min(half_y, pi);
  double sum = 0;
  for (int i = 0; i < n; ++i) {
    for (int k = 0; k < n; ++k) {
      const double x = half_x * ((2 * i + 1.0) / n - 1), y = half_y * ((2 * k + 1.0) / n - 1), theta = std::hypot(x, y);
      if (theta >= pi) continue;
      const double share = theta > 0 ? std::sin(theta) / theta : 1;
      sum += intensity(light, x * share, y * share, std::cos(theta)) * share;
    }
  }
  return sum * (2 * half_x / n) * (2 * half_y / n);
}

Pattern flat_top(double width, double height, double half_x = 0, double half_y = 0, int columns = 0, int rows = 0) {
  Pattern p;
  p.kind = Pattern::Kind::flat_top;
  p.width_rad = width, p.height_rad = height;
  p.half_range_x_rad = half_x, p.half_range_y_rad = half_y;
  p.columns = columns, p.rows = rows;
  return p;
}

Pattern table(int columns, int rows, double half_x, double half_y, const std::vector<double>& samples) {
  Pattern p;
  p.kind = Pattern::Kind::table;
  p.columns = columns, p.rows = rows;
  p.half_range_x_rad = half_x, p.half_range_y_rad = half_y;
  p.samples = samples;
  return p;
}

}  // namespace

// The middles of 600 × 600 cells are right to 1e-5: at the edges of a rectangle that cuts the light off, at the circle θ = π, and in the
// bends of 2 × 2 samples. The light may be off by as much; single precision adds 1e-6.
constexpr double tolerance = 5e-5;

TEST(light_power, of_a_flat_top_is_its_own_however_narrow_or_wide_it_is) {
  for (const double width : {1e-3, 0.3 * degree, 5 * degree, 62 * degree, 120 * degree, pi, 2 * pi}) {
    for (const double height : {1e-3, 45 * degree, 2 * pi}) {
      const camera::FrozenLight light = frozen(flat_top(width, height), 0.2);
      EXPECT_NEAR(power_within(light, 0.8 * width, 0.8 * height, 600), 0.2, 0.2 * tolerance) << width << " x " << height;
      EXPECT_LT(static_cast<double>(light.view.pattern.peak), 0.2 / 0.9e-6) << width << " x " << height;
    }
  }
}

// 0.3 degrees between samples half a degree apart once made 1.7e12 W/sr; 4 × 4 samples 8 % too much.
TEST(light_power, of_a_flat_top_does_not_depend_on_the_table_that_it_stands_for) {
  for (const int cells : {2, 4, 172}) {
    for (const double width : {0.3 * degree, 62 * degree}) {
      const camera::FrozenLight light = frozen(flat_top(width, 45 * degree, 43 * degree, 42 * degree, cells, cells), 0.2);
      EXPECT_NEAR(power_within(light, std::min(width, 43 * degree), 42 * degree, 600), 0.2, 0.2 * tolerance) << cells << " " << width;
    }
  }
  const camera::FrozenLight cut = frozen(flat_top(2, 2, 0.5, 0.1), 0.2);  // cut off where it is bright
  EXPECT_NEAR(power_within(cut, 0.5, 0.1, 600), 0.2, 0.2 * tolerance);
}

TEST(light_power, of_a_coarse_table_is_its_own) {
  for (const auto& [half_x, half_y] : {std::pair{0.7, 0.5}, {1e-3, 1e-3}, {1.5, 0.02}, {pi, 1.0}, {pi, pi}}) {
    const camera::FrozenLight even = frozen(table(2, 2, half_x, half_y, {1, 1, 1, 1}), 0.2);
    EXPECT_NEAR(power_within(even, half_x, half_y, 600), 0.2, 0.2 * tolerance) << half_x << " x " << half_y;
    const camera::FrozenLight leaning = frozen(table(3, 2, half_x, half_y, {5, 0, 1, 2, 0.1, 9}), 0.2);
    EXPECT_NEAR(power_within(leaning, half_x, half_y, 600), 0.2, 0.2 * tolerance) << half_x << " x " << half_y;
  }
}

// A table as fine as a measured one; beyond half a turn lies nothing that could shine.
TEST(light_power, of_a_fine_table_is_its_own_also_beyond_half_a_turn) {
  Random random(1);
  for (const double half_range : {0.7, 3.0, 2 * pi}) {
    std::vector<double> samples(90 * 70);
    for (std::size_t i = 0; i < samples.size(); ++i) samples[i] = 1 + std::sin(0.1 * static_cast<double>(i % 90)) + 0.2 * random.uniform();
    const camera::FrozenLight light = frozen(table(90, 70, half_range, half_range / 2, samples), 3);
    EXPECT_NEAR(power_within(light, half_range, half_range / 2, 630), 3, 3 * tolerance) << half_range;  // 7 or 9 in each of their cells
  }
}

// Numbers of any unit: only their ratios count.
TEST(light_power, of_a_table_does_not_depend_on_its_unit) {
  const double once = intensity(frozen(table(2, 2, 0.7, 0.5, {1, 2, 3, 4}), 1), 0, 0, 1);
  for (const double unit : {1e-300, 1e-20, 1e11})
    EXPECT_NEAR(intensity(frozen(table(2, 2, 0.7, 0.5, {unit, 2 * unit, 3 * unit, 4 * unit}), 1), 0, 0, 1), once, 1e-6 * once) << unit;
}

TEST(light_power, of_a_table_that_shines_nowhere_is_refused) {
  std::vector<double> samples(64 * 64);
  samples[0] = 1;  // at θ = √2·63/64·π
  EXPECT_THROW(frozen(table(64, 64, pi, pi, samples), 1), Error);
}

// cos⁰ is 1 in front, and nothing behind: not 0⁰.
TEST(light_power, of_a_lobe_of_exponent_0_is_spread_evenly_over_the_half_space_in_front) {
  Pattern p;
  p.kind = Pattern::Kind::cosine_lobe;
  p.exponent = 0;
  const camera::FrozenLight light = frozen(p, 0.3);
  for (const double z : {1.0, 0.5, 1e-3}) EXPECT_NEAR(intensity(light, std::sqrt(1 - z * z), 0, z), 0.3 / (2 * pi), 1e-7) << z;
  for (const double z : {0.0, -1e-3, -0.5, -1.0}) EXPECT_EQ(intensity(light, 0, std::sqrt(1 - z * z), z), 0) << z;
}
