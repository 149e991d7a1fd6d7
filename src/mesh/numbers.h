// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstdint>
#include <limits>
#include <string_view>

/// Numbers as mesh files write them, independent of the locale.
namespace tofray::mesh {

/// Also with a leading '+'. What is a number, but none that is finite, or is hexadecimal, gives NaN or infinity.
/// @return false where the text as a whole is no number
bool read_number(std::string_view text, double& value);

/// One beyond 64 bits gives the largest or smallest. @return false where the text as a whole is no whole number
bool read_integer(std::string_view text, std::int64_t& value);

/// The nearest float; infinity beyond its range.
inline float to_float(double value) {
  constexpr double most = std::numeric_limits<float>::max();
  if (value > most) return std::numeric_limits<float>::infinity();
  if (value < -most) return -std::numeric_limits<float>::infinity();
  return static_cast<float>(value);
}

}  // namespace tofray::mesh
