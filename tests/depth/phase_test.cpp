// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <functional>
#include <vector>

#include "camera/decoder/wiggling.h"
#include "support/bench.h"

using namespace tofray;
using namespace tofray::test;

namespace {

/// Correlation of a half duty square with a 50 % square gate: a triangle of period 2π, 1 at 0.
double triangle(double phase) {
  const double turns = phase / two_pi - std::floor(phase / two_pi);
  return 1 - 4 * std::min(turns, 1 - turns);
}

/// Correlation at φ + τ_k → A−B of N raw frames, in double, then as floats.
std::vector<float> differences(int phases, double phase, const std::function<double(double)>& correlation, double signal = 10000) {
  std::vector<float> out;
  for (int k = 0; k < phases; ++k) out.push_back(static_cast<float>(signal * correlation(phase + two_pi * k / phases)));
  return out;
}

struct Swing {
  double worst_error = 0;                         ///< [rad]
  double smallest = 1e30, largest = 0, mean = 0;  ///< amplitude
};

/// The decoder's φ̂ − φ over many phases.
Swing swing(int phases, const std::function<double(double)>& correlation, int count = 100'000) {
  const Bench bench(bench_camera({60.24e6}, phases));
  Swing out;
  for (int i = 0; i < count; ++i) {
    const double phase = two_pi * i / count;
    const auto estimate =
        depth::estimate<float>(bench.decoder(), bench.decoder().modulation[0], differences(phases, phase, correlation).data());
    EXPECT_GE(estimate.turns, 0.0f);
    EXPECT_LT(estimate.turns, 1.0f);
    out.worst_error = std::max(out.worst_error, std::abs(wrapped(static_cast<double>(estimate.turns) - phase / two_pi)) * two_pi);
    const double amplitude = static_cast<double>(estimate.amplitude);
    out.smallest = std::min(out.smallest, amplitude), out.largest = std::max(out.largest, amplitude), out.mean += amplitude / count;
  }
  return out;
}

}  // namespace

// Single precision: the raw differences have 24 bits and the phase 24 bits of a turn, some 1e-6 rad together.
TEST(phase, of_a_pure_sine_has_no_bias_for_any_number_of_raw_frames) {
  for (const int phases : {3, 4, 5, 6, 8, 9}) {
    const Swing s = swing(phases, [](double x) { return 0.7 * std::cos(x); });
    EXPECT_LT(s.worst_error, 2e-6) << phases;
    EXPECT_NEAR(s.smallest, 7000, 0.01) << phases;
    EXPECT_NEAR(s.largest, 7000, 0.01) << phases;
    // the setup's own forward model, in double
    const camera::PhaseResponse exact({{1, 0.7, 0.0}}, [&] {
      std::vector<double> tau;
      for (int k = 0; k < phases; ++k) tau.push_back(two_pi * k / phases);
      return tau;
    }());
    double worst = 0;
    for (int i = 0; i < 100'000; ++i) worst = std::max(worst, std::abs(exact.at(two_pi * i / 100'000).error_rad));
    EXPECT_LT(worst, 1e-14) << phases;
  }
}

// D grows toward φ + τ = 0 and the phase grows with the path: with τ = 270° the difference of a quarter turn is at its top.
TEST(phase, grows_with_the_path) {
  const Bench bench(bench_camera());
  double before = 0;
  for (int i = 1; i < 100; ++i) {
    const double half_path = 2.488 * i / 100;
    const auto taps = bench.expose({10000, half_path, 0});
    const double turns = static_cast<double>(bench.estimate(taps).turns);
    EXPECT_GT(turns, before);
    EXPECT_NEAR(turns, 2 * half_path * 60.24e6 / c, 1e-6);
    before = turns;
  }
  const auto quarter = bench.expose({10000, 0.25 * c / (2 * 60.24e6), 0});
  EXPECT_NEAR(static_cast<double>(quarter[3].a - quarter[3].b), 7000, 0.01);
  EXPECT_NEAR(static_cast<double>(quarter[1].a - quarter[1].b), -7000, 0.01);
  for (const auto& taps : quarter) EXPECT_NEAR(static_cast<double>(taps.difference), static_cast<double>(taps.a - taps.b), 0.01);
}

TEST(phase, turns_by_half_where_the_taps_are_swapped) {
  const Bench bench(bench_camera());
  for (int i = 0; i < 1000; ++i) {
    auto difference = differences(4, two_pi * i / 1000, [](double x) { return std::cos(x); });
    const double turns =
        static_cast<double>(depth::estimate<float>(bench.decoder(), bench.decoder().modulation[0], difference.data()).turns);
    for (float& d : difference) d = -d;
    EXPECT_NEAR(
        wrapped(static_cast<double>(depth::estimate<float>(bench.decoder(), bench.decoder().modulation[0], difference.data()).turns) -
                turns - 0.5),
        0, 1e-7);
  }
}

TEST(phase, turns_round_where_the_order_of_the_raw_frames_is_reversed) {
  const Bench bench(bench_camera());
  for (int i = 0; i < 1000; ++i) {
    auto difference = differences(4, two_pi * i / 1000, [](double x) { return std::cos(x); });
    const double turns =
        static_cast<double>(depth::estimate<float>(bench.decoder(), bench.decoder().modulation[0], difference.data()).turns);
    std::swap(difference[1], difference[3]);
    EXPECT_NEAR(
        wrapped(static_cast<double>(depth::estimate<float>(bench.decoder(), bench.decoder().modulation[0], difference.data()).turns) +
                turns),
        0, 1e-7);
  }
}

// ε = atan2(−a₃ sin4φ, 1 + a₃ cos4φ), for four raw frames; at most asin a₃: 19.8889 mm for 0.05 at 60 MHz.
TEST(wiggling, of_a_third_harmonic_is_that_of_the_closed_form) {
  const double a3 = 0.05;
  const Bench bench(bench_camera({60e6}));
  double worst = 0, largest = 0;
  for (int i = 0; i < 100'000; ++i) {
    const double phase = two_pi * i / 100'000;
    const auto d = differences(4, phase, [&](double x) { return std::cos(x) + a3 * std::cos(3 * x); });
    const double error =
        wrapped(static_cast<double>(depth::estimate<float>(bench.decoder(), bench.decoder().modulation[0], d.data()).turns) -
                phase / two_pi) *
        two_pi;
    worst = std::max(worst, std::abs(error - std::atan2(-a3 * std::sin(4 * phase), 1 + a3 * std::cos(4 * phase))));
    largest = std::max(largest, std::abs(error));
  }
  EXPECT_LT(worst, 2e-6);
  EXPECT_NEAR(largest * c / (4 * pi * 60e6) * 1e3, 19.8889, 1e-3);
}

// All harmonics: the exact triangle.
TEST(wiggling, of_square_by_square_is_that_of_all_its_harmonics) {
  const struct {
    int phases;
    double error, ripple;
  } known[] = {{3, .019495, .14691}, {6, .019495, .14691}, {4, .071115, .36088}, {5, .004058, .05059}, {8, .008018, .08016}};
  for (const auto& k : known) {
    const Swing s = swing(k.phases, triangle);
    EXPECT_NEAR(s.worst_error, k.error, 1e-5) << k.phases;
    EXPECT_NEAR((s.largest - s.smallest) / s.mean, k.ripple, 1e-5) << k.phases;
  }
}

// The table takes all of it out: δ = ¼ with edge, gate pole and contrast of the pico flexx, for both its modulation frequencies.
TEST(wiggling, is_taken_out_by_the_table) {
  for (const double f : {80.32e6, 60.24e6}) {
    for (const bool correct : {true, false}) {
      Camera camera = bench_camera({f});
      auto& wave = camera.illumination[0].waveform;
      wave.kind = Waveform::Kind::rectangular, wave.duty = 0.25, wave.rise_time_s = 1e-9, wave.harmonics = 4;
      camera.pixel.contrast = {{f}, {0.75}}, camera.pixel.bandwidth_hz = 180e6;
      camera.decoding.wiggling_correction = correct;
      const Bench bench(camera);
      const double range = c / (2 * f);
      double worst = 0;
      for (int i = 0; i < 20'000; ++i) {
        const double half_path = range * (i + 0.5) / 20'000;
        const auto d = differences(4, two_pi * half_path / range, [&](double x) {
          double sum = 0;
          for (const int m : {1, 3, 5, 7}) {
            const auto sinc = [](double v) { return std::sin(pi * v) / (pi * v); };
            const double a = 4 / (pi * m) * std::sin(m * pi / 2) * sinc(0.25 * m) * sinc(m * f * 1e-9) * 0.75 /
                             std::sqrt(1 + std::pow(m * f / 180e6, 2));
            sum += a * std::cos(m * x - std::atan(m * f / 180e6));
          }
          return sum;
        });
        const double off = static_cast<double>(bench.decode(d).range) - half_path;
        worst = std::max(worst, std::abs(off - range * std::round(off / range)));
      }
      // [m]; 0.5 mm are asked for. Without the table the first harmonic's shift alone is taken out, and the wiggling is there.
      EXPECT_LT(worst, correct ? 2e-5 : 0.030) << f;
      EXPECT_GT(worst, correct ? 0 : 0.005) << f;
    }
  }
}

// The table is a line between 1,024 nodes. Against the exact correction half-way between them, where it is off the most: as much as the
// theory prints, to its last digit. (A table of 2,048 nodes has those as well, and each of its nodes is solved.)
TEST(wiggling, is_interpolated_to_a_few_micrometres) {
  for (const auto& [f, known] : {std::pair{80.32e6, 1.8e-6}, std::pair{60.24e6, 3.0e-6}}) {
    Camera camera = bench_camera({f});
    auto& wave = camera.illumination[0].waveform;
    wave.duty = 0.25, wave.rise_time_s = 1e-9, wave.harmonics = 4;
    camera.pixel.contrast = {{f}, {0.75}}, camera.pixel.bandwidth_hz = 180e6;
    const Bench bench(camera);
    ASSERT_EQ(bench.decoder().wiggling_nodes, 1024);
    const auto exact =
        camera::wiggling_table(camera::correlation_harmonics(wave, camera.pixel, f), {0, pi / 2, pi, 3 * pi / 2}, 2048).correction;
    double worst = 0;
    for (int j = 1; j < 2048; j += 2) {
      const float turns = static_cast<float>(j) / 2048;
      const float got = depth::unwiggle<float>(bench.decoder(), bench.decoder().modulation[0], turns).turns;
      worst = std::max(worst, std::abs(static_cast<double>(got) - j / 2048.0 - exact[static_cast<std::size_t>(j)]));
    }
    EXPECT_NEAR(worst * c / (2 * f), known, 0.15e-6) << f;  // of that 0.1 µm for single precision: 2^-25 turns
  }
}

// Radial motion, raw frames T apart: phases of φ_m + (k − 3/2)·4πfvT/c give ε = atan2(t·cos2φ_m, 1 + t·sin2φ_m), t = tan(2πfvT/c).
TEST(radial_motion, biases_the_phase_as_the_closed_form_says) {
  const Bench bench(bench_camera({60e6}));
  for (const auto& [speed, between] : {std::pair{1.0, 1e-3}, std::pair{-1.5, 4.1e-3}, std::pair{5.0, 4.1e-3}}) {
    const double step = 4 * pi * 60e6 * speed * between / c, t = std::tan(step / 2);
    double worst = 0, largest = 0;
    for (int i = 0; i < 10'000; ++i) {
      const double middle = two_pi * i / 10'000;
      std::vector<float> d;
      for (int k = 0; k < 4; ++k) d.push_back(static_cast<float>(1e4 * std::cos(middle + (k - 1.5) * step + k * pi / 2)));
      const double error =
          wrapped(static_cast<double>(depth::estimate<float>(bench.decoder(), bench.decoder().modulation[0], d.data()).turns) -
                  middle / two_pi) *
          two_pi;
      worst = std::max(worst, std::abs(error - std::atan2(t * std::cos(2 * middle), 1 + t * std::sin(2 * middle))));
      largest = std::max(largest, std::abs(error));
    }
    EXPECT_LT(worst, 2e-6);
    if (speed == 1.0) {
      EXPECT_NEAR(largest * c / (4 * pi * 60e6), 0.5e-3, 1e-6);  // vT/2
    }
  }
}
