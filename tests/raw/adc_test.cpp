// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <vector>

#include "support/bench.h"

using namespace tofray;
using namespace tofray::test;

namespace {

/// A sensor of the given ADC; wells of 100 000 e⁻; noise on, so that depth takes the codes.
camera::SensorView adc(double step, double mid = 2048, double max_code = 4095, double valid_min = 400, double valid_max = 3750) {
  camera::SensorView s{};
  s.full_well = s.full_read = 100000;
  s.per_step = static_cast<float>(1 / step), s.step = static_cast<float>(step), s.mid_code = static_cast<float>(mid);
  s.max_code = static_cast<float>(max_code), s.valid_middle = static_cast<float>(0.5 * (valid_min + valid_max)),
  s.valid_half = static_cast<float>(0.5 * (valid_max - valid_min));
  s.noise = camera::Noise::merged;
  return s;
}

camera::RawFrameView lit(bool on = true) {
  camera::RawFrameView frame{};
  frame.lit = on;
  return frame;
}

/// Inverse of the normal distribution, by bisection.
double quantile(double share) {
  double low = -9, high = 9;
  for (int i = 0; i < 60; ++i) {
    const double middle = 0.5 * (low + high);
    (0.5 * std::erfc(-middle / std::sqrt(2.0)) < share ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

}  // namespace

// The photon transfer curve of A−B in an unlit raw frame (the light is all in A): var_DN = K²(m + σ²) + 1/12 with σ² = 2σ_r².
// 2e6 samples: the variance's standard error is 0.1 %, so that 0.5 % is five of it. Shot and read noise apart, just below the read noise from
// which they are merged, there, and far from it.
class PhotonTransfer : public testing::TestWithParam<double> {};

TEST_P(PhotonTransfer, is_the_line_of_the_closed_form) {
  constexpr int samples = 2'000'000;
  const double gain = 0.1, read_of_tap = GetParam();
  Camera camera = bench_camera({60e6}, 4, 0.7, true);
  camera.mode.sequence[0].integration_time_s = 1e-3;
  camera.pixel.read_noise_e = read_of_tap;
  camera.adc = {16, 1 / gain, 1000, 0, 65535};
  const Bench bench(camera, true);
  const double means[4] = {100, 1e3, 1e4, 5e4}, known[4] = {3.3333, 12.3333, 102.3333, 502.3333};  // those of a read noise of 15/√2
  double variance[4];
  for (int at = 0; at < 4; ++at) {
    Moments code(1000 + gain * means[at]);
    const auto& frame = bench.sensor().frame[0];
    for (int i = 0; i < samples; ++i) {
      const auto mean = raw::tap_means(frame, 0.0f, static_cast<float>(means[at] * 1e3), 0.0f);
      effect::TapWords<float> words{};
      const auto charge = bench.sensor().noise == camera::Noise::merged
                              ? raw::expose_merged<float>(bench.sensor(), mean, i, 0, {0, 0}, words)
                              : raw::expose_apart<float>(bench.sensor(), mean, i, 0, {0, 0});
      code.add(static_cast<double>(effect::read_out(bench.sensor(), charge, 0.0f).code));
    }
    const double expected = gain * gain * (means[at] + 2 * read_of_tap * read_of_tap) + 1.0 / 12;
    if (read_of_tap == std::sqrt(112.5)) {
      EXPECT_NEAR(expected, known[at], 1e-4);
    }
    EXPECT_NEAR(code.variance() / expected, 1, 0.005) << means[at];
    EXPECT_NEAR(code.mean(), 1000 + gain * means[at], 5.5 * std::sqrt(expected / samples) + 1e-4);
    variance[at] = code.variance();
  }
  // slope of the variance over the mean in DN: K
  EXPECT_NEAR((variance[3] - variance[0]) / (gain * (means[3] - means[0])) / gain, 1, 0.005);
}

INSTANTIATE_TEST_SUITE_P(read_noise, PhotonTransfer, testing::Values(0, 3.999, 4, 8, std::sqrt(112.5), 50),
                         [](const auto& which) { return "of_" + std::to_string(std::lround(1000 * which.param)) + "_thousandths"; });

// Rounding a signal with noise of s LSB is off by at most (1/π)·exp(−2π²s²) on average, and adds 1/12 to the variance for s >= ½.
// The noise comes as 1e5 equal shares of a normal, so that nothing is left to chance; the grid's own error is below 1e-4.
TEST(quantiser, has_the_bias_and_variance_of_the_closed_form) {
  constexpr int shares = 100'000, offsets = 64;
  std::vector<double> normal;
  for (int i = 0; i < shares; ++i) normal.push_back(quantile((i + 0.5) / shares));
  const auto sensor = adc(20, 2048, 4095);
  const double settings[3][2] = {{0.25, 0.092696}, {0.3, 0.053866}, {0.5, 0.002289}};
  for (const auto& [s, known] : settings) {
    const double ripple = (1 / (pi * pi) + 4 * s * s) * std::exp(-2 * pi * pi * s * s);  // what is left of the variance's first harmonic
    double worst = 0;
    for (int j = 0; j < offsets; ++j) {
      const double x = static_cast<double>(j) / offsets;
      Moments code(2048 + x);
      for (const double z : normal) {
        const effect::TapPair<float> charge{static_cast<float>(20 * (x + s * z) + 1000), 1000.0f};
        code.add(static_cast<double>(effect::read_out(sensor, charge, 0.0f).code));
      }
      worst = std::max(worst, std::abs(code.mean() - 2048 - x));
      if (s >= 0.5) {
        EXPECT_NEAR(code.variance(), s * s + 1.0 / 12, ripple + 2e-4);
      }
    }
    const double bound = std::exp(-2 * pi * pi * s * s) / pi;
    EXPECT_NEAR(bound, known, 1e-6);
    EXPECT_NEAR(worst, bound, 1e-3) << s;
  }
}

// Noise comes before the ADC, which rounds what it has moved: at a quarter LSB of noise a signal of ¼ LSB reads as ¼ −
// (1/π)·exp(−2π²/16) on average. (Noise after the rounding would read as 0, and no code would be a whole number.)
TEST(quantiser, rounds_what_the_noise_has_moved) {
  constexpr int samples = 200'000;
  Camera camera = bench_camera({60e6}, 4, 0.7, true);
  camera.pixel.read_noise_e = 0.25 * 20 / std::sqrt(2.0);  // 3.5: apart
  camera.adc = {12, 20, 2048, 0, 4095};
  const Bench bench(camera, true);
  Moments code(2048);
  for (int i = 0; i < samples; ++i) {
    const auto charge = raw::expose_apart<float>(bench.sensor(), {0.0f, 0.0f}, i, 0, {0, 0});
    const float got = effect::read_out(bench.sensor(), charge, 0.25f).code;
    ASSERT_EQ(got, std::floor(got));
    code.add(static_cast<double>(got));
    ASSERT_EQ(bench.expose({}, i)[0].code, std::round(bench.expose({}, i)[0].code));
  }
  EXPECT_NEAR(code.mean() - 2048, 0.25 - std::exp(-2 * pi * pi / 16) / pi, 5.5 * 0.4 / std::sqrt(samples));
}

// Every whole number of electrons across the range and beyond: the nearest code, no code missing, none twice out of order, ends held.
TEST(quantiser, is_monotone_misses_no_code_and_holds_its_ends) {
  const auto sensor = adc(20);
  std::set<int> seen;
  double before = -1;
  for (int difference = -60000; difference <= 60000; ++difference) {
    const effect::TapPair<float> charge{static_cast<float>(difference + 30000 > 0 ? difference + 30000 : 0),
                                        static_cast<float>(difference + 30000 > 0 ? 30000 : -difference)};
    const auto out = effect::read_out(sensor, charge, 0.0f);
    const double code = static_cast<double>(out.code), exact = difference / 20.0 + 2048;
    ASSERT_EQ(code, std::floor(code));
    ASSERT_GE(code, before);
    ASSERT_LE(std::abs(code - std::min(4095.0, std::max(0.0, exact))), 0.5) << difference;
    ASSERT_EQ(static_cast<double>(out.difference), (code - 2048) * 20) << "depth takes the code";
    seen.insert(static_cast<int>(code));
    before = code;
  }
  EXPECT_EQ(seen.size(), 4096u);
}

TEST(quantiser, adds_the_offset_pattern_before_it_rounds) {
  const auto sensor = adc(20);
  EXPECT_EQ(effect::read_out(sensor, {1000.0f, 1000.0f}, 3.4f).code, 2051.0f);
  EXPECT_EQ(effect::read_out(sensor, {1000.0f, 1000.0f}, 3.6f).code, 2052.0f);
  EXPECT_EQ(effect::read_out(sensor, {1005.0f, 1000.0f}, 0.3f).code, 2049.0f);  // 0.25 + 0.3
}

// Without noise depth comes from the unrounded difference; code, wells and flags are as ever.
TEST(quantiser, leaves_the_difference_alone_where_noise_is_off) {
  auto sensor = adc(20);
  sensor.noise = camera::Noise::off;
  const auto out = effect::read_out(sensor, {1234.5f, 1000.25f}, 0.0f);
  EXPECT_EQ(out.difference, 234.25f);
  EXPECT_EQ(out.code, 2060.0f);
}

// Codes cannot say more than their ends: the difference is held to what they reach, less the offset pattern that it is free of.
TEST(quantiser, holds_the_difference_to_its_codes_where_noise_is_off) {
  auto sensor = adc(20);
  sensor.noise = camera::Noise::off;
  EXPECT_EQ(effect::read_out(sensor, {90000.0f, 1000.0f}, 0.0f).difference, 20 * (4095.0f - 2048));
  EXPECT_EQ(effect::read_out(sensor, {1000.0f, 90000.0f}, 0.0f).difference, 20 * (0.0f - 2048));
  EXPECT_EQ(effect::read_out(sensor, {90000.0f, 1000.0f}, 3.0f).difference, 20 * (4095.0f - 2048 - 3));
  EXPECT_EQ(effect::read_out(sensor, {40000.0f, 1000.0f}, 3.0f).difference, 39000.0f);
}

// The flag is set exactly where a tap reaches its well, within one electron, and only in a lit raw frame.
TEST(saturation, is_flagged_where_a_tap_clips) {
  const auto sensor = adc(200);  // wide enough that no code leaves the valid range
  struct Case {
    float a, b;
    bool flagged;
  };
  for (const Case& at : {Case{99999, 80000, false}, Case{100000, 80000, true}, Case{100001, 80000, true}, Case{80000, 99999, false},
                         Case{80000, 100000, true}, Case{80000, 100001, true}, Case{100001, 100001, true}, Case{99999, 99999, false}}) {
    const auto out = effect::read_out(sensor, {at.a, at.b}, 0.0f);
    EXPECT_EQ(test::flags(sensor, lit(), {at.a, at.b}), at.flagged) << at.a << ", " << at.b;
    EXPECT_EQ(out.a, std::min(at.a, 100000.0f));
    EXPECT_EQ(out.b, std::min(at.b, 100000.0f));
    EXPECT_EQ(out.difference, (out.code - 2048) * 200);
    EXPECT_FALSE(test::flags(sensor, lit(false), {at.a, at.b})) << "a grey frame never is";
  }
  // Clipping happens per tap, before the difference: both over the well read as equal.
  EXPECT_EQ(effect::read_out(sensor, {150000.0f, 120000.0f}, 0.0f).code, 2048.0f);
}

TEST(saturation, is_flagged_where_a_code_leaves_the_valid_range) {
  const auto sensor = adc(20);
  for (const int code : {399, 400, 401, 2048, 3749, 3750, 3751}) {
    const float difference = static_cast<float>(20 * (code - 2048));
    const auto out = effect::read_out(sensor, {50000 + difference / 2, 50000 - difference / 2}, 0.0f);
    EXPECT_EQ(out.code, static_cast<float>(code));
    EXPECT_EQ(test::flags(sensor, lit(), {50000 + difference / 2, 50000 - difference / 2}), code < 400 || code > 3750) << code;
    EXPECT_FALSE(test::flags(sensor, lit(false), {50000 + difference / 2, 50000 - difference / 2}));
  }
}

// Where the valid codes reach the ends of the ADC, a code at an end is valid and one that was held there is not: what counts is the level
// before the ends, rounded.
TEST(saturation, is_flagged_where_the_adc_held_a_code_that_would_be_valid) {
  for (const camera::Noise noise : {camera::Noise::off, camera::Noise::apart, camera::Noise::merged}) {
    auto sensor = adc(20, 2048, 4095, 0, 4095);
    sensor.noise = noise;
    for (const double level : {-7.0, -0.6, -0.4, 0.0, 4095.0, 4095.4, 4095.6, 4100.0}) {
      const float difference = static_cast<float>(20 * (level - 2048));
      const effect::TapPair<float> charge{50000 + difference / 2, 50000 - difference / 2};
      EXPECT_EQ(test::flags(sensor, lit(), charge), level < -0.5 || level > 4095.5) << level;
      EXPECT_FALSE(test::flags(sensor, lit(false), charge)) << level;
    }
  }
}

// From light to flag: one electron below the well and one above it, in the raw frame where the tap's mean is largest.
TEST(saturation, of_a_pixel_follows_its_brightest_tap) {
  Camera camera = bench_camera({60e6}, 4, 0.5);
  camera.adc.bits = 16, camera.adc.step_e_per_dn = 4;
  camera.pixel.full_well_e = 50000;
  const Bench bench(camera);
  // φ = 0, τ = 0: A = ½(S + B) + ½·C·S
  const double signal = 40000, lit_part = 0.5 * signal + 0.5 * 0.5 * signal;
  EXPECT_EQ(bench.measure({signal, 0, 2 * (50000 - 1 - lit_part)}).depth.flags & depth::saturated, 0);
  EXPECT_EQ(bench.measure({signal, 0, 2 * (50000 + 1 - lit_part)}).depth.flags & depth::saturated, depth::saturated);
}
