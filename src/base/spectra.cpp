// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include "base/spectra.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>

#include "base/constants.h"
#include "tofray/error.h"

namespace tofray::base {

namespace {

constexpr double photopic_from_380_by_5[] = {
    0.000039, 0.000064, 0.000120, 0.000217, 0.000396, 0.000640, 0.001210, 0.002180, 0.004000, 0.007300,  // 380
    0.011600, 0.016840, 0.023000, 0.029800, 0.038000, 0.048000, 0.060000, 0.073900, 0.090980, 0.112600,  // 430
    0.139020, 0.169300, 0.208020, 0.258600, 0.323000, 0.407300, 0.503000, 0.608200, 0.710000, 0.793200,  // 480
    0.862000, 0.914850, 0.954000, 0.980300, 0.994950, 1.000000, 0.995000, 0.978600, 0.952000, 0.915400,  // 530
    0.870000, 0.816300, 0.757000, 0.694900, 0.631000, 0.566800, 0.503000, 0.441200, 0.381000, 0.321000,  // 580
    0.265000, 0.217000, 0.175000, 0.138200, 0.107000, 0.081600, 0.061000, 0.044580, 0.032000, 0.023200,  // 630
    0.017000, 0.011920, 0.008210, 0.005723, 0.004102, 0.002929, 0.002091, 0.001484, 0.001047, 0.000740,  // 680
    0.000520, 0.000361, 0.000249, 0.000172, 0.000120, 0.000085, 0.000060, 0.000042, 0.000030, 0.000021,  // 730
    0.000015,                                                                                            // 780
};

/// ∫ f over [a, b] by five Gauss–Legendre points: the roots of P_5 are 0 and ±√(5 ± 2√(10/7))/3.
double gauss_legendre(double a, double b, const std::function<double(double)>& f) {
  const double root = 2.0 * std::sqrt(10.0 / 7.0);
  const double inner = std::sqrt(5.0 - root) / 3.0, outer = std::sqrt(5.0 + root) / 3.0;
  const double part = 13.0 * std::sqrt(70.0);
  const double inner_weight = (322.0 + part) / 900.0, outer_weight = (322.0 - part) / 900.0;
  const double middle = 0.5 * (a + b), half = 0.5 * (b - a);
  const double sum = 128.0 / 225.0 * f(middle) + inner_weight * (f(middle - half * inner) + f(middle + half * inner)) +
                     outer_weight * (f(middle - half * outer) + f(middle + half * outer));
  return half * sum;
}

}  // namespace

void Spectrum::check() const {
  const auto refuse = [](const std::string& message) { throw Error(ErrorKind::bad_input, "error: " + message); };
  if (wavelength_m.size() != value.size() || value.size() < 2)
    refuse(fmt::format("a spectrum needs at least 2 samples, as many values as wavelengths\n  got {} wavelengths and {} values",
                       wavelength_m.size(), value.size()));
  for (std::size_t i = 0; i < value.size(); ++i) {
    if (!std::isfinite(wavelength_m[i]) || !std::isfinite(value[i]) || value[i] < 0 || wavelength_m[i] <= 0)
      refuse(fmt::format("sample {} of a spectrum makes no sense\n  got {} at {} m", i, value[i], wavelength_m[i]));
    if (i > 0 && !(wavelength_m[i] > wavelength_m[i - 1]))
      refuse(fmt::format("the wavelengths of a spectrum do not ascend\n  got {} m after {} m", wavelength_m[i], wavelength_m[i - 1]));
  }
}

double Spectrum::evaluate(double wavelength) const {
  if (!(wavelength >= wavelength_m.front() && wavelength <= wavelength_m.back())) return 0.0;
  const auto right = std::upper_bound(wavelength_m.begin() + 1, wavelength_m.end() - 1, wavelength);
  const auto i = static_cast<std::size_t>(right - wavelength_m.begin());
  const double share = (wavelength - wavelength_m[i - 1]) / (wavelength_m[i] - wavelength_m[i - 1]);
  return value[i - 1] + share * (value[i] - value[i - 1]);
}

const Spectrum& photopic() {
  static const Spectrum curve = [] {
    Spectrum spectrum;
    int nm = 380;
    for (const double efficiency : photopic_from_380_by_5) {
      spectrum.wavelength_m.push_back(nm / 1e9);
      spectrum.value.push_back(efficiency);
      nm += 5;
    }
    return spectrum;
  }();
  return curve;
}

double illuminance_lx(const Spectrum& irradiance) {
  const Spectrum& eye = photopic();
  const double flux = integrate(irradiance, eye.wavelength_m.front(), eye.wavelength_m.back(), eye.wavelength_m,
                                [&eye](double wavelength) { return eye.evaluate(wavelength); });
  return luminous_efficacy * flux;
}

double integrate(const Spectrum& spectrum, double from_m, double to_m, const std::vector<double>& knots,
                 const std::function<double(double)>& weight) {
  const double from = std::max(from_m, spectrum.wavelength_m.front());
  const double to = std::min(to_m, spectrum.wavelength_m.back());
  if (!(to > from)) return 0.0;
  std::vector<double> cuts{from, to};
  const auto cut = [&](const std::vector<double>& positions) {
    for (const double x : positions)
      if (x > from && x < to) cuts.push_back(x);
  };
  cut(spectrum.wavelength_m);
  cut(knots);
  std::sort(cuts.begin(), cuts.end());
  double sum = 0;
  for (std::size_t i = 1; i < cuts.size(); ++i)
    if (cuts[i] > cuts[i - 1]) sum += gauss_legendre(cuts[i - 1], cuts[i], [&](double x) { return spectrum.evaluate(x) * weight(x); });
  return sum;
}

}  // namespace tofray::base
