// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include <algorithm>

#include "base/constants.h"
#include "base/limits.h"
#include "model/rules.h"
#include "model/tables.h"

/// What a camera profile may say of the camera's lights, and how many of them there may be.
namespace tofray::model {

namespace {

using enum base::Dimension;
using base::pi;

constexpr Number half_angle{angle, {1e-3, pi}, "43 deg"};
constexpr Number half_range{angle, {1e-3, 2 * pi}, "43 deg"};
constexpr Number width{angle, {1e-3, 2 * pi}, "62 deg"};
constexpr Number cells{none, {2, 4096}, "172"};  // between two of them it is interpolated
constexpr Number edge{time, {0, 1e-3}, "1 ns"};
constexpr Number extent{length, {base::shortest_m, 10}, "10 mm"};
constexpr auto most_lights = static_cast<double>(base::limit::lights.value);
constexpr auto curve_points = static_cast<int>(base::limit::curve_points.value);
constexpr auto table_samples = static_cast<int>(base::limit::table_samples.value);

}  // namespace

template <>
const Table& table_of<Pattern>() {
  using Kind = Pattern::Kind;
  constexpr auto kind_of = &Pattern::kind;
  static const Table rows =
      table<Pattern>(
          kind<kind_of>("kind", {"cone", "lambertian", "cosine_lobe", "flat_top", "table"}),
          number<&Pattern::half_angle_rad>("half_angle", half_angle, "half angle of the cone, within which it is uniform")
              .when<kind_of>(Kind::cone)
              .required(),
          number<&Pattern::exponent>("exponent", {none, {0, 1e4}, "4"}, "n of cos^n").when<kind_of>(Kind::cosine_lobe).required(),
          number<&Pattern::width_rad>("width", width, "full width across x at half the peak").when<kind_of>(Kind::flat_top).required(),
          number<&Pattern::height_rad>("height", width, "full width across y at half the peak").when<kind_of>(Kind::flat_top).required(),
          number<&Pattern::columns>("columns", cells, "columns of the grid that power_model paper_literal reads")
              .when<kind_of>(Kind::flat_top)
              .absent(),
          number<&Pattern::rows>("rows", cells, "rows of the grid that power_model paper_literal reads")
              .when<kind_of>(Kind::flat_top)
              .absent(),
          number<&Pattern::half_range_x_rad>("half_range_x", half_range,
                                             "half range across x, beyond which it is dark; the width unless given")
              .when<kind_of>(Kind::flat_top)
              .absent(),
          number<&Pattern::half_range_y_rad>("half_range_y", half_range,
                                             "half range across y, beyond which it is dark; the height unless given")
              .when<kind_of>(Kind::flat_top)
              .absent(),
          also(number<&Pattern::half_range_x_rad>("half_range_x", half_range, "half range of the table across its columns")
                   .when<kind_of>(Kind::table)
                   .required()),
          also(number<&Pattern::half_range_y_rad>("half_range_y", half_range, "half range of the table across its rows")
                   .when<kind_of>(Kind::table)
                   .required()),
          grid<&Pattern::samples, &Pattern::rows, &Pattern::columns>(
              "samples", {none, {0, 1e12}, "1"}, 2, table_samples,
              "rows (from -half_range_y on) of samples (from -half_range_x on), any unit")
              .when<kind_of>(Kind::table)
              .or_file("pattern.csv"))
          .check_with(tables_shine);
  return rows;
}

template <>
const Table& table_of<Waveform>() {
  using enum Waveform::Kind;
  constexpr auto kind_of = &Waveform::kind;
  static const Table rows =
      table<Waveform>(
          kind<kind_of>("kind", {"rectangular", "sine", "measured", "trapezoid", "gaussian", "emission"}),
          number<&Waveform::duty>("duty", {fraction, {1e-3, 0.999}, "25 %"}, "pulse width at half height over the period")
              .when<kind_of>(rectangular, trapezoid),
          number<&Waveform::rise_time_s>("rise_time", edge, "rise time of a linear edge, 0 to 100 %").when<kind_of>(rectangular, trapezoid),
          number<&Waveform::fall_time_s>("fall_time", edge, "fall time of the linear edge at the pulse's end").when<kind_of>(trapezoid),
          number<&Waveform::sigma_s>("sigma", {time, {0, 1e-3}, "1.5 ns"}, "width of the pulse, 1 sigma")
              .when<kind_of>(gaussian)
              .required(),
          number<&Waveform::modulation_depth>("modulation_depth", {fraction, {1e-3, 1}, "90 %"},
                                              "modulation depth d of the light 1 + d cos")
              .when<kind_of>(sine),
          number<&Waveform::bandwidth_hz>("bandwidth", {frequency, {0, 1e12}, "200 MHz"}, "single pole of the light source; 0: none")
              .when<kind_of>(rectangular, sine, trapezoid, gaussian, emission),
          number<&Waveform::jitter_s>("jitter", {time, {0, 1e-6}, "50 ps"}, "Gaussian jitter of the light's edges, 1 sigma")
              .when<kind_of>(rectangular, sine, trapezoid, gaussian, emission),
          numbers<&Waveform::correlation>("correlation", {none, {-10, 10}, "0.5"}, 4, curve_points,
                                          "(A-B)/(A+B) at reference phases over one period, light and pixel at no distance")
              .when<kind_of>(measured)
              .or_file("correlation.csv"),
          numbers<&Waveform::emission>("emission", {none, {0, 1e12}, "1"}, 4, curve_points,
                                       "the light over one period, any unit, from the middle of the pulse on")
              .when<kind_of>(emission)
              .or_file("emission.csv"),
          numbers<&Waveform::sample_phases_rad>("phases", {angle, {-100, 100}, "45 deg"}, 4, curve_points,
                                                "phases of the samples, ascending; equally spaced from 0 unless given")
              .when<kind_of>(measured, emission)
              .absent(),
          number<&Waveform::harmonics>("harmonics", {none, {1, 8}, "4"}, "number of odd harmonics that are kept: 1, 3, 5, 7 …")
              .when<kind_of>(rectangular, measured, trapezoid, gaussian, emission))
          .check_with(samples_carry_their_harmonics);
  return rows;
}

template <>
const Table& table_of<Area>() {
  using Kind = Area::Kind;
  constexpr auto kind_of = &Area::kind;
  static const Table rows = table<Area>(
      kind<kind_of>("kind", {"none", "disk", "rectangle"}),
      number<&Area::radius_m>("radius", extent, "radius of the disk, which lies across the axis").when<kind_of>(Kind::disk).required(),
      number<&Area::width_m>("width", extent, "width along the camera's x; along its y where the axis is along x")
          .when<kind_of>(Kind::rectangle)
          .required(),
      number<&Area::height_m>("height", extent, "height, across the width and the axis").when<kind_of>(Kind::rectangle).required(),
      number<&Area::points>("points", {none, {1, most_lights}, "16"},
                            "number of points that stand for the area; each costs as much as a light source")
          .when<kind_of>(Kind::disk, Kind::rectangle));
  return rows;
}

template <>
const Table& table_of<Illumination>() {
  static const Table rows = table<Illumination>(
      number<&Illumination::position>("position", {length, {-100, 100}, "15.47 mm"}, "position of the light source in the camera's frame"),
      number<&Illumination::axis>("axis", {none, {-1e6, 1e6}, "1"}, "direction in which the light source shines, in the camera's frame")
          .direction(),
      number<&Illumination::illumination_wavelength_m>("illumination_wavelength", {length, {300e-9, 2e-6}, "850 nm"},
                                                       "wavelength of the light source")
          .required(),
      number<&Illumination::power_w>("power", {power, {0, 1e4}, "0.2 W"},
                                     "optical power during a lit raw frame, mean over the modulation period")
          .required(),
      number<&Illumination::ring_leds>("ring_leds", {none, {1, most_lights}, "4"},
                                       "number of sources on a circle about the position, across the axis"),
      number<&Illumination::ring_radius_m>("ring_radius", {length, {0, 10}, "20 mm"}, "radius of the circle of ring_leds"),
      record<&Illumination::area>("area", "a disk or rectangle across the axis that shines evenly, in place of a point"),
      record<&Illumination::pattern>("pattern", "how the light is spread over directions").required(),
      record<&Illumination::waveform>("waveform", "how the light is modulated").required());
  return rows;
}

namespace {
/// Point sources that stand for a light.
long long sources_of(const Illumination& light) {
  return static_cast<long long>(light.ring_leds) * (light.area.kind == Area::Kind::none ? 1 : light.area.points);
}

/// Samples of a light's pattern, as many times as it is kept.
long long samples_of(const Illumination& light) {
  const Pattern& pattern = light.pattern;
  const bool table = pattern.kind == Pattern::Kind::table || pattern.kind == Pattern::Kind::flat_top;
  return table ? sources_of(light) * pattern.columns * pattern.rows : 0;
}

/// Complains of the light that counts most where all of them count more than the limit.
void add_up_to_the_limit(const Camera& camera, long long (*count)(const Illumination&), const base::Limit& limit, const std::string& what,
                         const std::string& way_out, Complaints& complaints) {
  const auto& lights = camera.illumination;
  long long sum = 0;
  for (const Illumination& light : lights) sum += count(light);
  if (sum <= limit.value) return;
  const Illumination& most =
      *std::max_element(lights.begin(), lights.end(), [&](const Illumination& a, const Illumination& b) { return count(a) < count(b); });
  const std::string more = "got " + std::to_string(sum) + ", at most " + std::to_string(limit.value) +
                           " (`tofray --limits`); each LED of a ring and each point of an area is a source; " + way_out;
  if (most.area.kind != Area::Kind::none) return complaints.add(most.area, &most.area.points, what, more, ErrorKind::limit);
  complaints.add(most, &most.ring_leds, what, more, ErrorKind::limit);
}
}  // namespace

void lights_are_within_the_limits(const Camera& camera, Complaints& complaints) {
  add_up_to_the_limit(camera, sources_of, base::limit::lights, "the camera has too many light sources", "take fewer points or LEDs",
                      complaints);
  add_up_to_the_limit(camera, samples_of, base::limit::light_samples, "the camera's light sources have too many samples of their patterns",
                      "take fewer of them or coarser tables", complaints);
}

}  // namespace tofray::model
