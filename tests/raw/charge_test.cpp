// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "support/bench.h"

using namespace tofray;
using namespace tofray::test;

namespace {

/// By a pixel that has drawn nothing before.
effect::TapPair<float> suppressed(const camera::SensorView& s, const effect::TapPair<float>& charge, int pixel, int k,
                                  effect::FrameIndex frame) {
  effect::TapWords<float> words{};
  return effect::Suppression::suppress<float>(s, charge, pixel, k, frame, words);
}

camera::SensorView suppressing(float threshold, float budget, float factor, camera::Noise noise) {
  camera::SensorView s{};
  s.suppression_threshold = threshold, s.suppression_budget = budget, s.suppression_noise = factor, s.noise = noise;
  return s;
}

}  // namespace

// Whole electrons, so that floats subtract exactly: the difference does not change by a bit, until the well is full.
TEST(suppression, takes_the_same_off_both_taps) {
  const auto s = suppressing(20000, 50000, 1, camera::Noise::off);
  for (int a = 0; a <= 120000; a += 997) {
    for (int b = 0; b <= 120000; b += 1009) {
      const auto left = suppressed(s, {static_cast<float>(a), static_cast<float>(b)}, 0, 0, {0, 0});
      const int removed = std::min(50000, std::max(0, std::min(a, b) - 20000));
      ASSERT_EQ(left.a, static_cast<float>(a - removed));
      ASSERT_EQ(left.b, static_cast<float>(b - removed));
    }
  }
}

// Each tap that loses x gains a variance of factor²·x of its own. 2e5 draws: standard error of a variance 0.32 %.
TEST(suppression, adds_the_variance_of_what_it_takes) {
  const auto s = suppressing(1000, 1e6, 1.5f, camera::Noise::apart);
  Moments a(1000), b(5000), untouched(500);
  Correlation taps(1000, 5000);
  for (int i = 0; i < 200'000; ++i) {
    const auto left = suppressed(s, {9000.0f, 13000.0f}, i, 1, {2, 0});
    a.add(static_cast<double>(left.a)), b.add(static_cast<double>(left.b)),
        taps.add(static_cast<double>(left.a), static_cast<double>(left.b));
    untouched.add(static_cast<double>(suppressed(s, {500.0f, 700.0f}, i, 1, {2, 0}).a));
  }
  const double expected = 1.5 * 1.5 * 8000;
  EXPECT_NEAR(a.variance() / expected, 1, 5 * std::sqrt(2.0 / 200'000));
  EXPECT_NEAR(b.variance() / expected, 1, 5 * std::sqrt(2.0 / 200'000));
  EXPECT_LT(std::abs(a.mean() - 1000) / std::sqrt(expected / 200'000), 5);
  EXPECT_LT(std::abs(b.mean() - 5000) / std::sqrt(expected / 200'000), 5);
  EXPECT_LT(std::abs(taps.z()), 5);
  EXPECT_EQ(untouched.variance(), 0.0);
}

// With suppression a pixel in the sun keeps its depth where it would clip without it.
TEST(suppression, keeps_a_pixel_from_clipping) {
  Camera camera = bench_camera();
  camera.pixel.full_well_e = 100000;
  const Incoming sunny{20000, 1.0, 250000};
  EXPECT_NE(Bench(camera).measure(sunny).depth.flags & depth::saturated, 0);
  camera.pixel.suppression_threshold_e = 20000, camera.pixel.suppression_budget_e = 200000;
  const Measured kept = Bench(camera).measure(sunny);
  EXPECT_EQ(kept.depth.flags & depth::invalid, 0);
  EXPECT_NEAR(static_cast<double>(kept.depth.range), 1.0, 1e-5);
}

namespace {

/// A row of pixels with every fixed pattern on.
Camera patterned(int width) {
  Camera camera = bench_camera({60.24e6}, 4, 0.7, true);
  camera.sensor.width = width;
  camera.pixel.prnu = 0.02, camera.pixel.dsnu_dn = 3, camera.pixel.delay_s = 20e-12;
  return camera;
}

}  // namespace

TEST(fixed_pattern, has_the_deviations_asked_for_and_no_correlation) {
  constexpr int width = 100'000;
  const Bench bench(patterned(width));
  Moments gain(1), offset, delay;
  Correlation gain_offset(1, 0), gain_delay(1, 0), neighbours(1, 1);
  for (int i = 0; i < width; ++i) {
    const double g = static_cast<double>(bench.sensor().gain[i]), o = static_cast<double>(bench.sensor().offset[i]);
    gain.add(g), offset.add(o), delay.add(static_cast<double>(bench.sensor().delay[i]));
    gain_offset.add(g, o), gain_delay.add(g, static_cast<double>(bench.sensor().delay[i]) * 1e12);
    if (i > 0) neighbours.add(g, static_cast<double>(bench.sensor().gain[i - 1]));
  }
  const double tolerance = 5 / std::sqrt(2.0 * width);
  EXPECT_NEAR(gain.deviation() / 0.02, 1, tolerance);
  EXPECT_NEAR(offset.deviation() / 3, 1, tolerance);
  EXPECT_NEAR(delay.deviation() / 20e-12, 1, tolerance);
  EXPECT_NEAR(gain.mean(), 1, 5 * 0.02 / std::sqrt(width));
  EXPECT_LT(std::abs(gain_offset.z()), 5);
  EXPECT_LT(std::abs(gain_delay.z()), 5);
  EXPECT_LT(std::abs(neighbours.z()), 5);
}

TEST(fixed_pattern, belongs_to_the_specimen_not_to_the_run) {
  Camera camera = patterned(100);
  const Bench one(camera, true, 1), again(camera, true, 99);
  camera.pixel.pattern_seed = 2;
  const Bench other(camera, true, 1);
  int equal = 0;
  for (int i = 0; i < 100; ++i) {
    EXPECT_EQ(one.sensor().gain[i], again.sensor().gain[i]);
    EXPECT_EQ(one.sensor().offset[i], again.sensor().offset[i]);
    EXPECT_EQ(one.sensor().delay[i], again.sensor().delay[i]);
    equal += one.sensor().gain[i] == other.sensor().gain[i];
  }
  EXPECT_EQ(equal, 0);
}

// PRNU scales light, ambient light with it, and no dark charge: A = (light/2·(1 + PRNU) + dark)·(1 + g/2), and A − B follows in full.
TEST(fixed_pattern, of_gains_is_of_light_alone) {
  Camera even = patterned(64);
  even.pixel.delay_s = 0, even.pixel.dsnu_dn = 0, even.pixel.prnu = 0.3;
  even.pixel.dark_current_e_per_s = 2e6, even.pixel.full_well_e = 1e9;
  for (const double mismatch : {0.0, 0.1}) {
    Camera camera = even, flat = even;
    camera.pixel.tap_gain_mismatch = mismatch, flat.pixel.prnu = 0, flat.pixel.tap_gain_mismatch = 0;
    const Bench bench(camera), plain(flat);
    for (int i = 0; i < 64; ++i) {
      const double gain = static_cast<double>(bench.sensor().gain[i]);
      const flow::Taps<float> dark = bench.expose({0, 1.0, 0}, i)[1], seen = bench.expose({20000, 1.0, 3000}, i)[1];
      const flow::Taps<float> none = plain.expose({0, 1.0, 0}, i)[1], all = plain.expose({20000, 1.0, 3000}, i)[1];
      const auto expected = [&](float light, float without, double sign) {
        const double charge = static_cast<double>(without);
        return ((static_cast<double>(light) - charge) * gain + charge) * (1 + sign * mismatch / 2);
      };
      ASSERT_GT(none.a, 100.0F);
      EXPECT_NEAR(static_cast<double>(dark.a), static_cast<double>(none.a) * (1 + mismatch / 2), 1e-6 * static_cast<double>(none.a));
      const double a = expected(all.a, none.a, 1), b = expected(all.b, none.b, -1);
      EXPECT_NEAR(static_cast<double>(seen.a), a, 1e-6 * a) << i;
      EXPECT_NEAR(static_cast<double>(seen.b), b, 1e-6 * a) << i;
      EXPECT_NEAR(static_cast<double>(seen.difference), a - b, 2e-6 * a) << i;
    }
  }
}

// The mean of n frames: what changes from frame to frame falls as 1/√n, the pattern stays. 4000 pixels.
TEST(fixed_pattern, stays_where_the_noise_averages_out) {
  constexpr int width = 4000;
  const Camera camera = patterned(width);
  const Bench silent(camera), noisy(camera, true);
  const Incoming in{20000, 1.0, 2000};
  std::vector<double> sum(width), truth(width);
  for (int i = 0; i < width; ++i) {
    // without noise depth takes the unrounded difference, which has no offset pattern in it: add it
    truth[static_cast<std::size_t>(i)] =
        static_cast<double>(silent.expose(in, i)[1].difference) + static_cast<double>(silent.sensor().offset[i]);
  }
  Moments pattern(truth[0]);
  for (const double t : truth) pattern.add(t);
  std::vector<double> x, y;
  for (int n = 1; n <= 256; ++n) {
    for (int i = 0; i < width; ++i)
      sum[static_cast<std::size_t>(i)] += static_cast<double>(noisy.expose(in, i, static_cast<std::uint64_t>(n))[1].difference);
    if ((n & (n - 1)) != 0) continue;
    double square = 0;
    Moments mean(truth[0]);
    for (int i = 0; i < width; ++i) {
      const double value = sum[static_cast<std::size_t>(i)] / n, off = value - truth[static_cast<std::size_t>(i)];
      square += off * off;
      mean.add(value);
    }
    x.push_back(std::log(n)), y.push_back(0.5 * std::log(square / width));
    const double left = square / width;                                        // temporal variance after n frames
    EXPECT_NEAR(mean.variance() / (pattern.variance() + left), 1, 0.06) << n;  // 5 sigma of a variance over 2 · 4000 values or so
  }
  double mx = 0, my = 0, xx = 0, xy = 0;
  const double n = static_cast<double>(x.size());
  for (std::size_t i = 0; i < x.size(); ++i) mx += x[i] / n, my += y[i] / n;
  for (std::size_t i = 0; i < x.size(); ++i) xx += (x[i] - mx) * (x[i] - mx), xy += (x[i] - mx) * (y[i] - my);
  EXPECT_NEAR(xy / xx, -0.5, 0.03);
}

// The delay pattern moves what the raw frames see, and the decoder takes it out again.
TEST(fixed_pattern, of_delays_moves_the_phase_and_is_taken_out) {
  const Bench bench(patterned(200));
  for (int i = 0; i < 200; ++i) {
    const double delay = static_cast<double>(bench.sensor().delay[i]);
    const Measured m = bench.measure({20000, 1.0, 0}, i);
    const auto raw_phase = bench.estimate(m.taps);
    EXPECT_NEAR(wrapped(static_cast<double>(raw_phase.turns) - 2 * 1.0 * 60.24e6 / c - delay * 60.24e6), 0, 2e-7);
    EXPECT_NEAR(static_cast<double>(m.depth.range), 1.0, 2e-6);
  }
}

// Electrons are linear in exposure and power until they clip.
TEST(electrons, are_linear_in_light_and_time) {
  Camera camera = bench_camera();
  camera.pixel.full_well_e = 100000;
  const auto one = Bench(camera).expose({1000, 1.0, 300});
  for (const double factor : {0.01, 0.1, 2.0, 30.0, 100.0}) {
    const auto brighter = Bench(camera).expose({1000 * factor, 1.0, 300 * factor});
    Camera longer_camera = camera;
    for (RawFrame& frame : longer_camera.mode.sequence) frame.integration_time_s *= factor;
    const auto longer = Bench(longer_camera).expose({1000, 1.0, 300});
    for (std::size_t k = 0; k < one.size(); ++k) {
      EXPECT_NEAR(static_cast<double>(brighter[k].a) / (factor * static_cast<double>(one[k].a)), 1, 1e-6);
      EXPECT_NEAR(static_cast<double>(brighter[k].b) / (factor * static_cast<double>(one[k].b)), 1, 1e-6);
      EXPECT_NEAR(static_cast<double>(longer[k].a) / (factor * static_cast<double>(one[k].a)), 1, 1e-6);
      EXPECT_NEAR(static_cast<double>(longer[k].b) / (factor * static_cast<double>(one[k].b)), 1, 1e-6);
    }
  }
  for (const auto& taps : Bench(camera).expose({1e6, 1.0, 0})) EXPECT_LE(std::max(taps.a, taps.b), 100000.0f);
}

// Both taps together collect all the light, whatever the phase; dark current comes on top in both, unlit as well.
TEST(electrons, of_both_taps_are_all_that_came) {
  Camera camera = bench_camera({60.24e6}, 4, 0.7, true);
  camera.pixel.dark_current_e_per_s = 50000;  // 50 e⁻ per tap
  for (int i = 0; i < 50; ++i) {
    const auto taps = Bench(camera).expose({4000, 0.05 * i, 1000});
    EXPECT_NEAR(static_cast<double>(taps[0].a), 1000 + 50, 1e-3) << "a grey frame's gate rests on A";
    EXPECT_NEAR(static_cast<double>(taps[0].b), 50, 1e-3);
    for (std::size_t k = 1; k < taps.size(); ++k) {
      EXPECT_NEAR(static_cast<double>(taps[k].a + taps[k].b), 5000 + 100, 2e-3);
      const double phase = two_pi * (2 * 0.05 * i * 60.24e6 / c) + pi / 2 * static_cast<double>(k - 1);
      EXPECT_NEAR(static_cast<double>(taps[k].a - taps[k].b), 4000 * 0.7 * std::cos(phase), 5e-3);
    }
  }
}

// Harmonics cut off near full contrast can leave a mean below zero: it counts as zero, and only dark current is left.
TEST(electrons, are_never_expected_below_zero) {
  Camera camera = bench_camera({60.24e6}, 4, 1.2);
  camera.pixel.dark_current_e_per_s = 7000;
  const auto taps = Bench(camera).expose({1000, 0, 0});
  EXPECT_NEAR(static_cast<double>(taps[0].a), 1100 + 7, 1e-3);
  EXPECT_FLOAT_EQ(taps[0].b, 7.0f);
  EXPECT_FLOAT_EQ(taps[2].a, 7.0f);
}

// Light of several sources adds up as phasors: one source of twice the light, or two equal ones, are the same.
TEST(electrons, of_several_lights_add_up) {
  Camera camera = bench_camera({60.24e6}, 4, 0.6);
  camera.illumination.push_back(camera.illumination[0]);
  const Bench bench(camera);
  const flow::Light<float> light = bench.light_of({{3e6f, 2.0f}, {1e6f, 3.1f}});
  auto exposure = raw::start<float>(bench.sensor(), {0, 1}, nullptr);
  for (int k = 0; k < 4; ++k) {
    const auto taps = raw::expose(bench.sensor(), k, light, bench.phasors().orders, {0, 0}, exposure);
    double expected = 0;
    for (const auto& [signal, path] : {std::pair{3000.0, 2.0}, std::pair{1000.0, 3.1}}) {
      const double length = static_cast<double>(static_cast<float>(path));
      expected += 0.6 * signal * std::cos(two_pi * length * 60.24e6 / c + pi / 2 * k);
    }
    EXPECT_NEAR(static_cast<double>(taps.a - taps.b), expected, 2e-3);
    EXPECT_NEAR(static_cast<double>(taps.a + taps.b), 4000, 1e-3);
  }
}

// Several lights add up at reference phases that are no quarter turns as well, where every harmonic's real and imaginary part is summed
// over the lights. From D_k = Σ_l S_l·Σ_m a_m·cos(m(φ_l + τ_k) + ψ_m), with light poles that turn each light's harmonics by another angle.
TEST(electrons, of_several_lights_add_up_at_any_reference_phases) {
  const double f = 60.24e6, poles[2] = {90e6, 200e6}, duties[2] = {0.25, 0.4}, signals[2] = {30000, 10000}, paths[2] = {2.0, 3.1};
  for (const int phases : {3, 5}) {
    Camera camera = bench_camera({f}, phases);
    camera.pixel.contrast = {{60e6}, {0.8}};
    camera.illumination.push_back(camera.illumination[0]);
    for (std::size_t l = 0; l < 2; ++l) {
      Waveform& w = camera.illumination[l].waveform;
      w.harmonics = 4, w.duty = duties[l], w.bandwidth_hz = poles[l];
    }
    const Bench bench(camera);
    std::vector<flow::Path<float>> way;
    for (int l = 0; l < 2; ++l) way.push_back({static_cast<float>(1e3 * signals[l]), static_cast<float>(paths[l])});
    const flow::Light<float> light = bench.light_of(way);
    auto exposure = raw::start<float>(bench.sensor(), {0, 1}, nullptr);
    for (int k = 0; k < phases; ++k) {
      const auto taps = raw::expose(bench.sensor(), k, light, bench.phasors().orders, {0, 0}, exposure);
      double expected = 0;
      for (int l = 0; l < 2; ++l) {
        const double phase =
            two_pi * (static_cast<double>(way[static_cast<std::size_t>(l)].length) * f / c + static_cast<double>(k) / phases);
        for (const int m : {1, 3, 5, 7}) {
          const double x = pi * m * duties[l], pole = 1 / std::hypot(1.0, m * f / poles[l]);
          const double a = 4 / (pi * m) * std::sin(m * pi / 2) * std::sin(x) / x * 0.8 * pole;
          expected += signals[l] * a * std::cos(m * phase + std::atan(m * f / poles[l]));
        }
      }
      EXPECT_NEAR(static_cast<double>(taps.difference), expected, 0.03) << phases << " phases, raw frame " << k;
    }
  }
}

// Without noise a pixel's difference, which has no offset pattern in it, is held to what the pixel's own codes reach.
TEST(fixed_pattern, moves_the_ends_that_codes_reach_without_noise) {
  Camera camera = patterned(50);
  camera.adc = {12, 2, 2048, 0, 4095};
  const Bench bench(camera);
  for (int i = 0; i < 50; ++i) {
    float least = 0, most = 0;
    for (const auto& taps : bench.expose({40000, 0, 0}, i))
      least = std::min(least, taps.difference), most = std::max(most, taps.difference);
    const float zero = 2048 + bench.sensor().offset[i];
    EXPECT_EQ(least, -zero * 2);
    EXPECT_EQ(most, (4095 - zero) * 2);
  }
}

// What a pixel starts with is its own place in each pattern; without patterns gain 1, no offset, no delay.
TEST(fixed_pattern, is_each_pixel_s_own_from_the_start_of_its_exposure) {
  const Bench bench(patterned(50)), plain(bench_camera());
  for (int i = 0; i < 50; ++i) {
    const auto exposure = raw::start<float>(bench.sensor(), {i, 1}, nullptr);
    EXPECT_EQ(exposure.gain_a, bench.sensor().gain[i]);
    EXPECT_EQ(exposure.gain_b, bench.sensor().gain[i]);
    EXPECT_EQ(exposure.offset, bench.sensor().offset[i]);
    EXPECT_EQ(camera::late_by<float>(bench.sensor(), 0, {i, 1}), bench.sensor().delay[i]);
  }
  const auto exposure = raw::start<float>(plain.sensor(), {0, 1}, nullptr);
  EXPECT_EQ(exposure.gain_a, 1.0f);
  EXPECT_EQ(exposure.gain_b, 1.0f);
  EXPECT_EQ(exposure.offset, 0.0f);
  EXPECT_EQ(plain.sensor().delay, nullptr);
}
