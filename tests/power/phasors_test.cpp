// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
// Where nobody asks for single orders, only their sums are made: they have the bits of the sums over the orders.
#include "power/phasors.h"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>

#include "support/bench.h"
#include "support/random.h"

using namespace tofray;
using namespace tofray::test;

namespace {

/// Pulses at two modulation frequencies; the first gate is not at 0, so that no factor of an order is.
Camera camera_with(int harmonics) {
  Camera camera = bench_camera({60.24e6, 80.32e6});
  camera.illumination[0].waveform.harmonics = harmonics;
  for (RawFrame& k : camera.mode.sequence) k.reference_phase_rad += 0.3;
  return camera;
}

std::uint32_t bits(float a) { return std::bit_cast<std::uint32_t>(a); }

}  // namespace

TEST(sums_of_path, have_the_bits_of_the_sums_over_its_orders) {
  Random random(7);
  for (const int harmonics : {1, 3, 4, 5, 8}) {
    const Bench bench(camera_with(harmonics));
    const camera::PhasorView& s = bench.phasors();
    EXPECT_EQ(s.sums_alone, 1);
    const power::Wanted wanted = power::all_of(s);
    for (int i = 0; i < 2000; ++i) {
      const flow::Path<float> path{static_cast<float>(i == 0 ? 0 : random.scale(1, 1e12)), static_cast<float>(random.scale(1e-3, 1e5))};
      flow::Light<float> all{}, sums{};
      power::add_path(s, wanted, 0, path, true, all);
      power::add_up(s, wanted, all);
      power::sums_of_path(s, wanted, path, sums);
      ASSERT_EQ(bits(sums.signal_rate), bits(all.signal_rate));
      for (int j = 0; j < s.modulations; ++j) {
        double in_phase = 0, quarter = 0, size = 0;
        for (int h = 0; h < s.orders; ++h) {
          const double x = static_cast<double>(all.real[j * s.orders + h]), y = static_cast<double>(all.imaginary[j * s.orders + h]);
          in_phase += x, quarter += h % 2 == 0 ? y : -y, size += std::hypot(x, y);
        }
        ASSERT_NEAR(static_cast<double>(all.in_phase[j]), in_phase, 1e-6 * size);
        ASSERT_NEAR(static_cast<double>(all.quarter[j]), quarter, 1e-6 * size);
        ASSERT_EQ(bits(sums.in_phase[j]), bits(all.in_phase[j])) << harmonics << " harmonics, path " << i;
        ASSERT_EQ(bits(sums.quarter[j]), bits(all.quarter[j])) << harmonics << " harmonics, path " << i;
      }
    }
  }
}

// Single orders are needed where pixels are late, gates stand between quarter turns or drift, or several lights add up.
TEST(sums_of_path, are_alone_only_where_nothing_asks_for_an_order) {
  const auto alone = [](const Camera& camera) { return Bench(camera).phasors().sums_alone; };
  EXPECT_EQ(alone(camera_with(4)), 1);
  EXPECT_EQ(alone(bench_camera({60.24e6}, 3)), 0) << "thirds of a turn";
  EXPECT_EQ(alone(bench_camera({60.24e6}, 8)), 0) << "eighths of a turn";
  Camera camera = camera_with(4);
  camera.pixel.delay_s = 1e-12;
  EXPECT_EQ(alone(camera), 0) << "late pixels";
  camera = camera_with(4);
  camera.temperature.warm_up_m = 1e-3, camera.temperature.warm_up_time_s = 60;
  EXPECT_EQ(alone(camera), 0) << "drift";
  camera = camera_with(4);
  camera.illumination.push_back(Illumination(camera.illumination[0]));
  EXPECT_EQ(alone(camera), 0) << "two lights";
}
