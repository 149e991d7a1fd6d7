// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
// Light of another camera of the same kind at the same place.  [theory: interference, interference-known-phase, interference-free-clocks]
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "backend/cpu/cpu.h"
#include "support/pixels.h"
#include "support/statistics.h"

using namespace tofray;
using namespace tofray::test;

namespace {

constexpr double other_frequency = 60e6, other_exposure = 1e-3, other_readout = 0.3e-3, other_frame_rate = 10;
constexpr double other_phase = two_pi * 2 * other_frequency / c;  // φ of a wall at 1 m

/// Four phases, and a grey raw frame behind them.
Camera beside(const Interference& other, Waveform::Kind waveform = Waveform::Kind::sine, int width = 1) {
  Camera camera = lit_camera(width, 1);
  camera.illumination[0].waveform.kind = waveform;
  camera.lens.vignetting = Lens::Vignetting::off;
  camera.mode.sequence.push_back({false, 0, 0, other_exposure});
  camera.readout_time_s = other_readout, camera.mode.frame_rate_hz = other_frame_rate;
  camera.adc = {16, 100, 32768, 0, 65535};
  camera.interference = other;
  return camera;
}

Raw raw_beside(const Camera& camera, std::uint64_t frame = 0, Noise noise = Noise::off, std::uint64_t seed = 7) {
  return Simulator(wall(1), camera, {.seed = seed, .noise = noise, .threads = 1}).frame(frame).raw;
}
/// Both taps of a raw frame of the first pixel [e⁻].
struct BothTaps {
  double sum, difference;
};
BothTaps both_taps_of(const Raw& raw, std::size_t k, std::size_t pixel = 0) {
  const std::size_t at = k * raw.tap_a.size() / 5 + pixel;
  const double a = static_cast<double>(raw.tap_a[at]), b = static_cast<double>(raw.tap_b[at]);
  return {a + b, a - b};
}
double own_electrons() { return both_taps_of(raw_beside(beside({})), 0).sum; }

/// Σ_m a_m·cos mx of the own light against the gate: of a sine 2/π, of half a period's light a triangle's first four, 8/(π²m²).
double correlation_at(double x, Waveform::Kind waveform) {
  if (waveform == Waveform::Kind::sine) return 2 / pi * std::cos(x);
  double sum = 0;
  for (int m = 1; m < 9; m += 2) sum += 8 / (pi * pi * m * m) * std::cos(m * x);
  return sum;
}
/// What the other's light correlates to in a raw frame, moment by moment of its exposure: its phase stood at `phase` when frame 0 began.
double other_correlation(double phase, double difference_hz, std::uint64_t frame, std::size_t k, Waveform::Kind waveform) {
  constexpr int moments = 20000;
  const double begin = static_cast<double>(frame) / other_frame_rate + static_cast<double>(k) * (other_exposure + other_readout);
  double sum = 0;
  for (int i = 0; i < moments; ++i) {
    const double time = begin + (i + 0.5) / moments * other_exposure;
    sum += correlation_at(other_phase + static_cast<double>(k) * pi / 2 + phase - two_pi * difference_hz * time, waveform);
  }
  return sum / moments;
}

}  // namespace

// Single precision leaves some 1e-6 of the charge; 20000 moments of 2.3 turns of the seventh harmonic and more leave 1e-7 of the mean.
TEST(interference, is_what_its_light_correlates_to_moment_by_moment) {
  const double own = own_electrons();
  for (const auto waveform : {Waveform::Kind::sine, Waveform::Kind::rectangular}) {
    for (const double difference_hz : {0.0, 7.0, -240.0, 2330.0}) {
      const Camera camera = beside({0.3, difference_hz, 1, 1.1}, waveform);
      for (const std::uint64_t frame : {0, 3}) {
        const Raw raw = raw_beside(camera, frame);
        for (std::size_t k = 0; k < 4; ++k) {
          const double expected = correlation_at(other_phase + static_cast<double>(k) * pi / 2, waveform) +
                                  0.3 * other_correlation(1.1, difference_hz, frame, k, waveform);
          const BothTaps taps = both_taps_of(raw, k);
          EXPECT_NEAR(taps.difference / own, expected, 3e-6) << difference_hz << " " << frame << " " << k;
          EXPECT_NEAR(taps.sum / own, 1.3, 3e-6);
        }
        EXPECT_NEAR(both_taps_of(raw, 4).sum / own, 0.3, 1e-6);  // the grey raw frame: its light alone, all on tap A
        EXPECT_NEAR(both_taps_of(raw, 4).difference / own, 0.3, 1e-6);
      }
    }
  }
}

// Two modulation frequencies, whose light has harmonics: each raw frame has the phasors of its own.
TEST(interference, has_the_phasors_of_each_modulation_frequency) {
  constexpr double share = 0.3, phase = 1.1;
  Camera camera = beside({share, 0, 1, phase}, Waveform::Kind::rectangular);
  camera.mode.sequence.clear();
  for (const double hz : {other_frequency, 80e6})
    for (int k = 0; k < 4; ++k) camera.mode.sequence.push_back({true, hz, k * pi / 2, other_exposure});
  const Raw raw = raw_beside(camera);
  for (std::size_t k = 0; k < 8; ++k) {
    const double x = two_pi * 2 * (k < 4 ? other_frequency : 80e6) / c + static_cast<double>(k % 4) * pi / 2;
    const double expected = correlation_at(x, Waveform::Kind::rectangular) + share * correlation_at(x + phase, Waveform::Kind::rectangular);
    EXPECT_NEAR((static_cast<double>(raw.tap_a[k]) - static_cast<double>(raw.tap_b[k])) / own_electrons(), expected, 3e-6) << k;
  }
}

// arg(1 + s·e^{iθ}) [theory: interference-known-phase]: at a quarter of a turn atan(s), at most asin(s).
TEST(interference, of_a_known_phase_pulls_the_range_by_the_closed_form) {
  for (const double share : {0.02, 0.3}) {
    for (const double phase : {0.0, 0.7, pi / 2, pi / 2 + std::asin(share), pi, -pi / 2}) {
      const Camera camera = beside({share, 0, 1, phase});
      const double pulled = c / (4 * pi * other_frequency) * std::atan2(share * std::sin(phase), 1 + share * std::cos(phase));
      EXPECT_NEAR(static_cast<double>(expected_frame(wall(1), camera).depth.range_m[0]), 1 + pulled, 2e-6) << share << " " << phase;
    }
  }
}

// A whole number of turns within an exposure leaves nothing but light; x + ½ of them 1/(π(x + ½)).
TEST(interference, is_gone_where_the_frequencies_are_far_enough_apart) {
  for (const double turns : {1.0, 2.0, 1000.0}) {
    const Raw raw = raw_beside(beside({1, turns / other_exposure, 1, 0.4}));
    for (std::size_t k = 0; k < 4; ++k) {
      EXPECT_NEAR(both_taps_of(raw, k).difference / own_electrons(), 2 / pi * std::cos(other_phase + static_cast<double>(k) * pi / 2),
                  3e-6);
      EXPECT_NEAR(both_taps_of(raw, k).sum / own_electrons(), 2, 3e-6);
    }
  }
  const double half = both_taps_of(raw_beside(beside({1, 1.5 / other_exposure, 1, 0})), 0).difference / own_electrons();
  EXPECT_NEAR(std::abs(half - 2 / pi * std::cos(other_phase)), 2 / pi / (1.5 * pi) * std::abs(std::cos(other_phase - 1.5 * pi)), 3e-6);
}

namespace {

/// What the other camera adds to A−B, over what the own light at its best gives, for all lit raw frames of many frames.
std::vector<double> added_swing(const Interference& other, std::uint64_t frames, std::uint64_t seed = 7) {
  const Camera camera = beside(other);
  const double full = 2 / pi * own_electrons();
  Simulator simulator(wall(1), camera, {.seed = seed, .noise = Noise::exact, .threads = 1});
  std::vector<double> out;
  for (std::uint64_t n = 0; n < frames; ++n) {
    const Raw raw = simulator.frame(n).raw;
    for (std::size_t k = 0; k < 4; ++k)
      out.push_back(both_taps_of(raw, k).difference / full - std::cos(other_phase + static_cast<double>(k) * pi / 2));
  }
  return out;
}

}  // namespace

// Var = b·½·(s·sinc)² [theory: interference-free-clocks], and shot noise. n squares of the sine of a random phase, b of which are not 0,
// scatter by √((3/(2b) − 1)/n) of their mean: 5 of them, a false alarm in 1.7 million; so do 5/√n of correlations.
TEST(interference, of_free_clocks_has_the_variance_of_the_closed_form_and_is_drawn_anew) {
  const double full = 2 / pi * own_electrons();
  struct Case {
    double share, difference_hz, active;
  };
  for (const Case& at : {Case{0.5, 0, 1}, Case{0.5, 400, 1}, Case{0.5, 0, 0.3}}) {
    const std::vector<double> drawn = added_swing({at.share, at.difference_hz, at.active, {}}, 4000);
    const double n = static_cast<double>(drawn.size()), x = at.difference_hz * other_exposure,
                 left = x == 0 ? 1 : std::sin(pi * x) / (pi * x);
    const double shot = own_electrons() * (1 + at.share * at.active) / (full * full);
    const double expected = at.active * 0.5 * at.share * at.share * left * left;
    Moments all;
    for (const double value : drawn) all.add(value);
    EXPECT_NEAR(all.variance() / (expected + shot), 1, 5 * std::sqrt((1.5 / at.active - 1) / n));
    EXPECT_NEAR(all.mean(), 0, 5 * std::sqrt(expected / n));
    for (const std::size_t apart : {std::size_t{1}, std::size_t{2}, std::size_t{4}}) {
      Correlation both(0, 0);
      for (std::size_t i = 0; i + apart < drawn.size(); ++i) both.add(drawn[i], drawn[i + apart]);
      EXPECT_LT(std::abs(both.z()), 5) << apart;
    }
  }
}

// σ_φ = s/√N [theory: interference-free-clocks], here 25 mrad, and that of shot noise and rounding. First order leaves s² of it; 20000
// phases 0.5 %, 5 of them.
TEST(interference, of_free_clocks_is_the_phase_noise_of_the_closed_form) {
  const double share = 0.05, own = own_electrons();
  Simulator simulator(wall(1), beside({share, 0, 1, {}}), {.seed = 3, .noise = Noise::exact, .threads = 1});
  Moments range(1);
  for (std::uint64_t n = 0; n < 20000; ++n) range.add(static_cast<double>(simulator.frame(n).depth.range_m[0]));
  const double shot = own * (1 + share) + 100 * 100 / 12.0, contrast = 2 / pi * own;
  const double phase = std::sqrt(share * share / 4 + shot / (2 * contrast * contrast));
  EXPECT_NEAR(range.deviation() / (c / (4 * pi * other_frequency) * phase), 1, 0.025 + share * share);
}

// One clock for all pixels: where nothing else is drawn, all that see the same read the same. Its share of raw frames is `active`.
TEST(interference, meets_all_pixels_alike_in_the_raw_frames_that_it_meets) {
  const Camera camera = beside({1, 0, 0.3, {}}, Waveform::Kind::sine, 3);
  Simulator simulator(wall(1), camera, {.seed = 1, .noise = Noise::exact, .threads = 1});
  const double own = own_electrons();
  int met = 0;
  for (std::uint64_t n = 0; n < 2000; ++n) {
    const Raw raw = simulator.frame(n).raw;
    for (std::size_t k = 0; k < 5; ++k) {
      const double light = k < 4 ? 1 : 0;
      const bool first = both_taps_of(raw, k).sum / own > light + 0.5;
      met += first ? 1 : 0;
      for (std::size_t i = 1; i < 3; ++i) EXPECT_EQ(both_taps_of(raw, k, i).sum / own > light + 0.5, first);
      // Shot noise of two charges of some own/2 and more, 6 of its deviations.
      if (!first || k == 4) continue;
      EXPECT_NEAR(both_taps_of(raw, k, 2).difference, both_taps_of(raw, k, 0).difference, 6 * std::sqrt(4 * own) + 1e-3 * own);
    }
  }
  EXPECT_NEAR(met / 10000.0, 0.3, 5 * std::sqrt(0.3 * 0.7 / 10000));
}

// Without noise: what is expected. Nobody knows a free clock's phase, so its light alone is left; where the phase is known, the share of raw frames counts.
TEST(interference, without_noise_is_what_is_expected_of_it) {
  const Raw plain = raw_beside(beside({})), free = raw_beside(beside({0.4, 0, 0.5, {}})), known = raw_beside(beside({0.4, 0, 0.5, 0.3})),
            half = raw_beside(beside({0.2, 0, 1, 0.3}));
  for (std::size_t k = 0; k < 5; ++k) {
    EXPECT_NEAR(both_taps_of(free, k).sum / own_electrons(), (k < 4 ? 1 : 0) + 0.2, 1e-6);
    if (k == 4) continue;
    EXPECT_NEAR(both_taps_of(free, k).difference, both_taps_of(plain, k).difference, 1e-6 * own_electrons());
  }
  EXPECT_EQ(known.tap_a, half.tap_a);
  EXPECT_EQ(known.tap_b, half.tap_b);
}

TEST(interference, is_off_unless_its_share_is_given) {
  for (const Noise noise : {Noise::off, Noise::exact}) {
    const Raw plain = raw_beside(beside({}), 2, noise), none = raw_beside(beside({0, 1e3, 0.5, 1}), 2, noise);
    EXPECT_EQ(plain.raw, none.raw);
    EXPECT_EQ(plain.tap_a, none.tap_a);
  }
  EXPECT_EQ(Camera().interference.share, 0);
}

// A frame is that of its number and seed, whatever was computed before it, alone or in a batch.
TEST(interference, is_that_of_the_frame_s_number_and_seed) {
  const Camera camera = beside({0.5, 130, 0.7, {}});
  const SimulatorOptions options{.seed = 7, .noise = Noise::exact, .threads = 1};
  Simulator simulator(wall(1), camera, options);
  const Raw third = raw_beside(camera, 3, Noise::exact), other_seed = raw_beside(camera, 3, Noise::exact, 8);
  EXPECT_NE(third.tap_a, other_seed.tap_a);
  (void)simulator.frame(9);
  EXPECT_EQ(simulator.frame(3).raw.tap_a, third.tap_a);
  const std::vector<FrameRequest> requests = {{3, 8, {}}, {3, {}, {}}};
  std::vector<std::vector<float>> seen;
  simulator.frames(requests, [&](const FrameArrays& arrays) { seen.emplace_back(arrays.tap_a, arrays.tap_a + 5); });
  ASSERT_EQ(seen.size(), 2U);
  EXPECT_EQ(seen[0], other_seed.tap_a);
  EXPECT_EQ(seen[1], third.tap_a);
}

TEST(interference, is_the_same_with_every_instruction_set) {
  Camera camera = beside({0.5, 130, 0.7, {}}, Waveform::Kind::rectangular, 37);
  camera.temperature.warm_up_m = 0.01, camera.temperature.since_start_s = 0;
  const auto raw_with = [&](Isa isa, Noise noise) {
    return Simulator(wall(1), camera, {.seed = 7, .noise = noise, .threads = 1, .isa = isa}).frame(5).raw;
  };
  for (const Noise noise : {Noise::off, Noise::exact}) {
    const Raw scalar = raw_with(Isa::scalar, noise);
    for (const Isa isa : {Isa::scalar_fma, Isa::avx2, Isa::avx512}) {
      if (!backend::can_run(isa)) continue;
      EXPECT_EQ(raw_with(isa, noise).tap_a, scalar.tap_a);
    }
  }
}
