// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include "base/periodic.h"

#include <cmath>
#include <limits>

#include "base/constants.h"
#include "base/spline.h"

namespace tofray::base {

namespace {
constexpr std::size_t resampled = 4096;  // a spline of n samples has next to nothing beyond harmonic n: what folds back is far below 1e-6
}

std::vector<double> over_a_period(const std::vector<double>& phases_rad, const std::vector<double>& samples) {
  if (phases_rad.empty() && samples.size() % 2 == 0) return samples;
  std::vector<double> x, y = samples, out;
  for (std::size_t i = 0; i < samples.size(); ++i)
    x.push_back(phases_rad.empty() ? static_cast<double>(i) / static_cast<double>(samples.size()) : phases_rad[i] / two_pi);
  if (!samples.empty()) x.push_back(x.front() + 1), y.push_back(samples.front());
  const Spline spline(x, y, Spline::Kind::periodic);
  for (std::size_t i = 0; i < resampled; ++i) out.push_back(spline.evaluate(static_cast<double>(i) / resampled));
  return out;
}

double even_share(const std::vector<double>& samples) {
  const std::size_t half = samples.size() / 2;
  double mean = 0, even = 0, odd = 0;
  for (const double sample : samples) mean += sample / static_cast<double>(samples.size());
  for (std::size_t i = 0; i < half; ++i) {
    const double sum = 0.5 * (samples[i] + samples[i + half]) - mean, difference = 0.5 * (samples[i] - samples[i + half]);
    even += sum * sum, odd += difference * difference;
  }
  if (!(even > 0)) return 0;
  return odd > 0 ? std::sqrt(even / odd) : std::numeric_limits<double>::infinity();
}

}  // namespace tofray::base
