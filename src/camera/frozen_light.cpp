// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include <cmath>

#include "base/constants.h"
#include "base/vec.h"
#include "camera/frozen_camera.h"
#include "num/setup_math.h"

namespace tofray::camera {

using namespace base;
namespace setup = num::setup;

namespace {

float f(double a) { return static_cast<float>(a); }

struct Table {
  int columns, rows;
  double half_x, half_y;
  std::vector<double> samples;
};

/// The stand-in for the pico flexx: î ∝ exp(−ln2·((θx/½w)⁸ + (θy/½h)⁸)), half its peak at the edges of w × h.
Table flat_top(const Pattern& p) {
  const double degree = pi / 180;
  Table t{p.columns > 0 ? p.columns : 172, p.rows > 0 ? p.rows : 168, p.half_range_x_rad > 0 ? p.half_range_x_rad : 43 * degree,
          p.half_range_y_rad > 0 ? p.half_range_y_rad : 42 * degree, {}};
  const auto eighth = [](double a) { const double a2 = a * a, a4 = a2 * a2; return a4 * a4; };
  const double ln2 = setup::log(2.0);
  for (int row = 0; row < t.rows; ++row) {
    const double y = t.half_y * ((2 * row + 1.0) / t.rows - 1);
    for (int column = 0; column < t.columns; ++column) {
      const double x = t.half_x * ((2 * column + 1.0) / t.columns - 1);
      t.samples.push_back(setup::exp(-ln2 * (eighth(2 * x / p.width_rad) + eighth(2 * y / p.height_rad))));
    }
  }
  return t;
}

void freeze_table(const Table& t, double power, FrozenLight& out) {
  const double scale = power / table_integral(t.samples, t.columns, t.rows, t.half_x, t.half_y);
  for (const double sample : t.samples) out.table.push_back(f(scale * sample));
  PatternView& view = out.view.pattern;
  view.kind = PatternView::table;
  view.samples = out.table.data();
  view.columns = t.columns, view.rows = t.rows;
  view.per_rad_x = f(t.columns / (2 * t.half_x)), view.per_rad_y = f(t.rows / (2 * t.half_y));
  view.half_range_x = f(t.half_x), view.half_range_y = f(t.half_y);
}

void freeze_pattern(const Pattern& p, double power, FrozenLight& out) {
  PatternView& view = out.view.pattern;
  view = {};
  switch (p.kind) {
    case Pattern::Kind::cone:
      view.kind = PatternView::cone;
      view.cos_half_angle = f(setup::cos(p.half_angle_rad));
      view.peak = f(power / (2 * pi * (1 - setup::cos(p.half_angle_rad))));
      break;
    case Pattern::Kind::lambertian:
    case Pattern::Kind::cosine_lobe:
      view.kind = PatternView::cosine_lobe;
      view.exponent = p.kind == Pattern::Kind::lambertian ? 1.0f : f(p.exponent);
      view.peak = f(power * (static_cast<double>(view.exponent) + 1) / (2 * pi));
      break;
    case Pattern::Kind::flat_top: {
      const Table t = flat_top(p);
      freeze_table(t, power, out);      // the paper's printed formula reads the table; all else takes the formula
      view.kind = PatternView::flat_top;
      view.peak = f(power / table_integral(t.samples, t.columns, t.rows, t.half_x, t.half_y));
      view.per_half_width = f(2 / p.width_rad), view.per_half_height = f(2 / p.height_rad);
      break;
    }
    case Pattern::Kind::table: freeze_table({p.columns, p.rows, p.half_range_x_rad, p.half_range_y_rad, p.samples}, power, out); break;
  }
}

}  // namespace

double table_integral(const std::vector<double>& samples, int columns, int rows, double half_x, double half_y) {
  const double cell = (2 * half_x / columns) * (2 * half_y / rows);
  double sum = 0;
  for (int row = 0; row < rows; ++row) {
    const double y = half_y * ((2 * row + 1.0) / rows - 1);
    for (int column = 0; column < columns; ++column) {
      const double x = half_x * ((2 * column + 1.0) / columns - 1);
      const double theta = std::sqrt(x * x + y * y);
      sum += samples[static_cast<std::size_t>(row * columns + column)] * (theta > 0 ? setup::sin(theta) / theta : 1) * cell;
    }
  }
  return sum;
}

FrozenLight freeze_light(const Illumination& light, double quantum_efficiency) {
  FrozenLight out;
  const Vec3 axis = normalized(light.axis);
  // The source's x axis is the camera's, as far as that goes.
  const Vec3 aside = std::abs(axis[0]) < 0.9 ? Vec3{1, 0, 0} : Vec3{0, 1, 0};
  const Vec3 x = normalized(aside - dot(aside, axis) * axis);
  const Mat3 rows{{x, cross(axis, x), axis}};
  for (std::size_t i = 0; i < 3; ++i) {
    out.view.position[i] = f(light.position[i]);
    for (std::size_t k = 0; k < 3; ++k) out.view.rotation[i][k] = f(rows[i][k]);
  }
  out.view.turned = !(axis[0] == 0 && axis[1] == 0 && axis[2] > 0);
  out.view.electrons_per_joule = f(light.illumination_wavelength_m * quantum_efficiency / photon_energy_length);
  freeze_pattern(light.pattern, light.power_w, out);
  return out;
}

}  // namespace tofray::camera
