// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include "camera/lens/subpixel.h"

#include <algorithm>
#include <cmath>

#include "base/faults.h"

namespace tofray::camera {

namespace {

/// How much of the interval [a, b], in units of one of `cells` cells, each cell has: visit(cell, length).
template <class Visit>
void each_overlap(double a, double b, int cells, const Visit& visit) {
  const int first = std::max(static_cast<int>(std::floor(a)), 0), last = std::min(static_cast<int>(std::ceil(b)), cells);
  for (int i = first; i < last; ++i) {
    const double length = std::min(b, i + 1.0) - std::max(a, static_cast<double>(i));
    if (length > 0) visit(i, length);
  }
}

/// What the mask lets through of cell (row, column) of n × n.
double through_mask(const PixelMask& mask, int n, int row, int column) {
  const double height = static_cast<double>(mask.rows) / n, width = static_cast<double>(mask.columns) / n;
  double sum = 0;
  each_overlap(row * height, (row + 1) * height, mask.rows, [&](int y, double tall) {
    each_overlap(column * width, (column + 1) * width, mask.columns, [&](int x, double wide) {
      sum += tall * wide * mask.samples[static_cast<std::size_t>(y) * static_cast<std::size_t>(mask.columns) + static_cast<std::size_t>(x)];
    });
  });
  return sum;
}

}  // namespace

std::vector<SubpixelSample> subpixel_samples(const Sensor& sensor, int n) {
  const PixelMask& mask = sensor.mask;
  const bool masked = mask.kind == PixelMask::Kind::table;
  const double side = masked ? 1 : std::sqrt(sensor.fill_factor);
  const double largest = masked ? *std::max_element(mask.samples.begin(), mask.samples.end()) : 1;
  std::vector<SubpixelSample> out;
  double sum = 0;
  for (int row = 0; row < n; ++row) {
    for (int column = 0; column < n; ++column) {
      const double light = masked ? through_mask(mask, n, row, column) / largest : 1;
      if (!(light > 0)) continue;
      const auto place = [&](int i) { return ((i + 0.5) / n - 0.5) * side; };
      out.push_back({{place(column), place(row)}, light});
      sum += light;
    }
  }
  if (out.empty()) base::refuse("the pixel's mask lets no light through");
  for (SubpixelSample& sample : out) sample.share /= sum;
  return out;
}

}  // namespace tofray::camera
