// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include "camera/decoder/wiggling.h"

#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <string>
#include <vector>

#include "support/pi.h"
#include "tofray/error.h"

using tofray::camera::Harmonic;
using tofray::camera::PhaseResponse;
using tofray::camera::wiggling_table;
using tofray::test::pi;

namespace {

std::vector<double> equal_phases(int n, double first = 0) {
  std::vector<double> tau;
  for (int k = 0; k < n; ++k) tau.push_back(first + 2 * pi * k / n);
  return tau;
}

std::vector<Harmonic> triangle(int count) {
  std::vector<Harmonic> harmonics;
  for (int m = 1; m < 2 * count; m += 2) harmonics.push_back({m, 8 / (pi * pi * m * m), 0});
  return harmonics;
}

/// The pico flexx's at 80.32 MHz, roughly: strong phases, signs of both kinds.
std::vector<Harmonic> skewed() { return {{1, 0.777, -0.42}, {3, -0.05, -0.93}, {5, -0.011, -1.15}, {7, 0.004, -1.26}}; }

/// Ẑ as the camera makes it: the sum over raw frames, and each frame's sum over harmonics.
std::complex<double> demodulated(const std::vector<Harmonic>& harmonics, const std::vector<double>& tau, double phi) {
  std::complex<double> z = 0;
  for (const double t : tau) {
    double d = 0;
    for (const Harmonic& h : harmonics) d += h.amplitude * std::cos(h.order * (phi + t) + h.phase_rad);
    z += d * std::polar(2.0 / static_cast<double>(tau.size()), -t);
  }
  return z;
}

double wrapped(double angle) { return std::remainder(angle, 2 * pi); }

/// Square light against a square gate, in closed form: the correlation is a triangle.
struct SquareBySquare {
  double worst_error = 0, ripple = 0;
  explicit SquareBySquare(int n) {
    const int samples = 20 * 9 * 7 * 8 * 3;  // the extremes lie at fractions of a turn with small denominators
    double low = 1e9, high = 0, mean = 0;
    for (int i = 0; i < samples; ++i) {
      const double phi = 2 * pi * i / samples;
      std::complex<double> z = 0;
      for (const double t : equal_phases(n)) z += (1 - 2 * std::fabs(wrapped(phi + t)) / pi) * std::polar(2.0 / n, -t);
      worst_error = std::fmax(worst_error, std::fabs(wrapped(std::arg(z) - phi)));
      low = std::fmin(low, std::abs(z));
      high = std::fmax(high, std::abs(z));
      mean += std::abs(z) / samples;
    }
    ripple = (high - low) / mean;
  }
};

}  // namespace

TEST(phase_response, is_that_of_the_sum_over_raw_frames) {
  for (const int n : {3, 4, 5, 6, 8, 9})
    for (const double first : {0.0, 0.3}) {
      const auto tau = equal_phases(n, first);
      const PhaseResponse response(skewed(), tau);
      for (double phi = -1; phi < 8; phi += 0.0317) {
        const auto z = demodulated(skewed(), tau, phi);
        const auto value = response.at(phi);
        EXPECT_NEAR(wrapped(value.error_rad - (std::arg(z) - phi)), 0.0, 1e-14);
        EXPECT_NEAR(value.amplitude, std::abs(z), 1e-14);
        EXPECT_LT(std::fabs(value.error_rad + 0.42), 0.2);  // about ψ_1, no jump of 2π
        const double step = 1e-5;
        const double secant = 1 + (response.at(phi + step).error_rad - response.at(phi - step).error_rad) / (2 * step);
        EXPECT_NEAR(value.slope, secant, 1e-8);  // second-order difference: step² times a third derivative below 20
      }
    }
}

TEST(phase_response, a_pure_sine_has_no_error_for_any_number_of_phases) {
  for (const int n : {3, 4, 5, 6, 8, 9}) {
    const PhaseResponse response({{1, 0.7, 0}}, equal_phases(n));
    for (int i = 0; i < 10000; ++i) {
      const auto value = response.at(2 * pi * i / 10000);
      EXPECT_LT(std::fabs(value.error_rad), 1e-14);
      EXPECT_NEAR(value.slope, 1.0, 1e-14);
    }
  }
}

// Four phases, third harmonic only: ε = atan2(−a_3 sin 4φ, 1 + a_3 cos 4φ), at most asin a_3.
TEST(phase_response, third_harmonic_wiggles_four_times_per_period) {
  const double a3 = 0.05;
  const PhaseResponse response({{1, 1, 0}, {3, a3, 0}}, equal_phases(4));
  double worst = 0;
  for (int i = 0; i < 100000; ++i) {
    const double phi = pi / 2 * i / 100000;
    const double error = response.at(phi).error_rad;
    EXPECT_NEAR(error, std::atan2(-a3 * std::sin(4 * phi), 1 + a3 * std::cos(4 * phi)), 1e-14);
    worst = std::fmax(worst, std::fabs(error));
  }
  EXPECT_NEAR(worst, std::asin(a3), 1e-9);
  EXPECT_NEAR(worst * 299792458.0 / (4 * pi * 60e6) * 1e3, 19.8889, 5e-5);  // mm
}

// Four phases, third and fifth harmonic: ε = atan2((r_5 − r_3) sin 4φ, 1 + (r_3 + r_5) cos 4φ).
TEST(phase_response, fifth_harmonic_adds_to_the_third) {
  const double r3 = -0.111, r5 = -0.04;
  const PhaseResponse response({{1, 1.2, 0}, {3, 1.2 * r3, 0}, {5, 1.2 * r5, 0}}, equal_phases(4));
  for (double phi = 0; phi < 7; phi += 0.01)
    EXPECT_NEAR(response.at(phi).error_rad, std::atan2((r5 - r3) * std::sin(4 * phi), 1 + (r3 + r5) * std::cos(4 * phi)), 1e-14);
}

TEST(phase_response, only_harmonics_next_to_a_multiple_of_the_phases_leak) {
  for (const int n : {3, 4, 5, 6, 8, 9})
    for (int m = 2; m < 20; ++m) {
      const PhaseResponse response({{1, 1, 0}, {m, 0.1, 0.6}}, equal_phases(n));
      double worst = 0;
      for (double phi = 0; phi < 6.3; phi += 0.05) worst = std::fmax(worst, std::fabs(response.at(phi).error_rad));
      const bool leaks = m % n == 1 || m % n == n - 1;
      EXPECT_EQ(worst > 0.05, leaks) << n << " phases, harmonic " << m;
      EXPECT_EQ(worst > 1e-14, leaks) << n << " phases, harmonic " << m;
    }
}

// Known values of square light against a square gate: largest phase error [rad] and (largest − smallest)/mean amplitude.
TEST(phase_response, square_by_square_has_the_known_errors) {
  struct Known {
    int n;
    double error, ripple;
  };
  for (const Known& known : {Known{3, .019495, .14691}, Known{4, .071115, .36088}, Known{5, .004058, .05059}, Known{6, .019495, .14691},
                             Known{8, .008018, .08016}}) {
    const SquareBySquare oracle(known.n);
    EXPECT_NEAR(oracle.worst_error, known.error, 1e-6) << known.n;
    EXPECT_NEAR(oracle.ripple, known.ripple, 1e-5) << known.n;

    const PhaseResponse response(triangle(4000), equal_phases(known.n));
    double worst = 0, low = 1e9, high = 0, mean = 0;
    const int samples = 840;
    for (int i = 0; i < samples; ++i) {
      const auto value = response.at(2 * pi * i / samples);
      worst = std::fmax(worst, std::fabs(value.error_rad));
      low = std::fmin(low, value.amplitude);
      high = std::fmax(high, value.amplitude);
      mean += value.amplitude / samples;
    }
    EXPECT_NEAR(worst, known.error, 1e-5) << known.n;
    EXPECT_NEAR((high - low) / mean, known.ripple, 1e-4) << known.n;  // the triangle's tip, rounded off by 2/(π²·8000) per side
  }
}

// Both peak at 0.0711146 rad with four phases: 28.16 mm at 60.24 MHz, 21.12 mm at 80.32 MHz.
TEST(phase_response, quarter_duty_wiggles_as_much_as_half_duty) {
  std::vector<Harmonic> trapezoid;
  for (int m = 1; m < 8000; m += 2) {
    const double sign = m % 4 == 1 ? 1 : -1;
    trapezoid.push_back({m, sign * 16 / (pi * pi * m * m) * std::sin(pi * m / 4), 0});
  }
  for (const auto& harmonics : {triangle(4000), trapezoid}) {
    const PhaseResponse response(harmonics, equal_phases(4));
    double worst = 0;
    for (int i = 0; i < 1000; ++i) worst = std::fmax(worst, std::fabs(response.at(pi / 2 * i / 1000).error_rad));
    EXPECT_NEAR(worst, 0.0711146, 2e-6);
    EXPECT_NEAR(worst * 299792458.0 / (4 * pi * 60.24e6), 28.16e-3, 1e-5);
  }
}

TEST(wiggling_correction, takes_every_node_back_to_the_true_phase) {
  for (const int n : {3, 4, 5, 8})
    for (const auto& harmonics : {skewed(), triangle(4), std::vector<Harmonic>{{1, 1, 3.0}, {3, 0.1, 0}, {5, -0.06, 2}}}) {
      const auto tau = equal_phases(n);
      const auto table = wiggling_table(harmonics, tau).correction;
      ASSERT_EQ(table.size(), 1024u);
      for (int j = 0; j < 1024; ++j) {
        const double measured = j / 1024.0;
        const double phase = measured + table[static_cast<std::size_t>(j)];
        const double again = std::arg(demodulated(harmonics, tau, 2 * pi * phase)) / (2 * pi);
        EXPECT_NEAR(std::remainder(again - measured, 1.0), 0.0, 1e-12) << n << " " << j;
      }
    }
}

// Four phases, closed form with third and fifth harmonic: the node's true phase put in gives the correction back.
TEST(wiggling_correction, inverts_the_closed_form) {
  const double r3 = 0.1, r5 = 0.04;
  const auto table = wiggling_table({{1, 1, 0}, {3, r3, 0}, {5, r5, 0}}, equal_phases(4), 360).correction;
  for (std::size_t j = 0; j < 360; ++j) {
    const double phi = 2 * pi * (static_cast<double>(j) / 360 + table[j]);
    const double error = std::atan2((r5 - r3) * std::sin(4 * phi), 1 + (r3 + r5) * std::cos(4 * phi));
    EXPECT_NEAR(table[j], -error / (2 * pi), 1e-12);
  }
}

// Five phases: the fifth harmonic does not leak, the ninth does by its Q: ε = atan2(−r_9 sin 10φ, 1 + r_9 cos 10φ).
TEST(wiggling_correction, inverts_the_closed_form_for_five_phases) {
  const double r9 = 0.03;
  const auto table = wiggling_table({{1, 1, 0}, {5, 0.2, 0}, {9, r9, 0}}, equal_phases(5), 500).correction;
  for (std::size_t j = 0; j < 500; ++j) {
    const double phi = 2 * pi * (static_cast<double>(j) / 500 + table[j]);
    EXPECT_NEAR(table[j], -std::atan2(-r9 * std::sin(10 * phi), 1 + r9 * std::cos(10 * phi)) / (2 * pi), 1e-12);
  }
}

TEST(wiggling_correction, of_a_sine_is_its_phase_alone) {
  for (const double psi : {-0.42, 3.1, -3.1})
    for (const double value : wiggling_table({{1, 0.6, psi}}, equal_phases(4)).correction) EXPECT_NEAR(value, -psi / (2 * pi), 1e-15);
}

TEST(wiggling_correction, has_no_jumps) {
  for (const double psi : {0.0, 1.5, 3.14, -3.14}) {
    auto harmonics = skewed();
    for (Harmonic& h : harmonics) h.phase_rad += psi * h.order;  // a delay
    const auto table = wiggling_table(harmonics, equal_phases(4)).correction;
    for (std::size_t j = 0; j < table.size(); ++j) EXPECT_LT(std::fabs(table[j] - table[(j + 1) % table.size()]), 0.3 / 1024) << psi;
  }
}

TEST(wiggling_correction, is_the_same_whatever_the_order_of_the_phases) {
  const auto one = wiggling_table(skewed(), equal_phases(4)).correction;
  const auto other = wiggling_table(skewed(), {pi, 0, 3 * pi / 2, pi / 2}).correction;
  for (std::size_t j = 0; j < one.size(); ++j) EXPECT_NEAR(one[j], other[j], 1e-14);
}

TEST(wiggling_correction, refuses_a_curve_that_turns_back) {
  const auto refusal = [](const std::vector<Harmonic>& harmonics, const std::vector<double>& tau, int nodes) -> std::string {
    try {
      wiggling_table(harmonics, tau, nodes);
    } catch (const tofray::Error& error) {
      EXPECT_EQ(error.kind(), tofray::ErrorKind::bad_input);
      return error.what();
    }
    return "not refused";
  };
  // With r = r_3 alone, dφ̂/dφ is smallest where cos 4φ = 1: (1 − 3r)/(1 + r), negative from r = 1/3 on.
  EXPECT_EQ(refusal({{1, 1, 0}, {3, 0.33, 0}}, equal_phases(4), 1024), "not refused");
  EXPECT_NE(refusal({{1, 1, 0}, {3, 0.34, 0}}, equal_phases(4), 1024).find("does not grow"), std::string::npos);
  EXPECT_NE(refusal({{1, 1, 0}, {3, 1.0, 0}}, equal_phases(4), 1024).find("does not grow"), std::string::npos);
  EXPECT_NE(refusal({{1, 0, 0}, {3, 0.1, 0}}, equal_phases(4), 1024).find("first harmonic"), std::string::npos);
  EXPECT_NE(refusal({}, equal_phases(4), 1024).find("first harmonic"), std::string::npos);
  EXPECT_NE(refusal(skewed(), {0, pi}, 1024).find("at least 3 reference phases"), std::string::npos);
  EXPECT_NE(refusal(skewed(), equal_phases(4), 1).find("at least 2 nodes"), std::string::npos);
}
