// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
// Modulation frequencies that are swept over a band within each exposure.           [theory: spread-spectrum, spread-spectrum-down]
#include <gtest/gtest.h>

#include <cmath>

#include "backend/cpu/cpu.h"
#include "support/bench.h"
#include "support/pixels.h"

using namespace tofray;
using namespace tofray::test;

namespace {

using Band = SpreadSpectrum::Kind;
constexpr double swept_frequency = 60.24e6;

Camera swept(double width, Band kind, int harmonics = 1, int phases = 4) {
  Camera camera = bench_camera({swept_frequency}, phases, 0.7);
  camera.illumination[0].waveform.harmonics = harmonics;
  camera.spread_spectrum = {width, kind};
  return camera;
}

/// D/S of half a period's light against the gate, frequency by frequency: Σ_m 0.7/m²·cos m(2πfℓ/c + τ), the mean over the band.
double swept_difference(double half_path, double tau, double lowest, double highest, int harmonics) {
  constexpr int steps = 4000;
  double sum = 0;
  for (int i = 0; i < steps; ++i) {
    const double frequency = lowest + (highest - lowest) * (i + 0.5) / steps;
    for (int h = 0, m = 1; h < harmonics; ++h, m += 2) sum += 0.7 / (m * m) * std::cos(m * (two_pi * 2 * half_path * frequency / c + tau));
  }
  return sum / steps;
}

}  // namespace

// The midpoint rule of 4000 steps over some turns leaves 1e-6 of a cosine; single precision as much of the charge.
TEST(spread_spectrum, is_the_mean_over_the_band) {
  constexpr double signal = 20000;
  for (const int harmonics : {1, 4, 6}) {
    for (const double width : {0.001, 0.03, 0.4}) {
      for (const double half_path : {0.0, 0.3, 2.1, 9.0}) {
        const auto center = Bench(swept(width, Band::center, harmonics)).expose({signal, half_path, 100});
        const auto down = Bench(swept(width, Band::down, harmonics)).expose({signal, half_path, 100});
        for (std::size_t k = 0; k < 4; ++k) {
          const double tau = static_cast<double>(k) * pi / 2, half = 0.5 * width * swept_frequency;
          EXPECT_NEAR(static_cast<double>(center[k].difference) / signal,
                      swept_difference(half_path, tau, swept_frequency - half, swept_frequency + half, harmonics), 1e-5)
              << harmonics << " " << width << " " << half_path;
          EXPECT_NEAR(static_cast<double>(down[k].difference) / signal,
                      swept_difference(half_path, tau, swept_frequency - 2 * half, swept_frequency, harmonics), 1e-5)
              << harmonics << " " << width << " " << half_path;
          EXPECT_NEAR(static_cast<double>(center[k].a + center[k].b), signal + 100, 0.01);
        }
      }
    }
  }
}

// One harmonic: the amplitude is |sinc(Δf·ℓ/c)| of what it was, the range of a band about the modulation frequency what it was, and of one
// below it (1 − width/2) of that [theory: spread-spectrum, spread-spectrum-down].
TEST(spread_spectrum, takes_amplitude_with_the_distance_and_range_only_of_a_band_below) {
  for (const double width : {0.01, 0.05}) {
    for (const double half_path : {0.2, 1.1, 2.4}) {
      const double x = width * swept_frequency * 2 * half_path / c, left = std::sin(pi * x) / (pi * x);
      const auto plain = Bench(swept(0, Band::center)).measure({20000, half_path, 0}).depth;
      const auto center = Bench(swept(width, Band::center)).measure({20000, half_path, 0}).depth;
      const auto down = Bench(swept(width, Band::down)).measure({20000, half_path, 0}).depth;
      EXPECT_NEAR(static_cast<double>(center.amplitude / plain.amplitude), left, 2e-6);
      EXPECT_NEAR(static_cast<double>(down.amplitude / plain.amplitude), left, 2e-6);
      EXPECT_NEAR(static_cast<double>(center.range), half_path, 3e-6);
      EXPECT_NEAR(static_cast<double>(down.range), half_path * (1 - width / 2), 3e-6);
    }
  }
}

// Where a path is as long as c/Δf the band takes all of the first harmonic.
TEST(spread_spectrum, leaves_nothing_where_the_band_is_a_turn_wide) {
  const double width = 0.1, half_path = 0.5 * c / (width * swept_frequency);
  for (const auto& taps : Bench(swept(width, Band::center)).expose({20000, half_path, 0})) {
    EXPECT_NEAR(static_cast<double>(taps.difference), 0, 0.05);
  }
}

// Of two light sources each path has its own share of what is left: D adds up.
TEST(spread_spectrum, acts_on_each_path_by_its_length) {
  Camera camera = lit_camera(3, 1);
  camera.illumination.push_back(one_watt_per_steradian({0, 0, -6}));
  camera.adc = {16, 100, 32768, 0, 65535}, camera.lens.vignetting = Lens::Vignetting::off;
  camera.spread_spectrum = {0.2, Band::center};
  const auto both = expected_frame(wall(3), camera);
  std::vector<double> alone(12, 0.0);
  for (const std::size_t l : {std::size_t{0}, std::size_t{1}}) {
    Camera one = camera;
    one.illumination = {camera.illumination[l]};
    const Frame frame = expected_frame(wall(3), one);
    for (std::size_t i = 0; i < 12; ++i) alone[i] += static_cast<double>(frame.raw.tap_a[i]) - static_cast<double>(frame.raw.tap_b[i]);
    const double half_path = l == 0 ? 3 : 6, x = 0.2 * 60e6 * 2 * half_path / c, left = std::sin(pi * x) / (pi * x);
    const double light = static_cast<double>(frame.raw.tap_a[1]) + static_cast<double>(frame.raw.tap_b[1]);
    const double difference = static_cast<double>(frame.raw.tap_a[1]) - static_cast<double>(frame.raw.tap_b[1]);
    EXPECT_NEAR(difference / light, 2 / pi * left * std::cos(two_pi * 60e6 * 2 * half_path / c), 1e-5) << l;
  }
  for (std::size_t i = 0; i < 12; ++i) {
    const double light = static_cast<double>(both.raw.tap_a[i]) + static_cast<double>(both.raw.tap_b[i]);
    EXPECT_NEAR(static_cast<double>(both.raw.tap_a[i]) - static_cast<double>(both.raw.tap_b[i]), alone[i], 2e-6 * light);
  }
}

TEST(spread_spectrum, is_the_same_with_every_instruction_set_and_off_unless_given) {
  Camera camera = lit_camera(37, 3);
  camera.illumination[0].waveform.kind = Waveform::Kind::rectangular;
  const auto raw_with = [&](Isa isa) {
    return Simulator(wall(2), camera, {.seed = 7, .noise = Noise::exact, .threads = 1, .isa = isa}).frame(5).raw;
  };
  EXPECT_EQ(camera.spread_spectrum.width, 0);
  const Raw plain = raw_with(Isa::scalar);
  camera.spread_spectrum.kind = Band::down;  // of no width
  EXPECT_EQ(raw_with(Isa::scalar).tap_a, plain.tap_a);
  camera.spread_spectrum.width = 0.05;
  const Raw scalar = raw_with(Isa::scalar);
  EXPECT_NE(scalar.tap_a, plain.tap_a);
  for (const Isa isa : {Isa::scalar_fma, Isa::avx2, Isa::avx512}) {
    if (!backend::can_run(isa)) continue;
    EXPECT_EQ(raw_with(isa).tap_a, scalar.tap_a);
  }
}
