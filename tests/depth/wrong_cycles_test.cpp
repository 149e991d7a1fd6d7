// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

#include "support/bench.h"

using namespace tofray;
using namespace tofray::test;

namespace {

struct Pair {
  double f1, f2, base;
  double sigma;  ///< σ_φ of both, by the closed form [theory: phase-noise]
  [[nodiscard]] double m() const { return f1 / base; }
  [[nodiscard]] double n() const { return f2 / base; }
};

/// erfc(½/(√2·σ_q)), σ_q = σ_φ·√(M² + N²)/2π: as if phases were normal.
double of_normal_phases(const Pair& p) { return std::erfc(0.5 / (std::sqrt(2.0) * p.sigma * std::hypot(p.m(), p.n()) / two_pi)); }

/// Share of wrong cycles from the distribution that the phase of a phasor with normal noise in both components has,
/// p(θ) = e^{−ρ²/2}/2π + ρ·cosθ/√(2π)·e^{−ρ²sin²θ/2}·Φ(ρ·cosθ), ρ = 1/σ_φ: the chance that |M·θ_2 − N·θ_1| > π, by sums.
double of_noisy_phasors(const Pair& p) {
  constexpr int cells = 8000;
  const double rho = 1 / p.sigma, step = two_pi / cells;
  std::vector<double> density, below{0};
  for (int i = 0; i <= cells; ++i) {
    const double theta = -pi + i * step, along = rho * std::cos(theta);
    density.push_back(std::exp(-rho * rho / 2) / two_pi + along / std::sqrt(two_pi) * std::exp(-std::pow(rho * std::sin(theta), 2) / 2) *
                                                              0.5 * std::erfc(-along / std::sqrt(2.0)));
    if (i > 0) below.push_back(below.back() + 0.5 * (density.back() + density[static_cast<std::size_t>(i) - 1]) * step);
  }
  const auto share_below = [&](double theta) {
    const double place = std::clamp((theta + pi) / step, 0.0, cells - 1e-9);
    const auto i = static_cast<std::size_t>(place);
    return below[i] + (place - static_cast<double>(i)) * (below[i + 1] - below[i]);
  };
  double sum = 0;
  for (int i = 0; i < cells; ++i) {
    const double theta = -pi + i * step;
    const double wrong = 1 - share_below((pi + p.n() * theta) / p.m()) + share_below((-pi + p.n() * theta) / p.m());
    sum += density[static_cast<std::size_t>(i)] * step * wrong;
  }
  return sum;
}

constexpr int draws = 200'000;

/// Raw frames with shot noise of strong ambient light, through the decoder: the share of wrong cycles.
double simulated(const Pair& p) {
  const double signal = 2000, contrast = 0.7, ambient = 2 * std::pow(p.sigma * signal * contrast, 2) - signal;  // σ_φ = √V/(√2·S·C)
  Camera camera = bench_camera({p.f1, p.f2}, 4, contrast);
  camera.adc.step_e_per_dn = 1;
  const Bench bench(camera, true);
  std::mt19937_64 random(31);
  const double common = c / (2 * p.base);
  int wrong = 0;
  for (int i = 0; i < draws; ++i) {
    const double half_path = common * static_cast<double>(random() >> 11) * 0x1p-53;
    const double off = static_cast<double>(bench.measure({signal, half_path, ambient}, i).depth.range) - half_path;
    wrong += std::abs(off - common * std::round(off / common)) > 0.5 * c / (2 * p.f1);
  }
  return static_cast<double>(wrong) / draws;
}

double binomial_error(double share) { return std::sqrt(share * (1 - share) / draws); }

}  // namespace

// Ratio 10:9: a wrong cycle takes a phase off by π·10/181 = 0.17 rad, where the phase is as good as normal. The closed form is 4.6 % low.
TEST(wrong_cycles, are_as_many_as_the_closed_form_says_where_small_angles_suffice) {
  const Pair p{100e6, 90e6, 10e6, 0.10};
  const double share = simulated(p);
  EXPECT_LT(std::abs(share - of_noisy_phasors(p)), 5.5 * binomial_error(share));
  EXPECT_NEAR(of_noisy_phasors(p) / of_normal_phases(p), 1.046, 0.002);
  EXPECT_NEAR(share / of_normal_phases(p), 1, 0.046 + 5.5 * binomial_error(share) / share);
}

// 4:3 takes 0.50 rad, where a noisy phasor's phase has longer tails than a normal: 1.76 % of wrong cycles against 1.20 %.
TEST(wrong_cycles, are_more_than_the_closed_form_says_where_large_angles_are_needed) {
  const Pair p{80.32e6, 60.24e6, 20.08e6, 0.25};
  const double share = simulated(p);
  EXPECT_NEAR(of_normal_phases(p), 0.01196, 1e-5);
  EXPECT_NEAR(of_noisy_phasors(p), 0.01756, 1e-5);
  EXPECT_LT(std::abs(share - of_noisy_phasors(p)), 5.5 * binomial_error(share));
  EXPECT_GT(share - of_normal_phases(p), 10 * binomial_error(share)) << "the closed form does not hold here";
}

// Table of chapter 4: how much more often than by the closed form.
TEST(wrong_cycles, have_the_shares_that_the_theory_prints) {
  const struct {
    double sigma, by_the_form, true_share;
  } known[] = {{0.10, 3.3e-10, 1.5e-9}, {0.12, 1.6e-7, 5.0e-7}, {0.15, 2.8e-5, 6.1e-5}, {0.20, 1.7e-3, 2.8e-3}, {0.25, 1.2e-2, 1.8e-2}};
  for (const auto& k : known) {
    const Pair p{80.32e6, 60.24e6, 20.08e6, k.sigma};
    EXPECT_NEAR(of_normal_phases(p) / k.by_the_form, 1, 0.04) << k.sigma;
    EXPECT_NEAR(of_noisy_phasors(p) / k.true_share, 1, 0.04) << k.sigma;
  }
}
