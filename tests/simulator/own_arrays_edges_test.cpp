// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
// Geometry or light of one's own: what may be missing, what is refused, and where a frame ends.
#include "support/own_arrays.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "support/same_frame.h"

using namespace tofray;
using namespace tofray::test;

namespace {

std::string message_of(Simulator& simulator, const auto& input) {
  try {
    (void)simulator.frame(0, input);
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::bad_input);
    return error.what();
  }
  return "no error";
}

}  // namespace

TEST(own_arrays, show_nothing_where_z_says_so_and_mind_no_value_there) {
  const Camera camera = pico();
  Simulator simulator({}, camera, {.noise = Noise::off});
  constexpr float nan = std::numeric_limits<float>::quiet_NaN(), infinite = std::numeric_limits<float>::infinity();
  Geometry seen = wall(camera, 2);
  const float nothing[] = {0, -1, nan, infinite, -infinite, 1e10f};
  for (std::size_t i = 0; i < std::size(nothing); ++i) {
    seen.z_m[1000 + i] = nothing[i];
    seen.normal[3 * (1000 + i)] = seen.diffuse[1000 + i] = nan;
  }
  const Frame frame = simulator.frame(0, seen);
  for (std::size_t i = 0; i < std::size(nothing); ++i) {
    EXPECT_TRUE((frame.depth.flags[1000 + i] & flag_no_return) != 0) << nothing[i];
    EXPECT_TRUE(std::isnan(frame.truth.z_m[1000 + i])) << nothing[i];
    EXPECT_EQ(frame.truth.object_id[1000 + i], -1);
    EXPECT_EQ(frame.truth.signal_e[2 * seen.z_m.size() + 1000 + i], 0);
  }
  EXPECT_EQ(frame.depth.flags[999], 0);
  EXPECT_EQ(frame.truth.object_id[999], 0);
}

// From behind, a surface is seen as from the front.
TEST(own_arrays, may_have_normals_on_either_side) {
  const Camera camera = pico();
  Simulator simulator({}, camera);
  const Geometry front = wall(camera, 1.5f);
  Geometry back = front;
  for (float& component : back.normal) component = -component;
  EXPECT_EQ(first_difference(simulator.frame(0, front), simulator.frame(0, back)), "");
}

// The rays are those of the points of a frame, and the lens's distortion takes them back to their pixels.
TEST(own_arrays, lie_along_the_pixels_rays) {
  Camera camera = load_camera("pico-flexx");
  camera.lens.k1 = -0.2;
  const std::vector<float> rays = pixel_rays(camera);
  ASSERT_EQ(rays.size(), 2u * 224 * 172);
  const Frame frame = Simulator({}, camera, {.noise = Noise::off}).frame(0, wall(camera, 1.5f));
  const Lens& lens = camera.lens;
  for (const int i : {0, 223, 5000, 20000, 38527}) {
    const auto at = static_cast<std::size_t>(i);
    EXPECT_EQ(frame.truth.position_m[3 * at], rays[2 * at] * 1.5f) << i;
    EXPECT_EQ(frame.truth.position_m[3 * at + 1], rays[2 * at + 1] * 1.5f) << i;
    const double x = static_cast<double>(rays[2 * at]), y = static_cast<double>(rays[2 * at + 1]), square = x * x + y * y;
    const double radial = 1 + lens.k1 * square + lens.k2 * square * square + lens.k3 * square * square * square;
    EXPECT_NEAR(lens.cx_px + lens.fx_px * (x * radial + 2 * lens.p1 * x * y + lens.p2 * (square + 2 * x * x)), i % 224, 1e-3) << i;
    EXPECT_NEAR(lens.cy_px + lens.fy_px * (y * radial + lens.p1 * (square + 2 * y * y) + 2 * lens.p2 * x * y), i / 224, 1e-3) << i;
  }
  camera.lens.k1 = -2;
  const std::vector<float> folded = pixel_rays(camera);
  EXPECT_TRUE(std::isnan(folded[0]) && std::isnan(folded[1])) << "no inverse in the corner";
  EXPECT_FALSE(std::isnan(folded[2 * (86 * 224 + 112)]));
}

TEST(own_arrays, stop_after_the_stage_that_is_asked_for) {
  const Camera camera = pico();
  const Geometry seen = wall(camera, 1.5f);
  const Frame whole = Simulator({}, camera).frame(0, seen);
  for (const Stage last : {Stage::trace, Stage::power, Stage::raw}) {
    const Frame part = Simulator({}, camera, {.last_stage = last}).frame(0, seen);
    EXPECT_EQ(part.truth.z_m, whole.truth.z_m);
    EXPECT_EQ(part.truth.power_w == whole.truth.power_w, last >= Stage::power);
    EXPECT_EQ(part.raw.raw == whole.raw.raw, last >= Stage::raw);
    EXPECT_EQ(part.depth.flags, std::vector<std::uint16_t>(seen.z_m.size(), 0));
  }
  const PixelLight light = even_light(camera, 2e-12f, 3);
  const Frame lit = Simulator({}, camera).frame(0, light);
  for (const Stage last : {Stage::trace, Stage::power, Stage::raw}) {
    const Frame part = Simulator({}, camera, {.last_stage = last}).frame(0, light);
    EXPECT_EQ(part.truth.power_w, lit.truth.power_w);
    EXPECT_EQ(part.raw.raw == lit.raw.raw, last >= Stage::raw);
    EXPECT_EQ(part.depth.flags, std::vector<std::uint16_t>(seen.z_m.size(), 0));
  }
}

TEST(own_arrays, that_do_not_fit_are_refused_by_name) {
  const Camera camera = pico();
  Simulator simulator({}, camera);
  const auto geometry = [&](const auto& spoil) {
    Geometry seen = wall(camera, 2);
    spoil(seen);
    return message_of(simulator, seen);
  };
  constexpr float nan = std::numeric_limits<float>::quiet_NaN();
  EXPECT_EQ(geometry([](Geometry&) {}), "no error");
  EXPECT_EQ(geometry([](Geometry& g) { g.width = 223; }),
            "error: geometry has the wrong size\n  got 223 × 172 pixels, the camera has 224 × 172");
  EXPECT_EQ(geometry([](Geometry& g) { g.moments = 4; }), "error: geometry.moments is 4\n  expected 1, or 9: one for each raw frame");
  EXPECT_EQ(geometry([](Geometry& g) { g.z_m.pop_back(); }), "error: geometry.z_m has the wrong size\n  got 38527 values, expected 38528");
  EXPECT_EQ(geometry([](Geometry& g) { g.normal.clear(); }), "error: geometry.normal has the wrong size\n  got 0 values, expected 115584");
  EXPECT_EQ(geometry([](Geometry& g) { g.shadow.assign(7, 0); }),
            "error: geometry.shadow has the wrong size\n  got 7 values, expected 38528");
  EXPECT_EQ(geometry([](Geometry& g) { g.object_id.assign(38529, 0); }),
            "error: geometry.object_id has the wrong size\n  got 38529 values, expected 38528");
  EXPECT_EQ(geometry([](Geometry& g) { g.specular.assign(g.z_m.size(), 0); }),
            "error: geometry has specular or exponent without the other\n  expected both, or neither for Lambertian surfaces");
  EXPECT_EQ(geometry([](Geometry& g) { g.normal[3 * 225 + 2] = 0.5f; }),
            "error: geometry.normal's length, pixel (column 1, row 1) is out of range\n  got 0.5, expected 0.999 to 1.001");
  EXPECT_EQ(geometry([](Geometry& g) { g.normal[0] = 0.6f, g.normal[1] = 0, g.normal[2] = -0.8f; }), "no error");
  EXPECT_EQ(geometry([](Geometry& g) { g.normal[0] = 0, g.normal[1] = -0.6f, g.normal[2] = 0.8f; }), "no error");
  EXPECT_EQ(geometry([](Geometry& g) { g.diffuse[0] = nan; }),
            "error: geometry.diffuse, pixel (column 0, row 0) is out of range\n  got nan, expected 0 to 1");
  EXPECT_EQ(geometry([](Geometry& g) { g.specular.assign(g.z_m.size(), 0.6f), g.exponent.assign(g.z_m.size(), 20); }),
            "error: geometry.diffuse, pixel (column 0, row 0): diffuse + specular is more than 1\n  a surface cannot send back more light "
            "than it gets");
  const auto light = [&](const auto& spoil) {
    PixelLight given = even_light(camera, 1e-12f, 2);
    spoil(given);
    return message_of(simulator, given);
  };
  EXPECT_EQ(light([](PixelLight&) {}), "no error");
  EXPECT_EQ(light([](PixelLight& l) { l.power_w[3] = -1; }),
            "error: pixel light.power_w, pixel (column 3, row 0) is out of range\n  got -1, expected 0 to 1");
  EXPECT_EQ(light([](PixelLight& l) { l.path_length_m[224] = nan; }),
            "error: pixel light.path_length_m, pixel (column 0, row 1) is out of range\n  got nan, expected 0 to 1000000");
  EXPECT_EQ(light([](PixelLight& l) { l.ambient_e_per_s.assign(2, 0); }),
            "error: pixel light.ambient_e_per_s has the wrong size\n  got 2 values, expected 38528");
  EXPECT_EQ(light([](PixelLight& l) {
              l.moments = 9;
              for (auto* array : {&l.power_w, &l.path_length_m}) array->assign(9 * 38528, 1e-12f);
              l.power_w[5 * 38528 + 3] = 2;
            }),
            "error: pixel light.power_w, moment 5, pixel (column 3, row 0) is out of range\n  got 2, expected 0 to 1");
  Camera two = camera;
  two.illumination.push_back(two.illumination[0]);
  Simulator seen_twice({}, two);
  PixelLight given;
  given.width = 224, given.height = 172, given.moments = 9;
  for (auto* array : {&given.power_w, &given.path_length_m}) array->assign(9 * 2 * 38528, 1e-12f);
  given.path_length_m[5 * 38528 + 3] = -1;
  EXPECT_EQ(message_of(seen_twice, given),
            "error: pixel light.path_length_m, moment 2, path 1, pixel (column 3, row 0) is out of range\n  got -1, expected 0 to 1000000");
}

// Paths of any light, as many as there are; or their sums.
TEST(own_arrays, of_paths_and_phasors_must_fit_the_camera) {
  const Camera camera = pico();
  Simulator simulator({}, camera);
  const auto light = [&](const auto& spoil) {
    PixelLight given = even_light(camera, 1e-12f, 2);
    spoil(given);
    return message_of(simulator, given);
  };
  const std::size_t pixels = 38528;
  EXPECT_EQ(light([](PixelLight& l) { l.light_of_path = {0}; }), "no error");
  EXPECT_EQ(light([](PixelLight& l) { l.light_of_path = {1}; }),
            "error: pixel light.light_of_path[0] is 1\n  the camera has 1 light sources, counted from 0");
  EXPECT_EQ(light([](PixelLight& l) { l.light_of_path = {-1}; }),
            "error: pixel light.light_of_path[0] is -1\n  the camera has 1 light sources, counted from 0");
  EXPECT_EQ(light([](PixelLight& l) {
              l.light_of_path = {0, 0};
            }),
            "error: pixel light.power_w has the wrong size\n  got 38528 values, expected 77056");
  const auto phasors = [&](PixelLight& l) { l.path_length_m.clear(), l.phasor_w.assign(2 * 3 * pixels, {0, 1e-12f}); };
  EXPECT_EQ(light([&](PixelLight& l) { phasors(l); }), "no error");
  EXPECT_EQ(light([&](PixelLight& l) { phasors(l), l.phasor_w.pop_back(); }),
            "error: pixel light.phasor_w has the wrong size\n  got 231167 values, expected a multiple of 77056: [moment][light][modulation "
            "frequency][harmonic][height][width], the camera has 1 lights and 2 modulation frequencies");
  EXPECT_EQ(light([&](PixelLight& l) { phasors(l), l.path_length_m.assign(pixels, 2); }),
            "error: pixel light has both paths and phasors\n  give path_length_m (and light_of_path), or phasor_w");
  EXPECT_EQ(light([&](PixelLight& l) {
              phasors(l), l.phasor_w[4 * pixels + 5] = {1e-12f, 1e-13f};
            }),
            "error: pixel light.phasor_w[154117] is longer than its light's power\n  got 1.0049875e-12 W of 1e-12 W");
  EXPECT_EQ(light([&](PixelLight& l) {
              phasors(l), l.phasor_w[0] = {std::numeric_limits<float>::quiet_NaN(), 0};
            }),
            "error: pixel light.phasor_w[0] is longer than its light's power\n  got nan W of 1e-12 W");
}

TEST(own_arrays, leave_the_truth_out_where_it_is_not_wanted) {
  const Camera camera = pico();
  const Geometry seen = wall(camera, 1.5f);
  const PixelLight light = even_light(camera, 2e-12f, 3);
  Simulator whole({}, camera), bare({}, camera, {.truth = false});
  for (const bool from_light : {false, true}) {
    Frame a = from_light ? whole.frame(1, light) : whole.frame(1, seen);
    const Frame b = from_light ? bare.frame(1, light) : bare.frame(1, seen);
    EXPECT_TRUE(b.truth.z_m.empty());
    a.truth = {};
    EXPECT_EQ(first_difference(a, b), "");
  }
}

// Five phases, no lit raw frame, no light at all: what a scene may meet, arrays may meet.
TEST(own_arrays, go_with_any_sequence_and_with_no_light) {
  Camera five = load_camera("pico-flexx", {.mode = "MODE_5_35FPS_600"}), dark = pico(), blind = pico();
  dark.mode.sequence.resize(1);
  blind.illumination.clear();
  for (const Camera& camera : {five, dark, blind}) {
    const bool valid = camera.mode.sequence.size() == 5;
    Simulator simulator({}, camera, {.noise = Noise::off});
    const Frame frame = simulator.frame(0, wall(camera, 1));
    EXPECT_EQ((frame.depth.flags[20000] & flag_no_return) == 0, valid);
    EXPECT_EQ(frame.truth.z_m[20000], 1);
    PixelLight light = even_light(camera, 2e-12f, 2);
    if (camera.illumination.empty()) light.power_w.clear(), light.path_length_m.clear();
    light.ambient_e_per_s.assign(224 * 172, 1e6f);
    const Frame lit = simulator.frame(0, light);
    EXPECT_EQ((lit.depth.flags[20000] & flag_no_return) == 0, valid);
    EXPECT_NEAR(static_cast<double>(lit.raw.tap_a[20000]),
                (1e6 + camera.pixel.dark_current_e_per_s) * camera.mode.sequence[0].integration_time_s, 1)
        << "the grey frame";
  }
}
