// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
// Why pixels have no depth: each counts once, under the reason that truth gives.
#include <gtest/gtest.h>

#include <cmath>

#include "support/pixels.h"
#include "tofray/analysis.h"
#include "tofray/camera_report.h"
#include "tofray/load.h"
#include "tofray/simulator.h"

using namespace tofray;
using namespace tofray::test;

namespace {

/// One row of pixels: flags, object and range of each.
struct Flagged {
  int flags, object;
  float range_m;
};
Frame frame_of(const std::vector<Flagged>& pixels) {
  Frame out;
  out.depth.width = out.truth.width = static_cast<int>(pixels.size()), out.depth.height = out.truth.height = 1;
  for (const Flagged& one : pixels) {
    out.depth.flags.push_back(static_cast<std::uint16_t>(one.flags));
    out.truth.object_id.push_back(one.object), out.truth.range_m.push_back(one.range_m);
  }
  return out;
}

std::int64_t all_of(const InvalidPixels& pixels) {
  std::int64_t sum = pixels.valid;
  for (std::size_t i = 0; i < no_depth_count; ++i) sum += pixels.count(static_cast<NoDepth>(i));
  return sum;
}

/// A white wall at 1 m, by 80 and so many MHz.
struct Wall {
  explicit Wall(double megahertz) : camera(load_camera(TOFRAY_SOURCE_DIR "/profiles/custom.yaml", {"TWO_FREQUENCIES", {}, {}})) {
    for (RawFrame& one : camera.mode.sequence)
      if (one.lit && one.modulation_frequency_hz == 100e6) one.modulation_frequency_hz = megahertz * 1e6;
    Scene scene;
    scene.materials.resize(1), scene.objects.resize(1);
    scene.materials[0].diffuse = 0.8;
    scene.objects[0].shape = Plane{{0, 0, 1}, {0, 0, -1}};
    frame = Simulator(scene, camera).frame(0);
  }
  Camera camera;
  Frame frame;
};

}  // namespace

TEST(invalid_pixels, are_told_apart_by_truth) {
  const Camera camera = lit_camera();
  const auto far = static_cast<float>(invalid_pixels({}, camera).ambiguity_range_m + 1);
  const float nothing = std::nanf("");
  const std::vector<Flagged> pixels = {{0, 0, 1},
                                       {0, 0, far},
                                       {flag_low_signal, -1, nothing},
                                       {flag_low_signal | flag_no_return, -1, nothing},
                                       {flag_low_signal, 0, 1},
                                       {flag_no_return, 0, 1},
                                       {flag_low_signal, 0, far},
                                       {flag_flying_pixel, 0, far},
                                       {flag_saturated, 0, far},
                                       {flag_outside_lens, -1, nothing},
                                       {flag_rejected | flag_inconsistent_phases, 0, 1},
                                       {flag_rejected | flag_inconsistent_frequencies, 0, 1},
                                       {flag_flying_pixel, 0, 1}};
  Frame frame = frame_of(pixels);
  const InvalidPixels seen = invalid_pixels(frame, camera);
  EXPECT_EQ(seen.pixels, 13);
  EXPECT_EQ(seen.valid, 2);
  EXPECT_EQ(seen.wrapped, 1);
  EXPECT_EQ(seen.no_surface, 2);
  EXPECT_EQ(seen.dark, 2);
  EXPECT_EQ(seen.beyond_reach, 2);
  EXPECT_EQ(seen.saturated, 1);
  EXPECT_EQ(seen.outside_lens, 1);
  EXPECT_EQ(seen.inconsistent_phases, 1);
  EXPECT_EQ(seen.inconsistent_frequencies, 1);
  EXPECT_EQ(seen.flying_pixel, 1);
  EXPECT_EQ(all_of(seen), seen.pixels);
  // A recording has no truth.
  frame.truth = {};
  const InvalidPixels blind = invalid_pixels(frame, camera);
  EXPECT_EQ(blind.low_signal, 3);
  EXPECT_EQ(blind.no_return, 2);
  EXPECT_EQ(blind.flying_pixel, 2);
  EXPECT_EQ(blind.wrapped, 0);
}

// 80 and 61.7 MHz have cycles that nearly meet, and noise takes the one for the other.
TEST(invalid_pixels, of_wrong_cycles_are_no_flying_pixels) {
  const Wall wall(61.7);
  const InvalidPixels seen = invalid_pixels(wall.frame, wall.camera);
  EXPECT_GT(seen.wrong_cycle, 3 * seen.flying_pixel);
  EXPECT_GT(seen.wrong_cycle, seen.pixels / 2);
  EXPECT_EQ(seen.ranges_m.size(), 2U);
  EXPECT_EQ(invalid_pixels(wall.frame, wall.camera, false).wrong_cycle, 0) << "not asked for";
  // Neighbours say it where there is no truth, too.
  Frame recorded = wall.frame;
  recorded.truth = {};
  EXPECT_GT(invalid_pixels(recorded, wall.camera).wrong_cycle, seen.pixels / 2);
  recorded.raw.raw.clear(), recorded.raw.tap_a.clear();
  EXPECT_EQ(invalid_pixels(recorded, wall.camera).wrong_cycle, 0) << "nothing to decode";
}

TEST(invalid_pixels, of_edges_are_flying_pixels) {
  Scene scene = load_scene("thin-rods");
  const Camera camera = load_camera(scene);
  SimulatorOptions options;
  options.subpixel = 3;
  const InvalidPixels seen = invalid_pixels(Simulator(scene, camera, options).frame(0), camera);
  EXPECT_GT(seen.flying_pixel, seen.pixels / 100);
  EXPECT_LT(20 * seen.wrong_cycle, seen.flying_pixel);
}

// 10 % at 2.5 m before a pico flexx in 50 klx, no threshold: check says how many are on a wrong cycle, and truth counts them.
TEST(invalid_pixels, count_valid_ones_on_a_wrong_cycle) {
  Scene scene;
  scene.ambient = full_sun().ambient;
  scene.ambient.quantity = Ambient::Quantity::illuminance_lx, scene.ambient.amount = 50000;
  Material grey;
  grey.diffuse = 0.1;
  Object wall;
  wall.shape = Plane{{0, 0, 2.5}, {0, 0, -1}};
  scene.materials = {grey}, scene.objects = {wall};
  Camera camera = load_camera("pico-flexx");
  camera.decoding.noise_threshold_m = 1e3, camera.decoding.flying_check = false, camera.decoding.filter = {};
  SimulatorOptions options;
  options.backend = Backend::cpu;
  const InvalidPixels noisy = invalid_pixels(Simulator(scene, camera, options).frame(0), camera);
  EXPECT_GT(noisy.valid_on_wrong_cycle, noisy.valid / 2);
  EXPECT_LT(noisy.valid_on_wrong_cycle, noisy.valid);
  options.noise = Noise::off;
  EXPECT_EQ(invalid_pixels(Simulator(scene, camera, options).frame(0), camera).valid_on_wrong_cycle, 0);
}
