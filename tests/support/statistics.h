// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cmath>
#include <cstddef>
#include <vector>

#include "support/pi.h"

/// What tests of random numbers need, in double and without the code under test.
namespace tofray::test {

constexpr double c = 299792458.0;  ///< [m/s]

/// Mean and central moments of a stream of numbers, about a guess of the mean so that nothing cancels.
class Moments {
 public:
  explicit Moments(double guess = 0) : guess_(guess) {}
  void add(double x) {
    const double d = x - guess_;
    ++count_, first_ += d, second_ += d * d, third_ += d * d * d;
  }
  [[nodiscard]] double count() const { return count_; }
  [[nodiscard]] double mean() const { return guess_ + first_ / count_; }
  [[nodiscard]] double variance() const { return (second_ - first_ * first_ / count_) / (count_ - 1); }
  [[nodiscard]] double deviation() const { return std::sqrt(variance()); }
  [[nodiscard]] double skewness() const {
    const double m = first_ / count_, v = second_ / count_ - m * m;
    return (third_ / count_ - 3 * m * second_ / count_ + 2 * m * m * m) / std::pow(v, 1.5);
  }

 private:
  double guess_, count_ = 0, first_ = 0, second_ = 0, third_ = 0;
};

/// Correlation coefficient of a stream of pairs.
class Correlation {
 public:
  Correlation(double guess_x, double guess_y) : gx_(guess_x), gy_(guess_y) {}
  void add(double x, double y) {
    x -= gx_, y -= gy_;
    ++n_, x_ += x, y_ += y, xx_ += x * x, yy_ += y * y, xy_ += x * y;
  }
  [[nodiscard]] double r() const { return (xy_ - x_ * y_ / n_) / std::sqrt((xx_ - x_ * x_ / n_) * (yy_ - y_ * y_ / n_)); }
  /// r in units of its standard error where nothing is correlated.
  [[nodiscard]] double z() const { return r() * std::sqrt(n_); }

 private:
  double gx_, gy_, n_ = 0, x_ = 0, y_ = 0, xx_ = 0, yy_ = 0, xy_ = 0;
};

/// χ² of counts against their expectations as a standard normal: (χ² − k)/√(2k), k = cells − 1. Neighbouring cells are pooled until at
/// least 20 are expected, so that the normal holds; Wilson and Hilferty's cube root takes out the skew.
inline double chi_square_z(const std::vector<double>& seen, const std::vector<double>& expected) {
  double chi = 0, cells = 0, s = 0, e = 0, rest_s = 0, rest_e = 0;
  for (std::size_t i = 0; i < seen.size(); ++i) {
    s += seen[i], e += expected[i];
    if (e < 20) continue;
    rest_s = s, rest_e = e;
    chi += (s - e) * (s - e) / e, ++cells;
    s = 0, e = 0;
  }
  // what is left over joins the last cell
  if (e > 0 || s > 0)
    chi += (rest_s + s - rest_e - e) * (rest_s + s - rest_e - e) / (rest_e + e) - (rest_s - rest_e) * (rest_s - rest_e) / rest_e;
  const double k = cells - 1, spread = 2 / (9 * k);
  return (std::cbrt(chi / k) - (1 - spread)) / std::sqrt(spread);
}

}  // namespace tofray::test
