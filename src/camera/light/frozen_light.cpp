// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include "camera/light/frozen_light.h"

#include <algorithm>
#include <cmath>

#include "base/constants.h"
#include "base/curve.h"
#include "base/faults.h"
#include "base/shared.h"
#include "base/vec.h"
#include "camera/light/emitters.h"
#include "camera/light/pattern_integral.h"
#include "num/num.h"
#include "num/setup_math.h"

namespace tofray::camera {

using namespace base;
namespace setup = num::setup;
using num::single;

namespace {

/// A pattern as samples, and how much light one of them makes.
struct Table {
  int columns, rows;
  double half_x, half_y;
  std::vector<double> samples;
  double integral;  ///< [sr] of what kernels make of it
};

/// What a flat top stands for: half its peak at the edges of width × height.
Table flat_top(const Pattern& p) {
  Table t{p.columns > 0 ? p.columns : 172,
          p.rows > 0 ? p.rows : 168,
          p.half_range_x_rad > 0 ? p.half_range_x_rad : p.width_rad,
          p.half_range_y_rad > 0 ? p.half_range_y_rad : p.height_rad,
          {},
          0};
  // by axis: a table of all cells takes the product of two shares
  const auto shares = [](int cells, double half_range, double width) {
    std::vector<double> out;
    for (int i = 0; i < cells; ++i) out.push_back(flat_top_share(2 * half_range * ((2 * i + 1.0) / cells - 1) / width));
    return out;
  };
  const std::vector<double> across = shares(t.columns, t.half_x, p.width_rad), down = shares(t.rows, t.half_y, p.height_rad);
  for (const double y : down) {
    for (const double x : across) t.samples.push_back(y * x);
  }
  t.integral = flat_top_integral(p.width_rad, p.height_rad, t.half_x, t.half_y);
  return t;
}

/// Samples in any unit, as shares of the largest: however large or small they are, their integral is of the size of their solid angle.
Table measured(const Pattern& p) {
  Table t{p.columns, p.rows, p.half_range_x_rad, p.half_range_y_rad, p.samples, 0};
  const double largest = *std::max_element(t.samples.begin(), t.samples.end());
  for (double& sample : t.samples) sample /= largest;
  t.integral = table_integral(t.samples, t.columns, t.rows, t.half_x, t.half_y);
  if (!(t.integral > 0)) refuse("a light's pattern is dark\n  got samples above 0 only where the angle to the axis is beyond 180 deg");
  return t;
}

std::shared_ptr<const Table> table_of(const Pattern& p) {
  return base::shared<Pattern, Table>().get(
      p, [&] { return p.kind == Pattern::Kind::flat_top ? flat_top(p) : measured(p); },
      [](const Table& made) { return made.samples.size() * sizeof(double); });
}

/// @return the radiant intensity of a sample of 1 [W/sr]
double freeze_table(const Pattern& p, double power, FrozenLight& out) {
  const auto shared = table_of(p);
  const Table& t = *shared;
  const double peak = power / t.integral;
  for (const double sample : t.samples) out.table.push_back(single(peak * sample));
  PatternView& view = out.view.pattern;
  view.kind = PatternView::table;
  view.samples = out.table.data();
  view.columns = t.columns, view.rows = t.rows;
  view.per_rad_x = single(t.columns / (2 * t.half_x)), view.per_rad_y = single(t.rows / (2 * t.half_y));
  view.half_range_x = single(t.half_x), view.half_range_y = single(t.half_y);
  return peak;
}

void freeze_pattern(const Pattern& p, double power, FrozenLight& out) {
  PatternView& view = out.view.pattern;
  view = {};
  switch (p.kind) {
    case Pattern::Kind::cone:
      view.kind = PatternView::cone;
      view.cos_half_angle = single(setup::cos(p.half_angle_rad));
      view.peak = single(power / (2 * pi * (1 - setup::cos(p.half_angle_rad))));
      break;
    case Pattern::Kind::lambertian:
    case Pattern::Kind::cosine_lobe:
      view.kind = PatternView::cosine_lobe;
      view.exponent = p.kind == Pattern::Kind::lambertian ? 1.0f : single(p.exponent);
      view.peak = single(power * (static_cast<double>(view.exponent) + 1) / (2 * pi));
      break;
    case Pattern::Kind::flat_top: {
      view.peak = single(freeze_table(p, power, out));  // the paper's printed formula reads the table; all else takes the formula
      view.kind = PatternView::flat_top;
      view.per_half_width = single(2 / p.width_rad), view.per_half_height = single(2 / p.height_rad);
      break;
    }
    case Pattern::Kind::table: freeze_table(p, power, out); break;
  }
}

}  // namespace

FrozenLight freeze_light(const Illumination& light, double quantum_efficiency) {
  FrozenLight out;
  const Mat3 rows = source_axes(light.axis);
  const Vec3& axis = rows[2];
  for (std::size_t i = 0; i < 3; ++i) {
    out.view.position[i] = single(light.position[i]);
    for (std::size_t k = 0; k < 3; ++k) out.view.rotation[i][k] = single(rows[i][k]);
  }
  out.view.turned = !(axis[0] == 0 && axis[1] == 0 && axis[2] > 0);
  out.view.electrons_per_joule = single(light.illumination_wavelength_m * quantum_efficiency / photon_energy_length);
  freeze_pattern(light.pattern, light.power_w, out);
  return out;
}

FrozenLights::FrozenLights(const Camera& camera) {
  const ClampedCurve efficiency(camera.pixel.quantum_efficiency, "quantum_efficiency");
  for (const Illumination& light : camera.illumination) {
    lights_.push_back(freeze_light(light, efficiency.evaluate(light.illumination_wavelength_m)));
    if (camera.power_model == PowerModel::paper_literal && lights_.back().table.empty()) {
      refuse(
          "power_model paper_literal needs light sources with a table\n"
          "  got a cone or lobe; take the pattern flat_top or table, or the power_model tofray");
    }
  }
  for (const FrozenLight& light : lights_) views_.push_back(light.view);
}

PowerView power_view(const Camera& camera) {
  PowerView out{};
  const Sensor& sensor = camera.sensor;
  const double area = sensor.pixel_pitch_m * sensor.pixel_pitch_m * sensor.fill_factor;
  const double number = camera.lens.f_number;
  out.watts_per_radiance = single(pi * camera.lens.transmission * area / (4 * number * number));  // [theory: image-irradiance, pixel-power]
  out.paper_literal = camera.power_model == PowerModel::paper_literal;
  const double focal_mm = 1e3 * camera.lens.fx_px * sensor.pixel_pitch_m;
  out.paper_scale = single(pi * area / (4 * number * number * focal_mm * focal_mm));  // [theory: paper-formula]
  return out;
}

}  // namespace tofray::camera
