// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include "base/periodic.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/constants.h"
#include "base/spline.h"

namespace tofray::base {

namespace {
// A spline of n samples has images of harmonic m at n − m, n + m, 2n − m …, which fall with the fourth power of the harmonic. So many points
// fold next to nothing of them back onto others. The images themselves stay, and those at n − m are even where n and m are odd.
constexpr std::size_t resampled = 4096;

/// Amplitude of harmonic m of equally spaced samples of one period.
double amplitude_of(const std::vector<double>& samples, std::size_t m) {
  const std::size_t n = samples.size();
  double real = 0, imaginary = 0;
  for (std::size_t k = 0; k < n; ++k) {
    const double angle = two_pi * static_cast<double>(m * k % n) / static_cast<double>(n);
    real += samples[k] * std::cos(angle), imaginary += samples[k] * std::sin(angle);
  }
  return 2 * std::hypot(real, imaginary) / static_cast<double>(n);
}
}  // namespace

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

double even_share_of_few(const std::vector<double>& samples, std::size_t measured, std::size_t most) {
  double even = 0, odd = 0, falling = 0;
  for (std::size_t m = 1; 2 * m < measured; m += 2) {
    const double amplitude = amplitude_of(samples, m);
    odd += amplitude * amplitude;
    if (4 * m > measured) falling = std::max(falling, amplitude * static_cast<double>(m));
  }
  for (std::size_t m = 2; 2 * m < measured && m <= most; m += 2) {
    const double image = falling / static_cast<double>(measured - m), own = std::max(amplitude_of(samples, m) - image, 0.0);
    even += own * own;
  }
  if (!(even > 0)) return 0;
  return odd > 0 ? std::sqrt(even / odd) : std::numeric_limits<double>::infinity();
}

}  // namespace tofray::base
