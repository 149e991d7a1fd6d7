// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>

#include "support/files.h"
#include "support/quarter.h"
#include "tofray/tofray.h"

using namespace tofray;
using namespace tofray::test;

namespace {

template <class T>
bool same(const std::vector<T>& a, const std::vector<T>& b) {
  return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(T)) == 0;
}

void expect_same(const Depth& a, const Depth& b) {
  EXPECT_TRUE(same(a.z_m, b.z_m));
  EXPECT_TRUE(same(a.range_m, b.range_m));
  EXPECT_TRUE(same(a.points_m, b.points_m));
  EXPECT_TRUE(same(a.amplitude_e, b.amplitude_e));
  EXPECT_TRUE(same(a.ambient_e, b.ambient_e));
  EXPECT_TRUE(same(a.noise_m, b.noise_m));
  EXPECT_TRUE(same(a.confidence, b.confidence));
  EXPECT_TRUE(same(a.flags, b.flags));
}

class Process : public testing::TestWithParam<std::string> {};

}  // namespace

// Decoding what a frame read out gives the frame's own depth, to the last bit: from the codes.
TEST_P(Process, of_a_frame_s_raw_data_is_the_frame_s_depth) {
  const Scene scene = load_scene(GetParam());
  const Camera camera = camera_of(scene);
  const SimulatorOptions options{.seed = 3};
  const Frame frame = Simulator(scene, camera, options).frame(2);
  expect_same(process(frame.raw, camera, options), frame.depth);
}

// Without noise depth comes from the difference that is expected, which the taps hold to within the last place of a float.
TEST_P(Process, of_silent_taps_is_the_frame_s_depth_within_their_last_place) {
  const Scene scene = load_scene(GetParam());
  Camera camera = camera_of(scene);
  camera.decoding.filter = {};  // whom it averages with depends on last places, too
  const SimulatorOptions silent{.noise = Noise::off};
  Frame frame = Simulator(scene, camera, silent).frame(2);
  frame.raw.raw.clear();
  const Depth depth = process(frame.raw, camera, silent);
  int compared = 0;
  // Where light bounces, modulation frequencies show different ranges, and their weights change at each node of the wiggling table.
  const double weighed = scene.transport.bounces > 0 ? 1e-4 : 0;
  for (std::size_t i = 0; i < depth.z_m.size(); ++i) {
    // whether a level lies among the valid codes can depend on a tap's last place
    if (((frame.depth.flags[i] | depth.flags[i]) & flags_invalid) != 0) continue;
    ++compared;
    const double last_place = static_cast<double>(frame.depth.ambient_e[i] + frame.depth.amplitude_e[i]) * 0x1p-23;
    ASSERT_NEAR(depth.range_m[i], frame.depth.range_m[i], 1e-6 + weighed + 2 * last_place / static_cast<double>(frame.depth.amplitude_e[i]))
        << i;
    ASSERT_EQ(depth.flags[i], frame.depth.flags[i]) << i;
  }
  EXPECT_GT(compared, with_sanitizers ? 1250 : 5000);
}

// Codes without taps: a full well is not to be seen, all else is.
TEST_P(Process, of_codes_alone_is_the_same_where_no_well_was_full) {
  const Scene scene = load_scene(GetParam());
  const Camera camera = camera_of(scene);
  Frame frame = Simulator(scene, camera).frame(0);
  frame.raw.tap_a.clear(), frame.raw.tap_b.clear();
  const Depth depth = process(frame.raw, camera);
  int compared = 0;
  for (std::size_t i = 0; i < depth.z_m.size(); ++i) {
    if ((frame.depth.flags[i] & (flag_saturated | flag_flying_pixel)) != 0 || (depth.flags[i] & flag_flying_pixel) != 0) continue;
    ++compared;
    ASSERT_EQ(std::memcmp(&depth.range_m[i], &frame.depth.range_m[i], 4), 0) << i;
    ASSERT_EQ(depth.flags[i], frame.depth.flags[i]) << i;
  }
  EXPECT_GT(compared, with_sanitizers ? 1250 : 5000);
}

INSTANTIATE_TEST_SUITE_P(all, Process, testing::ValuesIn(scene_names()), [](const auto& which) { return test_name(which.param); });

TEST(process, takes_fixed_patterns_filters_and_all_instruction_sets) {
  const Scene scene = load_scene("grey-cards");
  Camera camera = load_camera(scene);
  camera.pixel.prnu = 0.01, camera.pixel.dsnu_dn = 0.7, camera.pixel.delay_s = 30e-12;
  for (const auto kind : {ImageFilter::Kind::none, ImageFilter::Kind::gaussian, ImageFilter::Kind::median, ImageFilter::Kind::bilateral,
                          ImageFilter::Kind::adaptive}) {
    camera.decoding.filter.kind = kind;
    const Frame frame = Simulator(scene, camera).frame(0);
    expect_same(process(frame.raw, camera, {.isa = Isa::scalar}), frame.depth);
    expect_same(process(frame.raw, camera, {.threads = 1}), frame.depth);
  }
}

// Each point lies on its pixel: through pinhole and distortion it comes back within 1e-4 px; NaN where there is no depth, and nowhere else.
TEST(point_cloud, projects_onto_its_own_pixels) {
  for (const std::string& name : scene_names()) {
    const Scene scene = load_scene(name);
    Camera camera = load_camera(scene);
    camera.lens.k2 = 0.05, camera.lens.k3 = -0.005, camera.lens.p1 = 0.002, camera.lens.p2 = -0.001;
    const Frame frame = Simulator(scene, camera, {.noise = Noise::off}).frame(0);
    const Lens& lens = camera.lens;
    int valid = 0;
    for (int v = 0; v < 172; ++v) {
      for (int u = 0; u < 224; ++u) {
        const std::size_t i = static_cast<std::size_t>(v * 224 + u);
        const bool has_depth = (frame.depth.flags[i] & flags_invalid) == 0;
        const float* p = &frame.depth.points_m[3 * i];
        for (int k = 0; k < 3; ++k) ASSERT_EQ(std::isnan(p[k]), !has_depth);
        ASSERT_EQ(std::isnan(frame.depth.z_m[i]), !has_depth);
        ASSERT_EQ(std::isnan(frame.depth.range_m[i]), !has_depth);
        if (!has_depth) {
          ASSERT_EQ(frame.depth.confidence[i], 0);
          continue;
        }
        ++valid;
        const double x = static_cast<double>(p[0]) / static_cast<double>(p[2]), y = static_cast<double>(p[1]) / static_cast<double>(p[2]);
        const double r2 = x * x + y * y, radial = 1 + r2 * (lens.k1 + r2 * (lens.k2 + r2 * lens.k3));
        ASSERT_NEAR(lens.fx_px * (x * radial + 2 * lens.p1 * x * y + lens.p2 * (r2 + 2 * x * x)) + lens.cx_px, u, 1e-4) << name;
        ASSERT_NEAR(lens.fy_px * (y * radial + lens.p1 * (r2 + 2 * y * y) + 2 * lens.p2 * x * y) + lens.cy_px, v, 1e-4) << name;
        ASSERT_EQ(p[2], frame.depth.z_m[i]);
        const double length = std::hypot(static_cast<double>(p[0]), static_cast<double>(p[1]), static_cast<double>(p[2]));
        ASSERT_NEAR(length / static_cast<double>(frame.depth.range_m[i]), 1, 5e-7);
      }
    }
    EXPECT_GT(valid, 5000) << name;
  }
}

// confidence = round(255·max(0, 1 − σ̂/0.07 m))
// Where there is one modulation frequency there is one cycle, and the noise alone counts.
TEST(confidence, falls_with_the_noise) {
  const Scene scene = load_scene("demo");
  const Frame frame =
      Simulator(scene, load_camera("pico-flexx", {.mode = "MODE_5_35FPS_600", .set = {{"decoding.filter", "{kind: none}"}}})).frame(0);
  for (std::size_t i = 0; i < frame.depth.z_m.size(); ++i) {
    if ((frame.depth.flags[i] & flags_invalid) != 0) continue;
    const double exact = 255 * std::max(0.0, 1 - static_cast<double>(frame.depth.noise_m[i]) / 0.07);
    ASSERT_NEAR(frame.depth.confidence[i], exact, 0.5 + 1e-4) << i;
  }
}

// No well holds 1e15 electrons: what says so, or says no number, counts as none, and its pixel as saturated.
TEST(process, takes_charges_beyond_measure_for_none) {
  const Scene scene = load_scene("card");
  const Camera camera = load_camera(scene);
  const Raw good = Simulator(scene, camera).frame(0).raw;
  const auto with = [&](float charge) {
    Raw raw = good;
    raw.raw.clear(), raw.tap_a[good.tap_a.size() / 9 * 3 + 1234] = charge;
    return process(raw, camera);
  };
  const Depth expected = with(std::numeric_limits<float>::infinity());
  EXPECT_NE(expected.flags[1234] & flag_saturated, 0);
  for (const float charge : {1.001e15F, 1.9e15F, 1e30F, -1.001e15F, std::nanf("")}) expect_same(with(charge), expected);
}

// A grey frame alone is raw data, too: there is ambient light, and no depth.
TEST(process, takes_a_single_raw_frame) {
  Camera camera = load_camera("pico-flexx");
  camera.mode.sequence.resize(1);
  ASSERT_FALSE(camera.mode.sequence[0].lit);
  const Frame frame = Simulator(load_scene("card"), camera).frame(0);
  const Depth depth = process(frame.raw, camera);
  expect_same(depth, frame.depth);
  for (const Depth& one : {depth, frame.depth}) {
    EXPECT_EQ(one.width, 224);
    EXPECT_EQ(one.height, 172);
  }
  EXPECT_TRUE(std::all_of(depth.z_m.begin(), depth.z_m.end(), [](float z) { return std::isnan(z); }));
}

TEST(process, refuses_raw_data_that_does_not_fit) {
  const Scene scene = load_scene("card");
  const Camera camera = load_camera(scene);
  const Raw good = Simulator(scene, camera).frame(0).raw;
  const auto kind_of = [&](const auto& spoil) {
    Raw raw = good;
    spoil(raw);
    try {
      (void)process(raw, camera);
    } catch (const Error& error) {
      return error.kind();
    }
    return ErrorKind::bug;
  };
  EXPECT_EQ(kind_of([](Raw& r) { r.width = 100; }), ErrorKind::bad_input);
  EXPECT_EQ(kind_of([](Raw& r) { r.raw.pop_back(); }), ErrorKind::bad_input);
  EXPECT_EQ(kind_of([](Raw& r) { r.tap_a.pop_back(); }), ErrorKind::bad_input);
  EXPECT_EQ(kind_of([](Raw& r) { r.raw.clear(), r.tap_b.clear(); }), ErrorKind::bad_input);
  EXPECT_EQ(kind_of([](Raw& r) { r.lit.pop_back(); }), ErrorKind::bad_input);
  EXPECT_EQ(kind_of([](Raw& r) { r.phases = 0; }), ErrorKind::bad_input);
  EXPECT_EQ(kind_of([](Raw& r) { r.reference_phase_rad[2] = 0.3; }), ErrorKind::bad_input);
  EXPECT_EQ(kind_of([](Raw& r) { r.modulation_frequency_hz[2] = 71e6; }), ErrorKind::bad_input);
}
