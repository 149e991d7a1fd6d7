// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <string>
#include <vector>

#include "tofray/frame.h"
#include "tofray/quality.h"

/// Numbers of many numbers, and pixels of depth.
namespace tofray::analysis {

inline constexpr double unknown = std::numeric_limits<double>::quiet_NaN();

/// What is farther off than so many sigmas of its claimed noise is no noise: a wrong cycle, another surface.
inline constexpr double outlier_sigmas = 6;

/// The number that the share q (0…1) lies below, between two of them in proportion; NaN of none.
inline double quantile(std::vector<double> values, double q) {
  if (values.empty()) return unknown;
  const double place = q * static_cast<double>(values.size() - 1);
  const auto below = static_cast<std::size_t>(place);
  const auto at = values.begin() + static_cast<std::ptrdiff_t>(below);
  std::nth_element(values.begin(), at, values.end());
  const double low = *at;
  if (place == static_cast<double>(below)) return low;
  return low + (place - static_cast<double>(below)) * (*std::min_element(at + 1, values.end()) - low);
}

inline double median_of(std::vector<double> values) { return quantile(std::move(values), 0.5); }

/// Mean of many; NaN of none.
inline double mean_of(const std::vector<double>& values) {
  double sum = 0;
  for (const double value : values) sum += value;
  return values.empty() ? unknown : sum / static_cast<double>(values.size());
}

/// Sum of the squares about a middle.
inline double squares_about(const std::vector<double>& values, double middle) {
  double sum = 0;
  for (const double value : values) sum += (value - middle) * (value - middle);
  return sum;
}

/// 1.4826 times the median of the distances from the median: sigma of normal noise, whatever a few of them are.
inline double spread_about_median(const std::vector<double>& values) {
  const double middle = median_of(values);
  std::vector<double> away;
  away.reserve(values.size());
  for (const double value : values) away.push_back(std::fabs(value - middle));
  return 1.4826 * median_of(std::move(away));
}

/// Whether a pixel has a depth.
inline bool has_depth(const Depth& depth, std::size_t pixel) {
  return std::isfinite(depth.z_m[pixel]) && depth.z_m[pixel] > 0 && (depth.flags.empty() || (depth.flags[pixel] & flags_invalid) == 0);
}

/// The region's pixels as they lie in an image of that width, row by row.
inline std::vector<std::size_t> pixels_of(const ImageRegion& region, int width) {
  std::vector<std::size_t> out;
  out.reserve(static_cast<std::size_t>(region.width) * static_cast<std::size_t>(region.height));
  for (int row = region.v; row < region.v + region.height; ++row)
    for (int column = region.u; column < region.u + region.width; ++column)
      out.push_back(static_cast<std::size_t>(row) * static_cast<std::size_t>(width) + static_cast<std::size_t>(column));
  return out;
}

/// The region, or the whole image where it is empty. @throws Error (bad_input) where it is not in the image
ImageRegion region_within(const ImageRegion& region, int width, int height);

/// Refuses depth without z, or whose arrays are not of its size. @param whose  for messages: "frame 3"
void check_depth(const Depth& depth, const std::string& whose);

}  // namespace tofray::analysis
