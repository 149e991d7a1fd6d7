// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include "io/camera_sections.h"

#include <charconv>
#include <cmath>

#include "base/limits.h"
#include "base/text.h"
#include "base/units.h"
#include "io/convert.h"
#include "io/text_file.h"

namespace tofray::io {

using base::in_quotes;

namespace {
int whole(const Value& value) { return static_cast<int>(value.number); }
}  // namespace

Camera CameraReader::camera(const Value& root) {
  Camera out;
  if (root.names.empty()) return out;
  out.name = root["name"].text;
  sensor(root["sensor"], out.sensor);
  lens(root["lens"], out.lens);
  for (const auto& one : root["illumination"].items) out.illumination.push_back(light(one));
  filter(root["filter"], out, out.filter);
  pixel(root["pixel"], out.pixel);
  adc(root["adc"], out.adc);
  decoding(root["decoding"], out.decoding);
  temperature(root["temperature"], out.temperature);
  out.refractive_index = root["refractive_index"].number;
  out.power_model = root["power_model"].text == "paper_literal" ? PowerModel::paper_literal : PowerModel::tofray;
  if (root["timing"].good) {
    out.readout_time_s = root["timing"]["readout_time"].number;
    out.min_integration_time_s = root["timing"]["min_integration_time"].number;
  }
  modes(root, out);
  return out;
}

void CameraReader::sensor(const Value& value, Sensor& out) {
  if (!value || !value.good) return;
  out = {whole(value["width"]), whole(value["height"]), value["pixel_pitch"].number, value["fill_factor"].number};
  const long long pixels = static_cast<long long>(out.width) * out.height;
  if (pixels > base::limit::sensor_pixels.value)
    faults_.add(value.place(), "the sensor has too many pixels",
                "got " + std::to_string(out.width) + " x " + std::to_string(out.height) + " = " + std::to_string(pixels) + ", at most " +
                    std::to_string(base::limit::sensor_pixels.value) + " (`tofray --limits`)",
                ErrorKind::limit);
}

void CameraReader::lens(const Value& value, Lens& out) {
  if (!value || !value.good) return;
  out.fx_px = value["fx"].number;
  out.fy_px = value["fy"].number;
  out.cx_px = value["cx"].number;
  out.cy_px = value["cy"].number;
  const Value& d = value["distortion"];
  out.k1 = d["k1"].number;
  out.k2 = d["k2"].number;
  out.p1 = d["p1"].number;
  out.p2 = d["p2"].number;
  out.k3 = d["k3"].number;
  out.f_number = value["f_number"].number;
  out.transmission = value["transmission"].number;
  const Value& vignetting = value["vignetting"];
  out.vignetting = vignetting.either == 1     ? Lens::Vignetting::table
                   : vignetting.text == "off" ? Lens::Vignetting::off
                                              : Lens::Vignetting::cos4;
  if (vignetting.either == 1) table(vignetting, "angle", "factor", faults_, out.vignetting_table.x, out.vignetting_table.y);
}

void CameraReader::filter(const Value& value, const Camera& camera, Filter& out) {
  if (!value || !value.good) return;
  if (!camera.illumination.empty()) out.center_m = camera.illumination[0].illumination_wavelength_m;
  if (value["center"]) out.center_m = value["center"].number;
  out.half_width_m = value["half_width"].number;
  out.peak = value["peak"].number;
  const bool x = static_cast<bool>(value["wavelength"]), y = static_cast<bool>(value["transmission"]);
  if (x != y)
    faults_.add(value.place(), std::string("filter has ") + (x ? "wavelength" : "transmission") + " alone",
                "expected wavelength and transmission, as long as each other");
  if (x && y) table(value, "wavelength", "transmission", faults_, out.table.x, out.table.y);
}

Illumination CameraReader::light(const Value& value) {
  Illumination out;
  if (!value.good) return out;
  out.position = vector(value["position"]);
  out.axis = vector(value["axis"]);
  if (!(std::hypot(out.axis[0], out.axis[1], out.axis[2]) >= 1e-6))
    faults_.add(value.place_of("axis"), "axis has no length",
                "got " + flow_text(*value["axis"].node) + ", expected a direction such as [0, 0, 1]");
  out.illumination_wavelength_m = value["illumination_wavelength"].number;
  out.power_w = value["power"].number;
  pattern(value["pattern"], out.pattern);
  waveform(value["waveform"], out.waveform);
  return out;
}

void CameraReader::pattern(const Value& value, Pattern& out) {
  using enum Pattern::Kind;
  out.kind = value.text == "cone"          ? cone
             : value.text == "cosine_lobe" ? cosine_lobe
             : value.text == "flat_top"    ? flat_top
             : value.text == "table"       ? Pattern::Kind::table
                                           : lambertian;
  out.half_angle_rad = value["half_angle"].number;
  if (value["exponent"]) out.exponent = value["exponent"].number;
  out.width_rad = value["width"].number;
  out.height_rad = value["height"].number;
  out.columns = whole(value["columns"]);
  out.rows = whole(value["rows"]);
  out.half_range_x_rad = value["half_range_x"] ? value["half_range_x"].number : out.width_rad;
  out.half_range_y_rad = value["half_range_y"] ? value["half_range_y"].number : out.height_rad;
  if ((out.columns > 0) != (out.rows > 0)) faults_.add(value.place(), "pattern has columns or rows alone", "expected both, or none");
  if (static_cast<long long>(out.columns) * out.rows > base::limit::table_samples.value)
    faults_.add(value.place(), "the pattern has too many samples",
                "got " + std::to_string(out.columns) + " x " + std::to_string(out.rows) + ", at most " +
                    std::to_string(base::limit::table_samples.value),
                ErrorKind::limit);
  if (out.kind != Pattern::Kind::table) return;
  std::vector<std::vector<double>> rows;
  if (value["file"])
    rows = number_file(value["file"]);
  else
    for (const auto& row : value["samples"].items) rows.push_back(numbers(row));
  const base::Place& place = value["file"] ? value["file"].place() : value["samples"].place();
  double sum = 0;
  for (const auto& row : rows) {
    if (row.size() != rows[0].size())
      return faults_.add(place, "the pattern's rows are not as long as each other",
                         "got rows of " + std::to_string(rows[0].size()) + " and of " + std::to_string(row.size()));
    for (const double sample : row) {
      if (!(sample >= 0 && sample <= 1e12))
        return faults_.add(place, "a sample of the pattern is out of range", "got " + base::number_text(sample) + ", expected 0 to 1e12");
      sum += sample;
    }
    out.samples.insert(out.samples.end(), row.begin(), row.end());
  }
  if (!(sum > 0)) faults_.add(place, "the pattern is dark", "expected a sample above 0");
  if (rows.size() < 2 || rows[0].size() < 2)
    faults_.add(place, "the pattern has fewer than two rows or columns", "a constant one needs the same number four times");
  if (static_cast<long long>(out.samples.size()) > base::limit::table_samples.value)
    faults_.add(place, "the pattern has too many samples", "at most " + std::to_string(base::limit::table_samples.value), ErrorKind::limit);
  out.rows = static_cast<int>(rows.size());
  out.columns = rows.empty() ? 0 : static_cast<int>(rows[0].size());
}

void CameraReader::waveform(const Value& value, Waveform& out) {
  using enum Waveform::Kind;
  out.kind = value.text == "sine" ? sine : value.text == "measured" ? measured : rectangular;
  if (value["duty"]) out.duty = value["duty"].number;
  out.rise_time_s = value["rise_time"].number;
  if (value["modulation_depth"]) out.modulation_depth = value["modulation_depth"].number;
  out.bandwidth_hz = value["bandwidth"].number;
  out.jitter_s = value["jitter"].number;
  out.harmonics = value["harmonics"] ? whole(value["harmonics"]) : 1;
  if (out.kind != measured) return;
  if (value["file"])
    for (const auto& row : number_file(value["file"])) out.correlation.insert(out.correlation.end(), row.begin(), row.end());
  else
    out.correlation = numbers(value["correlation"]);
  const base::Place& place = value["file"] ? value["file"].place() : value["correlation"].place();
  double largest = 0;
  for (const double sample : out.correlation) largest = std::max(largest, std::abs(sample));
  if (!(largest > 0 && largest <= 10)) faults_.add(place, "the correlation is nowhere above 0, or above 10", "expected (A-B)/(A+B)");
  // Harmonic m needs more than 2 m samples.
  if (static_cast<int>(out.correlation.size()) <= 2 * (2 * out.harmonics - 1))
    faults_.add(place, "too few samples of the correlation for its harmonics",
                "got " + std::to_string(out.correlation.size()) + " samples, expected more than " +
                    std::to_string(2 * (2 * out.harmonics - 1)) + " for " + std::to_string(out.harmonics) + " odd harmonics");
}

void CameraReader::curve(const Value& value, const char* x_key, Curve& out) {
  if (value.either == 1) return table(value, x_key, "value", faults_, out.x, out.y);
  out.x = {0};
  out.y = {value.number};
}

void CameraReader::pixel(const Value& value, Pixel& out) {
  if (!value || !value.good) return;
  curve(value["quantum_efficiency"], "wavelength", out.quantum_efficiency);
  curve(value["contrast"], "modulation_frequency", out.contrast);
  out.bandwidth_hz = value["bandwidth"].number;
  out.full_well_e = value["full_well"].number;
  out.read_noise_e = value["read_noise"].number;
  out.dark_current_e_per_s = value["dark_current"].number;
  const Value& patterns = value["patterns"];
  out.prnu = patterns["prnu"].number;
  out.dsnu_dn = patterns["dsnu"].number;
  out.delay_s = patterns["delay"].number;
  out.pattern_seed = static_cast<unsigned long long>(patterns["seed"].number);
  const Value& suppression = value["suppression"];
  if (!suppression) return;
  out.suppression_threshold_e = suppression["threshold"].number;
  out.suppression_budget_e = suppression["budget"].number;
  out.suppression_noise_factor = suppression["noise_factor"].number;
}

void CameraReader::adc(const Value& value, Adc& out) {
  if (!value || !value.good) return;
  out.bits = whole(value["bits"]);
  const int largest = (1 << out.bits) - 1;
  out.step_e_per_dn = value["step"].number;
  out.mid_code = value["mid_code"] ? value["mid_code"].number : 1 << (out.bits - 1);
  out.valid_min = value["valid_min"] ? whole(value["valid_min"]) : 0;
  out.valid_max = value["valid_max"] ? whole(value["valid_max"]) : largest;
  for (const auto& [key, code] :
       {std::pair<const char*, double>{"mid_code", out.mid_code}, {"valid_min", out.valid_min}, {"valid_max", out.valid_max}})
    if (code > largest)
      faults_.add(
          value.place_of(key), std::string(key) + " is above the largest code",
          "got " + base::number_text(code) + ", a code of " + std::to_string(out.bits) + " bits is at most " + std::to_string(largest));
  if (out.valid_min >= out.valid_max)
    faults_.add(value.place_of("valid_min"), "valid_min is not below valid_max",
                "got " + std::to_string(out.valid_min) + " and " + std::to_string(out.valid_max));
}

void CameraReader::decoding(const Value& value, Decoding& out) {
  if (!value || !value.good) return;
  out.wiggling_correction = value["wiggling_correction"].flag;
  out.low_signal_noise_m = value["low_signal_noise"].number;
  const Value& flying = value["flying_pixel"];
  out.flying_near_z_m = flying["near_z"].number;
  out.flying_near_limit_m = flying["near_limit"].number;
  out.flying_far_z_m = flying["far_z"].number;
  out.flying_far_limit_m = flying["far_limit"].number;
  if (!(out.flying_far_z_m - out.flying_near_z_m >= 1e-6))
    faults_.add(flying.place_of("far_z"), "far_z is not beyond near_z",
                "got " + base::number_text(out.flying_far_z_m) + " m and " + base::number_text(out.flying_near_z_m) + " m");
  out.inconsistent_range_m = value["inconsistent_range"].number;
  const Value& chosen = value["filter"];
  out.filter.kind = chosen.text == "gaussian" ? ImageFilter::Kind::gaussian
                    : chosen.text == "median" ? ImageFilter::Kind::median
                                              : ImageFilter::Kind::none;
  if (chosen["sigma"]) out.filter.sigma_px = chosen["sigma"].number;
  if (chosen["radius"]) out.filter.radius_px = whole(chosen["radius"]);
}

void CameraReader::temperature(const Value& value, Temperature& out) {
  if (!value || !value.good) return;
  out = {value["actual"].number,  value["reference"].number,    value["drift"].number,
         value["warm_up"].number, value["warm_up_time"].number, value["since_start"].number};
}

std::vector<std::vector<double>> CameraReader::number_file(const Value& name) {
  std::vector<std::vector<double>> rows;
  std::string path, content;
  try {
    if (folder_.empty())
      base::fail(name.place(), "this profile cannot name files", "got " + in_quotes(name.text) + "; write the numbers into the profile");
    content = read_reference(name.text, folder_, {}, name.place(), path);
  } catch (const Error&) {
    if (faults_.empty()) throw;  // else the file's other faults are reported first
    return rows;
  }
  const auto source = std::make_shared<const std::string>(path);
  int line_number = 0;
  for (std::size_t from = 0; from < content.size();) {
    const std::size_t end = std::min(content.find('\n', from), content.size());
    const std::string_view line = std::string_view(content).substr(from, end - from);
    from = end + 1;
    ++line_number;
    std::vector<double> row;
    for (std::size_t i = 0; i < line.size() && line[i] != '#';) {
      if (line[i] == ' ' || line[i] == '\t' || line[i] == ',' || line[i] == ';' || line[i] == '\r') {
        ++i;
        continue;
      }
      const std::size_t stop = std::min(line.find_first_of(" \t,;\r#", i), line.size());
      const auto number = base::parse_quantity(line.substr(i, stop - i), base::Dimension::none);
      if (number.status != base::Quantity::Status::good && number.status != base::Quantity::Status::bare) {
        faults_.add({source, line_number, static_cast<int>(i) + 1}, "not a number",
                    "got " + in_quotes(line.substr(i, stop - i)) + ", expected numbers with \",\" or blanks between them");
        return {};
      }
      row.push_back(number.value);
      i = stop;
    }
    if (!row.empty()) rows.push_back(std::move(row));
  }
  if (rows.empty()) faults_.add(base::whole(path), "there are no numbers in it", "expected rows of numbers, one row a line");
  return rows;
}

}  // namespace tofray::io
