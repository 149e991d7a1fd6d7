// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <string>
#include <string_view>
#include <vector>

#include "tofray/scene.h"

/// Quantities as people write them ("2000 us", "5 %") and their SI values.
namespace tofray::base {

enum class Dimension {
  none,
  fraction,
  length,
  time,
  frequency,
  angle,
  speed,
  angular_speed,
  power,
  charge,
  charge_rate,
  charge_per_code,
  code,
  pixel,
  celsius,
  drift,
  temperature_difference,
  illuminance,
  irradiance,
  spectral_irradiance,
};

struct Unit {
  const char* name;  ///< as the user writes it
  Dimension dimension;
  int exponent;  ///< SI value = number · 10^exponent · factor
  double factor = 1;
};

/// "a length", "a fraction", …: how messages call the dimension.
const char* article_and_name(Dimension dimension);

/// The units that a dimension has, the ones to advertise first.
std::vector<std::string> unit_names(Dimension dimension);

/// The SI unit of a dimension, in which structs hold its numbers; empty where they have none.
std::string si_unit(Dimension dimension);

/// The unit of that name, or none. (No name stands for two units.)
const Unit* find_unit(std::string_view name);

/// What stands in a text: the number, the unit's name ("" where bare), and the SI value where both are good.
struct Quantity {
  enum class Status {
    good,
    not_a_number,  ///< no number at the text's start
    not_finite,    ///< nan, inf
    out_of_range,  ///< too large or too small for a double
    unknown_unit,
    other_dimension,  ///< a unit of something else
    bare,             ///< no unit, and the number is not 0
  };
  Status status = Status::not_a_number;
  std::string unit;
  double value = 0;  ///< SI; with `bare` the number itself
};

/// Reads a number with a unit of `dimension`. The decimal exponent of the unit is joined to the number's before it is rounded:
/// "80.32 MHz" is the double nearest to 80.32e6. Independent of the locale. −0 becomes 0.
Quantity parse_quantity(std::string_view text, Dimension dimension);

/// An SI value in the unit that `example` carries, e.g. "0.5 um", for messages.
std::string quantity_text(double value, std::string_view example);

/// The size of a box: "0.40 x 0.40 x 0.40 m", in mm or um where it is small.
std::string size_text(const Vec3& low, const Vec3& high);

}  // namespace tofray::base
