// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
// Lights that are no rectangles: trapezoid, Gaussian pulse, measured emission, and correlations measured anywhere in the period.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <functional>
#include <string>
#include <vector>

#include "base/periodic.h"
#include "camera/pixel/waveform.h"
#include "support/pi.h"
#include "tofray/tofray.h"

using namespace tofray;
using tofray::camera::correlation_harmonics;
using tofray::camera::Harmonic;
using tofray::test::pi;
using tofray::test::two_pi;

namespace {

constexpr double pulse_frequency = 50e6, pulse_period = 1 / pulse_frequency;

Pixel pixel_without_faults() {
  Pixel pixel;
  pixel.contrast = {{0.0}, {1.0}};
  return pixel;
}

std::vector<Harmonic> harmonics_of(Waveform waveform, int count) {
  waveform.harmonics = count;
  return correlation_harmonics(waveform, pixel_without_faults(), pulse_frequency);
}

/// The sum that the simulator makes of them for a path of phase `angle`: D/S.
double summed(const std::vector<Harmonic>& harmonics, double angle) {
  double sum = 0;
  for (const Harmonic& h : harmonics) sum += h.amplitude * std::cos(h.order * angle + h.phase_rad);
  return sum;
}

/// The same from first principles: light p(t) comes late by the angle, the gate q = ±1 is open for A around t = 0. Counted at 2^18 times.
double counted(const std::function<double(double)>& light, double angle) {
  constexpr int times = 1 << 18;
  double difference = 0, both = 0;
  for (int i = 0; i < times; ++i) {
    const double turn = (i + 0.5) / times - 0.5, of_light = turn - angle / two_pi;
    const double p = light((of_light - std::floor(of_light + 0.5)) * pulse_period);
    difference += std::cos(two_pi * turn) > 0 ? p : -p, both += p;
  }
  return difference / both;
}

Waveform trapezoid(double duty, double rise_s, double fall_s) {
  Waveform waveform;
  waveform.kind = Waveform::Kind::trapezoid, waveform.duty = duty, waveform.rise_time_s = rise_s, waveform.fall_time_s = fall_s;
  return waveform;
}

Waveform emission(const std::function<double(double)>& light, int count, bool uneven = false) {
  Waveform waveform;
  waveform.kind = Waveform::Kind::emission;
  for (int i = 0; i < count; ++i) {
    const double phase = two_pi * (i + (uneven ? 0.3 * std::sin(7.0 * i) : 0.0)) / count;
    if (uneven) waveform.sample_phases_rad.push_back(phase);
    waveform.emission.push_back(light(phase));
  }
  return waveform;
}

std::string refused(const std::function<void()>& act) {
  try {
    act();
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::bad_input);
    return error.what();
  }
  return "taken";
}

std::complex<double> phasor_of(const Harmonic& h) { return std::polar(1.0, h.phase_rad) * h.amplitude; }

}  // namespace

// What is cut off behind 2000 harmonics is below 1e-4 where edges are not sharp; the count errs by a sample at each of the gate's edges.
TEST(pulses, of_trapezoids_are_the_overlap_of_light_and_gate) {
  for (const auto& [duty, rise, fall] : {std::array{0.25, 1e-9, 4e-9}, std::array{0.4, 5e-9, 1e-10}, std::array{0.5, 2e-9, 2e-9}}) {
    const auto light = [duty = duty, rise = rise, fall = fall](double t) {
      const double up = (t + 0.5 * duty * pulse_period) / rise + 0.5, down = (t - 0.5 * duty * pulse_period) / fall + 0.5;
      return std::clamp(up, 0.0, 1.0) - std::clamp(down, 0.0, 1.0);
    };
    const auto harmonics = harmonics_of(trapezoid(duty, rise, fall), 2000);
    for (const double angle : {0.0, 0.4, 1.1, 1.6, 2.0, 3.0, 4.4})
      EXPECT_NEAR(summed(harmonics, angle), counted(light, angle), 2e-4) << angle;
  }
}

TEST(pulses, of_trapezoids_with_equal_edges_are_those_of_the_rectangle_with_edges) {
  Waveform rectangle;
  rectangle.duty = 0.3, rectangle.rise_time_s = 3e-9;
  const auto expected = harmonics_of(rectangle, 8), got = harmonics_of(trapezoid(0.3, 3e-9, 3e-9), 8);
  for (std::size_t i = 0; i < 8; ++i) EXPECT_LT(std::abs(phasor_of(got[i]) - phasor_of(expected[i])), 1e-15) << i;
}

// A late fall is light that comes later: the path looks longer.
TEST(pulses, with_a_slow_fall_look_farther_away_and_with_a_slow_rise_nearer) {
  EXPECT_GT(harmonics_of(trapezoid(0.3, 1e-9, 5e-9), 1)[0].phase_rad, 0);
  EXPECT_LT(harmonics_of(trapezoid(0.3, 5e-9, 1e-9), 1)[0].phase_rad, 0);
}

TEST(pulses, of_trapezoids_whose_edges_do_not_fit_are_refused) {
  EXPECT_EQ(refused([] { harmonics_of(trapezoid(0.25, 4e-9, 6e-9), 4); }), "taken");  // pulse of 5 ns: just so
  EXPECT_NE(refused([] { harmonics_of(trapezoid(0.25, 4.1e-9, 6e-9), 4); }).find("do not fit into its pulse or its pause"),
            std::string::npos);
  EXPECT_NE(refused([] { harmonics_of(trapezoid(0.75, 4.1e-9, 6e-9), 4); }).find("do not fit into its pulse or its pause"),
            std::string::npos);
}

// a_m = 4/(πm)·sin(mπ/2)·exp(−2π²m²f²σ²), and the overlap of a Gaussian and a gate: sums of its distribution function.
TEST(pulses, of_a_gaussian_are_its_closed_form_and_the_overlap_of_light_and_gate) {
  for (const double sigma : {0.5e-9, 1.5e-9, 4e-9}) {
    Waveform waveform;
    waveform.kind = Waveform::Kind::gaussian, waveform.sigma_s = sigma;
    const auto harmonics = harmonics_of(waveform, 200);
    for (std::size_t i = 0; i < 4; ++i) {
      const int m = static_cast<int>(2 * i + 1);
      const double expected = (m % 4 == 1 ? 4 : -4) / (pi * m) * std::exp(-2 * pi * pi * m * m * std::pow(pulse_frequency * sigma, 2));
      EXPECT_NEAR(harmonics[i].amplitude, expected, 1e-15) << m;
      EXPECT_EQ(harmonics[i].phase_rad, 0);
    }
    for (const double angle : {0.0, 0.7, 1.5, 2.2, 3.1, 5.0}) {
      double share_of_a = 0;  // gates A are open from (k − ¼)T to (k + ¼)T
      for (int k = -8; k <= 8; ++k) {
        const auto below = [&](double t) { return 0.5 * std::erfc((angle / two_pi * pulse_period - t) / (std::sqrt(2.0) * sigma)); };
        share_of_a += below((k + 0.25) * pulse_period) - below((k - 0.25) * pulse_period);
      }
      EXPECT_NEAR(summed(harmonics, angle), 2 * share_of_a - 1, 1e-12) << sigma << " " << angle;
    }
  }
}

// Light 1 + Σ r_m cos(mx + β_m): a_m·e^{iψ_m} = 2/(πm)·sin(mπ/2)·r_m·e^{−iβ_m}. The even harmonic meets no gate, and any unit will do.
TEST(pulses, of_a_measured_emission_are_the_odd_harmonics_of_the_light) {
  const auto light = [](double x) { return 7 * (1 + 0.6 * std::cos(x + 0.4) + 0.3 * std::cos(2 * x) + 0.1 * std::cos(3 * x - 1)); };
  const auto fine = harmonics_of(emission(light, 32), 2), uneven = harmonics_of(emission(light, 64, true), 2);
  const std::complex<double> expected[] = {std::polar(2 / pi * 0.6, -0.4), std::polar(2 / (3 * pi) * 0.1, 1.0 + pi)};
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_LT(std::abs(phasor_of(fine[i]) - expected[i]), 1e-15) << i;
    // A cubic spline of step h errs by some 5/384·h⁴·|p''''|, here 6e-5 of the mean at gaps of 0.16, and its harmonics by much less.
    EXPECT_LT(std::abs(phasor_of(uneven[i]) - expected[i]), 2e-5) << i;
  }
}

// Poles, jitter and contrast belong to what light and gate make of each other, whatever the light is.
TEST(pulses, have_poles_jitter_and_contrast) {
  Pixel pixel = pixel_without_faults();
  pixel.contrast = {{0.0}, {0.8}}, pixel.bandwidth_hz = 180e6;
  const auto light = [](double x) { return 1 + 0.6 * std::cos(x + 0.4); };
  for (Waveform waveform : {trapezoid(0.3, 1e-9, 3e-9), emission(light, 16)}) {
    const Harmonic plain = harmonics_of(waveform, 1)[0];
    waveform.harmonics = 1, waveform.bandwidth_hz = 250e6, waveform.jitter_s = 1e-10;
    const Harmonic got = correlation_harmonics(waveform, pixel, pulse_frequency)[0];
    const double poles = std::hypot(1.0, pulse_frequency / 180e6) * std::hypot(1.0, pulse_frequency / 250e6);
    EXPECT_NEAR(got.amplitude, plain.amplitude * 0.8 / poles * std::exp(-0.5 * std::pow(two_pi * pulse_frequency * 1e-10, 2)), 1e-15);
    EXPECT_NEAR(got.phase_rad, plain.phase_rad + std::atan(pulse_frequency / 250e6) - std::atan(pulse_frequency / 180e6), 1e-15);
  }
}

TEST(pulses, of_a_correlation_measured_at_uneven_phases_are_its_fourier_coefficients) {
  Waveform waveform;
  waveform.kind = Waveform::Kind::measured;
  for (int i = 0; i < 90; ++i) {
    const double tau = 1.0 + two_pi * (i + 0.3 * std::sin(5.0 * i)) / 90;  // from anywhere on
    waveform.sample_phases_rad.push_back(tau);
    waveform.correlation.push_back(0.02 + 0.8 * std::cos(tau - 0.4) + 0.11 * std::cos(3 * tau + 2.1));
  }
  const auto harmonics = harmonics_of(waveform, 2);
  EXPECT_LT(std::abs(phasor_of(harmonics[0]) - std::polar(0.8, -0.4)), 2e-5);
  EXPECT_LT(std::abs(phasor_of(harmonics[1]) - std::polar(0.11, 2.1)), 2e-5);
}

TEST(contrast, follows_the_wavelength_of_each_light) {
  Pixel pixel = pixel_without_faults();
  pixel.contrast = {{60e6}, {0.8}}, pixel.contrast_by_wavelength = {{850e-9, 940e-9}, {1, 0.6}};
  Illumination light;
  for (const auto& [wavelength, factor] : {std::pair{850e-9, 1.0}, {895e-9, 0.8}, {940e-9, 0.6}, {1000e-9, 0.6}}) {
    light.illumination_wavelength_m = wavelength;
    EXPECT_NEAR(correlation_harmonics(light, pixel, 60e6)[0].amplitude, 8 / (pi * pi) * 0.8 * factor, 1e-15) << wavelength;
  }
  light.waveform.kind = Waveform::Kind::measured;  // has it in itself
  for (int k = 0; k < 8; ++k) light.waveform.correlation.push_back(std::cos(two_pi * k / 8));
  light.waveform.harmonics = 1;
  EXPECT_NEAR(correlation_harmonics(light, pixel, 60e6)[0].amplitude, 1, 1e-15);
}

// Harmonics 1 and 2 of amplitudes 1 and e: the share is e. A mean is no harmonic.
TEST(even_harmonics, are_told_from_odd_ones_without_a_transform) {
  for (const double e : {0.0, 0.009, 0.3}) {
    std::vector<double> samples;
    for (int k = 0; k < 40; ++k) samples.push_back(0.2 + std::cos(two_pi * k / 40 + 0.3) + e * std::cos(2 * two_pi * k / 40 + 1));
    EXPECT_NEAR(base::even_share(samples), e, 1e-15);
  }
  EXPECT_EQ(base::even_share({1, 1, 1, 1}), 0);
  EXPECT_TRUE(std::isinf(base::even_share({1, -1, 1, -1})));
}

TEST(even_harmonics, of_a_measured_correlation_are_refused_above_one_per_cent) {
  const auto camera = [](double even, int count, bool uneven) {
    Camera out = load_camera("pico-flexx");
    Waveform& waveform = out.illumination[0].waveform;
    waveform = {};
    waveform.kind = Waveform::Kind::measured, waveform.harmonics = 1;
    for (int k = 0; k < count; ++k) {
      const double tau = two_pi * (k + (uneven ? 0.2 * std::sin(3.0 * k) : 0.0)) / count;
      if (uneven) waveform.sample_phases_rad.push_back(tau);
      waveform.correlation.push_back(0.7 * std::cos(tau) + 0.7 * even * std::cos(2 * tau + 1));
    }
    return out;
  };
  for (const int count : {48, 49}) {
    for (const bool uneven : {false, true}) {
      const auto told = [&](double even) {
        return refused([&] { Simulator(load_scene("card"), camera(even, count, uneven), {.threads = 1}); });
      };
      EXPECT_EQ(told(0.0098), "taken") << count << uneven;
      EXPECT_NE(told(0.0102).find("the correlation has even harmonics"), std::string::npos) << count << uneven << told(0.0102);
      EXPECT_NE(told(0.3).find("got 30 % of the odd ones"), std::string::npos) << count << uneven << told(0.3);
    }
  }
}

// Of an odd number of samples harmonic m beyond them shows as n − m, which is even: those of a sound triangle are none of its own.
TEST(even_harmonics, of_a_triangle_are_none_however_many_samples_it_has) {
  const auto told = [](int count, int harmonics, double even, bool phases) {
    Camera camera = load_camera("pico-flexx");
    Waveform& waveform = camera.illumination[0].waveform;
    waveform = {};
    waveform.kind = Waveform::Kind::measured, waveform.harmonics = harmonics;
    for (int k = 0; k < count; ++k) {
      const double turn = static_cast<double>(k) / count;
      waveform.correlation.push_back(0.7 * (1 - 4 * std::min(turn, 1 - turn)) + 0.7 * even * std::cos(2 * two_pi * turn + 1));
      if (phases) waveform.sample_phases_rad.push_back(two_pi * turn);
    }
    return refused([&] { Simulator(load_scene("card"), camera, {.threads = 1}); });
  };
  for (const bool phases : {false, true}) {
    for (int count = 15; count <= 31; ++count) {
      for (const int harmonics : {1, 2, 4}) {
        EXPECT_EQ(told(count, harmonics, 0, phases), "taken") << count << " " << harmonics << phases;
        const std::string even = told(count, harmonics, 0.06, phases);
        EXPECT_NE(even.find("the correlation has even harmonics"), std::string::npos) << count << " " << harmonics << phases << even;
      }
    }
  }
  EXPECT_NE(told(15, 4, 0.06, false).find("measure at an even number of equally spaced phases"), std::string::npos);
  EXPECT_EQ(told(16, 4, 0.06, false).find("measure at an even number"), std::string::npos);
}

TEST(pulses, with_samples_that_make_no_sense_are_refused) {
  const auto told = [](const std::function<void(Waveform&)>& change) {
    Camera camera = load_camera("pico-flexx");
    Waveform& waveform = camera.illumination[0].waveform;
    waveform = emission([](double x) { return 1 + std::cos(x); }, 16, true);
    change(waveform);
    return refused([&] { Simulator(load_scene("card"), camera, {.threads = 1}); });
  };
  EXPECT_EQ(told([](Waveform&) {}), "taken");
  EXPECT_NE(told([](Waveform& w) { w.sample_phases_rad.pop_back(); }).find("not as many phases as samples"), std::string::npos);
  EXPECT_NE(told([](Waveform& w) { std::swap(w.sample_phases_rad[3], w.sample_phases_rad[4]); }).find("do not ascend"), std::string::npos);
  EXPECT_NE(told([](Waveform& w) { w.sample_phases_rad.back() = w.sample_phases_rad.front() + two_pi; }).find("more than a period"),
            std::string::npos);
  EXPECT_NE(told([](Waveform& w) { std::fill(w.emission.begin(), w.emission.end(), 0); }).find("the emission is nowhere above 0"),
            std::string::npos);
  EXPECT_NE(told([](Waveform& w) { w.harmonics = 5; }).find("too few samples of the emission"), std::string::npos);
  EXPECT_NE(told([](Waveform& w) { w.emission[2] = -1; }).find("emission"), std::string::npos);
}
