// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include "dataset/amount.h"

#include <charconv>
#include <cmath>
#include <vector>

#include "base/text.h"

namespace tofray::dataset {

using base::Dimension;

Dimensions dimensions_of(Dimension dimension) {
  const auto of = [](std::initializer_list<std::pair<Dimensions::Kind, int>> factors) {
    Dimensions out;
    for (const auto& [kind, power] : factors) out.powers[kind] = static_cast<signed char>(power);
    return out;
  };
  switch (dimension) {
    case Dimension::none:
    case Dimension::fraction: return {};
    case Dimension::length: return of({{Dimensions::length, 1}});
    case Dimension::time: return of({{Dimensions::time, 1}});
    case Dimension::frequency: return of({{Dimensions::time, -1}});
    case Dimension::angle: return of({{Dimensions::angle, 1}});
    case Dimension::speed: return of({{Dimensions::length, 1}, {Dimensions::time, -1}});
    case Dimension::angular_speed: return of({{Dimensions::angle, 1}, {Dimensions::time, -1}});
    case Dimension::power: return of({{Dimensions::power, 1}});
    case Dimension::charge: return of({{Dimensions::charge, 1}});
    case Dimension::charge_rate: return of({{Dimensions::charge, 1}, {Dimensions::time, -1}});
    case Dimension::charge_per_code: return of({{Dimensions::charge, 1}, {Dimensions::code, -1}});
    case Dimension::code: return of({{Dimensions::code, 1}});
    case Dimension::pixel: return of({{Dimensions::pixel, 1}});
    case Dimension::celsius: return of({{Dimensions::celsius, 1}});
    case Dimension::drift: return of({{Dimensions::length, 1}, {Dimensions::kelvin, -1}});
    case Dimension::temperature_difference: return of({{Dimensions::kelvin, 1}});
    case Dimension::illuminance: return of({{Dimensions::illuminance, 1}});
    case Dimension::irradiance: return of({{Dimensions::power, 1}, {Dimensions::length, -2}});
    case Dimension::spectral_irradiance: return of({{Dimensions::power, 1}, {Dimensions::length, -3}});
  }
  return {};
}

namespace {

constexpr Dimension named[] = {Dimension::length,          Dimension::time,       Dimension::frequency,
                               Dimension::angle,           Dimension::speed,      Dimension::angular_speed,
                               Dimension::power,           Dimension::charge,     Dimension::charge_rate,
                               Dimension::charge_per_code, Dimension::code,       Dimension::pixel,
                               Dimension::celsius,         Dimension::drift,      Dimension::temperature_difference,
                               Dimension::illuminance,     Dimension::irradiance, Dimension::spectral_irradiance};

const Dimension* find(const Dimensions& dimensions) {
  for (const Dimension& one : named)
    if (dimensions_of(one) == dimensions) return &one;
  return nullptr;
}

std::string_view trimmed(std::string_view text) {
  while (!text.empty() && (text.back() == ' ' || text.back() == '\t')) text.remove_suffix(1);
  while (!text.empty() && (text.front() == ' ' || text.front() == '\t')) text.remove_prefix(1);
  return text;
}

}  // namespace

std::string name_of(const Dimensions& dimensions) {
  if (dimensions.bare()) return "a bare number";
  if (const Dimension* found = find(dimensions)) return base::article_and_name(*found);
  constexpr const char* names[] = {"length", "time", "angle", "power", "charge", "code", "pixels", "temperature", "kelvin", "illuminance"};
  std::string text;
  for (std::size_t i = 0; i < dimensions.powers.size(); ++i) {
    if (dimensions.powers[i] == 0) continue;
    if (!text.empty()) text += " x ";
    text += names[i];
    if (dimensions.powers[i] != 1) text += "^" + std::to_string(dimensions.powers[i]);
  }
  return text;
}

std::optional<std::string> si_unit_of(const Dimensions& dimensions) {
  if (dimensions.bare()) return "";
  const Dimension* found = find(dimensions);
  if (found == nullptr) return {};
  return base::si_unit(*found);
}

Dimensions Amount::dimensions() const { return unit.empty() ? Dimensions() : dimensions_of(base::find_unit(unit)->dimension); }

double Amount::si() const { return unit.empty() ? number : base::parse_quantity(text(), base::find_unit(unit)->dimension).value; }

std::string Amount::text() const { return base::number_text(number) + (unit.empty() ? "" : " " + unit); }

std::optional<Amount> parse_amount(std::string_view written, std::string& why) {
  std::string_view text = trimmed(written);
  if (text.starts_with('+')) text.remove_prefix(1);
  Amount out;
  const auto read = std::from_chars(text.data(), text.data() + text.size(), out.number);
  if (read.ec == std::errc::invalid_argument || !std::isfinite(out.number))
    return why = base::in_quotes(written) + " is no number", std::nullopt;
  if (read.ec != std::errc()) return why = base::in_quotes(written) + " is too large or too small", std::nullopt;
  out.number += 0.0;  // −0 → 0
  out.unit = trimmed(text.substr(static_cast<std::size_t>(read.ptr - text.data())));
  if (out.unit.empty()) return out;
  const base::Unit* unit = base::find_unit(out.unit);
  if (unit == nullptr) return why = base::in_quotes(out.unit) + " is no unit", std::nullopt;
  if (base::parse_quantity(text, unit->dimension).status != base::Quantity::Status::good)
    return why = base::in_quotes(written) + " is too large or too small", std::nullopt;
  return out;
}

std::optional<Amount> amount_of(double si, const Dimensions& dimensions) {
  auto unit = si_unit_of(dimensions);
  if (!unit) return {};
  return Amount{si + 0.0, std::move(*unit)};
}

}  // namespace tofray::dataset
