// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <vector>

#include "support/bench.h"

using namespace tofray;
using namespace tofray::test;

namespace {

struct Setting {
  double signal, ambient, read, amplitude;
  int phases;
  double step;
};

/// σ_φ = √(2V/N)/(S·C), V = S + B + 2σ_r² + s²/12.
double phase_deviation(const Setting& s) {
  const double variance = s.signal + s.ambient + 2 * s.read * s.read + s.step * s.step / 12;
  return std::sqrt(2 * variance / s.phases) / (s.signal * s.amplitude);
}

Camera camera_of(const Setting& s) {
  Camera camera = bench_camera({60.24e6}, s.phases, s.amplitude);
  camera.pixel.read_noise_e = s.read;
  camera.adc.step_e_per_dn = s.step;
  return camera;
}

class TwoTapNoise : public testing::TestWithParam<Setting> {};

/// Correlation of two draws over 2e5 pixels, in units of its standard error. Each is a mean and a function of the pixel.
struct Stream {
  double mean;
  std::function<double(int pixel)> draw;
};

constexpr int samples = 200'000;

double correlation(const Stream& x, const Stream& y) {
  Correlation c(x.mean, y.mean);
  for (int i = 0; i < samples; ++i) c.add(x.draw(i), y.draw(i));
  return c.z();
}

/// Tap a or b of raw frame k with all that a draw is keyed by.
struct Key {
  int tap = 0, k = 0, shift = 0;
  std::uint64_t frame = 0, seed = 1;
};

Stream shot(double mean, const Key& key, camera::Noise noise = camera::Noise::apart) {
  return {mean, [=](int pixel) {
            camera::SensorView s{};
            if (noise == camera::Noise::merged) s.read_noise = 50, s.read_variance = 2500;
            s.keys = num::round_keys(static_cast<std::uint32_t>(key.seed), static_cast<std::uint32_t>(key.seed >> 32));
            const effect::FrameIndex frame{static_cast<std::uint32_t>(key.frame), static_cast<std::uint32_t>(key.frame >> 32)};
            const effect::TapPair<float> means{static_cast<float>(mean), static_cast<float>(mean)};
            effect::TapPair<float> got;
            if (noise == camera::Noise::merged) {
              effect::TapWords<float> words{};
              for (int k = 0; k <= key.k; ++k) got = raw::expose_merged<float>(s, means, pixel + key.shift, k, frame, words);
            } else {
              got = raw::expose_apart<float>(s, means, pixel + key.shift, key.k, frame);
            }
            return static_cast<double>(key.tap == 0 ? got.a : got.b);
          }};
}

}  // namespace

// 2e5 samples: the deviation's own standard error is 0.16 %, so that ±1 % is 6 sigma.
TEST_P(TwoTapNoise, of_the_phase_is_that_of_the_closed_form) {
  const Setting setting = GetParam();
  const double expected = phase_deviation(setting);
  ASSERT_LT(expected, 0.1);  // first order
  const Bench bench(camera_of(setting), true);
  const double phase = 0.37, half_path = phase * c / (2 * 60.24e6);
  Moments moments, amplitude(setting.signal * setting.amplitude);
  for (int i = 0; i < samples; ++i) {
    const auto estimate = bench.estimate(bench.expose({setting.signal, half_path, setting.ambient}, i));
    moments.add(wrapped(static_cast<double>(estimate.turns) - phase) * two_pi);
    amplitude.add(static_cast<double>(estimate.amplitude));
  }
  EXPECT_NEAR(moments.deviation() / expected, 1, 0.01);
  EXPECT_LT(std::abs(moments.mean()) / (expected / std::sqrt(samples)), 5);  // no bias
  // Rice: a noisy phasor is longer by σ²/2 on average, with the standard error of a length.
  const double rice = 1 + expected * expected / 2, error = expected / std::sqrt(samples);
  EXPECT_LT(std::abs(amplitude.mean() / (setting.signal * setting.amplitude) - rice), 5 * error);
}

INSTANTIATE_TEST_SUITE_P(settings, TwoTapNoise,
                         testing::Values(Setting{5000, 2000, 30, 0.7, 4, 1}, Setting{50000, 0, 0, 0.8, 4, 1},
                                         Setting{2000, 20000, 10, 0.9, 4, 1}, Setting{10000, 1000, 50, 0.5, 3, 1},
                                         Setting{1200, 100, 5, 0.75, 8, 1}, Setting{8000, 3000, 50, 0.81, 5, 20},
                                         Setting{1500, 0, 50, 0.8, 4, 20}, Setting{5000, 2000, 3.999, 0.7, 4, 1},
                                         Setting{5000, 2000, 4, 0.7, 4, 1}, Setting{3000, 0, 8, 0.9, 4, 1}),
                         [](const auto& which) { return "setting_" + std::to_string(which.index); });

// The bias is there to be seen: at σ_φ = 0.09 it is 0.4 %, eighteen standard errors.
TEST(amplitude, of_a_noisy_phasor_is_longer_by_rice_s_share) {
  const Setting setting{1500, 0, 50, 0.7, 4, 1};
  const double expected = phase_deviation(setting);
  const Bench bench(camera_of(setting), true);
  Moments amplitude(1050);
  for (int i = 0; i < samples; ++i) amplitude.add(static_cast<double>(bench.estimate(bench.expose({1500, 0.3, 0}, i)).amplitude));
  const double error = expected / std::sqrt(samples), longer = amplitude.mean() / 1050 - 1;
  EXPECT_GT(longer, 10 * error);
  EXPECT_LT(std::abs(longer - expected * expected / 2), 5 * error);
}

// 2e5 pairs, |r|·√n < 5: false alarm 6e-7 each. Pairs that differ in one thing only, on both sides of the switch.
TEST(draws, are_independent_of_each_other) {
  for (const double mean : {8.0, 1000.0}) {
    const auto base = shot(mean, {});
    EXPECT_LT(std::abs(correlation(base, shot(mean, {.tap = 1}))), 5) << "taps";
    EXPECT_LT(std::abs(correlation(base, shot(mean, {.k = 1}))), 5) << "raw frames";
    EXPECT_LT(std::abs(correlation(shot(mean, {.k = 2}), shot(mean, {.tap = 1, .k = 3}))), 5) << "tap and raw frame";
    EXPECT_LT(std::abs(correlation(base, shot(mean, {.shift = 1}))), 5) << "neighbours";
    EXPECT_LT(std::abs(correlation(base, shot(mean, {.shift = 224}))), 5) << "rows";
    EXPECT_LT(std::abs(correlation(base, shot(mean, {.frame = 1}))), 5) << "frames";
    EXPECT_LT(std::abs(correlation(base, shot(mean, {.frame = 1ull << 32}))), 5) << "frames 2^32 apart";
    EXPECT_LT(std::abs(correlation(base, shot(mean, {.seed = 2}))), 5) << "seeds";
    EXPECT_LT(std::abs(correlation(base, shot(mean, {.seed = 1 + (1ull << 32)}))), 5) << "seeds 2^32 apart";
  }
  EXPECT_LT(std::abs(correlation(shot(8, {}), shot(1000, {}))), 5) << "inversion and expansion";
}

TEST(draws, of_merged_noise_are_independent_of_each_other) {
  constexpr auto merged = camera::Noise::merged;
  const auto base = shot(1000, {}, merged);
  EXPECT_LT(std::abs(correlation(base, shot(1000, {.tap = 1}, merged))), 5) << "taps";
  EXPECT_LT(std::abs(correlation(base, shot(1000, {.k = 1}, merged))), 5) << "raw frames of one block";
  EXPECT_LT(std::abs(correlation(shot(1000, {.k = 1}, merged), shot(1000, {.k = 2}, merged))), 5) << "raw frames of two blocks";
  EXPECT_LT(std::abs(correlation(base, shot(1000, {.tap = 1, .k = 1}, merged))), 5);
  EXPECT_LT(std::abs(correlation(base, shot(1000, {.shift = 1}, merged))), 5) << "neighbours";
  EXPECT_LT(std::abs(correlation(base, shot(1000, {.shift = 224}, merged))), 5) << "rows";
  EXPECT_LT(std::abs(correlation(base, shot(1000, {.frame = 1}, merged))), 5) << "frames";
  EXPECT_LT(std::abs(correlation(base, shot(1000, {.frame = 1ull << 32}, merged))), 5) << "frames 2^32 apart";
  EXPECT_LT(std::abs(correlation(base, shot(1000, {.seed = 2}, merged))), 5) << "seeds";
  EXPECT_LT(std::abs(correlation(base, shot(1000, {.seed = 1 + (1ull << 32)}, merged))), 5) << "seeds 2^32 apart";
}

// Whole sequences, as frames take them: no raw frame's A or B is like another's, with shot and read noise apart and merged.
TEST(draws, of_a_whole_sequence_are_independent_of_each_other) {
  for (const double read : {3.0, 50.0}) {
    Camera camera = bench_camera({80.32e6, 60.24e6}, 4, 0.0001, true);
    camera.pixel.read_noise_e = read;
    const Bench bench(camera, true);
    constexpr std::size_t raw_frames = 9, taps = 2 * raw_frames;
    std::vector<Correlation> pairs(taps * taps, Correlation(500, 500));
    for (int i = 0; i < samples; ++i) {
      const auto got = bench.expose({600, 1.0, 400}, i);
      double value[taps];
      for (std::size_t k = 0; k < raw_frames; ++k)
        value[2 * k] = static_cast<double>(got[k].a), value[2 * k + 1] = static_cast<double>(got[k].b);
      for (std::size_t x = 0; x < taps; ++x) {
        for (std::size_t y = 0; y < x; ++y) pairs[x * taps + y].add(value[x], value[y]);
      }
    }
    for (std::size_t x = 0; x < taps; ++x) {
      for (std::size_t y = 0; y < x; ++y)
        EXPECT_LT(std::abs(pairs[x * taps + y].z()), 5) << "read noise " << read << ": " << x << " and " << y;
    }
  }
}

// One counter with and without read noise: the rest is the read noise, of the right size, and knows nothing of the shot noise.
TEST(draws, of_read_noise_are_independent_of_shot_noise) {
  camera::SensorView silent{}, noisy{};
  noisy.read_noise = 16;
  Correlation with_shot(0, 1000), between_taps(0, 0), with_other_shot(0, 1000);
  Moments size;
  for (int i = 0; i < samples; ++i) {
    const auto a = raw::expose_apart<float>(silent, {1000.0f, 1000.0f}, i, 0, {0, 0}),
               b = raw::expose_apart<float>(noisy, {1000.0f, 1000.0f}, i, 0, {0, 0});
    const double read_a = static_cast<double>(b.a - a.a), read_b = static_cast<double>(b.b - a.b);
    with_shot.add(read_a, static_cast<double>(a.a));
    with_other_shot.add(read_a, static_cast<double>(a.b));
    between_taps.add(read_a, read_b);
    size.add(read_a), size.add(read_b);
  }
  EXPECT_LT(std::abs(with_shot.z()), 5);
  EXPECT_LT(std::abs(with_other_shot.z()), 5);
  EXPECT_LT(std::abs(between_taps.z()), 5);
  EXPECT_NEAR(size.deviation(), 16, 5 * 16 / std::sqrt(4.0 * samples));
  EXPECT_LT(std::abs(size.mean()), 5 * 16 / std::sqrt(2.0 * samples));
}

// What suppression draws is not what shot and read noise drew for the same pixel, raw frame and frame: neither the value nor its size.
TEST(draws, of_suppression_are_independent_of_shot_and_read_noise) {
  camera::SensorView shot{}, read{}, taking{};
  read.read_noise = 16;
  taking.suppression_threshold = 1000, taking.suppression_budget = 1e6f, taking.suppression_noise = 1, taking.noise = camera::Noise::merged;
  std::vector<Correlation> pairs(24, Correlation(0, 0));
  for (int i = 0; i < samples; ++i) {
    effect::TapWords<float> words{};
    const auto without_read = raw::expose_apart<float>(shot, {10000.0f, 10000.0f}, i, 0, {0, 0});
    const auto with_read = raw::expose_apart<float>(read, {10000.0f, 10000.0f}, i, 0, {0, 0});
    const auto together = raw::expose_merged<float>(shot, {10000.0f, 10000.0f}, i, 0, {0, 0}, words);
    effect::TapWords<float> own{};
    const auto left = effect::Suppression::suppress<float>(taking, {10000.0f, 10000.0f}, i, 0, {0, 0}, own);
    const double drawn[6] = {static_cast<double>(without_read.a) - 10000,       static_cast<double>(without_read.b) - 10000,
                             static_cast<double>(with_read.a - without_read.a), static_cast<double>(with_read.b - without_read.b),
                             static_cast<double>(together.a) - 10000,           static_cast<double>(together.b) - 10000};
    const double added[2] = {static_cast<double>(left.a) - 1000, static_cast<double>(left.b) - 1000};
    for (std::size_t x = 0; x < 6; ++x) {
      for (std::size_t y = 0; y < 2; ++y) {
        pairs[2 * x + y].add(drawn[x], added[y]), pairs[12 + 2 * x + y].add(drawn[x] * drawn[x], added[y] * added[y]);
      }
    }
  }
  for (std::size_t i = 0; i < pairs.size(); ++i) EXPECT_LT(std::abs(pairs[i].z()), 5) << (i < 12 ? "values " : "squares ") << i % 12;
}

// Three raw frames share a block of words: their draws know nothing of each other's, nor of those of the next block, and each is the same
// whether the pixel's charge was suppressed in raw frames before or not.
TEST(draws, of_suppression_are_independent_between_taps_and_raw_frames) {
  constexpr int raw_frames = 5;
  constexpr std::size_t draws = 2 * raw_frames;
  camera::SensorView s{};
  s.suppression_threshold = 1000, s.suppression_budget = 1e6f, s.suppression_noise = 1, s.noise = camera::Noise::merged;
  const effect::TapPair<float> charge{10000.0f, 10000.0f}, little{500.0f, 500.0f};
  std::vector<Correlation> values(draws * draws, Correlation(1000, 1000)), sizes(draws * draws, Correlation(9000, 9000));
  for (int i = 0; i < samples; ++i) {
    effect::TapWords<float> words{};
    double drawn[draws];
    for (int k = 0; k < raw_frames; ++k) {
      const auto left = effect::Suppression::suppress<float>(s, charge, i, k, {0, 0}, words);
      drawn[2 * k] = static_cast<double>(left.a), drawn[2 * k + 1] = static_cast<double>(left.b);
      if (i >= 100) continue;
      effect::TapWords<float> fresh{};
      for (int before = 0; before < k; ++before)
        (void)effect::Suppression::suppress<float>(s, before == 0 ? charge : little, i, before, {0, 0}, fresh);
      const auto alone = effect::Suppression::suppress<float>(s, charge, i, k, {0, 0}, fresh);
      ASSERT_EQ(alone.a, left.a) << "pixel " << i << ", raw frame " << k;
      ASSERT_EQ(alone.b, left.b) << "pixel " << i << ", raw frame " << k;
    }
    for (std::size_t x = 0; x < draws; ++x) {
      for (std::size_t y = 0; y < x; ++y) {
        const auto size = [&](std::size_t at) { return (drawn[at] - 1000) * (drawn[at] - 1000); };
        values[x * draws + y].add(drawn[x], drawn[y]), sizes[x * draws + y].add(size(x), size(y));
      }
    }
  }
  for (std::size_t x = 0; x < draws; ++x) {
    for (std::size_t y = 0; y < x; ++y) {
      EXPECT_LT(std::abs(values[x * draws + y].z()), 5) << x << " and " << y;
      EXPECT_LT(std::abs(sizes[x * draws + y].z()), 5) << "sizes of " << x << " and " << y;
    }
  }
}

// Three raw frames share a block of merged noise, too, and its fourth word: radii and angles of all of them are evenly spread, and no two know of
// each other, nor where within a 256th of a turn their angles lie, which is what the fourth word says. χ² over 64 cells of radius and 1,024 of angle, and |r|·√n < 5: false alarm 6e-7 each.
TEST(draws, of_merged_noise_that_share_a_block_are_as_good_as_any) {
  constexpr double mean = 1e6;
  constexpr std::size_t raw_frames = 5;
  const auto count = [](std::vector<double>& cells, double share) {
    const double last = static_cast<double>(cells.size()) - 1;
    ++cells[static_cast<std::size_t>(std::min(last, std::max(0.0, share * (last + 1))))];
  };
  camera::SensorView sensor{};
  std::vector<std::vector<double>> radius(raw_frames, std::vector<double>(64)), angle(raw_frames, std::vector<double>(1024));
  std::vector<Correlation> sizes(raw_frames * raw_frames, Correlation(2, 2)), values(4 * raw_frames * raw_frames, Correlation(0, 0)),
      places(raw_frames * raw_frames, Correlation(0.5, 0.5));
  for (int i = 0; i < samples; ++i) {
    effect::TapWords<float> words{};
    double z[raw_frames][2], size[raw_frames], place[raw_frames];
    for (std::size_t k = 0; k < raw_frames; ++k) {
      const auto got = raw::expose_merged<float>(sensor, {1e6f, 1e6f}, i, static_cast<int>(k), {0, 0}, words);
      z[k][0] = (static_cast<double>(got.a) - mean) / std::sqrt(mean), z[k][1] = (static_cast<double>(got.b) - mean) / std::sqrt(mean);
      size[k] = z[k][0] * z[k][0] + z[k][1] * z[k][1];
      const double turns = std::atan2(z[k][1], z[k][0]) / two_pi + 0.5;
      place[k] = 256 * turns - std::floor(256 * turns);
      count(radius[k], std::exp(-0.5 * size[k])), count(angle[k], turns);
      for (std::size_t before = 0; before < k; ++before) {
        const std::size_t pair = raw_frames * k + before;
        sizes[pair].add(size[k], size[before]), places[pair].add(place[k], place[before]);
        for (std::size_t tap = 0; tap < 4; ++tap) values[4 * pair + tap].add(z[k][tap / 2], z[before][tap % 2]);
      }
    }
  }
  for (std::size_t k = 0; k < raw_frames; ++k) {
    const auto even = [](std::size_t cells) {
      return std::vector<double>(cells, static_cast<double>(samples) / static_cast<double>(cells));
    };
    EXPECT_LT(std::abs(chi_square_z(radius[k], even(64))), 5) << "radius, raw frame " << k;
    EXPECT_LT(std::abs(chi_square_z(angle[k], even(1024))), 5) << "angle, raw frame " << k;
    for (std::size_t before = 0; before < k; ++before) {
      const std::size_t pair = raw_frames * k + before;
      EXPECT_LT(std::abs(sizes[pair].z()), 5) << "sizes, raw frames " << k << " and " << before;
      EXPECT_LT(std::abs(places[pair].z()), 5) << "places within a 256th, raw frames " << k << " and " << before;
      for (std::size_t tap = 0; tap < 4; ++tap)
        EXPECT_LT(std::abs(values[4 * pair + tap].z()), 5) << "values, raw frames " << k << " and " << before;
    }
  }
}
