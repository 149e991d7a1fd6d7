// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
// What a camera can do, asked from C++: wrong cycles above all, against closed forms, draws of phasors and the simulator's own frames.
#include "tofray/camera_report.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

#include "analysis/wrong_cycles.h"
#include "support/pi.h"
#include "tofray/error.h"
#include "tofray/load.h"
#include "tofray/simulator.h"
#include "tofray/stages.h"

using namespace tofray;
using analysis::phase_density;
using test::pi;

namespace {

/// Of phases without wiggling.
double wrong_cycle_probability(const std::vector<double>& sigma_rad, const std::vector<int>& cycles) {
  std::vector<analysis::NoisyPhase> phases;
  for (const double sigma : sigma_rad) phases.push_back({sigma, {}});
  return analysis::wrong_cycle_probability(phases, cycles);
}

/// Trapezoids over −π…π, exact for what is periodic and smooth.
template <class F>
double over_all_phases(const F& f) {
  constexpr int steps = 20000;
  double sum = 0;
  for (int i = 0; i < steps; ++i) sum += f(-pi + 2 * pi * i / steps);
  return sum * 2 * pi / steps;
}

TEST(phase_density, is_a_density_and_that_of_drawn_phasors) {
  for (const double sigma : {0.02, 0.1, 0.5, 1.0, 3.0}) {
    EXPECT_NEAR(over_all_phases([&](double x) { return phase_density(x, sigma); }), 1, 1e-12) << sigma;
    // E cos θ of a noisy phasor: √(π/8)·ρ·e^{−ρ²/4}·(I₀(ρ²/4) + I₁(ρ²/4)).
    const double rho = 1 / sigma, quarter = rho * rho / 4;
    if (quarter > 600) continue;
    const double closed =
        std::sqrt(pi / 8) * rho * std::exp(-quarter) * (std::cyl_bessel_i(0.0, quarter) + std::cyl_bessel_i(1.0, quarter));
    EXPECT_NEAR(over_all_phases([&](double x) { return std::cos(x) * phase_density(x, sigma); }), closed, 1e-9) << sigma;
  }
}

// The table of theory 4.2, which was found by integrating both densities on grids of their own.
TEST(wrong_cycles, of_four_to_three_are_those_of_the_theory) {
  const struct {
    double sigma, share, digits;
  } rows[] = {{0.10, 1.5e-9, 0.1e-9}, {0.12, 5.0e-7, 0.1e-7}, {0.15, 6.1e-5, 0.1e-5}, {0.20, 2.8e-3, 0.1e-3}, {0.25, 1.76e-2, 0.01e-2}};
  for (const auto& row : rows) EXPECT_NEAR(wrong_cycle_probability({row.sigma, row.sigma}, {4, 3}), row.share, row.digits) << row.sigma;
}

// Where the angle in question is small, phases are normal: [theory: wrong-cycle].
TEST(wrong_cycles, of_close_frequencies_are_those_of_normal_phases) {
  for (const double sigma : {0.008, 0.01, 0.015}) {
    const double sigma_q = std::hypot(80 * sigma, 79 * sigma) / (2 * pi);
    EXPECT_NEAR(wrong_cycle_probability({sigma, sigma}, {80, 79}) / std::erfc(0.5 / (std::numbers::sqrt2 * sigma_q)), 1, 2e-3) << sigma;
  }
}

// The noise of one modulation frequency counts as many times as the other has cycles: M of the second, N of the first.
TEST(wrong_cycles, weigh_each_frequencys_noise_by_the_cycles_of_the_other) {
  const double sigma_q = std::hypot(40 * 0.03, 3 * 0.005) / (2 * pi);
  EXPECT_NEAR(wrong_cycle_probability({0.005, 0.03}, {40, 3}) / std::erfc(0.5 / (std::numbers::sqrt2 * sigma_q)), 1, 1e-2);
}

TEST(wrong_cycles, depend_on_each_frequencys_noise_and_not_on_their_order) {
  const double one = wrong_cycle_probability({0.1, 0.3}, {4, 3}), other = wrong_cycle_probability({0.3, 0.1}, {3, 4});
  EXPECT_NEAR(one / other, 1, 1e-4);  // grids of 4,096 steps
  EXPECT_GT(std::fabs(wrong_cycle_probability({0.3, 0.1}, {4, 3}) / one - 1), 0.05);
}

// A correction that stretches all errors by half is as half as much noise again, where errors are small.
TEST(wrong_cycles, are_those_of_corrected_phases) {
  const auto stretched = [](double error) { return error + 0.5 * std::sin(error); };
  const double one = analysis::wrong_cycle_probability({{0.012, stretched}, {0.012, stretched}}, {40, 39});
  EXPECT_NEAR(one / wrong_cycle_probability({0.018, 0.018}, {40, 39}), 1, 5e-3);
  EXPECT_GT(one, 1e-3);
}

TEST(wrong_cycles, are_none_of_one_frequency_or_without_noise) {
  EXPECT_EQ(wrong_cycle_probability({1.0}, {1}), 0);
  EXPECT_EQ(wrong_cycle_probability({0, 0}, {4, 3}), 0);
  EXPECT_EQ(wrong_cycle_probability({0, 0, 0}, {4, 3, 2}), 0);
}

// By three frequencies, against pseudo-random phasors: half paths R_i p_i, unwrapped by trying every cycle of each.
TEST(wrong_cycles, of_three_frequencies_are_those_of_drawn_phasors) {
  const int cycles[] = {15, 12, 10};
  std::mt19937_64 words(7);
  std::normal_distribution<double> normal;
  for (const double sigma : {0.12, 0.2, 0.4, 1.0}) {
    constexpr int draws = 20000;
    int wrong = 0;
    for (int draw = 0; draw < draws; ++draw) {
      double error[3], best = 1e9;
      for (int i = 0; i < 3; ++i) error[i] = std::atan2(sigma * normal(words), 1 + sigma * normal(words)) / (2 * pi) / cycles[i];
      bool right = false;
      for (int n = 0; n < 10; ++n) {  // of the reference, and the nearest of the two others
        double cost = 0;
        bool own = n == 0;
        for (int i = 0; i < 2; ++i) {
          double least = 1e9;
          int nearest = 0;
          for (int m = -1; m <= cycles[i] + 1; ++m) {
            const double apart = std::fabs(error[i] + static_cast<double>(m) / cycles[i] - error[2] - n / 10.0);
            if (apart < least) least = apart, nearest = m;
          }
          own = own && nearest == 0;
          cost += least * least;
        }
        if (cost < best) best = cost, right = own;
      }
      wrong += right ? 0 : 1;
    }
    const double share = static_cast<double>(wrong) / draws, here = wrong_cycle_probability({sigma, sigma, sigma}, {15, 12, 10});
    // Five standard errors of the draws, and what 16,384 even points leave: one false alarm in a million.
    EXPECT_NEAR(here, share, 5 * std::sqrt(share * (1 - share) / draws) + 2e-3) << sigma;
    EXPECT_GT(here, 0) << sigma;
  }
}

/// All pixels look along the axis and see a wall that faces them; no pattern, no flag that needs neighbours, no threshold.
struct AxisCamera {
  explicit AxisCamera(const std::string& profile) : camera(load_camera(profile)) {
    camera.sensor.width = camera.sensor.height = pixels;
    camera.lens.fx_px = camera.lens.fy_px = 1e5;
    camera.lens.cx_px = camera.lens.cy_px = 0.5 * (pixels - 1);
    camera.lens.k1 = camera.lens.k2 = camera.lens.k3 = camera.lens.k4 = camera.lens.k5 = camera.lens.k6 = camera.lens.p1 = camera.lens.p2 =
        0;
    camera.lens.scatter = {}, camera.decoding.filter = {}, camera.decoding.flying_check = false;
    camera.decoding.noise_threshold_m = 1e3;
    camera.pixel.prnu = camera.pixel.dsnu_dn = camera.pixel.delay_s = camera.pixel.phase_offset_rad = 0;
  }
  static constexpr int pixels = 256;
  Camera camera;
};

/// The share of one frame's pixels that are off by more than half of the shortest range.
double simulated_share(const Camera& camera, double z, double reflectivity, double shortest_m) {
  Geometry wall;
  wall.width = camera.sensor.width, wall.height = camera.sensor.height;
  const std::size_t count = static_cast<std::size_t>(wall.width) * static_cast<std::size_t>(wall.height);
  wall.z_m.assign(count, static_cast<float>(z)), wall.diffuse.assign(count, static_cast<float>(reflectivity));
  wall.normal.assign(3 * count, 0.0F);
  for (std::size_t i = 0; i < count; ++i) wall.normal[3 * i + 2] = -1.0F;
  SimulatorOptions options;
  options.backend = Backend::cpu, options.seed = 5;
  const Depth depth = Simulator(Scene(), camera, options).frame(0, wall).depth;
  int wrong = 0;
  for (const float range : depth.range_m) wrong += !(std::fabs(static_cast<double>(range) - z) < shortest_m / 2) ? 1 : 0;
  return static_cast<double>(wrong) / static_cast<double>(count);
}

// 65,536 pixels: five standard errors, and a twentieth of the share, since the noise of both frequencies is that of expected light, its
// harmonics left out (amplitudes are 3 % off between sampling points).
TEST(camera_report, wrong_cycles_are_those_of_simulated_frames) {
  const AxisCamera axis("pico-flexx");
  CameraQuestion question;
  question.distances_m = {2.5, 3.0, 4.0}, question.reflectivities = {0.2}, question.ambients = {AmbientCase()};
  const CameraReport report = camera_report(axis.camera, question);
  ASSERT_EQ(report.noise.size(), 1U);
  EXPECT_EQ(report.cycles, (std::vector<int>{4, 3}));
  for (const NoiseAt& here : report.noise[0].at) {
    const double share = simulated_share(axis.camera, here.z_m, 0.2, 299792458.0 / 2 / 80.32e6);
    EXPECT_GT(share, 1e-3) << here.z_m;
    EXPECT_NEAR(here.wrong_cycle, share, 5 * std::sqrt(share / 65536) + 0.05 * share) << here.z_m;
  }
}

TEST(camera_report, warns_of_frequencies_whose_cycles_noise_confuses) {
  Camera camera = load_camera("pico-flexx");
  EXPECT_TRUE(camera_report(camera).warnings.empty());
  for (RawFrame& one : camera.mode.sequence)
    if (one.modulation_frequency_hz == 60.24e6) one.modulation_frequency_hz = 79.52e6;
  const CameraReport report = camera_report(camera);
  ASSERT_EQ(report.warnings.size(), 1U);
  EXPECT_NE(report.warnings[0].find("on a wrong cycle: the modulation frequencies 80.32 MHz and 79.52 MHz are as 502 to 497"),
            std::string::npos)
      << report.warnings[0];
}

TEST(camera_report, answers_what_is_asked_in_its_order) {
  CameraQuestion question;
  question.distances_m = {3, 1}, question.reflectivities = {0.5, 0.1, 0.9};
  AmbientCase dim = full_sun();
  dim.name = "dim", dim.ambient.quantity = Ambient::Quantity::illuminance_lx, dim.ambient.amount = 500;
  question.ambients = {dim, full_sun()};
  const CameraReport report = camera_report(load_camera("pico-flexx"), question);
  ASSERT_EQ(report.noise.size(), 6U);
  EXPECT_EQ(report.noise[2].ambient, "dim");
  EXPECT_EQ(report.noise[2].reflectivity, 0.9);
  EXPECT_EQ(report.noise[3].ambient, "in the sun");
  ASSERT_EQ(report.noise[1].at.size(), 2U);
  EXPECT_EQ(report.noise[1].at[0].z_m, 3);
  EXPECT_GT(report.noise[1].at[0].sigma_m, report.noise[1].at[1].sigma_m);
  EXPECT_GT(report.noise[4].at[1].sigma_m, 2 * report.noise[1].at[1].sigma_m);  // the sun
}

TEST(camera_report, refuses_what_no_wall_can_be) {
  const Camera camera = load_camera("pico-flexx");
  for (const double z : {0.0, -1.0, 1e6, std::nan("")}) {
    CameraQuestion question;
    question.distances_m = {z};
    EXPECT_THROW(camera_report(camera, question), Error) << z;
  }
  for (const double share : {-0.1, 1.1, std::nan("")}) {
    CameraQuestion question;
    question.reflectivities = {share};
    EXPECT_THROW(camera_report(camera, question), Error) << share;
  }
}

}  // namespace
