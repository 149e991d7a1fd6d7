// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
// Integration times that follow the light.                                                 [theory: brightness, auto-exposure]
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <string>
#include <vector>

#include "backend/cpu/cpu.h"
#include "support/own_arrays.h"
#include "support/pixels.h"
#include "support/same_frame.h"

using namespace tofray;
using namespace tofray::test;

namespace {

constexpr double of_the_mode = 1e-3;

/// A wide ADC, so that codes hardly round; an unlit raw frame first; valid codes that are not symmetric.
Camera following(double speed, double longest = 4e-3) {
  Camera camera = lit_camera(24, 18, 60);
  camera.adc = {16, 1, 32768, 1000, 60000};
  camera.mode.sequence.insert(camera.mode.sequence.begin(), {false, 0, 0, 2e-4});
  camera.auto_exposure = {speed, 0.7, 0.9, 1e-5, longest};
  return camera;
}

Simulator quiet(const Scene& scene, const Camera& camera) { return Simulator(scene, camera, {.noise = Noise::off, .threads = 1}); }

double lit_time(const Frame& frame) { return frame.raw.integration_time_s[1]; }

/// How much of the valid codes the bright pixels use: by [theory: brightness], out of the codes.
double used_by(const Frame& frame, const Camera& camera) {
  const std::size_t pixels = 24 * 18;
  const double reach = std::min(camera.adc.mid_code - camera.adc.valid_min, camera.adc.valid_max - camera.adc.mid_code);
  std::vector<double> all;
  for (std::size_t i = 0; i < pixels; ++i) {
    double most = 0;
    for (std::size_t k = 1; k < 5; ++k) most = std::max(most, std::abs(frame.raw.raw[k * pixels + i] - camera.adc.mid_code) / reach);
    all.push_back(most);
  }
  std::sort(all.begin(), all.end());
  return all[static_cast<std::size_t>(camera.auto_exposure.bright * (pixels - 1))];
}

std::string complaint(const Camera& camera, const SimulatorOptions& options = {}) {
  try {
    Simulator simulator(wall(1), camera, options);
    (void)simulator.frame(0);
  } catch (const Error& error) {
    return error.what();
  }
  return "none";
}

}  // namespace

// What pixels use grows as the time does, so that by [theory: auto-exposure] the logarithm of the time nears its end by the factor 1 −
// speed from frame to frame: t_i = t_∞·(t_0/t_∞)^((1 − s)^i). Rounding to codes of 1 e⁻, of some 10⁴, moves it by less than 10⁻³.
TEST(auto_exposure, nears_its_aim_by_the_speed) {
  for (const double speed : {0.3, 0.5, 1.0}) {
    const Camera camera = following(speed);
    Simulator simulator = quiet(wall(1.7, 0.25), camera);
    const Frame first = simulator.frame(0);
    ASSERT_EQ(lit_time(first), of_the_mode);
    const double end = of_the_mode * camera.auto_exposure.aim / used_by(first, camera);
    ASSERT_GT(end / of_the_mode, 1.3);  // there is a way to go
    ASSERT_LT(end, 4e-3);
    for (int i = 1; i < 9; ++i) {
      const double expected = end * std::pow(of_the_mode / end, std::pow(1 - speed, i));
      EXPECT_NEAR(lit_time(simulator.frame(static_cast<std::uint64_t>(i))), expected, 1e-3 * expected) << speed << ", frame " << i;
    }
    EXPECT_NEAR(used_by(simulator.frame(30), camera), 0.7, 1e-3);
  }
}

// All lit raw frames go together, unlit ones stay; raw frames begin later, and what they collect grows as the times.
TEST(auto_exposure, is_that_of_the_raw_frames) {
  Camera camera = following(1);
  for (std::size_t k = 1; k < 5; ++k) camera.mode.sequence.push_back({true, 40e6, camera.mode.sequence[k].reference_phase_rad, 5e-4});
  camera.readout_time_s = 1e-4;
  Simulator simulator = quiet(wall(1.7, 0.25), camera);
  const Frame first = simulator.frame(0), next = simulator.frame(1);
  const double factor = lit_time(next) / lit_time(first);
  ASSERT_GT(factor, 1.3);
  double start = 0.1;  // ten frames a second
  const std::size_t pixels = 24 * 18;
  for (std::size_t k = 0; k < 9; ++k) {
    const double exposure = next.raw.integration_time_s[k];
    EXPECT_NEAR(exposure, first.raw.integration_time_s[k] * (k == 0 ? 1 : factor), 1e-12) << k;
    EXPECT_NEAR(next.raw.start_time_s[k], start, 1e-12) << k;
    start += exposure + 1e-4;
    for (std::size_t i = 0; i < pixels; ++i)
      EXPECT_NEAR(static_cast<double>(next.raw.tap_a[k * pixels + i]),
                  static_cast<double>(first.raw.tap_a[k * pixels + i]) * (k == 0 ? 1 : factor), 1e-5 * 3e4)
          << k;
  }
}

TEST(auto_exposure, stays_within_its_limits) {
  Camera camera = following(1, 1.2e-3);
  EXPECT_DOUBLE_EQ(lit_time(quiet(wall(3, 0.1), camera).frame(4)), 1.2e-3);
  camera = following(1);
  camera.auto_exposure.longest_s = 0;  // the mode's
  EXPECT_DOUBLE_EQ(lit_time(quiet(wall(3, 0.1), camera).frame(4)), of_the_mode);
  camera.auto_exposure.shortest_s = 4e-4;
  EXPECT_DOUBLE_EQ(lit_time(quiet(wall(0.2), camera).frame(6)), 4e-4);
  camera.min_integration_time_s = 6e-4;
  EXPECT_DOUBLE_EQ(lit_time(quiet(wall(0.2), camera).frame(6)), 6e-4);
}

// Where the bright pixels saturate, how far beyond is not known: a quarter of the time each at full speed, by wells and codes alike.
TEST(auto_exposure, leaves_saturation_by_a_quarter) {
  Camera codes = following(1);
  codes.auto_exposure.shortest_s = 1e-6;
  Camera wells = codes;
  wells.pixel.full_well_e = 2e4, wells.adc.step_e_per_dn = 10;  // wells are full long before codes are
  for (const Camera& camera : {codes, wells}) {
    Simulator simulator = quiet(wall(0.25), camera);
    ASSERT_NE(simulator.frame(0).depth.flags[200] & flag_saturated, 0);
    EXPECT_NEAR(lit_time(simulator.frame(1)), of_the_mode / 4, 1e-12);
    const Frame settled = simulator.frame(12);
    EXPECT_EQ(settled.depth.flags[200] & flag_saturated, 0);
  }
}

// Ambient light is that of the exposure, and depth that of the times that stand in the frame: recorded raw frames say the same again.
TEST(auto_exposure, process_makes_the_same_depth_of_what_was_recorded) {
  Scene scene = wall(1.7, 0.25);
  scene.ambient.spectrum = Ambient::Spectrum::sun_am15, scene.ambient.amount = 0.05;
  Camera camera = following(0.6);
  camera.pixel.read_noise_e = 20, camera.pixel.dark_current_e_per_s = 1e5;
  const Frame frame = Simulator(scene, camera, {.seed = 4, .threads = 1}).frame(3);
  ASSERT_NE(lit_time(frame), of_the_mode);
  const Depth again = process(frame.raw, camera, {.threads = 1});
  EXPECT_EQ(again.flags, frame.depth.flags);
  EXPECT_EQ(again.ambient_e, frame.depth.ambient_e);
  EXPECT_EQ(again.noise_m, frame.depth.noise_m);
}

// Frame i is the same whatever was computed before, and on what.
TEST(auto_exposure, frames_are_the_same_in_any_order) {
  Camera camera = following(0.5);
  camera.pixel.read_noise_e = 20;
  camera.decoding.temporal_frames = 3;
  Scene scene = wall(1.7, 0.25);
  Object card = object(Sphere{{0, 0, 1.2}, 0.2});
  card.velocity_m_per_s = {0, 0, -1};
  scene.objects.push_back(card);
  const auto start = [&](int threads, Isa isa) { return Simulator(scene, camera, {.seed = 4, .threads = threads, .isa = isa}); };
  Simulator in_turn = start(1, Isa::scalar);
  std::vector<Frame> frames;
  for (std::uint64_t i = 0; i < 6; ++i) frames.push_back(in_turn.frame(i));
  ASSERT_NE(lit_time(frames[5]), lit_time(frames[4]));
  for (const Isa isa : backend::machine_isas) {
    if (!backend::can_run(isa)) continue;
    EXPECT_EQ(first_difference(start(3, isa).frame(5), frames[5]), "") << backend::isa_name(isa);
  }
  Simulator backward = start(1, Isa::best);
  for (const std::uint64_t i : {5, 2, 4, 0}) EXPECT_EQ(first_difference(backward.frame(i), frames[i]), "") << i;
  Simulator batch = start(2, Isa::best);
  std::uint64_t next = 3;
  batch.frames(3, 3, [&](const FrameArrays& seen) {
    EXPECT_EQ(seen.index, next);
    for (std::size_t i = 0; i < 24 * 18; ++i) EXPECT_EQ(seen.noise_m[i], frames[next].depth.noise_m[i]);
    ++next;
  });
  EXPECT_EQ(next, 6U);
}

TEST(auto_exposure, says_what_it_cannot_do) {
  Camera camera = following(1, 0.1);
  EXPECT_NE(complaint(camera).find("the longest exposures do not fit into a frame"), std::string::npos);
  camera = following(1);
  camera.auto_exposure.shortest_s = 5e-3;
  EXPECT_NE(complaint(camera).find("the shortest exposure is longer than the longest"), std::string::npos);
  camera = following(1);
  for (RawFrame& raw : camera.mode.sequence) raw = {false, 0, 0, 1e-3};
  EXPECT_NE(complaint(camera).find("no exposure can follow the light"), std::string::npos);
  EXPECT_NE(complaint(following(1), {.last_stage = Stage::power}).find("exposures that follow the light need raw frames"),
            std::string::npos);
  EXPECT_EQ(complaint(following(0), {.last_stage = Stage::power}), "none");
  Simulator simulator = quiet(wall(1), following(1));
  EXPECT_THROW((void)simulator.frame(3ULL << 32), Error);
  const std::vector<FrameRequest> other_seed{{1, 7, {}}};
  EXPECT_THROW(simulator.frames(other_seed, [](const FrameArrays&) {}), Error);
  PixelLight light;
  light.width = 24, light.height = 18;
  light.power_w.assign(24 * 18, 1e-12F), light.path_length_m.assign(24 * 18, 2.0F);
  EXPECT_THROW((void)simulator.frame(0, light), Error);
}
