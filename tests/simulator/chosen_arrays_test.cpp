// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
// SimulatorOptions::arrays: what is chosen has the bytes that it has among all, and nothing is computed that nobody chose.
#include <gtest/gtest.h>

#include <cstring>
#include <set>
#include <string>

#include "support/every_array.h"
#include "support/pixels.h"
#include "tofray/tofray.h"

using namespace tofray;
using namespace tofray::test;

namespace {

/// All that hands pixels on to other pixels, times or arrays.
Camera busy_camera() {
  Camera camera = lit_camera(37, 23, 40);
  camera.decoding.filter.kind = ImageFilter::Kind::bilateral;
  camera.pixel.blooming_share = 0.1, camera.pixel.blooming_limit_e = 1000;
  return camera;
}

Scene moving_steps() {
  Scene scene = wall(1.3, 0.6);
  scene.objects.push_back(object(Box{{-0.4, -0.3, 0.9}, {0.1, 0.25, 1.0}}));
  scene.objects.back().velocity_m_per_s = {0.5, 0, 0};
  return scene;
}

Scene with_light_of_all_ways() {
  Scene scene = moving_steps();
  scene.transport.bounces = 2, scene.transport.samples = 4, scene.transport.transient = {20, 0, 0.2};
  return scene;
}

/// The names of arrays that have values, and whether each has those of the whole frame.
struct Chosen {
  std::set<std::string> there;
  std::string other;  ///< the first one whose bytes are others
};

Chosen compared_with(const Frame& chosen, const Frame& whole) {
  Chosen out;
  const auto look = [&](const char* name, const auto& one, const auto& all) {
    if (one.empty()) return;
    out.there.insert(name);
    if (one.size() != all.size() || std::memcmp(one.data(), all.data(), one.size() * sizeof one[0]) != 0)
      out.other = out.other.empty() ? name : out.other;
  };
#define TOFRAY_LOOK(name, part, member, ...) look(#name, chosen.part.member, whole.part.member);
  TOFRAY_IMAGE_ARRAYS(TOFRAY_LOOK)
#undef TOFRAY_LOOK
  return out;
}

void expect_each_alone(const Scene& scene, const Camera& camera, SimulatorOptions options, std::uint64_t index) {
  options.arrays = every_array();
  const Frame whole = Simulator(scene, camera, options).frame(index);
  const std::set<std::string> all = compared_with(whole, whole).there;
  ASSERT_GT(all.size(), 20U);
  Frame used;  // goes from one choice to the next
  for (const std::string& name : all) {
    options.arrays = {name};
    Simulator simulator(scene, camera, options);
    simulator.frame(index, used);
    const Chosen alone = compared_with(used, whole);
    EXPECT_EQ(alone.other, "") << name;
    EXPECT_EQ(alone.there.count(name), 1U) << name;
    EXPECT_LE(alone.there.size(), camera.auto_exposure.speed > 0 ? 8U : 5U) << name;
    // The exposure's numbers are the mode's, and always there.
    EXPECT_EQ(used.raw.start_time_s, whole.raw.start_time_s);
    EXPECT_EQ(used.truth.width, whole.truth.width);
  }
}

std::string complaint_of(const SimulatorOptions& options) {
  try {
    Simulator(wall(1), lit_camera(), options);
  } catch (const Error& error) {
    return error.what();
  }
  return "none";
}

}  // namespace

TEST(chosen_arrays, have_the_bytes_that_they_have_among_all) {
  expect_each_alone(moving_steps(), busy_camera(), {.exposure_samples = 2}, 1);
  expect_each_alone(with_light_of_all_ways(), busy_camera(), {.subpixel = 2}, 1);
}

TEST(chosen_arrays, have_the_bytes_that_they_have_among_all_where_frames_hang_together) {
  Camera camera = busy_camera();
  camera.decoding.temporal_frames = 3;
  expect_each_alone(moving_steps(), camera, {}, 4);
  camera = busy_camera();
  camera.auto_exposure.speed = 0.5;
  expect_each_alone(moving_steps(), camera, {}, 2);
}

TEST(chosen_arrays, are_alone_but_for_what_they_are_made_of) {
  const auto there = [](const std::vector<std::string>& arrays, const Camera& camera, int subpixel = 1) {
    const Frame frame = Simulator(moving_steps(), camera, {.arrays = arrays, .subpixel = subpixel}).frame(0);
    return compared_with(frame, frame).there;
  };
  using Names = std::set<std::string>;
  Camera camera = busy_camera();
  EXPECT_EQ(there({"raw", "gt_z_m"}, camera), (Names{"raw", "gt_z_m"}));
  EXPECT_EQ(there({"gt_normal", "gt_signal_e"}, camera), (Names{"gt_normal", "gt_signal_e"}));
  EXPECT_EQ(there({"points_m"}, camera), (Names{"points_m", "z_m", "range_m", "noise_m", "flags"}));
  EXPECT_EQ(there({"gt_mixed"}, camera, 2), (Names{"gt_mixed", "gt_object_id"}));
  camera.auto_exposure.speed = 0.5;
  EXPECT_EQ(there({"gt_z_m"}, camera), (Names{"gt_z_m", "tap_a", "tap_b", "raw"})) << "the next exposure follows them";
  const Frame none = Simulator(moving_steps(), busy_camera(), {.truth = false, .arrays = {"gt_z_m"}}).frame(0);
  EXPECT_TRUE(compared_with(none, none).there.empty()) << "truth is switched off";
}

TEST(chosen_arrays, of_batches_are_the_only_pointers) {
  Simulator simulator(moving_steps(), busy_camera(), {.arrays = {"raw", "gt_z_m"}});
  const Frame whole = Simulator(moving_steps(), busy_camera()).frame(1);
  int seen = 0;
  simulator.frames(1, 1, [&](const FrameArrays& frame) {
    ++seen;
    EXPECT_EQ(frame.tap_a, nullptr);
    EXPECT_EQ(frame.z_m, nullptr);
    EXPECT_EQ(frame.gt_range_m, nullptr);
    ASSERT_NE(frame.raw, nullptr);
    ASSERT_NE(frame.gt_z_m, nullptr);
    EXPECT_EQ(std::memcmp(frame.raw, whole.raw.raw.data(), whole.raw.raw.size() * sizeof(std::uint16_t)), 0);
    EXPECT_EQ(std::memcmp(frame.gt_z_m, whole.truth.z_m.data(), whole.truth.z_m.size() * sizeof(float)), 0);
  });
  EXPECT_EQ(seen, 1);
}

TEST(chosen_arrays, that_frames_do_not_have_are_refused) {
  const std::string said = complaint_of({.arrays = {"raw", "gt_z"}});
  EXPECT_NE(said.find("arrays[1]: frames have no array \"gt_z\""), std::string::npos) << said;
  EXPECT_NE(said.find("gt_z_m"), std::string::npos) << said;
  EXPECT_NE(complaint_of({.arrays = {""}}).find("arrays[0]"), std::string::npos);
  EXPECT_NE(complaint_of({.arrays = {"start_time_s"}}).find("arrays[0]"), std::string::npos) << "no image: it is always there";
  EXPECT_EQ(complaint_of({.arrays = {"raw", "raw"}}), "none");
}
