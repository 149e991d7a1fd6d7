// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <vector>

/// The law of a tap's charge, in double and without the code under test.
namespace tofray::test {

inline double normal_density(double z) { return std::exp(-z * z / 2) / std::sqrt(2 * std::numbers::pi); }

/// Poisson(λ) + Normal(0, σ²).
class NoiseLaw {
 public:
  NoiseLaw(double mean, double read) : read_(read) {
    const double spread = 11 * std::sqrt(mean) + 30;
    first_ = std::max(0.0, std::floor(mean - spread));
    for (double n = first_; n <= mean + spread; ++n)
      chance_.push_back(mean > 0 ? std::exp(n * std::log(mean) - mean - std::lgamma(n + 1)) : n == 0 ? 1.0 : 0.0);
  }
  [[nodiscard]] double density(double x) const {
    return sum(x, [&](double z) { return normal_density(z) / read_; });
  }
  /// P(N < x).
  [[nodiscard]] double below(double x) const {
    return sum(x, [](double z) { return 0.5 * std::erfc(-z / std::numbers::sqrt2); });
  }

 private:
  template <class OfNormal>
  [[nodiscard]] double sum(double x, const OfNormal& of) const {
    double out = 0;
    for (std::size_t i = 0; i < chance_.size(); ++i) out += chance_[i] * of((x - first_ - static_cast<double>(i)) / read_);
    return out;
  }

  double read_, first_ = 0;
  std::vector<double> chance_;
};

/// [theory: merged-noise] in double.
inline double expansion(double mean, double read, double z) {
  const double variance = mean + read * read, share = mean / variance;
  return mean + std::sqrt(variance) * z +
         share * ((z * z - 1) / 6 + z / std::sqrt(variance) * ((z * z - 3) / 24 - share * (2 * z * z - 5) / 36));
}

/// Slope of a charge over the normal number that it comes from.
template <class Charge>
double slope_of(const Charge& charge, double z) {
  return (charge(z + 1e-4) - charge(z - 1e-4)) / 2e-4;
}

/// Total variation between a law and that of a charge N(z) of a normal z: half of ∫|f − g| over x = N(z), where g·dx = φ(z)·dz.
template <class Charge>
double total_variation(const NoiseLaw& law, const Charge& charge) {
  constexpr double step = 0.01;
  double sum = 0;
  for (double z = -8; z < 8; z += step) sum += std::abs(law.density(charge(z)) * slope_of(charge, z) - normal_density(z)) * step;
  return sum / 2;
}

}  // namespace tofray::test
