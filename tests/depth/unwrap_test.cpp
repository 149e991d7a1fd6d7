// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include "depth/unwrap.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <vector>

#include "support/bench.h"

using namespace tofray;
using namespace tofray::test;

namespace {

double half_wave(double frequency) { return c / (2 * frequency); }

/// Phases of a half path in turns, wrapped, as floats.
std::vector<float> turns_of(const std::vector<double>& frequencies, double half_path, const std::vector<double>& noise = {}) {
  std::vector<float> out;
  for (std::size_t i = 0; i < frequencies.size(); ++i) {
    const double p = half_path / half_wave(frequencies[i]) + (noise.empty() ? 0 : noise[i]);
    const float turns = static_cast<float>(p - std::floor(p));
    out.push_back(turns >= 1.0f ? 0.0f : turns);
  }
  return out;
}

/// The unwrapped half path's error, whole common ranges taken off.
double error_of(const Bench& bench, const std::vector<double>& frequencies, double common, double half_path,
                const std::vector<double>& noise = {}) {
  const auto turns = turns_of(frequencies, half_path, noise);
  std::vector<float> weight;
  for (const double f : frequencies) weight.push_back(static_cast<float>(1 / std::pow(0.001 * half_wave(f), 2)));  // equal phase noise
  const auto got = depth::unwrap<float>(bench.decoder(), turns.data(), weight.data());
  const double d = static_cast<double>(got.value);
  EXPECT_GE(d, 0.0) << half_path;
  EXPECT_LT(got.value, bench.decoder().common_range) << half_path;
  return d - half_path - common * std::round((d - half_path) / common);
}

double uniform(std::mt19937_64& random) { return static_cast<double>(random() >> 11) * 0x1p-53; }

double normal(std::mt19937_64& random) { return std::sqrt(-2 * std::log(uniform(random) + 1e-300)) * std::cos(two_pi * uniform(random)); }

struct Set {
  std::vector<double> frequencies;
  double base;
};

const std::vector<Set> sets = {{{80.32e6, 60.24e6}, 20.08e6}, {{60.24e6, 80.32e6}, 20.08e6}, {{80e6, 60e6}, 20e6},
                               {{100e6, 80e6}, 20e6},         {{70e6, 50e6}, 10e6},          {{90e6, 80e6}, 10e6},
                               {{30e6, 20e6}, 10e6},          {{80e6, 40e6}, 40e6},          {{60e6}, 60e6},
                               {{100e6, 80e6, 60e6}, 20e6},   {{80e6, 70e6, 60e6}, 10e6},    {{110e6, 70e6, 50e6, 30e6}, 10e6}};

}  // namespace

// c/(2f): what one modulation frequency can tell apart, and c/(2f_0) of several.
TEST(unambiguous_range, is_that_of_the_common_base) {
  const struct {
    std::vector<double> frequencies;
    double range;
  } known[] = {{{20e6}, 7.494811450},    {{60e6}, 2.498270483},  {{80e6}, 1.873702863},
               {{80.32e6}, 1.866237911}, {{100e6}, 1.498962290}, {{80.32e6, 60.24e6}, 7.464951643}};
  for (const auto& k : known) EXPECT_FLOAT_EQ(Bench(bench_camera(k.frequencies)).decoder().common_range, static_cast<float>(k.range));
}

TEST(unambiguous_range, halves_when_the_modulation_frequency_doubles) {
  EXPECT_EQ(Bench(bench_camera({40e6})).decoder().common_range, 2 * Bench(bench_camera({80e6})).decoder().common_range);
}

// 1e6 half paths over the whole range, noise-free: none in a wrong cycle, and each within a few places of a float (1e-6 of the range).
TEST(unwrapping, without_noise_never_fails) {
  std::mt19937_64 random(21);
  for (const Set& set : sets) {
    const Bench bench(bench_camera(set.frequencies));
    const double common = half_wave(set.base);
    const int count = &set == &sets.front() ? 1'000'000 : 100'000;
    double worst = 0;
    for (int i = 0; i < count; ++i) worst = std::max(worst, std::abs(error_of(bench, set.frequencies, common, common * uniform(random))));
    EXPECT_LT(worst, 1e-6 * common + 5e-7) << set.frequencies.size() << " of " << set.frequencies[0];
  }
}

// At every wrap of every modulation frequency, and next to it by steps down to the last place of a phase.
TEST(unwrapping, is_right_at_every_wrap) {
  for (const Set& set : sets) {
    const Bench bench(bench_camera(set.frequencies));
    const double common = half_wave(set.base);
    for (const double f : set.frequencies) {
      const int cycles = static_cast<int>(std::lround(f / set.base));
      for (int n = 0; n <= cycles; ++n) {
        for (const double off : {0.0, 1e-16, 1e-9, 1e-8, 3e-8, 6e-8, 1.2e-7, 1e-6, 1e-5}) {
          for (const double sign : {-1.0, 1.0}) {
            const double half_path = half_wave(f) * (n + sign * off);
            EXPECT_LT(std::abs(error_of(bench, set.frequencies, common, half_path)), 1e-6 * common + 5e-7)
                << f << ", wrap " << n << " " << sign * off;
          }
        }
      }
    }
  }
}

// The phases themselves one place of a float below a turn, at 0, and above, in all combinations: near the wrap, and in [0, R).
TEST(unwrapping, keeps_to_its_range_within_a_last_place) {
  const float below = std::nextafter(1.0f, 0.0f), above = std::numeric_limits<float>::denorm_min();
  for (const Set& set : sets) {
    const Bench bench(bench_camera(set.frequencies));
    const std::size_t count = set.frequencies.size();
    std::vector<float> weight(count, 1e6f), turns(count);
    for (std::size_t which = 0; which < static_cast<std::size_t>(std::pow(3, count)); ++which) {
      for (std::size_t i = 0, rest = which; i < count; ++i, rest /= 3) turns[i] = rest % 3 == 0 ? below : rest % 3 == 1 ? 0.0f : above;
      const float d = depth::unwrap<float>(bench.decoder(), turns.data(), weight.data()).value;
      EXPECT_GE(d, 0.0f);
      EXPECT_LT(d, bench.decoder().common_range);
      EXPECT_LT(std::min(d, bench.decoder().common_range - d), 1e-6f);
    }
  }
}

// P(wrong cycle) = erfc(½/(√2·σ_q)), σ_q = σ·√(M² + N²)/2π. 1e6 half paths over the whole range; binomial 5.5 sigma.
TEST(unwrapping, of_two_frequencies_fails_as_often_as_the_closed_form_says) {
  struct Case {
    double f1, f2, base, sigma;
  };
  for (const Case& at :
       {Case{80e6, 60e6, 20e6, 0.25}, Case{80e6, 60e6, 20e6, 0.35}, Case{80.32e6, 60.24e6, 20.08e6, 0.25}, Case{100e6, 80e6, 20e6, 0.2}}) {
    const std::vector<double> frequencies{at.f1, at.f2};
    const Bench bench(bench_camera(frequencies));
    const double common = half_wave(at.base), m = at.f1 / at.base, n = at.f2 / at.base;
    std::mt19937_64 random(22);
    constexpr int count = 1'000'000;
    int wrong = 0;
    Moments fused;
    for (int i = 0; i < count; ++i) {
      const double half_path = common * uniform(random);
      const double error =
          error_of(bench, frequencies, common, half_path, {at.sigma * normal(random) / two_pi, at.sigma * normal(random) / two_pi});
      // a wrong cycle is off by whole waves of one modulation frequency
      if (std::abs(error) > 0.5 * half_wave(at.f1))
        ++wrong;
      else
        fused.add(error);
    }
    const double share = std::erfc(0.5 / (std::sqrt(2.0) * at.sigma * std::sqrt(m * m + n * n) / two_pi));
    EXPECT_LT(std::abs(wrong - share * count) / std::sqrt(count * share * (1 - share)), 5.5) << at.f1 << " " << at.sigma << ": " << wrong;
    // what is in the right cycle: c·σ/(4π·√(f1² + f2²)), a little less where the widest are sorted out as wrong cycles
    const double expected = c * at.sigma / (4 * pi * std::sqrt(at.f1 * at.f1 + at.f2 * at.f2));
    EXPECT_NEAR(fused.deviation() / expected, 1, 0.01) << at.f1 << " " << at.sigma;
    EXPECT_LT(std::abs(fused.mean()), 5.5 * expected / std::sqrt(count));
  }
}

TEST(unwrapping, chances_are_those_that_were_published) {
  EXPECT_NEAR(std::erfc(0.5 / (std::sqrt(2.0) * 0.25 * 5 / two_pi)), 1.196e-2, 5e-6);
  EXPECT_NEAR(std::erfc(0.5 / (std::sqrt(2.0) * 0.35 * 5 / two_pi)), 7.262e-2, 5e-6);
}

// A third modulation frequency makes wrong cycles rarer; the closest point is what a search over all of them in double finds.
TEST(unwrapping, of_three_frequencies_takes_the_closest_point) {
  const std::vector<double> frequencies{100e6, 80e6, 60e6};
  const Bench bench(bench_camera(frequencies));
  const double common = half_wave(20e6);
  std::mt19937_64 random(23);
  int different = 0;
  for (int i = 0; i < 20'000; ++i) {
    const double half_path = common * uniform(random);
    std::vector<double> noise;
    for (int k = 0; k < 3; ++k) noise.push_back(0.3 * normal(random) / two_pi);
    const auto turns = turns_of(frequencies, half_path, noise);
    double least = 1e30, best = 0;
    for (int n = 0; n < 3; ++n) {  // cycles of 60 MHz, the one with the fewest
      const double d = half_wave(60e6) * (n + static_cast<double>(turns[2]));
      double misfit = 0, mean = 0, weights = 0;
      for (std::size_t k = 0; k < 3; ++k) {
        const double r = half_wave(frequencies[k]), p = static_cast<double>(turns[k]), near = r * (std::round(d / r - p) + p);
        misfit += (near - d) * (near - d), mean += near / (r * r), weights += 1 / (r * r);
      }
      if (misfit < least) least = misfit, best = mean / weights;
    }
    const double error = half_path + error_of(bench, frequencies, common, half_path, noise) - best;
    if (std::abs(error - common * std::round(error / common)) > 1e-5) ++different;
  }
  EXPECT_LE(different, 2);  // ties within the rounding of a float
}

// The average first, then the range: near the far end one phase has wrapped and the other has not.
TEST(unwrapping, averages_before_it_wraps) {
  const std::vector<double> frequencies{80.32e6, 60.24e6};
  const Bench bench(bench_camera(frequencies));
  const double common = half_wave(20.08e6);
  for (const double shift : {-0.02, 0.02}) {
    for (const double half_path : {0.0, 1e-4, common - 1e-4}) {
      EXPECT_NEAR(error_of(bench, frequencies, common, half_path, {shift, -shift}),
                  shift *
                      (half_wave(80.32e6) / (half_wave(80.32e6) * half_wave(80.32e6)) -
                       half_wave(60.24e6) / (half_wave(60.24e6) * half_wave(60.24e6))) /
                      (1 / (half_wave(80.32e6) * half_wave(80.32e6)) + 1 / (half_wave(60.24e6) * half_wave(60.24e6))),
                  2e-6);
    }
  }
}

// Weights 1/σ²: the sharper one counts.
TEST(unwrapping, weighs_by_the_variance) {
  const Bench bench(bench_camera({80e6, 60e6}));
  const double d = 3.0, r1 = half_wave(80e6), r2 = half_wave(60e6);
  const float turns[2] = {static_cast<float>(d / r1 - std::floor(d / r1) + 0.01), static_cast<float>(d / r2 - std::floor(d / r2))};
  for (const double ratio : {0.1, 1.0, 3.0}) {
    const float weight[2] = {static_cast<float>(1 / std::pow(0.002 * ratio, 2)), static_cast<float>(1 / (0.002 * 0.002))};
    const double w1 = 1 / (ratio * ratio), expected = d + 0.01 * r1 * w1 / (w1 + 1);
    const auto got = depth::unwrap<float>(bench.decoder(), turns, weight);
    EXPECT_NEAR(static_cast<double>(got.value), expected, 2e-6);
    EXPECT_NEAR(std::sqrt(static_cast<double>(got.variance)), 0.002 / std::sqrt(w1 + 1), 1e-8);
  }
}
