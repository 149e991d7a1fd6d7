// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
// What is read of a tap's charge: a curve behind the full well.                                                     [theory: nonlinearity]
#include <gtest/gtest.h>

#include <cmath>

#include "effect/nonlinearity.h"
#include "support/bench.h"
#include "tofray/tofray.h"

using namespace tofray;
using namespace tofray::test;

namespace {

constexpr double bend = 100000;  // X [e⁻]

/// read_of(x) = x − x²/(2X), in samples of which a not-a-knot spline makes the very same parabola. Where the taps add up to S it takes the share
/// 1 − S/(2X) of their difference: read_of(a) − read_of(b) = (a − b)·(1 − (a + b)/(2X)).
double read_of(double x) { return x - x * x / (2 * bend); }

Camera bent(double full_well_e = 1e30) {
  Camera camera = bench_camera({60.24e6}, 4, 0.7, true);
  for (int i = 0; i <= 8; ++i) camera.pixel.nonlinearity.x.push_back(1e4 * i), camera.pixel.nonlinearity.y.push_back(read_of(1e4 * i));
  camera.pixel.full_well_e = full_well_e;
  return camera;
}

}  // namespace

// Lines over 1024 cells of 78 e⁻ are off by width²/(8X) = 0.008 e⁻ at most; beyond the end the last goes on.
TEST(nonlinearity, is_the_curve_and_goes_on_beyond_its_ends) {
  const Bench bench(bent());
  const camera::ReadCurveView& curve = bench.sensor().read;
  for (double x = 0; x <= 80000; x += 123.4)
    EXPECT_NEAR(static_cast<double>(effect::read_charge(curve, static_cast<float>(x)).value), read_of(x), 0.02) << x;
  const double slope_at_end = 1 - (80000 - 0.5 * 80000 / 1024) / bend;
  EXPECT_NEAR(static_cast<double>(effect::read_charge(curve, 90000.0f).value), read_of(80000) + 1e4 * slope_at_end, 1);
  EXPECT_NEAR(static_cast<double>(effect::read_charge(curve, -1000.0f).value), -1000, 1);  // read noise
}

TEST(nonlinearity, acts_on_each_tap_behind_the_full_well) {
  const Bench bench(bent(50000));
  const auto taps = bench.expose({40000, 1.0, 10000});
  for (std::size_t k = 0; k < 4; ++k) {
    const double half = 0.5 * 40000 * 0.7 * std::cos(two_pi * (2.0 * 60.24e6 / c + static_cast<double>(k) / 4));
    EXPECT_NEAR(static_cast<double>(taps[k + 1].a), read_of(25000 + half), 0.03) << k;
    EXPECT_NEAR(static_cast<double>(taps[k + 1].b), read_of(25000 - half), 0.03) << k;
    EXPECT_NEAR(static_cast<double>(taps[k + 1].difference), 2 * half * (1 - 50000 / (2 * bend)), 0.06) << k;
  }
  bool clipped = false;
  const auto full = bench.expose({0, 0, 70000}, 0, 0, &clipped);  // the grey raw frame clips, which is no fault; the lit ones do not
  EXPECT_NEAR(static_cast<double>(full[0].a), read_of(50000), 0.03);
  EXPECT_FALSE(clipped);
  (void)bench.expose({0, 0, 100001}, 0, 0, &clipped);
  EXPECT_TRUE(clipped);
}

// Single precision knows a charge of 1e5 e⁻ to 0.008; a curve's slope, here 0.2 at least, makes five times as much of it.
TEST(nonlinearity, is_undone_cell_by_cell_whichever_way_it_bends) {
  const auto bending = [](double third) {
    Camera camera = bent(90000);
    camera.pixel.nonlinearity = {};
    for (int i = 0; i <= 8; ++i) {
      const double x = 1e4 * i;
      camera.pixel.nonlinearity.x.push_back(x),
          camera.pixel.nonlinearity.y.push_back(x + third * (x - 4e4) * (x - 4e4) * (x - 4e4) + third * 6.4e13);
    }
    return camera;
  };
  for (const Camera& camera : {bent(90000), bending(1e-9), bending(-1.6e-10)}) {
    const Bench bench(camera);
    const camera::ReadCurveView& curve = bench.sensor().read;
    for (float x = -500; x < 90000; x += 37)
      EXPECT_NEAR(static_cast<double>(effect::charge_of(curve, effect::read_charge(curve, x).value)), static_cast<double>(x), 0.1) << x;
    // the cell by a guess is that by halves: the charge lies in it, or beyond an end
    for (int i = 0; i < curve.cells; ++i) {
      const float begin = curve.cell[2 * i], step = curve.cell[2 * i + 1];
      for (const float read : {begin, std::nextafter(begin, -1e9f), begin + 0.5f * step, begin + step}) {
        const float cell = effect::cell_of(curve, read);
        const int at = 2 * static_cast<int>(cell);
        const float charge = (cell + (read - curve.cell[at]) / curve.cell[at + 1]) * (1.0f / curve.per_cell);
        EXPECT_EQ(effect::charge_of(curve, read), std::fmax(std::fmin(charge, curve.most), -curve.most)) << i;
      }
    }
    EXPECT_EQ(effect::charge_of(curve, 1e9f), 90000.0f);  // no tap holds more
    EXPECT_EQ(effect::charge_of(curve, -1e9f), -90000.0f);
  }
}

// A sample far beyond the full well takes no lines away from where charge is: the samples lie on the lines' ends, each 128 cells on.
TEST(nonlinearity, ends_where_a_tap_is_full) {
  Camera camera = bent(80000);
  camera.pixel.nonlinearity.x.push_back(1e9), camera.pixel.nonlinearity.y.push_back(1e8);
  const Bench far(camera);
  for (int i = 0; i <= 8; ++i) {
    const double x = 1e4 * i;
    EXPECT_NEAR(static_cast<double>(effect::read_charge(far.sensor().read, static_cast<float>(x)).value), read_of(x), 0.02) << x;
  }
}

// Of a frame's tap_a and tap_b the same depth comes as of the frame itself. The curve is no parabola, which would leave the phase; and a full well
// reads less than its charge.
TEST(nonlinearity, of_recorded_taps_is_not_applied_twice) {
  Camera camera = load_camera("pico-flexx");
  for (int i = 0; i <= 8; ++i) {
    const double x = 125 * i;
    camera.pixel.nonlinearity.x.push_back(x), camera.pixel.nonlinearity.y.push_back(x - x * x * x / (3 * 1200.0 * 1200));
  }
  camera.pixel.full_well_e = 1000;
  camera.decoding.noise_threshold_m = 100, camera.decoding.flying_check = false;  // of recorded raw frames both look at noise
  Simulator simulator(load_scene("card"), camera, {.noise = Noise::off, .threads = 1});
  Frame first = simulator.frame(0);
  Raw taps = first.raw;
  taps.raw.clear();
  const Depth again = process(taps, camera);
  int full = 0, valid = 0;
  for (std::size_t i = 0; i < first.depth.flags.size(); ++i) {
    EXPECT_EQ(again.flags[i] & 1, first.depth.flags[i] & 1) << i;
    full += first.depth.flags[i] & 1;
    if (std::isnan(first.depth.range_m[i])) continue;
    ++valid;
    EXPECT_NEAR(again.range_m[i], first.depth.range_m[i], 1e-5) << i;
  }
  EXPECT_GT(full, 100);
  EXPECT_GT(valid, 100);
}

TEST(nonlinearity, is_refused_where_it_is_no_rising_curve_from_nothing) {
  const auto refusal = [](const Curve& curve) -> std::string {
    Camera camera = load_camera("pico-flexx");
    camera.pixel.nonlinearity = curve;
    try {
      Simulator(load_scene("card"), camera, {.threads = 1});
    } catch (const Error& error) {
      return error.what();
    }
    return "taken";
  };
  EXPECT_NE(refusal({{0}, {0}}).find("has one sample"), std::string::npos) << refusal({{0}, {0}});
  EXPECT_NE(refusal({{10, 20}, {10, 20}}).find("does not begin at 0 e"), std::string::npos);
  EXPECT_NE(refusal({{0, 20}, {1, 20}}).find("does not begin at 0 e"), std::string::npos);
  EXPECT_NE(refusal({{0, 100, 200}, {0, 90, 90}}).find("does not rise"), std::string::npos);
  EXPECT_NE(refusal({{0, 100, 200}, {0, 90, 2000}}).find("at most 10 e for each electron"), std::string::npos);
  EXPECT_NE(refusal({{0, 0.5}, {0, 0.5}}).find("ends below 1 e"), std::string::npos);
  // Up to the full well of 100 ke or the last sample 1024 lines of 97.7 e⁻ each.
  EXPECT_NE(refusal({{0, 90, 2e5}, {0, 80, 1e5}}).find("samples of the nonlinearity are closer than the lines that stand for it"),
            std::string::npos)
      << refusal({{0, 90, 2e5}, {0, 80, 1e5}});
  EXPECT_EQ(refusal({{0, 98, 2e5}, {0, 80, 1e5}}), "taken");
  EXPECT_EQ(refusal({{0, 50e3, 1e5, 100010, 1e9}, {0, 45e3, 8e4, 80001, 1e8}}), "taken");  // what is beyond the well does not count
  EXPECT_EQ(refusal({{0, 1}, {0, 10}}), "taken");
  EXPECT_EQ(refusal({{0, 1e12}, {0, 1e12}}), "taken");
}
