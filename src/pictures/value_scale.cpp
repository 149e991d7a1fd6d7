// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include "pictures/value_scale.h"

#include <algorithm>
#include <cmath>

#include "base/constants.h"

namespace tofray::pictures {

std::vector<double> right_z(const Depth& depth, const Truth& truth, const Raw& raw) {
  const std::vector<double> all(depth.z_m.begin(), depth.z_m.end());
  double highest_hz = 0;
  for (std::size_t k = 0; k < std::min(raw.lit.size(), raw.modulation_frequency_hz.size()); ++k)
    if (raw.lit[k] != 0) highest_hz = std::max(highest_hz, raw.modulation_frequency_hz[k]);
  if (!(highest_hz > 0) || truth.z_m.size() != all.size()) return all;
  const double half_cycle = base::speed_of_light / (4 * highest_hz);
  std::vector<double> right;
  for (std::size_t i = 0; i < all.size(); ++i)
    if (std::abs(all[i] - static_cast<double>(truth.z_m[i])) < half_cycle) right.push_back(all[i]);
  return right.empty() ? all : right;
}

PictureScale length_scale(const std::vector<double>& metres) {
  return round_scale(percentile(metres, 0.01, 0), percentile(metres, 0.99, 1), 0.1);
}

PictureScale strength_scale(const std::vector<double>& values) { return round_scale(0, percentile(values, 0.995, 1), 1e-3); }

PictureScale noise_scale(const std::vector<double>& millimetres) { return round_scale(0, percentile(millimetres, 0.98, 1), 0.1); }

ErrorScale error_scale(const std::vector<double>& millimetres) {
  std::vector<double> magnitudes;
  for (const double value : millimetres) magnitudes.push_back(std::abs(value));
  // One wrong cycle is metres: where more than 2 % are wrong, the 98th percentile shows them alone.
  const double most = percentile(magnitudes, 0.98, 1), usual = 3 * percentile(magnitudes, 0.68, 1);
  const double bound = std::min(most, usual);
  ErrorScale out{round_scale(-bound, bound, 0.2), most <= usual};
  out.scale.low = -out.scale.high;
  return out;
}

}  // namespace tofray::pictures
