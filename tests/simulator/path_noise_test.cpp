// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
// How well light that bounces is known, when a pixel has ways enough, and what smoothing does to it.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "support/cuda_cases.h"
#include "support/pixels.h"
#include "support/sanitizers.h"

using namespace tofray;
using namespace tofray::test;

namespace {

/// Two walls, the one of two materials, and a card that keeps the light off a part of them.
Scene walls_and_card() {
  Scene scene = wall(1, 0.8);
  scene.materials.push_back({"grey", Material::Brdf::lambert, 0.3, 0, 1});
  scene.objects.push_back(object(Plane{{0.4, 0, 0}, {-1, 0, 0}}));
  Object card = object(Rectangle{{0, 0, 0}, {0.2, 0.4}}, 1);
  card.position = {-0.2, 0.1, 0.8};
  scene.objects.push_back(card);
  return scene;
}

Camera small_camera() {
  Camera camera = with_sanitizers ? lit_camera(40, 30, 30) : lit_camera(80, 60, 60);
  camera.illumination[0].power_w *= 2e-3;  // so that codes are not held at their ends
  return camera;
}

Frame frame_of(Scene scene, const Camera& camera, unsigned long long seed, int subpixel = 1) {
  scene.transport.seed = seed;
  return Simulator(scene, camera, {.noise = Noise::off, .subpixel = subpixel}).frame(0);
}

/// The standard errors that frames of many seeds say, and those that they have.
struct Compared {
  std::vector<double> said, had;  ///< of each lit pixel's first lit raw frame [m]
  std::vector<double> said_once;  ///< by the first frame alone
  std::vector<double> mean;       ///< of the multipath [m]
  std::vector<double> light;      ///< mean of the light that bounces [e]
  std::vector<double> light_off;  ///< standard error of that mean
};
Compared compare(const Scene& scene, const Camera& camera, int seeds, int subpixel = 1) {
  std::vector<double> sum, square, said, once, light, light_square;
  for (int seed = 0; seed < seeds; ++seed) {
    const Frame frame = frame_of(scene, camera, static_cast<unsigned long long>(seed), subpixel);
    const std::size_t pixels = frame.truth.range_m.size();
    sum.resize(pixels), square.resize(pixels), said.resize(pixels), light.resize(pixels), light_square.resize(pixels);
    for (std::size_t i = 0; i < pixels; ++i) {
      const double off = static_cast<double>(frame.truth.multipath_m[i]), noise = static_cast<double>(frame.truth.path_noise_m[i]);
      const double e = static_cast<double>(frame.truth.indirect_e[i]);
      light[i] += e, light_square[i] += e * e;
      sum[i] += off, square[i] += off * off, said[i] += noise * noise;
      if (seed == 0) once.push_back(noise);
    }
  }
  Compared out;
  for (std::size_t i = 0; i < sum.size(); ++i) {
    if (!std::isfinite(sum[i])) continue;
    const double mean = sum[i] / seeds;
    out.mean.push_back(mean), out.said.push_back(std::sqrt(said[i] / seeds)), out.said_once.push_back(once[i]);
    out.had.push_back(std::sqrt((square[i] - seeds * mean * mean) / (seeds - 1)));
    const double light_mean = light[i] / seeds;
    out.light.push_back(light_mean);
    out.light_off.push_back(std::sqrt((light_square[i] / seeds - light_mean * light_mean) / (seeds - 1)));
  }
  return out;
}

/// Share of the pixels whose ratio is within low … high.
double within(const std::vector<double>& said, const std::vector<double>& had, double low, double high) {
  std::size_t good = 0;
  for (std::size_t i = 0; i < said.size(); ++i) good += said[i] >= low * had[i] && said[i] <= high * had[i] ? 1 : 0;
  return static_cast<double>(good) / static_cast<double>(said.size());
}

double rms(const std::vector<double>& values) {
  double sum = 0;
  for (const double value : values) sum += value * value;
  return std::sqrt(sum / static_cast<double>(values.size()));
}

constexpr int seeds = with_sanitizers ? 12 : 200;
constexpr int fewer = with_sanitizers ? 12 : 100;
constexpr double nearly_all = with_sanitizers ? 0.4 : 0.95;

}  // namespace

// T9, and what a single frame knows of itself: its neighbours are some fifty tries.
TEST(path_noise, is_what_frames_of_other_seeds_are_off_by) {
  Scene scene = walls_and_card();
  scene.transport.bounces = 3, scene.transport.samples = 16;
  const Camera camera = small_camera();
  for (const int subpixel : {1, 2}) {
    const Compared c = compare(scene, camera, seeds, subpixel);
    ASSERT_GT(c.had.size(), 900u);
    EXPECT_GT(within(c.said, c.had, 0.8, 1.25), nearly_all) << subpixel;
    EXPECT_NEAR(rms(c.said) / rms(c.had), 1, with_sanitizers ? 0.2 : 0.1) << subpixel;
    EXPECT_GT(within(c.said_once, c.had, 0.5, 2), with_sanitizers ? 0.7 : 0.95) << subpixel;
  }
}

// The error of smoothed light, which is smaller and whose bias is less than what it takes away.
TEST(path_noise, is_that_of_smoothed_light) {
  Scene scene = walls_and_card();
  scene.transport.bounces = 3, scene.transport.samples = 16;
  const Camera camera = small_camera();
  const Compared rough = compare(scene, camera, fewer);
  scene.transport.smooth = true;
  const Compared smooth = compare(scene, camera, fewer);
  EXPECT_GT(within(smooth.said, smooth.had, 0.8, 1.25), nearly_all);
  EXPECT_LT(rms(smooth.had), 0.4 * rms(rough.had));
  Scene known = scene;
  known.transport.smooth = false, known.transport.samples = with_sanitizers ? 256 : 10000;
  const Compared truth = compare(known, camera, 2);
  std::vector<double> bias;
  for (std::size_t i = 0; i < truth.mean.size(); ++i) bias.push_back(smooth.mean[i] - truth.mean[i]);
  EXPECT_LT(rms(bias), (with_sanitizers ? 0.4 : 0.22) * rms(rough.had));
}

// A pixel that goes on takes twice as many ways: fewer are no next step. It begins with two at least for each sample within it.
TEST(path_noise, needs_room_for_a_second_step) {
  Scene scene = walls_and_card();
  const auto said = [&](int bounces, int samples, int most, int subpixel = 1) -> std::string {
    scene.transport.bounces = bounces, scene.transport.samples = samples, scene.transport.max_samples = most;
    try {
      const Simulator simulator(scene, small_camera(), {.subpixel = subpixel});
    } catch (const Error& error) {
      EXPECT_EQ(error.kind(), ErrorKind::bad_input);
      return error.what();
    }
    return "";
  };
  for (const int bounces : {1, 2}) {
    EXPECT_EQ(said(bounces, 16, 32), "");
    EXPECT_EQ(said(bounces, 16, 0), "");
    for (const auto& [samples, most] : {std::pair(16, 31), {16, 1}, {15, 29}})
      EXPECT_NE(said(bounces, samples, most).find("transport.max_samples: max_samples is less than twice samples"), std::string::npos)
          << most;
  }
  for (const int bounces : {1, 2}) {
    EXPECT_EQ(said(bounces, 16, 64, 4), "");
    EXPECT_NE(said(bounces, 16, 63, 4).find("transport.max_samples adds no light paths\n  got 63, but each pixel begins with 32"),
              std::string::npos)
        << said(bounces, 16, 63, 4);
  }
}

TEST(path_noise, ends_the_search_for_more_ways) {
  Scene scene = walls_and_card();
  scene.transport.bounces = 2, scene.transport.samples = 16, scene.transport.max_samples = 512;
  const Camera camera = small_camera();
  const auto with = [&](double wanted) {
    scene.transport.path_noise_m = wanted;
    return frame_of(scene, camera, 3);
  };
  for (const auto& [wanted, count] : {std::pair{1e-9, 512}, {100.0, 16}})
    for (const int n : with(wanted).truth.path_count) ASSERT_EQ(n, count) << wanted;
  scene.transport.max_samples = 1023;  // twice 512 would be too many
  for (const int n : with(1e-9).truth.path_count) ASSERT_EQ(n, 512);
  scene.transport.max_samples = 512;
  // A length, or a share of the depth noise; where it is not reached all ways were followed. Who has enough gets no more.
  scene.transport.max_samples = 0;
  const Frame first = with(0);
  scene.transport.max_samples = 512;
  for (const double wanted : {0.003, 0.0}) {
    const Frame frame = with(wanted);
    std::vector<int> found;
    std::size_t good = 0, ended = 0;
    for (std::size_t i = 0; i < frame.truth.path_count.size(); ++i) {
      const int n = frame.truth.path_count[i];
      ASSERT_TRUE(n >= 16 && n <= 512 && (n & (n - 1)) == 0) << n;
      if (!std::isfinite(frame.truth.path_noise_m[i]) || n == 512) continue;
      const double most = wanted > 0 ? wanted : 0.2 * static_cast<double>(frame.depth.noise_m[i]);
      const double noise = static_cast<double>(frame.truth.path_noise_m[i]);
      ++ended;
      ASSERT_TRUE(wanted == 0 || noise <= 1.00001 * most) << i << ": " << noise;
      good += noise <= 1.05 * most ? 1 : 0;  // what the decoder says of its noise is another with each frame
      found.push_back(n);
      if (n == 16) {
        ASSERT_EQ(frame.truth.indirect_e[i], first.truth.indirect_e[i]) << i;
      }
    }
    EXPECT_GT(static_cast<double>(good), 0.9 * static_cast<double>(ended)) << wanted;
    std::sort(found.begin(), found.end());
    found.erase(std::unique(found.begin(), found.end()), found.end());
    EXPECT_GE(found.size(), 2u) << wanted;
  }
}

// Where chance has made a pixel bright it is sooner thought to be known, and keeps that: a bias, of some hundredths of the error that is left.
TEST(path_noise, hardly_pulls_to_one_side) {
  Scene scene = walls_and_card();
  scene.transport.bounces = 2, scene.transport.samples = 16;
  const Camera camera = small_camera();
  const Compared fixed = compare(scene, camera, fewer);
  scene.transport.max_samples = 256, scene.transport.path_noise_m = 0.5 * rms(fixed.had);
  const Compared goes_on = compare(scene, camera, fewer);
  ASSERT_EQ(fixed.light.size(), goes_on.light.size());
  double sum = 0;
  for (std::size_t i = 0; i < fixed.light.size(); ++i)
    sum += (goes_on.light[i] - fixed.light[i]) / (goes_on.light_off[i] * std::sqrt(fewer));
  EXPECT_LT(std::abs(sum) / static_cast<double>(fixed.light.size()), 0.05);
  EXPECT_LT(rms(goes_on.had), 0.6 * rms(fixed.had));
  EXPECT_GT(within(goes_on.said, goes_on.had, 0.8, 1.25), nearly_all);
}

// Twice as many ways each time are the same ways as all of them at once.
TEST(path_noise, of_many_rounds_is_that_of_one) {
  Scene scene = walls_and_card();
  scene.transport.bounces = 2, scene.transport.samples = 16, scene.transport.max_samples = 256, scene.transport.path_noise_m = 1e-9;
  const Camera camera = small_camera();
  const Frame rounds = frame_of(scene, camera, 5);
  scene.transport = {2, 256};
  const Frame one = frame_of(scene, camera, 5);
  for (std::size_t i = 0; i < one.truth.indirect_e.size(); ++i)
    ASSERT_NEAR(rounds.truth.indirect_e[i] / one.truth.indirect_e[i], 1, 2e-6) << i;
  for (std::size_t i = 0; i < one.truth.range_m.size(); ++i) {
    if (std::isnan(one.truth.path_noise_m[i])) continue;
    ASSERT_NEAR(rounds.truth.path_noise_m[i] / one.truth.path_noise_m[i], 1, 1e-3) << i;
  }
}

// A dark card on a bright wall stays dark, and one that turns away from the bright wall gets nothing of its light.
TEST(path_noise, of_smoothed_light_knows_what_is_seen) {
  Scene scene = wall(1, 0.8);
  scene.materials.push_back({"dark", Material::Brdf::lambert, 0.05, 0, 1});
  scene.objects.push_back(object(Plane{{0.4, 0, 0}, {-1, 0, 0}}));
  scene.objects.push_back(object(Rectangle{{0, 0, 0}, {0.2, 0.2}}, 1));
  scene.objects.back().position = {0, 0, 0.999};
  scene.objects.push_back(object(Rectangle{{0, 0, 0}, {0.12, 0.12}}));
  scene.objects.back().position = {-0.2, 0, 0.6}, scene.objects.back().rotation = {{0, 1, 0}, pi / 3};
  const Camera camera = lit_camera(40, 30, 30);
  scene.transport.bounces = 2, scene.transport.samples = with_sanitizers ? 512 : 4096;
  const Frame known = frame_of(scene, camera, 1);
  scene.transport.samples = 16, scene.transport.smooth = true;
  const Frame smooth = frame_of(scene, camera, 2);
  int dark = 0, turned = 0;
  for (std::size_t i = 0; i < known.truth.object_id.size(); ++i) {
    const int object = known.truth.object_id[i];
    if (object < 2) continue;
    dark += object == 2 ? 1 : 0, turned += object == 3 ? 1 : 0;
    EXPECT_NEAR(smooth.truth.indirect_e[i] / known.truth.indirect_e[i], 1, 0.3) << object << " at " << i;
  }
  EXPECT_GT(dark, 20);
  EXPECT_GT(turned, 8);
}

// A frame is that of its number, whatever was computed before it: also where the sensor drifts, and with it what is well enough known.
TEST(path_noise, is_that_of_its_frame) {
  Scene scene = walls_and_card();
  scene.transport = {2, 8, 0, 64};
  Camera camera = small(load_camera("pico-flexx"));
  for (Illumination& light : camera.illumination) light.waveform = {Waveform::Kind::rectangular, 0.4, 0, 0, 0, 7, 1, {}};
  camera.temperature.warm_up_m = 0.02, camera.temperature.warm_up_time_s = 0.5, camera.temperature.since_start_s = 0;
  Simulator simulator(scene, camera, {});
  (void)simulator.frame(0);
  EXPECT_EQ(first_difference(simulator.frame(5), Simulator(scene, camera, {}).frame(5)), "");
}

// Who does not ask gets the same light; where nothing bounces back, it is known to be nothing.
TEST(path_noise, changes_nothing_else) {
  Scene scene = walls_and_card();
  scene.transport.bounces = 2, scene.transport.samples = 8;
  const Camera camera = small_camera();
  const Frame with = Simulator(scene, camera, {}).frame(0), without = Simulator(scene, camera, {.truth = false}).frame(0);
  EXPECT_EQ(with.raw.raw, without.raw.raw);
  for (const bool smooth : {false, true}) {
    Scene alone = wall(1, 0.8);
    alone.transport.bounces = 2, alone.transport.smooth = smooth;
    const Frame frame = Simulator(alone, camera, {}).frame(0);
    for (std::size_t i = 0; i < frame.truth.range_m.size(); ++i) ASSERT_EQ(frame.truth.path_noise_m[i], 0.0f);
    EXPECT_EQ(frame.truth.path_count, std::vector<std::int32_t>(frame.truth.range_m.size(), 16));
    Scene nothing;
    nothing.transport = alone.transport;
    for (const float noise : Simulator(nothing, camera, {}).frame(0).truth.path_noise_m) ASSERT_TRUE(std::isnan(noise));
  }
}
