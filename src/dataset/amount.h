// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <array>
#include <optional>
#include <string>
#include <string_view>

#include "base/units.h"

/// Numbers with units as a set's file has them, and what units they are of where they are multiplied.
namespace tofray::dataset {

/// Powers of the quantities that others are made of; all 0: a bare number, or a fraction.
struct Dimensions {
  enum Kind : unsigned char { length, time, angle, power, charge, code, pixel, celsius, kelvin, illuminance };
  std::array<signed char, 10> powers{};
  bool operator==(const Dimensions&) const = default;
  [[nodiscard]] bool bare() const { return *this == Dimensions(); }
};
Dimensions dimensions_of(base::Dimension dimension);
/// What people call it: "a length", "a speed"; "length·length" where it has no name.
std::string name_of(const Dimensions& dimensions);
/// The SI unit; empty of a bare number; none where no quantity of tofray is of it.
std::optional<std::string> si_unit_of(const Dimensions& dimensions);

/// "0.8 m": 0.8 and "m".
struct Amount {
  double number = 0;
  std::string unit;  ///< as written; empty: bare
  [[nodiscard]] Dimensions dimensions() const;
  /// Its SI value, as the scene's file would be read.
  [[nodiscard]] double si() const;
  /// In the fewest digits that read back to it.
  [[nodiscard]] std::string text() const;
};
/// None where the text is no number, or its unit is none of tofray's. @param why  is told
std::optional<Amount> parse_amount(std::string_view text, std::string& why);

/// An SI value in its SI unit. @return none where no quantity is of these dimensions
std::optional<Amount> amount_of(double si, const Dimensions& dimensions);

}  // namespace tofray::dataset
