// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include "view/scales.h"

#include <array>
#include <bit>
#include <cmath>
#include <span>

#include "pictures/color_map.h"
#include "pictures/figure.h"
#include "pictures/picture_scale.h"
#include "pictures/pictures.h"
#include "pictures/value_scale.h"
#include "view/wire.h"

namespace tofray::view {

namespace {

using files::Json;
using pictures::PictureScale;
using pictures::Rgb;

enum class Kind { length, strength, power, noise, error, share, byte, bits };

struct Row {
  Pane pane;
  Kind kind;
};

constexpr Row rows[] = {{{"z_m", "Depth"}, Kind::length},
                        {{"amplitude_e", "Amplitude"}, Kind::strength},
                        {{"z_error_m", "Error against truth"}, Kind::error},
                        {{"flags", "Flags"}, Kind::bits},
                        {{"noise_m", "Noise, estimated"}, Kind::noise},
                        {{"confidence", "Confidence"}, Kind::byte},
                        {{"range_m", "Range"}, Kind::length},
                        {{"ambient_e", "Ambient light"}, Kind::strength},
                        {{"gt_z_m", "True depth"}, Kind::length},
                        {{"gt_range_m", "True range"}, Kind::length},
                        {{"gt_reflectivity", "Reflectivity"}, Kind::share},
                        {{"gt_irradiance_w_m2", "Irradiance"}, Kind::strength},
                        {{"gt_radiance_w_m2_sr", "Radiance"}, Kind::strength},
                        {{"gt_power_w", "Power on the pixel"}, Kind::power},
                        {{"gt_ambient_e_per_s", "Ambient electrons"}, Kind::strength}};

Json color_json(Rgb color) { return Json::list(std::array<int, 3>{color.red, color.green, color.blue}); }

Json stops_json(std::span<const Rgb> stops) {
  Json list = Json::array();
  for (const Rgb one : stops) list.push(color_json(one));
  return list;
}

std::vector<double> values_of(const Frame& frame, std::string_view name) {
  std::vector<double> out;
  const auto array = find_wire_array(name);
  std::vector<float> made;
  const ArrayView view = array ? view_of(frame, *array, made) : ArrayView();
  const std::size_t pixels = static_cast<std::size_t>(view.extents[0]) * view.extents[1];
  for (std::size_t i = 0; i < pixels; ++i) out.push_back(pixel_values(frame, *array, i)[0]);
  return out;
}

/// @param factor  from the array's unit to that of the labels; ends and ticks are in the array's own
Json json_of(const PictureScale& scale, const char* palette, const char* curve, const char* unit, double factor = 1) {
  Json ticks = Json::array();
  for (const double tick : scale.ticks()) ticks.push(Json::object().set("at", tick / factor).set("label", scale.label(tick)));
  Json out = Json::object();
  out.set("low", scale.low / factor).set("high", scale.high / factor).set("palette", palette).set("curve", curve);
  return out.set("ticks", std::move(ticks)).set("unit", unit).set("factor", factor);
}

PictureScale up_to(double high, double step, int decimals) {
  PictureScale scale;
  scale.low = 0, scale.high = high, scale.step = step, scale.decimals = decimals;
  return scale;
}

Json scale_of(Kind kind, std::vector<double> values, const char* unit) {
  const double factor = kind == Kind::noise || kind == Kind::error ? 1000 : kind == Kind::power ? 1e12 : 1;
  for (double& one : values) one *= factor;
  switch (kind) {
    case Kind::length: return json_of(pictures::length_scale(values), "depth", "linear", unit);
    case Kind::strength: return json_of(pictures::strength_scale(values), "grey", "sqrt", unit);
    case Kind::power: return json_of(pictures::strength_scale(values), "grey", "sqrt", "pW", factor);
    case Kind::noise:
      return json_of(pictures::noise_scale(values), "depth", "linear", "mm", factor).set("reverse", true);  // little is dark
    case Kind::error: return json_of(pictures::error_scale(values).scale, "error", "linear", "mm", factor);
    case Kind::share: return json_of(up_to(1, 0.2, 1), "grey", "linear", unit);
    case Kind::byte: return json_of(up_to(255, 50, 0), "grey", "linear", unit);
    case Kind::bits: break;
  }
  return {};
}

}  // namespace

std::vector<Pane> all_panes() {
  std::vector<Pane> out;
  for (const Row& row : rows) out.push_back(row.pane);
  return out;
}

std::vector<Pane> panes_of(const Frame& frame) {
  std::vector<Pane> out;
  for (const Row& row : rows)
    if (has_array(frame, *find_wire_array(row.pane.array))) out.push_back(row.pane);
  return out;
}

std::optional<Json> scale_json(const Frame& frame, std::string_view array) {
  for (const Row& row : rows) {
    if (array != row.pane.array) continue;
    const char* unit = wire_arrays()[*find_wire_array(array)].unit;
    // In z the truth tells which pixels are whole cycles off.
    return scale_of(row.kind, array == "z_m" ? pictures::right_z(frame.depth, frame.truth, frame.raw) : values_of(frame, array), unit);
  }
  return {};
}

Json palettes_json() {
  Json out = Json::object();
  out.set("depth", stops_json(pictures::depth_stops())).set("grey", stops_json(pictures::grey_stops()));
  return out.set("error_near", stops_json(pictures::near_stops())).set("error_far", stops_json(pictures::far_stops()));
}

Json invalid_json() {
  Json out = Json::array();
  for (const pictures::FlagRow& one : pictures::flag_table()) {
    if ((one.bit & flags_reasons) == 0) continue;
    Json json = Json::object();
    json.set("bit", std::countr_zero(one.bit)).set("name", one.words).set("letter", std::string(1, one.letter));
    out.push(std::move(json.set("color", color_json(pictures::color_of_reason(one, pictures::Theme::dark))).set("advice", one.advice)));
  }
  return out;
}

Json invalid_color_json() { return color_json(pictures::look_of(pictures::Theme::dark).invalid); }

}  // namespace tofray::view
