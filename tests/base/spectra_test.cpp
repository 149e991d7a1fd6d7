// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include "base/spectra.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

#include "base/constants.h"
#include "tofray/error.h"

using tofray::base::integrate;
using tofray::base::photopic;
using tofray::base::Spectrum;
using tofray::base::sun_am15;

namespace {

/// W m⁻² nm⁻¹, mean of the tabulated values, both ends included.
double mean_of_samples(int from_nm, int to_nm) {
  double sum = 0;
  for (int nm = from_nm; nm <= to_nm; ++nm) sum += sun_am15().evaluate(nm / 1e9) / 1e9;
  return sum / (to_nm - from_nm + 1);
}

double power(double from_nm, double to_nm) {
  return integrate(sun_am15(), from_nm * 1e-9, to_nm * 1e-9, {}, [](double) { return 1.0; });
}

}  // namespace

TEST(constants, are_those_of_the_si) {
  EXPECT_NEAR(tofray::base::photon_energy_length, 1.98644586e-25, 0.5e-33);
  EXPECT_NEAR(tofray::base::two_pi, 2 * std::acos(-1.0), 1e-15);
}

TEST(sun_am15, has_the_known_means_in_the_two_near_infrared_bands) {
  EXPECT_NEAR(mean_of_samples(835, 865), 0.982, 5e-4);
  EXPECT_NEAR(mean_of_samples(925, 955), 0.373, 5e-4);
}

// Of the published grid by the trapezoidal rule, as the standard does; of these some 46 lie below 400 nm and 8 beyond 2500 nm.
TEST(sun_am15, adds_up_to_the_standard_sun) {
  EXPECT_NEAR(power(0, 1e5), 1000.37, 0.005);
  EXPECT_NEAR(power(280, 400), 46.10, 0.005);
  EXPECT_NEAR(power(2500, 4000), 7.79, 0.005);
}

// Samples of the published table, two from each of its grids. In the bands of water a coarser grid finds other lines.
TEST(sun_am15, holds_the_published_values) {
  const auto at = [](double nm) { return sun_am15().evaluate(nm / 1e9) / 1e9; };
  for (const auto& [nm, published] : {std::pair{299.5, 0.00086068},
                                      {391.5, 0.86344},
                                      {550.0, 1.5399},
                                      {1113.0, 0.26850},
                                      {1416.0, 0.035565},
                                      {1702.0, 0.20396},
                                      {1775.0, 0.11484},
                                      {2245.0, 0.070838},
                                      {3535.0, 0.0094556},
                                      {4000.0, 0.0071043}})
    EXPECT_NEAR(at(nm), published, 1e-9 * published) << nm;  // 1e-9: nm / 1e9 is rounded
  EXPECT_NEAR(power(1380, 1420), 0.10975, 1e-5);             // the trapezoidal rule by hand; thinned to 5 nm: 0.0266
}

// An ideal silicon cell (every photon up to 1107 nm makes one electron) delivers 43.8 mA/cm² under this spectrum.
TEST(sun_am15, drives_the_known_current_through_an_ideal_cell) {
  using namespace tofray::base;
  const double current = integrate(sun_am15(), 280e-9, 1107e-9, {}, [](double x) { return x / photon_energy_length * elementary_charge; });
  EXPECT_NEAR(current / 10, 43.8, 0.1);  // A/m² to mA/cm²
}

TEST(sun_am15, ascends_and_is_nowhere_negative) {
  EXPECT_NO_THROW(sun_am15().check());
  EXPECT_EQ(sun_am15().wavelength_m.size(), 2002u);
  EXPECT_EQ(sun_am15().evaluate(279e-9), 0.0);
  EXPECT_EQ(sun_am15().evaluate(4001e-9), 0.0);
}

TEST(photopic, has_the_known_sum_and_peak) {
  const auto& value = photopic().value;
  EXPECT_NEAR(std::accumulate(value.begin(), value.end(), 0.0), 21.3713, 1e-4);  // CIE's sum at every 5 nm
  EXPECT_EQ(photopic().evaluate(555e-9), 1.0);
  EXPECT_NEAR(photopic().evaluate(507.5e-9), (0.4073 + 0.5030) / 2, 1e-9);  // the middle of a line
}

TEST(illuminance, of_equal_energy_is_that_of_the_curve_s_sum) {
  const Spectrum flat{{280e-9, 4000e-9}, {1e9, 1e9}};
  EXPECT_NEAR(tofray::base::illuminance_lx(flat), 683 * 5 * 21.371327, 0.1);  // the trapezoid's half ends: 683·5·2.7e-5 lx
}

TEST(illuminance, of_the_standard_sun_is_that_of_a_clear_day) { EXPECT_NEAR(tofray::base::illuminance_lx(sun_am15()), 109.5e3, 0.5e3); }

TEST(integrate, is_exact_for_polynomials_up_to_degree_eight_times_a_line) {
  const Spectrum line{{1, 2, 5}, {1, 3, 0}};
  for (int degree = 0; degree <= 8; ++degree) {
    // ∫_1^2 (2x − 1) x^d + ∫_2^4 (5 − x) x^d
    const double d = degree;
    const auto part = [d](double slope, double offset, double a, double b) {
      return slope * (std::pow(b, d + 2) - std::pow(a, d + 2)) / (d + 2) + offset * (std::pow(b, d + 1) - std::pow(a, d + 1)) / (d + 1);
    };
    const double right = part(2, -1, 1, 2) + part(-1, 5, 2, 4);
    EXPECT_NEAR(integrate(line, 0, 4, {}, [degree](double x) { return std::pow(x, degree); }) / right, 1.0, 1e-14) << degree;
  }
}

TEST(integrate, takes_the_weight_s_knots_into_account) {
  const Spectrum flat{{0, 10}, {2, 2}};
  const auto step = [](double x) { return x < 3.3 ? 1.0 : 0.0; };
  EXPECT_NEAR(integrate(flat, -5, 20, {3.3, 77, -3}, step), 6.6, 1e-14);
  EXPECT_EQ(integrate(flat, 11, 12, {}, step), 0.0);
  EXPECT_EQ(integrate(flat, 3, 2, {}, step), 0.0);
}

TEST(spectrum, refuses_samples_that_make_none) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (const Spectrum& bad : {Spectrum{{1}, {1}}, Spectrum{{1, 2}, {1}}, Spectrum{{2, 1}, {1, 1}}, Spectrum{{1, 1}, {1, 1}},
                              Spectrum{{1, 2}, {1, nan}}, Spectrum{{1, 2}, {1, -1}}, Spectrum{{0, 2}, {1, 1}}})
    EXPECT_THROW(bad.check(), tofray::Error);
}
