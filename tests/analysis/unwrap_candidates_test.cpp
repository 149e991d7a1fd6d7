// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
// What unwrapping chooses from, against all cycles of all modulation frequencies tried in double precision.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "support/pi.h"
#include "support/pixels.h"
#include "tofray/pixel.h"

using namespace tofray;
using namespace tofray::test;

namespace {

/// A wall, seen with these modulation frequencies at four phases each.
struct Seen {
  Camera camera;
  Frame frame;
};
Seen seen_at(const std::vector<double>& frequencies_hz, double z, double power_w = 0.02) {
  Seen out{lit_camera(9, 7, 100), {}};
  out.camera.illumination[0].power_w = power_w;
  out.camera.decoding.noise_threshold_m = 10;
  out.camera.mode.sequence.clear();
  for (const double hz : frequencies_hz)
    for (int k = 0; k < 4; ++k) out.camera.mode.sequence.push_back({true, hz, k * pi / 2, 1e-3});
  SimulatorOptions options;
  options.seed = 3, options.backend = Backend::cpu, options.threads = 1;
  out.frame = Simulator(wall(z, 0.5), out.camera, options).frame(0);
  return out;
}

/// By the reference's cycle: the least sum of squares over all cycles of all others.
std::map<int, double> all_cycles_tried(const PixelChain& chain, const std::vector<int>& cycles) {
  const std::size_t reference = static_cast<std::size_t>(std::min_element(cycles.begin(), cycles.end()) - cycles.begin());
  std::map<int, double> out;
  for (int n = 0; n < cycles[reference]; ++n) {
    const double path = chain.phases[reference].half_wave_m * (n + chain.phases[reference].calibrated_turns);
    double sum = 0;
    for (std::size_t i = 0; i < cycles.size(); ++i) {
      if (i == reference) continue;
      double least = std::numeric_limits<double>::infinity();
      for (int m = -1; m <= cycles[i]; ++m) {
        const double off = chain.phases[i].half_wave_m * (m + chain.phases[i].calibrated_turns) - path;
        least = std::min(least, off * off);
      }
      sum += least;
    }
    out[n] = sum;
  }
  return out;
}

void expect_as_tried(const PixelChain& chain, const std::vector<int>& cycles) {
  const std::map<int, double> tried = all_cycles_tried(chain, cycles);
  std::vector<double> costs;
  for (const auto& [n, cost] : tried) costs.push_back(cost);
  std::sort(costs.begin(), costs.end());
  ASSERT_EQ(chain.candidates.size(), costs.size());
  for (std::size_t i = 0; i < costs.size(); ++i) {
    EXPECT_NEAR(std::sqrt(chain.candidates[i].cost_m2), std::sqrt(costs[i]), 2e-5) << i;
    EXPECT_EQ(chain.candidates[i].chosen, i == 0);
    ASSERT_EQ(chain.candidates[i].cycles.size(), cycles.size());
  }
}

TEST(unwrap_candidates, cost_what_trying_all_cycles_says) {
  for (const double z : {0.4, 1.7, 3.1, 5.2, 6.9}) {
    const Seen two = seen_at({80e6, 60e6}, z), three = seen_at({100e6, 80e6, 60e6}, z);
    expect_as_tried(pixel_chain(two.frame, two.camera, 4, 3), {4, 3});
    expect_as_tried(pixel_chain(three.frame, three.camera, 4, 3), {5, 4, 3});
  }
}

TEST(unwrap_candidates, the_chosen_one_is_the_frame_s_range_and_its_cycles) {
  for (const double power : {0.02, 5e-5}) {  // the weaker one has wrong cycles
    const Seen seen = seen_at({80e6, 60e6}, 3.1, power);
    int right = 0, wrong = 0;
    for (int v = 0; v < 7; ++v)
      for (int u = 0; u < 9; ++u) {
        const PixelChain chain = pixel_chain(seen.frame, seen.camera, u, v);
        ASSERT_FALSE(chain.candidates.empty());
        if (!std::isfinite(chain.range_m)) continue;
        const UnwrapCandidate& chosen = chain.candidates.front();
        EXPECT_NEAR(chosen.range_m, chain.range_m, 2e-5) << u << "," << v;
        for (std::size_t i = 0; i < chain.phases.size(); ++i) EXPECT_EQ(chosen.cycles[i], chain.phases[i].cycles) << u << "," << v;
        ++(std::abs(chain.range_m - chain.true_range_m) < 0.5 ? right : wrong);
      }
    EXPECT_GT(right, 0) << power;
    if (power < 0.01) {
      EXPECT_GT(wrong, 0) << "no cycle is wrong: the test tries nothing";
    }
  }
}

TEST(unwrap_candidates, others_are_whole_cycles_of_both_away) {
  const Seen seen = seen_at({80e6, 60e6}, 1);
  const PixelChain chain = pixel_chain(seen.frame, seen.camera, 4, 3);
  ASSERT_EQ(chain.candidates.size(), 3u);
  EXPECT_EQ(chain.candidates[0].cycles, (std::vector<double>{0, 0}));
  // Half a metre and more lies between: half the difference of the two half waves.
  EXPECT_GT(std::sqrt(chain.candidates[1].cost_m2), 0.4);
  for (const UnwrapCandidate& one : chain.candidates) {
    const double path = 0.5 * (chain.phases[0].half_wave_m * (one.cycles[0] + chain.phases[0].calibrated_turns) +
                               chain.phases[1].half_wave_m * (one.cycles[1] + chain.phases[1].calibrated_turns));
    EXPECT_NEAR(one.range_m, path, 0.2) << "a mean of both half paths, by their weights";
  }
}

TEST(unwrap_candidates, of_one_modulation_frequency_there_are_none) {
  const Seen seen = seen_at({60e6}, 1);
  EXPECT_TRUE(pixel_chain(seen.frame, seen.camera, 4, 3).candidates.empty());
}

TEST(unwrap_candidates, the_phase_s_noise_is_that_of_many_frames) {
  Seen seen = seen_at({80e6, 60e6}, 1);
  double sum = 0, squares = 0, estimate = 0;
  const double n = 63;
  for (int v = 0; v < 7; ++v)
    for (int u = 0; u < 9; ++u) {
      const ChainPhase phase = pixel_chain(seen.frame, seen.camera, u, v).phases[0];
      sum += phase.amplitude_e, squares += phase.amplitude_e * phase.amplitude_e, estimate += phase.noise_e / n;
    }
  const double sigma = std::sqrt((squares - sum * sum / n) / (n - 1));
  EXPECT_NEAR(sigma / estimate, 1, 0.45) << "63 pixels of nearly one brightness: to a tenth, five of them";
}

}  // namespace
