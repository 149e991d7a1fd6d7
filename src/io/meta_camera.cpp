// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include "io/meta_camera.h"

#include "base/text.h"
#include "tofray/error.h"

namespace tofray::io {

namespace {

const Json nothing;

const Json& member(const Json& from, const char* key) {
  const Json* found = from.find(key);
  return found == nullptr ? nothing : *found;
}

/// A number with its unit, as people write it.
Json quantity(const Json& value, const char* unit) {
  double number = 0;
  if (!value.number(number)) return {};
  if (*unit == '\0') return value;
  return base::number_text(number) + " " + unit;
}

Json quantities(const Json& values, const char* unit) {
  Json list = Json::array();
  if (values.is_array())
    for (const Json& value : *values.items()) list.push(quantity(value, unit));
  return list;
}

/// Builds one map of the profile out of one object of `meta`.
class Section {
 public:
  explicit Section(const Json& from) : from_(from) {}

  Section& number(const char* key, const char* name, const char* unit) {
    if (const Json* value = from_.find(key)) out_.set(name, quantity(*value, unit));
    return *this;
  }
  Section& same(const char* key) {
    if (const Json* value = from_.find(key)) out_.set(key, *value);
    return *this;
  }
  Section& set(const char* name, Json value) {
    out_.set(name, std::move(value));
    return *this;
  }
  Json take() { return std::move(out_); }

 private:
  const Json& from_;
  Json out_ = Json::object();
};

Json curve(const Json& from, const char* x_name, const char* x_unit, const char* y_name) {
  return Json::object().set(x_name, quantities(member(from, "x"), x_unit)).set(y_name, member(from, "y"));
}

/// One sample is a constant.
Json curve_or_constant(const Json& from, const char* x_name, const char* x_unit) {
  const Json& y = member(from, "y");
  if (y.is_array() && y.items()->size() == 1) return y.items()->front();
  return curve(from, x_name, x_unit, "value");
}

Json lens(const Json& from) {
  Section out(from);
  out.number("fx_px", "fx", "px").number("fy_px", "fy", "px").number("cx_px", "cx", "px").number("cy_px", "cy", "px");
  out.set("distortion", Section(from).same("k1").same("k2").same("p1").same("p2").same("k3").take());
  out.same("f_number").same("transmission");
  if (const Json* table = from.find("vignetting_table"))
    out.set("vignetting", curve(*table, "angle", "rad", "factor"));
  else
    out.same("vignetting");
  return out.take();
}

Json filter(const Json& from) {
  if (const Json* table = from.find("table")) return curve(*table, "wavelength", "m", "transmission");
  return Section(from).number("center_m", "center", "m").number("half_width_m", "half_width", "m").same("peak").take();
}

Json pattern(const Json& from) {
  Section out(from);
  out.same("kind").number("half_angle_rad", "half_angle", "rad").same("exponent").number("width_rad", "width", "rad");
  out.number("height_rad", "height", "rad")
      .number("half_range_x_rad", "half_range_x", "rad")
      .number("half_range_y_rad", "half_range_y", "rad");
  const Json::Array* samples = member(from, "samples").items();
  std::uint64_t columns = 0;
  if (samples == nullptr || !member(from, "columns").unsigned_integer(columns) || columns == 0) return out.take();
  Json rows = Json::array();
  for (std::size_t i = 0; i + columns <= samples->size(); i += columns)
    rows.push(Json::Array(samples->begin() + static_cast<std::ptrdiff_t>(i), samples->begin() + static_cast<std::ptrdiff_t>(i + columns)));
  return out.set("samples", std::move(rows)).take();
}

/// Each kind has keys of its own.
Json waveform(const Json& from) {
  const std::string* kind = member(from, "kind").string();
  Section out(from);
  out.same("kind");
  if (kind != nullptr && *kind == "measured") return out.same("correlation").same("harmonics").take();
  out.number("bandwidth_hz", "bandwidth", "Hz").number("jitter_s", "jitter", "s");
  if (kind != nullptr && *kind == "sine") return out.same("modulation_depth").take();
  return out.same("duty").number("rise_time_s", "rise_time", "s").same("harmonics").take();
}

Json illumination(const Json& from) {
  Json list = Json::array();
  if (!from.is_array()) return list;
  for (const Json& light : *from.items()) {
    Section out(light);
    out.set("position", quantities(member(light, "position"), "m")).same("axis");
    out.number("illumination_wavelength_m", "illumination_wavelength", "m").number("power_w", "power", "W");
    list.push(out.set("pattern", pattern(member(light, "pattern"))).set("waveform", waveform(member(light, "waveform"))).take());
  }
  return list;
}

Json pixel(const Json& from) {
  Section out(from), patterns(from);
  out.set("quantum_efficiency", curve_or_constant(member(from, "quantum_efficiency"), "wavelength", "m"));
  out.set("contrast", curve_or_constant(member(from, "contrast"), "modulation_frequency", "Hz"));
  out.number("bandwidth_hz", "bandwidth", "Hz").number("full_well_e", "full_well", "e").number("read_noise_e", "read_noise", "e");
  out.number("dark_current_e_per_s", "dark_current", "e/s");
  patterns.same("prnu").number("dsnu_dn", "dsnu", "DN").number("delay_s", "delay", "s").number("pattern_seed", "seed", "");
  out.set("patterns", patterns.take());
  double threshold = 0;
  if (!member(from, "suppression_threshold_e").number(threshold) || threshold == 0) return out.take();
  Section suppression(from);
  suppression.number("suppression_threshold_e", "threshold", "e").number("suppression_budget_e", "budget", "e");
  return out.set("suppression", suppression.number("suppression_noise_factor", "noise_factor", "").take()).take();
}

Json decoding(const Json& from) {
  Section out(from), flying(from);
  out.same("wiggling_correction")
      .number("low_signal_noise_m", "low_signal_noise", "m")
      .number("inconsistent_range_m", "inconsistent_range", "m");
  flying.number("flying_near_z_m", "near_z", "m").number("flying_near_limit_m", "near_limit", "m");
  flying.number("flying_far_z_m", "far_z", "m").number("flying_far_limit_m", "far_limit", "m");
  const Json& chosen = member(from, "filter");
  const std::string* kind = member(chosen, "kind").string();
  Section filter_out(chosen);
  filter_out.same("kind");
  if (kind != nullptr && *kind == "gaussian") filter_out.number("sigma_px", "sigma", "px");
  if (kind != nullptr && *kind == "median") filter_out.number("radius_px", "radius", "");
  return out.set("flying_pixel", flying.take()).set("filter", filter_out.take()).take();
}

Json temperature(const Json& from) {
  Section out(from);
  out.number("celsius", "actual", "degC").number("reference_celsius", "reference", "degC").number("drift_m_per_kelvin", "drift", "m/K");
  out.number("warm_up_m", "warm_up", "m").number("warm_up_time_s", "warm_up_time", "s").number("since_start_s", "since_start", "s");
  return out.take();
}

Json modes(const Json& from) {
  Json sequence = Json::array();
  if (const Json::Array* raw_frames = member(from, "sequence").items()) {
    for (const Json& raw_frame : *raw_frames) {
      const bool* lit = member(raw_frame, "lit").boolean();
      Section out(raw_frame);
      out.same("lit").number("integration_time_s", "integration_time", "s");
      if (lit != nullptr && *lit)
        out.number("modulation_frequency_hz", "modulation_frequency", "Hz").number("reference_phase_rad", "reference_phase", "rad");
      sequence.push(out.take());
    }
  }
  const std::string* name = member(from, "name").string();
  Json mode = Section(from).number("frame_rate_hz", "frame_rate", "Hz").set("sequence", std::move(sequence)).take();
  return Json::object().set(name == nullptr || name->empty() ? "mode" : *name, std::move(mode));
}

}  // namespace

std::string profile_text(const Json& camera) {
  Section out(camera), sensor(member(camera, "sensor")), adc(member(camera, "adc"));
  sensor.same("width").same("height").number("pixel_pitch_m", "pixel_pitch", "m").same("fill_factor");
  adc.same("bits").number("step_e_per_dn", "step", "e/DN").same("mid_code").same("valid_min").same("valid_max");
  out.same("name").set("sensor", sensor.take()).set("lens", lens(member(camera, "lens"))).set("filter", filter(member(camera, "filter")));
  out.set("illumination", illumination(member(camera, "illumination"))).set("pixel", pixel(member(camera, "pixel"))).set("adc", adc.take());
  out.set("decoding", decoding(member(camera, "decoding"))).set("temperature", temperature(member(camera, "temperature")));
  out.set(
      "timing",
      Section(camera).number("readout_time_s", "readout_time", "s").number("min_integration_time_s", "min_integration_time", "s").take());
  return json_text(out.same("refractive_index").same("power_model").set("modes", modes(member(camera, "mode"))).take());
}

Camera camera_of_meta(const std::string& meta, const std::string& where, const Settings& settings) {
  const Json document = parse_json(meta, where + ": meta");
  const Json* camera = document.find("camera");
  if (camera == nullptr || !camera->is_object())
    throw Error(ErrorKind::bad_input, where + ": error: meta does not say which camera made it\n  name its profile with --camera");
  CameraOptions options;
  options.set = settings;
  return camera_from_text(profile_text(*camera), where + ": meta", "", options);
}

}  // namespace tofray::io
