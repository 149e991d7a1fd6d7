// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
// The check for flying pixels on whole frames: what it leaves of a wall, what it finds of edges.
#include <gtest/gtest.h>

#include "support/flying_errors.h"

using namespace tofray;
using namespace tofray::test;

namespace {

class FlatWall : public testing::TestWithParam<int> {};

/// Exposure times of the four modes with nine raw frames [µs].
std::string name_of(const testing::TestParamInfo<int>& which) { return "in_" + std::to_string(which.param) + "_us"; }

}  // namespace

// Reflectivity 0.3 at 1 m. Three neighbours in line whose noise is normal fly by chance once in 10⁶: both differences pass 4√2 σ on one side,
// P = 2∫φ(t)·Q(4√2 − t)² dt = 9.7·10⁻⁷, for two pairs 2·10⁻⁶. That of a phase has longer tails; a hundred times as many are allowed.
TEST_P(FlatWall, loses_nothing_to_noise) {
  const FlatLoss loss = flat_loss(flying_camera(1e-6 * GetParam()), 1.0, 0.3, 2);
  EXPECT_LT(loss.flat, 2e-4);
  // In the corners light is too little for 70 mm of noise. Nothing else takes pixels away, but for wrong cycles, which do fly.
  EXPECT_GT(loss.valid, 1 - loss.low_signal - 0.005);
  EXPECT_GT(loss.valid_middle, GetParam() >= 700 ? 0.99 : 0.95);
}

INSTANTIATE_TEST_SUITE_P(modes, FlatWall, testing::Values(2000, 1000, 700, 450), name_of);

// What the old limit alone did: half of the wall in 700 µs.
TEST(flying_pixels, of_a_wall_are_noise_where_the_limit_alone_decides) {
  Camera camera = flying_camera(700e-6);
  camera.decoding.flying_sigmas = 0;
  EXPECT_GT(flat_loss(camera, 1.0, 0.3, 1).flat, 0.2);
}
