// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <algorithm>

/// Colours as pictures, scanners and programs for meshes write them.
namespace tofray::base {

/// A sample of 0…1, IEC 61966-2-1: x^2.4 with x = (a + 0.055)/1.055 as x²·y, y the fifth root of x², by Newton's method from a cubic in x that
/// is off by less than 3 %. To 4.5e-16, and the same bits with every compiler and processor, which the C library's pow is not.
inline double linear_of_srgb(double a) {
  if (a <= 0.04045) return a / 12.92;
  const double x = (a + 0.055) / 1.055, square = x * x;
  double y = 0.2459 + x * (1.7186 + x * (-1.6757 + x * 0.7156));
  for (int i = 0; i < 4; ++i) y = 0.8 * y + 0.2 * (square / (y * y * (y * y)));
  return square * y;
}

/// Relative luminance (ITU-R BT.709) of linear red, green and blue, 1 at most.
inline double luminance(double red, double green, double blue) { return std::min(0.2126 * red + 0.7152 * green + 0.0722 * blue, 1.0); }

}  // namespace tofray::base
