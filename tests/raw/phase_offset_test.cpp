// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
// Fixed phases of pixels, others at each modulation frequency.                                                      [theory: phase-offset]
#include <gtest/gtest.h>

#include <cmath>

#include "camera/pixel/pixel_delay.h"
#include "support/bench.h"
#include "tofray/tofray.h"

using namespace tofray;
using namespace tofray::test;

namespace {

constexpr double two_frequencies[] = {80.32e6, 60.24e6};

Camera phases_on(int width, double phase_offset_rad, double delay_s = 0) {
  Camera camera = bench_camera({two_frequencies[0], two_frequencies[1]});
  camera.sensor.width = width;
  camera.pixel.phase_offset_rad = phase_offset_rad, camera.pixel.delay_s = delay_s;
  return camera;
}

/// What a pixel has at a modulation frequency [rad].
double phase_of(const Bench& bench, int pixel, int modulation) {
  return two_pi * two_frequencies[modulation] * static_cast<double>(camera::late_by<float>(bench.sensor(), modulation, {pixel, 1}));
}

}  // namespace

// A deviation of n normal numbers scatters by 1/√(2n) of itself: 5.5 of them, a false alarm in 26 million.
TEST(phase_offset, has_its_deviation_at_each_modulation_frequency_and_no_correlation) {
  constexpr int width = 100'000;
  const Bench bench(phases_on(width, 0.02));
  Moments first, second;
  Correlation both(0, 0);
  for (int i = 0; i < width; ++i) {
    const double a = phase_of(bench, i, 0), b = phase_of(bench, i, 1);
    first.add(a), second.add(b), both.add(a, b);
  }
  EXPECT_NEAR(first.deviation() / 0.02, 1, 5.5 / std::sqrt(2.0 * width));
  EXPECT_NEAR(second.deviation() / 0.02, 1, 5.5 / std::sqrt(2.0 * width));
  EXPECT_LT(std::abs(both.z()), 5.5);
}

TEST(phase_offset, belongs_to_the_specimen_and_leaves_the_delays_alone) {
  Camera camera = phases_on(100, 0.02, 20e-12);
  const Bench one(camera, true, 1), again(camera, true, 99), delays(phases_on(100, 0, 20e-12)), phases(phases_on(100, 0.02));
  camera.pixel.pattern_seed = 2;
  const Bench other(camera, true, 1);
  for (int i = 0; i < 100; ++i) {
    for (int j = 0; j < 2; ++j) {
      EXPECT_EQ(phase_of(one, i, j), phase_of(again, i, j));
      EXPECT_NE(phase_of(one, i, j), phase_of(other, i, j));
      EXPECT_NEAR(phase_of(one, i, j), phase_of(delays, i, j) + phase_of(phases, i, j), 1e-8);  // two roundings of some 0.05 rad
    }
  }
  EXPECT_EQ(delays.sensor().delay_stride, 0);  // one map for all modulation frequencies
}

// It moves the phase that is measured by as much, and the decoder, which knows it as it knows the delays, takes it out.
TEST(phase_offset, moves_the_phase_of_its_modulation_frequency_and_is_taken_out) {
  const Bench bench(phases_on(200, 0.05));
  for (int i = 0; i < 200; ++i) {
    const Measured m = bench.measure({20000, 1.0, 0}, i);
    for (int j = 0; j < 2; ++j) {
      const double turns = static_cast<double>(bench.estimate(m.taps, j).turns);
      EXPECT_NEAR(wrapped(turns - 2 * two_frequencies[j] / c - phase_of(bench, i, j) / two_pi), 0, 2e-7);
    }
    EXPECT_NEAR(static_cast<double>(m.depth.range), 1.0, 2e-6);
  }
}

// Phase offsets through the whole simulator, and through raw frames that are decoded later: pixels are not mixed up.
TEST(phase_offset, is_taken_out_of_each_pixel_of_an_image) {
  Camera camera = load_camera("pico-flexx");
  const Scene scene = load_scene("card");
  const SimulatorOptions options{.noise = Noise::off, .threads = 1};
  const Frame plain = Simulator(scene, camera, options).frame(0);
  camera.pixel.phase_offset_rad = 0.1;
  Simulator simulator(scene, camera, options);
  const Frame frame = simulator.frame(0);
  int moved = 0;
  for (std::size_t i = 0; i < plain.depth.range_m.size(); ++i) {
    if ((plain.depth.flags[i] & flags_invalid) != 0) continue;
    EXPECT_NEAR(frame.depth.range_m[i], plain.depth.range_m[i], 1e-4) << i;  // between nodes of the wiggling table
    moved += frame.raw.raw[i + plain.depth.range_m.size()] != plain.raw.raw[i + plain.depth.range_m.size()] ? 1 : 0;
  }
  EXPECT_GT(moved, 1000);
}
