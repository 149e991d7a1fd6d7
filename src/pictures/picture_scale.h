// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <string>
#include <vector>

namespace tofray::pictures {

/// A range of values for a picture, with round numbers at its ends and at its ticks.
struct PictureScale {
  double low = 0, high = 1;
  double step = 1;   ///< distance of two ticks
  int decimals = 0;  ///< digits after the point that the ticks need

  /// Where a value lies: 0 at low, 1 at high.
  [[nodiscard]] double at(double value) const { return (value - low) / (high - low); }
  /// The multiples of step from low to high.
  [[nodiscard]] std::vector<double> ticks() const;
  /// A tick's label, with a true minus sign and digits in threes: "12 000".
  [[nodiscard]] std::string label(double tick) const;
};

/// Digits before the point in threes: "1 234 567".
std::string grouped(std::string digits);

/// The scale whose ticks are 1, 2 or 5 times a power of ten apart, about five of them, and that holds low…high.
/// @param least_span  the scale is made at least this wide
PictureScale round_scale(double low, double high, double least_span);

/// The share q (0…1) of the finite values lies below the result; `otherwise` where there is none.
double percentile(std::vector<double> values, double q, double otherwise);

}  // namespace tofray::pictures
