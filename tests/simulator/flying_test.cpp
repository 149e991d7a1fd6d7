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

// The modes as they are. In the corners the assumed light is 1.6 % of the middle's: at 1,000 µs they are means over neighbours, which the
// threshold of the noise that is left lets pass. Of those some are wrong cycles whose neighbours have the same: where one pixel's range has 70
// mm of noise, each of two phases has 0.33 rad, and one cycle in 20 is wrong ([theory: wrong-cycle], 1.8 % at 0.25 rad).
TEST(walls, have_19_of_20_pixels_in_the_modes_as_they_are) {
  for (const char* mode : {"MODE_9_5FPS_2000", "MODE_9_10FPS_1000"}) {
    const Camera camera = load_camera("pico-flexx", {.mode = mode});
    const Frame frame = Simulator(wall_at(1.0, 0.3), camera, {.seed = 11}).frame(0);
    int valid = 0, filtered = 0, off = 0;
    for (std::size_t i = 0; i < frame.depth.flags.size(); ++i) {
      if ((frame.depth.flags[i] & flags_invalid) != 0) continue;
      ++valid;
      if ((frame.depth.flags[i] & flag_filtered) == 0) continue;
      ++filtered;
      off += std::abs(frame.depth.range_m[i] - frame.truth.range_m[i]) > 5 * frame.depth.noise_m[i] ? 1 : 0;
    }
    RecordProperty(std::string(mode) + "_valid", valid);
    RecordProperty(std::string(mode) + "_filtered", filtered);
    RecordProperty(std::string(mode) + "_off", off);
    EXPECT_GT(valid, 0.95 * static_cast<double>(frame.depth.flags.size())) << mode;
    EXPECT_LE(off, filtered / 16) << mode << ", of " << filtered;
  }
}

// What the old limit alone did: half of the wall in 700 µs.
TEST(flying_pixels, of_a_wall_are_noise_where_the_limit_alone_decides) {
  Camera camera = flying_camera(700e-6);
  camera.decoding.flying_sigmas = 0;
  EXPECT_GT(flat_loss(camera, 1.0, 0.3, 1).flat, 0.2);
}

namespace {
/// Mean square of (z − truth)/σ̂, and of σ̂ [mm²], of the valid pixels in the middle of a wall that are no wrong cycles.
struct Left {
  double ratio = 0, noise = 0;
};
Left left_of_noise(const Camera& camera) {
  const Frame frame = Simulator(wall_at(1.0, 0.3), camera, {.seed = 5}).frame(0);
  Left out;
  double count = 0;
  for (std::size_t i = 0; i < frame.depth.flags.size(); ++i) {
    const std::size_t x = i % 224, y = i / 224;
    const double off = static_cast<double>(frame.depth.range_m[i] - frame.truth.range_m[i]),
                 noise = static_cast<double>(frame.depth.noise_m[i]);
    if (x < 80 || x >= 144 || y < 54 || y >= 118 || (frame.depth.flags[i] & flags_invalid) != 0 || std::abs(off) > 0.3) continue;
    out.ratio += off * off / (noise * noise), out.noise += 1e6 * noise * noise, count += 1;
  }
  out.ratio = std::sqrt(out.ratio / count), out.noise = std::sqrt(out.noise / count);
  return out;
}
}  // namespace

// 64 × 64 pixels, whole frames: what the pixels say after a filter of 25 of them is what they are off by. 4096/25 = 160 independent ones say
// so to 5.6 %; 3 of these are allowed, and the bilateral filter's 8 %.
TEST(filters, of_frames_leave_the_noise_that_noise_m_says) {
  Camera camera = flying_camera(700e-6);
  const Left plain = left_of_noise(camera);
  EXPECT_NEAR(plain.ratio, 1, 0.06);
  for (const auto kind :
       {ImageFilter::Kind::gaussian, ImageFilter::Kind::median, ImageFilter::Kind::bilateral, ImageFilter::Kind::adaptive}) {
    camera.decoding.filter.kind = kind, camera.decoding.filter.radius_px = 2, camera.decoding.filter.goal_m = 0;
    const Left got = left_of_noise(camera);
    EXPECT_NEAR(got.ratio, 1, 0.25) << static_cast<int>(kind);
    EXPECT_LT(got.noise, 0.6 * plain.noise) << static_cast<int>(kind);
  }
}

// After the adaptive filter less noise hides the edges: more of them are found, and no more of the wall is lost. (What is flagged of pixels that
// were too noisy alone are wrong cycles, most of all.)
TEST(flying_pixels, are_found_after_the_adaptive_filter) {
  Camera camera = flying_camera(1000e-6), filtered = camera;
  filtered.decoding.filter.kind = ImageFilter::Kind::adaptive, filtered.decoding.filter.radius_px = 2;
  const double without = edges_found(camera, 1.0, 0.3, 0.3, 2).noisy, with = edges_found(filtered, 1.0, 0.3, 0.3, 2).noisy;
  EXPECT_GT(with, without + 0.1) << without;
  const FlatLoss loss = flat_loss(filtered, 1.0, 0.3, 1), alone = flat_loss(camera, 1.0, 0.3, 1);
  EXPECT_LT(loss.flat, 4e-3) << loss.flying;
  EXPECT_GT(loss.valid, alone.valid + 0.02) << alone.valid;
}
