// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
// Range as the mean over the last frames.                                                                [theory: temporal-mean]
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "backend/cpu/cpu.h"
#include "support/own_arrays.h"
#include "support/pixels.h"
#include "support/same_frame.h"
#include "support/statistics.h"

using namespace tofray;
using namespace tofray::test;

namespace {

constexpr int timed_width = 61, timed_height = 43;  // no whole number of packs or tiles
constexpr std::size_t timed_pixels = std::size_t{timed_width} * timed_height;

Camera over_frames(int frames, double sigmas = 3) {
  Camera camera = lit_camera(timed_width, timed_height, 60);
  camera.pixel.read_noise_e = 300;
  camera.adc = {16, 10, 32768, 0, 65535};
  camera.decoding.noise_threshold_m = 10;
  camera.decoding.flying_check = false;
  camera.decoding.temporal_frames = frames, camera.decoding.temporal_sigmas = sigmas;
  return camera;
}

Simulator timed(const Scene& scene, const Camera& camera, Isa isa = Isa::best) {
  return Simulator(scene, camera, {.seed = 11, .threads = 1, .isa = isa});
}

/// A wall at 1 m, and another one in front of it that comes from the left: half a picture further in each frame.
Scene passing_wall() {
  Scene scene = wall(1);
  Object card = object(Box{{-0.9, -2, 0.69}, {-0.5, 2, 0.7}});
  card.velocity_m_per_s = {2, 0, 0};  // 10 frames a second
  scene.objects.push_back(card);
  return scene;
}

/// [theory: temporal-mean] of a pixel, in double precision, of frames that stand by themselves: those up to number i.
struct TimedMean {
  double range, noise;
};
TimedMean mean_of(const std::vector<Frame>& single, std::size_t i, int frames, double sigmas, std::size_t at) {
  const auto variance = [&](std::size_t n) { return std::pow(static_cast<double>(single[n].depth.noise_m[at]), 2); };
  const double here = static_cast<double>(single[i].depth.range_m[at]);
  double sum = 0, weights = 0;
  for (std::size_t n = i + 1 < static_cast<std::size_t>(frames) ? 0 : i + 1 - static_cast<std::size_t>(frames); n <= i; ++n) {
    if ((single[n].depth.flags[at] & flags_invalid) != 0) continue;
    const double range = static_cast<double>(single[n].depth.range_m[at]);
    if (std::abs(range - here) > sigmas * std::sqrt(variance(i) + variance(n))) continue;
    sum += range / variance(n), weights += 1 / variance(n);
  }
  return {sum / weights, std::sqrt(1 / weights)};
}

/// Noise that four fifths of the pixels are below.
double darker_part(const Depth& depth) {
  std::vector<float> noise = depth.noise_m;
  std::sort(noise.begin(), noise.end());
  return static_cast<double>(noise[noise.size() * 4 / 5]);
}

}  // namespace

// All arrays of depth against frames that stand by themselves; a handful of roundings. Raw frames, flags and amplitude stay. Where rounding
// decides whether a frame still counts, one in some 10⁶ differs: none of these do.
TEST(temporal, is_the_mean_over_the_frames_that_are_near_enough) {
  const Scene scene = passing_wall();
  Camera camera = over_frames(4);
  const double threshold = darker_part(timed(scene, camera).frame(0).depth);  // some pixels are invalid in some frames
  camera.decoding.noise_threshold_m = threshold;
  Camera alone = camera;
  alone.decoding.temporal_frames = 1;
  Simulator single = timed(scene, alone), several = timed(scene, camera);
  std::vector<Frame> frames;
  int fewer = 0, lost = 0;
  for (std::size_t i = 0; i < 7; ++i) {
    frames.push_back(single.frame(i));
    const Frame seen = several.frame(i);
    EXPECT_EQ(seen.raw.raw, frames[i].raw.raw);
    EXPECT_EQ(seen.depth.amplitude_e, frames[i].depth.amplitude_e);
    for (std::size_t at = 0; at < timed_pixels; ++at) {
      const bool other = !std::isnan(seen.depth.range_m[at]) && seen.depth.range_m[at] != frames[i].depth.range_m[at];
      EXPECT_EQ(seen.depth.flags[at], frames[i].depth.flags[at] | (other ? flag_filtered : 0)) << at;
      if ((seen.depth.flags[at] & flags_invalid) != 0) {
        EXPECT_TRUE(std::isnan(seen.depth.range_m[at]));
        ++lost;
        continue;
      }
      const TimedMean expected = mean_of(frames, i, 4, 3, at);
      const double range = static_cast<double>(seen.depth.range_m[at]), noise = static_cast<double>(seen.depth.noise_m[at]);
      ASSERT_NEAR(range, expected.range, 5e-7) << i << " " << at;
      ASSERT_NEAR(noise / expected.noise, 1, 1e-6) << i << " " << at;
      fewer += i > 2 && noise > 0.55 * static_cast<double>(frames[i].depth.noise_m[at]) ? 1 : 0;
      const double share = static_cast<double>(seen.depth.range_m[at] / frames[i].depth.range_m[at]);
      EXPECT_NEAR(static_cast<double>(seen.depth.z_m[at] / frames[i].depth.z_m[at]), share, 4e-7);
      EXPECT_NEAR(static_cast<double>(seen.depth.points_m[3 * at + 2] / frames[i].depth.points_m[3 * at + 2]), share, 4e-7);
      const double all = 255 * std::max(0.0, 1 - expected.noise / threshold);  // but for the chance of another cycle
      EXPECT_LE(static_cast<double>(seen.depth.confidence[at]), all + 0.51);
      EXPECT_GE(static_cast<double>(seen.depth.confidence[at]), 0.95 * all - 1);
    }
  }
  EXPECT_GT(fewer, 100);  // where something moved, or was invalid
  EXPECT_GT(lost, 10);
}

// σ/√N, in truth and as said. Limits of 20σ leave nothing out. n·N/(2N−1) pixels' worth of independent means: here 8 · 2623 of them, 5/√(2n).
TEST(temporal, leaves_the_root_of_the_frames_of_the_noise) {
  Simulator single = timed(wall(1), over_frames(1)), several = timed(wall(1), over_frames(8, 20));
  Moments before, after;
  for (std::uint64_t i = 7; i < 64; i += 8) {
    const Frame one = single.frame(i), mean = several.frame(i);
    for (std::size_t at = 0; at < timed_pixels; ++at) {
      const double truth = static_cast<double>(one.truth.range_m[at]);
      before.add((static_cast<double>(one.depth.range_m[at]) - truth) / static_cast<double>(one.depth.noise_m[at]));
      after.add((static_cast<double>(mean.depth.range_m[at]) - truth) / static_cast<double>(mean.depth.noise_m[at]));
      ASSERT_NEAR(static_cast<double>(mean.depth.noise_m[at] / one.depth.noise_m[at]), 1 / std::sqrt(8), 0.02);
    }
  }
  EXPECT_NEAR(after.deviation() / before.deviation(), 1, 5 * std::sqrt(1 / before.count()) + 0.01);
}

// Whatever was computed before: in any order, from the middle on, again, as a batch.
TEST(temporal, of_a_frame_is_the_same_wherever_a_sequence_begins) {
  const Scene scene = passing_wall();
  const Camera camera = over_frames(3);
  Simulator in_order = timed(scene, camera);
  std::vector<Frame> frames;
  for (std::uint64_t i = 0; i < 8; ++i) frames.push_back(in_order.frame(i));
  Simulator other = timed(scene, camera);
  for (const std::uint64_t i : {5, 6, 7, 7, 2, 0, 1, 4, 6, 3})
    EXPECT_EQ(first_difference(other.frame(i), frames[static_cast<std::size_t>(i)]), "") << i;
  std::vector<std::vector<float>> seen;
  other.frames(4, 3, [&](const FrameArrays& arrays) { seen.emplace_back(arrays.range_m, arrays.range_m + timed_pixels); });
  ASSERT_EQ(seen.size(), 3U);
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t at = 0; at < timed_pixels; ++at) {
      if (std::isnan(seen[i][at])) continue;
      ASSERT_EQ(seen[i][at], frames[4 + i].depth.range_m[at]) << i << " " << at;
    }
  }
}

// A frame that is given up while those before it are computed leaves some of them out; the next one wants them.
TEST(temporal, of_a_frame_behind_one_that_was_given_up_lacks_nothing) {
  const Scene scene = passing_wall();
  const Camera camera = over_frames(3);
  FrameProgress progress;
  Simulator simulator(scene, camera, {.seed = 11, .threads = 1, .progress = &progress});
  progress.stop = true;
  (void)simulator.frame(7);
  progress.stop = false;
  EXPECT_EQ(first_difference(simulator.frame(6), timed(scene, camera).frame(6)), "");
  progress.stop = true;
  (void)simulator.frame(7);
  progress.stop = false;
  EXPECT_EQ(first_difference(simulator.frame(8), timed(scene, camera).frame(8)), "");
  progress.stop = true;
  (void)simulator.frame(3);
  progress.stop = false;
  EXPECT_EQ(first_difference(simulator.frame(3), timed(scene, camera).frame(3)), "");
}

TEST(temporal, is_off_unless_asked_for_and_needs_frames_before) {
  EXPECT_EQ(Decoding().temporal_frames, 1);
  const Scene scene = wall(1);
  EXPECT_EQ(first_difference(timed(scene, over_frames(1)).frame(0), timed(scene, over_frames(5)).frame(0)), "");
  EXPECT_EQ(first_difference(timed(scene, over_frames(1)).frame(3), timed(scene, over_frames(1, 9)).frame(3)), "");
  const Camera camera = over_frames(2);
  Simulator simulator = timed(scene, camera);
  EXPECT_THROW((void)simulator.frame(0, test::wall(camera, 1)), Error);
  const std::vector<FrameRequest> requests = {{0, 5, {}}};
  EXPECT_THROW(simulator.frames(requests, [](const FrameArrays&) { ADD_FAILURE(); }), Error);
  Frame into;
  EXPECT_THROW(simulator.frame(requests[0], into), Error);
  DeviceFrames device;
  EXPECT_THROW(simulator.frames_on_device(0, 1, device), Error);
  for (const int frames : {0, 33}) EXPECT_THROW(timed(scene, over_frames(frames)), Error);
  EXPECT_NO_THROW((void)Simulator(scene, camera, {.last_stage = Stage::raw}).frame(0, test::wall(camera, 1)));
}

TEST(temporal, is_the_same_with_every_instruction_set) {
  const Scene scene = passing_wall();
  Camera camera = over_frames(4);
  camera.decoding.filter.kind = ImageFilter::Kind::bilateral, camera.decoding.flying_check = true;
  const Frame scalar = timed(scene, camera, Isa::scalar).frame(5);
  for (const Isa isa : {Isa::scalar_fma, Isa::avx2, Isa::avx512}) {
    if (backend::can_run(isa)) {
      EXPECT_EQ(first_difference(timed(scene, camera, isa).frame(5), scalar), "");
    }
  }
}
