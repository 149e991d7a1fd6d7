// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace tofray::base {

/// From low to high, ends included.
struct Range {
  double low, high;
  [[nodiscard]] constexpr bool contains(double value) const { return value >= low && value <= high; }  // NaN: no
};

/// Of a direction, a radius or a thickness: below, float could not tell it from zero.
inline constexpr double shortest_m = 1e-6;
/// Coordinates of a scene are at most this: float carries 8 mm there.
inline constexpr double farthest_m = 1e5;

}  // namespace tofray::base
