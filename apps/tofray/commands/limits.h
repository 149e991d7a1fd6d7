// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <string>
#include <utility>
#include <vector>

/// `--limit NAME=VALUE` of commands that measure.
namespace tofray::app {

/// A number that can have a limit. Its unit is the end of its name: _m, _rad, _percent, _px, _e, or none.
struct Measured {
  std::string name;
  double value = 0;       ///< NaN: unknown
  bool at_least = false;  ///< a limit is the least that is good; false: the most, of either sign
  std::string needs;      ///< where it is unknown: what would make it known
};

/// A number in the unit that people read: "3.21 mm".
std::string measured_text(const std::string& name, double value);

/// A line for each limit that does not hold; empty: all hold.
/// @throws Error (bad_input) for a name that nothing is called, a value of another unit, a number that is unknown
std::string beyond_limits(const std::vector<Measured>& all, const std::vector<std::pair<std::string, std::string>>& limits);

}  // namespace tofray::app
