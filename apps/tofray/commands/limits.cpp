// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include "commands/limits.h"

#include <fmt/core.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <optional>

#include "base/constants.h"
#include "base/text.h"
#include "base/units.h"
#include "tofray/error.h"

namespace tofray::app {

namespace {

constexpr const char* unit_ends[] = {"_m", "_rad", "_percent", "_px", "_e", ""};

/// "_m" of "bias_m".
std::string unit_end(const std::string& name) {
  for (const char* end : unit_ends)
    if (name.ends_with(end)) return end;
  return "";
}

std::optional<double> plain_of(std::string_view text) {
  while (!text.empty() && text.back() == ' ') text.remove_suffix(1);
  double number = 0;
  const auto read = std::from_chars(text.data(), text.data() + text.size(), number);
  if (read.ec != std::errc() || read.ptr != text.data() + text.size() || !std::isfinite(number)) return std::nullopt;
  return number;
}

/// The value in the unit; none where it is of another one.
std::optional<double> in_unit(const std::string& value, const std::string& end, bool bare) {
  const auto with = [&](const char* unit) -> std::optional<double> {
    if (!value.ends_with(unit)) return std::nullopt;
    return plain_of(std::string_view(value).substr(0, value.size() - std::string_view(unit).size()));
  };
  if (bare || end.empty())
    if (const std::optional<double> number = plain_of(value)) return number;
  if (end == "_percent") return with("%");
  if (end == "_px") return with("px");
  if (end == "_e") return with("e");
  if (end.empty()) return std::nullopt;
  const base::Quantity quantity = base::parse_quantity(value, end == "_m" ? base::Dimension::length : base::Dimension::angle);
  return quantity.status == base::Quantity::Status::good ? std::optional<double>(quantity.value) : std::nullopt;
}

const char* example_of(const std::string& end) {
  return end == "_m" ? "5mm" : end == "_rad" ? "2deg" : end == "_percent" ? "5%" : end == "_px" ? "1.5px" : end == "_e" ? "100e" : "1.2";
}

/// Which number a limit means, and its value in that number's unit.
std::pair<const Measured*, double> meant(const std::vector<Measured>& all, const std::string& name, const std::string& value) {
  std::vector<std::string> known, examples;
  for (const Measured& one : all) {
    const std::string end = unit_end(one.name);
    known.push_back(one.name.substr(0, one.name.size() - end.size()));
    if (one.name != name && known.back() != name) continue;
    if (const std::optional<double> number = in_unit(value, end, one.name == name)) return {&one, *number};
    examples.push_back(fmt::format("--limit {}={}", name, example_of(end)));
  }
  if (!examples.empty())
    throw Error(ErrorKind::bad_input, fmt::format("error: the limit of {} cannot be {}\n  expected a number with its unit, as in {}", name,
                                                  base::in_quotes(value), base::listed(examples)));
  known.erase(std::unique(known.begin(), known.end()), known.end());
  throw Error(ErrorKind::bad_input, fmt::format("error: nothing that is measured is called {}{}\n  expected {}", base::in_quotes(name),
                                                base::did_you_mean(name, known), base::listed(known)));
}

}  // namespace

std::string measured_text(const std::string& name, double value) {
  const std::string end = unit_end(name);
  if (std::isnan(value)) return "-";
  if (end == "_m")
    return std::fabs(value) < 1 && name.find("distance") == std::string::npos && name.find("step") == std::string::npos
               ? fmt::format("{:.4g} mm", 1e3 * value)
               : fmt::format("{:.4g} m", value);
  if (end == "_rad") return fmt::format("{:.3g} deg", value * 180 / base::pi);
  if (end == "_percent") return fmt::format("{:.4g} %", value);
  if (end == "_px") return fmt::format("{:.3g} px", value);
  if (end == "_e") return fmt::format("{:.5g} e", value);
  return fmt::format("{:.4g}", value);
}

std::string beyond_limits(const std::vector<Measured>& all, const std::vector<std::pair<std::string, std::string>>& limits) {
  std::string out;
  for (const auto& [name, value] : limits) {
    const auto [of, limit] = meant(all, name, value);
    if (std::isnan(of->value))
      throw Error(ErrorKind::bad_input, fmt::format("error: {} has a limit and is not known\n  expected {}", name, of->needs));
    const bool good = of->at_least ? of->value >= limit : std::fabs(of->value) <= limit;
    if (!good)
      out += fmt::format("limit: {} is {}, {} {}\n", name, measured_text(of->name, of->value), of->at_least ? "below" : "beyond",
                         measured_text(of->name, limit));
  }
  return out;
}

}  // namespace tofray::app
