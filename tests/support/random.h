// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cmath>
#include <cstdint>
#include <random>

#include "base/vec.h"

/// Random numbers for tests: raw words of a generator that the standard fixes to the last bit, so that a seed always means the same run.
namespace tofray::test {

class Random {
 public:
  explicit Random(std::uint64_t seed) : words_(seed) {}
  /// In [0, 1).
  double uniform() { return static_cast<double>(words_() >> 11) * 0x1p-53; }
  double between(double low, double high) { return low + (high - low) * uniform(); }
  /// Even on a logarithmic scale.
  double scale(double low, double high) { return low * std::pow(high / low, uniform()); }
  int below(int n) { return static_cast<int>(uniform() * n); }
  /// In the cube of this half width.
  Vec3 point(double half) { return {between(-half, half), between(-half, half), between(-half, half)}; }
  /// Uniform over the unit sphere.
  Vec3 direction() {
    const double z = between(-1, 1), angle = between(0, 2 * std::acos(-1.0)), rim = std::sqrt(1 - z * z);
    return {rim * std::cos(angle), rim * std::sin(angle), z};
  }
  /// A unit vector at right angles to n.
  Vec3 across(const Vec3& n) {
    Vec3 side = base::cross(n, direction());
    while (base::length(side) < 1e-3) side = base::cross(n, direction());
    return base::normalized(side);
  }
  /// Rows of a random rotation.
  base::Mat3 rotation() {
    const Vec3 x = direction();
    const Vec3 y = across(x);
    return {{x, y, base::cross(x, y)}};
  }

 private:
  std::mt19937_64 words_;
};

}  // namespace tofray::test
