// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <array>
#include <cmath>
#include <cstddef>

namespace tofray::mesh {

/// A point of a plane, its coordinates those of floats: products of two are exact in double.
using Point = std::array<double, 2>;

/// Whether three points turn to the left (1), to the right (−1) or not at all (0): exactly. The sign of a rounded determinant where it is
/// larger than its error, else of the determinant's six products, added without an error (Shewchuk 1997, "Adaptive precision
/// floating-point arithmetic and fast robust geometric predicates").
inline int orientation(const Point& a, const Point& b, const Point& c) {
  const double left = (b[0] - a[0]) * (c[1] - a[1]), right = (b[1] - a[1]) * (c[0] - a[0]), rounded = left - right;
  constexpr double most_error = 4e-16;  // of either product and their difference: 3 + 16·2⁻⁵³ times 2⁻⁵³
  if (std::abs(rounded) > most_error * (std::abs(left) + std::abs(right))) return rounded > 0 ? 1 : -1;
  const double products[] = {a[0] * b[1], -(a[1] * b[0]), b[0] * c[1], -(b[1] * c[0]), c[0] * a[1], -(c[1] * a[0])};
  std::array<double, 6> parts{};  // of the sum: no two have a bit of one place, the last one that is not 0 has its sign
  for (std::size_t n = 0; n < parts.size(); ++n) {
    double sum = products[n];
    for (std::size_t k = 0; k < n; ++k) {
      const double both = sum + parts[k], second = both - sum;
      parts[k] = (sum - (both - second)) + (parts[k] - second);
      sum = both;
    }
    parts[n] = sum;
  }
  for (std::size_t n = parts.size(); n-- > 0;)
    if (parts[n] < 0 || parts[n] > 0) return parts[n] > 0 ? 1 : -1;
  return 0;
}

}  // namespace tofray::mesh
