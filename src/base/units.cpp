// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include "base/units.h"

#include <fmt/core.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>

#include "base/constants.h"
#include "base/text.h"

namespace tofray::base {

namespace {

using enum Dimension;

// Each dimension's first units are the ones that messages advertise.
constexpr Unit units[] = {
    {"%", fraction, -2},
    {"ppm", fraction, -6},
    {"m", length, 0},
    {"cm", length, -2},
    {"mm", length, -3},
    {"um", length, -6},
    {"nm", length, -9},
    {"km", length, 3},
    {"µm", length, -6},
    {"μm", length, -6},
    {"s", time, 0},
    {"ms", time, -3},
    {"us", time, -6},
    {"ns", time, -9},
    {"ps", time, -12},
    {"min", time, 0, 60},
    {"h", time, 0, 3600},
    {"µs", time, -6},
    {"μs", time, -6},
    {"Hz", frequency, 0},
    {"kHz", frequency, 3},
    {"MHz", frequency, 6},
    {"GHz", frequency, 9},
    {"deg", angle, 0, pi / 180},
    {"rad", angle, 0},
    {"mrad", angle, -3},
    {"°", angle, 0, pi / 180},
    {"m/s", speed, 0},
    {"cm/s", speed, -2},
    {"mm/s", speed, -3},
    {"km/h", speed, 0, 1 / 3.6},
    {"deg/s", angular_speed, 0, pi / 180},
    {"rad/s", angular_speed, 0},
    {"rpm", angular_speed, 0, pi / 30},
    {"°/s", angular_speed, 0, pi / 180},
    {"W", power, 0},
    {"mW", power, -3},
    {"uW", power, -6},
    {"kW", power, 3},
    {"µW", power, -6},
    {"μW", power, -6},
    {"e", charge, 0},
    {"ke", charge, 3},
    {"e/s", charge_rate, 0},
    {"ke/s", charge_rate, 3},
    {"e/DN", charge_per_code, 0},
    {"DN", code, 0},
    {"px", pixel, 0},
    {"degC", celsius, 0},
    {"°C", celsius, 0},
    {"mm/K", drift, -3},
    {"um/K", drift, -6},
    {"m/K", drift, 0},
    {"K", temperature_difference, 0},
    {"lx", illuminance, 0},
    {"klx", illuminance, 3},
    {"W/m2", irradiance, 0},
    {"mW/m2", irradiance, -3},
    {"kW/m2", irradiance, 3},
    {"W/m^2", irradiance, 0},
    {"W/m²", irradiance, 0},
    {"W/(m2 nm)", spectral_irradiance, 9},
    {"mW/(m2 nm)", spectral_irradiance, 6},
    {"W/m3", spectral_irradiance, 0},
    {"W/(m2 um)", spectral_irradiance, 6},
    {"W/m2/nm", spectral_irradiance, 9},
};

// The number at the text's start with 10^exponent joined to it; `end` is where it ends.
std::from_chars_result scaled(std::string_view text, int exponent, double& value) {
  auto read = std::from_chars(text.data(), text.data() + text.size(), value);
  if (exponent == 0 || (read.ec != std::errc() && read.ec != std::errc::result_out_of_range)) return read;
  const std::string_view number = text.substr(0, static_cast<std::size_t>(read.ptr - text.data()));
  const std::size_t mark = number.find_first_of("eE");
  long written = 0;
  if (mark != std::string_view::npos) {
    std::string_view digits = number.substr(mark + 1);
    if (digits.starts_with('+')) digits.remove_prefix(1);
    const auto e = std::from_chars(digits.data(), digits.data() + digits.size(), written);
    if (e.ec != std::errc()) return {read.ptr, std::errc::result_out_of_range};
  }
  if (written > 100'000 || written < -100'000) return {read.ptr, std::errc::result_out_of_range};
  const std::string joined = std::string(number.substr(0, mark)) + "e" + std::to_string(written + exponent);
  return {read.ptr, std::from_chars(joined.data(), joined.data() + joined.size(), value).ec};
}

bool too_fine(double value) { return value != 0 && std::abs(value) < std::numeric_limits<double>::min(); }

}  // namespace

const char* article_and_name(Dimension dimension) {
  switch (dimension) {
    case none: return "a number";
    case fraction: return "a fraction";
    case length: return "a length";
    case time: return "a time";
    case frequency: return "a frequency";
    case angle: return "an angle";
    case speed: return "a speed";
    case angular_speed: return "an angular speed";
    case power: return "a power";
    case charge: return "a charge in electrons";
    case charge_rate: return "a current in electrons";
    case charge_per_code: return "a charge per code";
    case code: return "an ADC code";
    case pixel: return "a size in pixels";
    case celsius: return "a temperature";
    case drift: return "a length per kelvin";
    case temperature_difference: return "a difference of temperatures";
    case illuminance: return "an illuminance";
    case irradiance: return "an irradiance";
    case spectral_irradiance: return "a spectral irradiance";
  }
  return "a quantity";
}

std::vector<std::string> unit_names(Dimension dimension) {
  std::vector<std::string> names;
  for (const auto& unit : units)
    if (unit.dimension == dimension) names.emplace_back(unit.name);
  return names;
}

std::string si_unit(Dimension dimension) {
  if (dimension == fraction) return "";
  for (const auto& unit : units)
    if (unit.dimension == dimension && unit.exponent == 0 && unit.factor == 1) return unit.name;
  return "";
}

const Unit* find_unit(std::string_view name) {
  for (const auto& unit : units)
    if (name == unit.name) return &unit;
  return nullptr;
}

Quantity parse_quantity(std::string_view text, Dimension dimension) {
  Quantity out;
  while (!text.empty() && (text.back() == ' ' || text.back() == '\t')) text.remove_suffix(1);
  while (!text.empty() && (text.front() == ' ' || text.front() == '\t')) text.remove_prefix(1);
  if (text.starts_with('+') && !text.starts_with("+-")) text.remove_prefix(1);
  auto read = scaled(text, 0, out.value);
  if (read.ec == std::errc::invalid_argument) {
    const bool special = text == ".inf" || text == "-.inf" || text == ".nan" || text == ".NaN" || text == ".Inf";
    out.status = special ? Quantity::Status::not_finite : Quantity::Status::not_a_number;
    return out;
  }
  std::string_view rest = text.substr(static_cast<std::size_t>(read.ptr - text.data()));
  while (!rest.empty() && (rest.front() == ' ' || rest.front() == '\t')) rest.remove_prefix(1);
  out.unit = rest;
  if (read.ec == std::errc() && !std::isfinite(out.value)) {
    out.status = Quantity::Status::not_finite;
    return out;
  }
  const Unit* unit = rest.empty() ? nullptr : find_unit(rest);
  if (!rest.empty() && unit == nullptr) {
    out.status = Quantity::Status::unknown_unit;
    return out;
  }
  if (unit != nullptr && unit->dimension != dimension) {
    out.status = Quantity::Status::other_dimension;
    return out;
  }
  if (unit != nullptr) {
    read = scaled(text, unit->exponent, out.value);
    out.value *= unit->factor;
  }
  if (read.ec != std::errc() || !std::isfinite(out.value) || too_fine(out.value)) {
    out.status = Quantity::Status::out_of_range;
    return out;
  }
  out.value += 0.0;  // −0 → 0
  out.status = unit == nullptr && out.value != 0 ? Quantity::Status::bare : Quantity::Status::good;
  return out;
}

std::string quantity_text(double value, std::string_view example) {
  const std::size_t space = example.find(' ');
  const Unit* unit = space == std::string_view::npos ? nullptr : find_unit(example.substr(space + 1));
  if (unit == nullptr) return number_text(value);
  double number = value / unit->factor;
  // Through text, so that 1e-06 m is 1 um and not 0.9999999999999999 um.
  const std::string shifted = number_text(number);
  scaled(shifted, -unit->exponent, number);
  return number_text(number) + " " + unit->name;
}

std::string size_text(const Vec3& low, const Vec3& high) {
  const double most = std::max({high[0] - low[0], high[1] - low[1], high[2] - low[2]});
  const double unit = most < 1e-4 ? 1e6 : most < 0.1 ? 1e3 : 1;
  const auto one = [&](std::size_t k) {
    const double size = (high[k] - low[k]) * unit;
    return fmt::format("{:.{}f}", size, size >= 100 ? 0 : size >= 10 ? 1 : 2);
  };
  return fmt::format("{} x {} x {} {}", one(0), one(1), one(2), most < 1e-4 ? "um" : most < 0.1 ? "mm" : "m");
}

}  // namespace tofray::base
