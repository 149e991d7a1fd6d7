// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include "camera/pixel/waveform.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>
#include <string>

#include "support/pi.h"
#include "tofray/error.h"

using tofray::Pixel;
using tofray::Waveform;
using tofray::camera::correlation_harmonics;
using tofray::test::pi;

namespace {

Pixel ideal_pixel() {
  Pixel pixel;
  pixel.contrast = {{0.0}, {1.0}};
  return pixel;
}

Pixel pico_flexx_pixel() {
  Pixel pixel;
  pixel.contrast = {{80e6}, {0.75}};
  pixel.bandwidth_hz = 180e6;
  return pixel;
}

Waveform rectangular(double duty, int harmonics) {
  Waveform waveform;
  waveform.duty = duty;
  waveform.harmonics = harmonics;
  return waveform;
}

Waveform pico_flexx_waveform() {
  Waveform waveform = rectangular(0.25, 4);
  waveform.rise_time_s = 1e-9;
  return waveform;
}

/// The correlation itself, from first principles: the overlap of a light pulse with the gate q = ±1, by counting samples of one period.
double overlap(double duty, double angle) {
  const int samples = 1 << 20;
  double sum = 0;
  for (int i = 0; i < samples; ++i) {
    const double x = (i + 0.5) / samples - 0.5;
    if (std::fabs(x) >= duty / 2) continue;
    const double at = x + angle / (2 * pi);
    sum += std::cos(2 * pi * at) > 0 ? 1 : -1;  // square gate centred on zero
  }
  return sum / (duty * samples);
}

std::string refusal(const std::function<void()>& act) {
  try {
    act();
  } catch (const tofray::Error& error) {
    EXPECT_EQ(error.kind(), tofray::ErrorKind::bad_input);
    return error.what();
  }
  return "not refused";
}

}  // namespace

TEST(correlation_harmonics, of_a_half_duty_square_are_those_of_a_triangle) {
  const auto harmonics = correlation_harmonics(rectangular(0.5, 1000), ideal_pixel(), 60e6);
  ASSERT_EQ(harmonics.size(), 1000u);
  for (const auto& h : harmonics)  // error: that of sin at π·order/2, over order
    EXPECT_NEAR(h.amplitude, 8 / (pi * pi * h.order * h.order), 2e-15 / h.order) << h.order;
  EXPECT_NEAR(harmonics[0].amplitude, 0.810569, 5e-7);
  EXPECT_EQ(harmonics[999].order, 1999);
}

// The known values to the digits printed.
TEST(correlation_harmonics, of_a_quarter_duty_square_are_the_known_values) {
  const double known[] = {1.146318, -0.127369, -0.045853, 0.023394, 0.014152};
  const auto harmonics = correlation_harmonics(rectangular(0.25, 5), ideal_pixel(), 60e6);
  ASSERT_EQ(harmonics.size(), 5u);
  for (std::size_t i = 0; i < 5; ++i) {
    EXPECT_EQ(harmonics[i].order, static_cast<int>(2 * i + 1));
    EXPECT_NEAR(harmonics[i].amplitude, known[i], 5e-7);
    EXPECT_EQ(harmonics[i].phase_rad, 0.0);
  }
}

TEST(correlation_harmonics, add_up_to_the_overlap_of_light_and_gate) {
  for (const double duty : {0.25, 0.5, 0.31}) {
    const auto harmonics = correlation_harmonics(rectangular(duty, 2000), ideal_pixel(), 60e6);
    for (const double angle : {0.0, 0.4, 1.1, 2.0, 3.0, 4.4}) {
      double sum = 0;
      for (const auto& h : harmonics) sum += h.amplitude * std::cos(h.order * angle + h.phase_rad);
      // What is cut off is below Σ 4/(π²δm²) over m > 4000, i.e. 2/(π²δ·4000); the count errs by two samples.
      EXPECT_NEAR(sum, overlap(duty, angle), 3e-4) << duty << " " << angle;
    }
  }
}

TEST(correlation_harmonics, of_the_pico_flexx_are_the_known_values) {
  const auto fast = correlation_harmonics(pico_flexx_waveform(), pico_flexx_pixel(), 80.32e6);
  const auto slow = correlation_harmonics(pico_flexx_waveform(), pico_flexx_pixel(), 60.24e6);
  ASSERT_EQ(fast.size(), 4u);
  EXPECT_NEAR(fast[0].amplitude, 0.776815, 5e-7);
  EXPECT_NEAR(fast[0].phase_rad, -0.419708, 5e-7);
  EXPECT_NEAR(slow[0].amplitude, 0.810435, 5e-7);
  EXPECT_NEAR(slow[0].phase_rad, -0.322950, 5e-7);
  // The offset in half the path, c/(4πf)·ψ_1: 125 mm.
  EXPECT_NEAR(fast[0].phase_rad * 299792458.0 / (4 * pi * 80.32e6), -0.125, 5e-4);
}

TEST(correlation_harmonics, every_factor_acts_on_its_own) {
  const double f = 50e6;
  const auto plain = correlation_harmonics(rectangular(0.4, 4), ideal_pixel(), f);
  const auto compare = [&](const Waveform& waveform, const Pixel& pixel, auto gain, auto phase) {
    const auto harmonics = correlation_harmonics(waveform, pixel, f);
    ASSERT_EQ(harmonics.size(), 4u);
    for (std::size_t i = 0; i < 4; ++i) {
      const int m = plain[i].order;
      EXPECT_NEAR(harmonics[i].amplitude, plain[i].amplitude * gain(m), 1e-15) << m;
      EXPECT_NEAR(harmonics[i].phase_rad, phase(m), 1e-15) << m;
    }
  };
  const auto none = [](int) { return 0.0; };

  Waveform waveform = rectangular(0.4, 4);
  waveform.rise_time_s = 1.5e-9;
  compare(
      waveform, ideal_pixel(), [&](int m) { return std::sin(pi * m * f * 1.5e-9) / (pi * m * f * 1.5e-9); }, none);

  waveform = rectangular(0.4, 4);
  waveform.jitter_s = 2e-10;
  compare(
      waveform, ideal_pixel(), [&](int m) { return std::exp(-0.5 * std::pow(2 * pi * m * f * 2e-10, 2)); }, none);

  // Slow light: every harmonic comes later, as from a longer path (φ + atan).
  waveform = rectangular(0.4, 4);
  waveform.bandwidth_hz = 120e6;
  const auto pole = [&](int m) { return 1 / std::hypot(1.0, m * f / 120e6); };
  compare(waveform, ideal_pixel(), pole, [&](int m) { return std::atan(m * f / 120e6); });

  Pixel pixel = ideal_pixel();
  pixel.bandwidth_hz = 120e6;
  compare(rectangular(0.4, 4), pixel, pole, [&](int m) { return -std::atan(m * f / 120e6); });

  pixel = ideal_pixel();
  pixel.contrast = {{20e6, 100e6}, {0.9, 0.5}};
  compare(
      rectangular(0.4, 4), pixel, [](int) { return 0.75; }, none);  // a line, at 50 MHz
}

TEST(correlation_harmonics, contrast_is_held_outside_its_samples) {
  Pixel pixel = ideal_pixel();
  pixel.contrast = {{20e6, 60e6, 100e6}, {0.9, 0.8, 0.5}};
  const double first = correlation_harmonics(rectangular(0.5, 1), ideal_pixel(), 60e6)[0].amplitude;
  EXPECT_NEAR(correlation_harmonics(rectangular(0.5, 1), pixel, 5e6)[0].amplitude, 0.9 * first, 1e-15);
  EXPECT_NEAR(correlation_harmonics(rectangular(0.5, 1), pixel, 300e6)[0].amplitude, 0.5 * first, 1e-15);
}

/// Light 1 + d·cos against the gate q = ±1, by counting samples of one period.
double sine_overlap(double depth, double angle) {
  const int samples = 1 << 20;
  double sum = 0;
  for (int i = 0; i < samples; ++i) {
    const double x = 2 * pi * (i + 0.5) / samples;
    sum += (1 + depth * std::cos(x)) * (std::cos(x + angle) > 0 ? 1 : -1);
  }
  return sum / samples;
}

// A cosine in the angle, and nothing else: 2d/π·cos. Each of the gate's two edges can be a sample off: 2·2/2^20 at most.
TEST(correlation_harmonics, of_a_sine_are_the_overlap_of_a_cosine_and_the_gate) {
  for (const double depth : {1.0, 0.6}) {
    Waveform waveform;
    waveform.kind = Waveform::Kind::sine, waveform.modulation_depth = depth;
    const auto harmonics = correlation_harmonics(waveform, ideal_pixel(), 60e6);
    ASSERT_EQ(harmonics.size(), 1u);
    EXPECT_NEAR(harmonics[0].amplitude, 2 * depth / pi, 1e-15);
    EXPECT_EQ(harmonics[0].phase_rad, 0.0);
    for (const double angle : {0.0, 0.4, 1.1, 2.0, 3.0, 4.4})
      EXPECT_NEAR(harmonics[0].amplitude * std::cos(angle), sine_overlap(depth, angle), 4e-6) << depth << " " << angle;
  }
}

// Poles, jitter and contrast act on a sine; duty and edges it has none.
TEST(correlation_harmonics, of_a_sine_have_poles_jitter_and_contrast_but_no_duty_and_no_edges) {
  const double f = 80.32e6;
  Waveform waveform = pico_flexx_waveform();
  waveform.kind = Waveform::Kind::sine;
  waveform.bandwidth_hz = 250e6, waveform.jitter_s = 1e-10;
  const auto harmonics = correlation_harmonics(waveform, pico_flexx_pixel(), f);
  ASSERT_EQ(harmonics.size(), 1u);
  EXPECT_EQ(harmonics[0].order, 1);
  const double poles = std::hypot(1.0, f / 180e6) * std::hypot(1.0, f / 250e6), jitter = std::exp(-0.5 * std::pow(2 * pi * f * 1e-10, 2));
  EXPECT_NEAR(harmonics[0].amplitude, 2 / pi / poles * jitter * 0.75, 1e-15);
  EXPECT_NEAR(harmonics[0].phase_rad, std::atan(f / 250e6) - std::atan(f / 180e6), 1e-15);
}

// A rectangle cut off after its first harmonic is another thing: 8/π² at half duty.
TEST(correlation_harmonics, of_a_rectangle_can_be_cut_off_after_the_first) {
  const auto harmonics = correlation_harmonics(rectangular(0.5, 1), ideal_pixel(), 60e6);
  ASSERT_EQ(harmonics.size(), 1u);
  EXPECT_NEAR(harmonics[0].amplitude, 8 / (pi * pi), 1e-15);
}

TEST(correlation_harmonics, of_a_measured_curve_are_its_fourier_coefficients) {
  const double amplitude[] = {0.8, 0.11, 0.04, 0.02}, phase[] = {-0.4, 2.1, -3.0, 0.7};
  Waveform waveform;
  waveform.kind = Waveform::Kind::measured;
  for (int k = 0; k < 32; ++k) {
    const double tau = 2 * pi * k / 32;
    double sum = 0.05 + 0.005 * std::cos(2 * tau + 1);  // an offset and an even harmonic are none of ours
    for (int i = 0; i < 4; ++i) sum += amplitude[i] * std::cos((2 * i + 1) * tau + phase[i]);
    waveform.correlation.push_back(sum);
  }
  const auto harmonics = correlation_harmonics(waveform, pico_flexx_pixel(), 80.32e6);
  ASSERT_EQ(harmonics.size(), 4u);
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_NEAR(harmonics[i].amplitude, amplitude[i], 1e-15);
    EXPECT_NEAR(harmonics[i].phase_rad, phase[i], 2e-14);  // 1e-16 over an amplitude of 0.02
  }
  waveform.correlation.resize(8);
  EXPECT_EQ(correlation_harmonics(waveform, pico_flexx_pixel(), 80.32e6).size(), 2u);  // 1 and 3 lie below 8/2
}

TEST(correlation_harmonics, refuse_what_makes_no_sense) {
  const auto message = [](Waveform waveform, double f) { return refusal([&] { correlation_harmonics(waveform, ideal_pixel(), f); }); };
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (const double f : {0.0, -1.0, nan, std::numeric_limits<double>::infinity()})
    EXPECT_NE(message(rectangular(0.5, 4), f).find("modulation frequency must be above zero"), std::string::npos);
  for (const double duty : {0.0, 1.0, -0.1, nan}) EXPECT_NE(message(rectangular(duty, 4), 1e6).find("duty"), std::string::npos);
  EXPECT_NE(message(rectangular(0.5, 0), 1e6).find("at least one harmonic"), std::string::npos);
  for (const double depth : {0.0, 1.01, -0.1, nan}) {
    Waveform sine;
    sine.kind = Waveform::Kind::sine, sine.modulation_depth = depth;
    EXPECT_NE(message(sine, 1e6).find("modulation depth"), std::string::npos);
  }
  Waveform measured;
  measured.kind = Waveform::Kind::measured;
  measured.correlation = {1, -1};
  EXPECT_NE(message(measured, 1e6).find("at least 3 samples"), std::string::npos);
  measured.correlation = {1, 0, nan, 0};
  EXPECT_NE(message(measured, 1e6).find("sample 2"), std::string::npos);
  measured.correlation = {nan, 0, 1, 0};
  EXPECT_NE(message(measured, 1e6).find("sample 0"), std::string::npos);
  EXPECT_NE(refusal([] { correlation_harmonics(rectangular(0.5, 4), Pixel{}, 1e6); }).find("contrast has no samples"), std::string::npos);
}
