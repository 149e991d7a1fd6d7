// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
// Geometry or light of one's own in the place of the first stages.
#include "support/own_arrays.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "backend/cpu/cpu.h"
#include "support/files.h"
#include "support/same_frame.h"
#include "support/statistics.h"

using namespace tofray;
using namespace tofray::test;

namespace {

class OwnArrays : public testing::TestWithParam<std::string> {};

/// The scene's camera without ambient light and motion.
Scene still(Scene scene) {
  scene.ambient = {};
  for (Object& object : scene.objects) object.velocity_m_per_s = {0, 0, 0};
  return scene;
}

/// A wall of reflectivity 0.5 that faces the camera.
Geometry wall(const Camera& camera, float z, int moments = 1) {
  const auto pixels = static_cast<std::size_t>(camera.sensor.width) * static_cast<std::size_t>(camera.sensor.height) * static_cast<std::size_t>(moments);
  Geometry out;
  out.width = camera.sensor.width, out.height = camera.sensor.height, out.moments = moments;
  out.z_m.assign(pixels, z), out.diffuse.assign(pixels, 0.5f);
  for (std::size_t i = 0; i < pixels; ++i) out.normal.insert(out.normal.end(), {0, 0, -1});
  return out;
}

PixelLight even_light(const Camera& camera, float power, float path_length) {
  const auto pixels = static_cast<std::size_t>(camera.sensor.width) * static_cast<std::size_t>(camera.sensor.height);
  PixelLight out;
  out.width = camera.sensor.width, out.height = camera.sensor.height;
  out.power_w.assign(pixels, power), out.path_length_m.assign(pixels, path_length);
  return out;
}

/// A sine, the light at the pupil, an ideal lens.
Camera plain_camera() {
  Camera camera = load_camera("pico-flexx");
  camera.lens.k1 = camera.lens.k2 = camera.lens.p1 = camera.lens.p2 = camera.lens.k3 = 0;
  camera.illumination[0].position = {0, 0, 0};
  camera.illumination[0].waveform.kind = Waveform::Kind::sine;
  camera.pixel.bandwidth_hz = 0;
  camera.pixel.quantum_efficiency = {{850e-9}, {0.5}};
  return camera;
}

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

// What a scene's own first stage found goes in again: the same frame comes out, to the last bit of every array.
TEST_P(OwnArrays, of_what_a_scene_showed_give_its_frame) {
  Scene scene = still(load_scene(GetParam()));
  scene.ambient.spectrum = Ambient::Spectrum::sun_am15, scene.ambient.amount = 0.05;   // uniform
  const Camera camera = load_camera(scene);
  for (const Noise noise : {Noise::off, Noise::fast, Noise::exact}) {
    Simulator simulator(scene, camera, {.seed = 7, .noise = noise});
    const Frame frame = simulator.frame(3);
    EXPECT_EQ(first_difference(simulator.frame(3, geometry_of(scene, camera, frame)), frame), "");
    EXPECT_EQ(first_difference(simulator.frame(3), frame), "") << "and the scene is there again";
  }
}

TEST_P(OwnArrays, of_the_light_that_a_scene_sent_give_its_raw_data_and_depth) {
  const Scene scene = still(load_scene(GetParam()));
  const Camera camera = load_camera(scene);
  for (const Noise noise : {Noise::off, Noise::fast, Noise::exact}) {
    Simulator simulator(scene, camera, {.seed = 7, .noise = noise});
    Frame frame = simulator.frame(3);
    Frame again = simulator.frame(3, light_of(camera, frame));
    EXPECT_TRUE(std::isnan(again.truth.z_m[0]) && std::isnan(again.truth.irradiance_w_m2[0]) && again.truth.object_id[0] == -1)
        << "nothing of this is known";
    EXPECT_EQ(again.truth.power_w, frame.truth.power_w);
    EXPECT_EQ(again.truth.signal_e, frame.truth.signal_e);
    again.truth = frame.truth;
    EXPECT_EQ(first_difference(again, frame), "");
  }
}

INSTANTIATE_TEST_SUITE_P(all, OwnArrays, testing::ValuesIn(scene_names()), [](const auto& which) { return test_name(which.param); });

TEST(own_arrays, have_the_same_bytes_on_every_machine) {
  const Scene scene = load_scene("demo");
  const Camera camera = load_camera(scene);
  const Frame frame = Simulator(scene, camera).frame(0);
  Geometry seen = geometry_of(scene, camera, frame);
  seen.sun_shadow = seen.shadow;
  PixelLight light = light_of(camera, frame);
  light.ambient_e_per_s.assign(light.power_w.size(), 1e6f);
  Frame geometry_reference, light_reference;
  for (const Isa isa : {Isa::scalar, Isa::scalar_fma, Isa::avx2, Isa::avx512}) {
    if (!backend::can_run(isa)) continue;
    for (const int threads : {1, 3}) {
      Simulator simulator(scene, camera, {.threads = threads, .backend = Backend::cpu, .isa = isa});
      const Frame from_geometry = simulator.frame(1, seen), from_light = simulator.frame(1, light);
      if (geometry_reference.raw.raw.empty()) geometry_reference = from_geometry, light_reference = from_light;
      EXPECT_EQ(first_difference(from_geometry, geometry_reference), "") << simulator.isa() << ", " << threads;
      EXPECT_EQ(first_difference(from_light, light_reference), "") << simulator.isa() << ", " << threads;
    }
  }
}

// Each raw frame takes its own moment, and nothing of another's.
TEST(own_arrays, of_each_raw_frame_are_taken_at_its_own_moment) {
  const Camera camera = plain_camera();
  const auto phases = camera.mode.sequence.size();
  for (const Noise noise : {Noise::off, Noise::fast, Noise::exact}) {
    Simulator simulator({}, camera, {.noise = noise});
    Geometry moving = wall(camera, 1, static_cast<int>(phases));
    const std::size_t pixels = moving.z_m.size() / phases;
    for (std::size_t i = 0; i < moving.z_m.size(); ++i) moving.z_m[i] = 1 + 0.1f * static_cast<float>(i / pixels);
    const Frame all = simulator.frame(2, moving);
    for (std::size_t k = 0; k < phases; ++k) {
      const Frame one = simulator.frame(2, wall(camera, 1 + 0.1f * static_cast<float>(k)));
      const auto slice = [&](const auto& array) { return std::vector(array.begin() + static_cast<long>(k * pixels), array.begin() + static_cast<long>((k + 1) * pixels)); };
      EXPECT_EQ(slice(all.raw.tap_a), slice(one.raw.tap_a)) << k;
      EXPECT_EQ(slice(all.raw.tap_b), slice(one.raw.tap_b)) << k;
      EXPECT_EQ(slice(all.raw.raw), slice(one.raw.raw)) << k;
      EXPECT_EQ(slice(all.truth.signal_e), slice(one.truth.signal_e)) << k;
    }
    EXPECT_EQ(all.truth.z_m, wall(camera, 1 + 0.1f * static_cast<float>(phases / 2)).z_m) << "the truth is that of the middle raw frame";
  }
}

TEST(own_arrays, of_each_raw_frame_have_all_lights_at_its_own_moment) {
  Camera camera = plain_camera();
  camera.illumination.push_back(camera.illumination[0]);
  const auto phases = camera.mode.sequence.size();
  Simulator simulator({}, camera);
  PixelLight all;
  std::vector<PixelLight> each;
  for (std::size_t k = 0; k < phases; ++k) {
    PixelLight one = even_light(camera, 1e-13f * static_cast<float>(k + 1), 2);
    const PixelLight second = even_light(camera, 3e-13f, 2 + 0.1f * static_cast<float>(k));
    const auto append = [](auto& to, const auto& from) { to.insert(to.end(), from.begin(), from.end()); };
    one.ambient_e_per_s.assign(one.power_w.size(), 1e5f * static_cast<float>(k));
    append(one.power_w, second.power_w), append(one.path_length_m, second.path_length_m);
    append(all.power_w, one.power_w), append(all.path_length_m, one.path_length_m), append(all.ambient_e_per_s, one.ambient_e_per_s);
    each.push_back(one);
  }
  all.width = each[0].width, all.height = each[0].height, all.moments = static_cast<int>(phases);
  const Frame together = simulator.frame(2, all);
  const std::size_t pixels = together.depth.z_m.size();
  for (std::size_t k = 0; k < phases; ++k) {
    const Frame one = simulator.frame(2, each[k]);
    const auto slice = [&](const auto& array) { return std::vector(array.begin() + static_cast<long>(k * pixels), array.begin() + static_cast<long>((k + 1) * pixels)); };
    EXPECT_EQ(slice(together.raw.tap_a), slice(one.raw.tap_a)) << k;
    EXPECT_EQ(slice(together.raw.tap_b), slice(one.raw.tap_b)) << k;
    EXPECT_EQ(together.truth.power_w == one.truth.power_w, k == phases / 2);
  }
}

// S = P·t·λQE/(hc), ambient electrons as they are given, and depth is half the path: by hand.
TEST(own_arrays, of_light_become_the_electrons_of_the_closed_form) {
  const Camera camera = plain_camera();
  Simulator simulator({}, camera, {.noise = Noise::off});
  PixelLight light = even_light(camera, 2e-12f, 3.0f);
  light.ambient_e_per_s.assign(light.power_w.size(), 4e6f);
  const Frame frame = simulator.frame(0, light);
  const double planck = 6.62607015e-34, rate = 2e-12 * camera.illumination[0].illumination_wavelength_m * 0.5 / (planck * c);
  const std::size_t pixels = light.power_w.size(), at = 100 * 224 + 77;
  for (std::size_t k = 0; k < camera.mode.sequence.size(); ++k) {
    const RawFrame& exposure = camera.mode.sequence[k];
    const double both = static_cast<double>(frame.raw.tap_a[k * pixels + at]) + static_cast<double>(frame.raw.tap_b[k * pixels + at]);
    const double dark = 2 * camera.pixel.dark_current_e_per_s * exposure.integration_time_s;
    const double expected = (exposure.lit ? rate : 0) * exposure.integration_time_s + 4e6 * exposure.integration_time_s + dark;
    EXPECT_NEAR(both / expected, 1, 1e-5) << k;
    EXPECT_NEAR(static_cast<double>(frame.truth.signal_e[k * pixels + at]), exposure.lit ? rate * exposure.integration_time_s : 0, 1e-5 * expected);
  }
  EXPECT_NEAR(static_cast<double>(frame.depth.range_m[at]), 1.5, 2e-5);
}

// Two paths of one light: two phasors of the same length have the direction of their middle, and the cosine of half their angle as length.
TEST(own_arrays, of_several_paths_add_up_as_phasors) {
  Camera camera = plain_camera();
  camera.decoding.inconsistent_range_m = 100;
  camera.illumination.push_back(camera.illumination[0]);
  const Frame once = Simulator({}, plain_camera(), {.noise = Noise::off}).frame(0, even_light(plain_camera(), 2e-12f, 2.5f));
  PixelLight light = even_light(camera, 1e-12f, 2.3f);
  const PixelLight longer = even_light(camera, 1e-12f, 2.7f);
  light.power_w.insert(light.power_w.end(), longer.power_w.begin(), longer.power_w.end());
  light.path_length_m.insert(light.path_length_m.end(), longer.path_length_m.begin(), longer.path_length_m.end());
  const Frame frame = Simulator({}, camera, {.noise = Noise::off}).frame(0, light);
  const std::size_t at = 80 * 224 + 110;
  EXPECT_NEAR(static_cast<double>(frame.depth.range_m[at]), 1.25, 2e-5);
  double shrink = 0;
  int lit = 0;
  for (const RawFrame& exposure : camera.mode.sequence) {
    if (exposure.lit) shrink += std::cos(two_pi * exposure.modulation_frequency_hz * 0.2 / c), ++lit;
  }
  EXPECT_NEAR(static_cast<double>(frame.depth.amplitude_e[at] / once.depth.amplitude_e[at]), shrink / lit, 1e-4);
}

TEST(own_arrays, of_shadows_keep_light_and_sun_away) {
  Scene scene;
  scene.ambient.spectrum = Ambient::Spectrum::sun_am15, scene.ambient.amount = 0.1, scene.ambient.direction = Vec3{0, 0.3, 1};
  const Camera camera = plain_camera();
  Simulator simulator(scene, camera, {.noise = Noise::off});
  Geometry seen = wall(camera, 1.2f);
  const Depth open = simulator.frame(0, seen).depth;
  seen.shadow.assign(seen.z_m.size(), 0), seen.sun_shadow.assign(seen.z_m.size(), 0);
  const std::size_t light = 5001, sun = 5002, both = 5003;
  seen.shadow[light] = seen.shadow[both] = 1, seen.sun_shadow[sun] = seen.sun_shadow[both] = 1;
  const Frame frame = simulator.frame(0, seen);
  const Depth& d = frame.depth;
  EXPECT_GT(open.amplitude_e[sun], 100);
  EXPECT_GT(open.ambient_e[light], 100);
  EXPECT_EQ(d.amplitude_e[sun], open.amplitude_e[sun]);
  EXPECT_EQ(d.ambient_e[light], open.ambient_e[light]);
  EXPECT_EQ(d.amplitude_e[light], 0);
  EXPECT_EQ(d.ambient_e[both], d.ambient_e[sun]) << "the dark current is left";
  EXPECT_LT(d.ambient_e[sun], 1e-2f * open.ambient_e[sun]);
  EXPECT_TRUE((d.flags[both] & flag_no_return) != 0);
  EXPECT_EQ(frame.truth.power_w[light], 0);
}

// Each light has shadows of its own: what is left is the frame of the other one.
TEST(own_arrays, of_shadows_know_which_light_is_kept_away) {
  const Camera left = plain_camera();
  Camera right = left, both = left;
  right.illumination[0].position = {0.05, 0, 0}, right.illumination[0].power_w *= 0.5;
  both.illumination.push_back(right.illumination[0]);
  Geometry seen = wall(left, 1.2f);
  const auto power = [&](const Camera& camera, const Geometry& geometry) {
    return Simulator({}, camera, {.noise = Noise::off}).frame(0, geometry).truth.power_w;
  };
  const std::vector<float> of_left = power(left, seen), of_right = power(right, seen);
  seen.shadow.assign(2 * seen.z_m.size(), 0);
  seen.shadow[5001] = 1, seen.shadow[seen.z_m.size() + 5002] = 1;
  const std::vector<float> found = power(both, seen);
  EXPECT_NE(of_left[5001], of_right[5001]);
  EXPECT_EQ(found[5000], of_left[5000] + of_right[5000]);
  EXPECT_EQ(found[5001], of_right[5001]);
  EXPECT_EQ(found[5002], of_left[5002]);
}

TEST(own_arrays, show_nothing_where_z_says_so_and_mind_no_value_there) {
  const Camera camera = plain_camera();
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
  const Camera camera = plain_camera();
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
  const Camera camera = plain_camera();
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
  const Camera camera = plain_camera();
  Simulator simulator({}, camera);
  const auto geometry = [&](const auto& spoil) {
    Geometry seen = wall(camera, 2);
    spoil(seen);
    return message_of(simulator, seen);
  };
  constexpr float nan = std::numeric_limits<float>::quiet_NaN();
  EXPECT_EQ(geometry([](Geometry&) {}), "no error");
  EXPECT_EQ(geometry([](Geometry& g) { g.width = 223; }), "error: geometry has the wrong size\n  got 223 × 172 pixels, the camera has 224 × 172");
  EXPECT_EQ(geometry([](Geometry& g) { g.moments = 4; }), "error: geometry.moments is 4\n  expected 1, or 9: one for each raw frame");
  EXPECT_EQ(geometry([](Geometry& g) { g.z_m.pop_back(); }), "error: geometry.z_m has the wrong size\n  got 38527 values, expected 38528");
  EXPECT_EQ(geometry([](Geometry& g) { g.normal.clear(); }), "error: geometry.normal has the wrong size\n  got 0 values, expected 115584");
  EXPECT_EQ(geometry([](Geometry& g) { g.shadow.assign(7, 0); }), "error: geometry.shadow has the wrong size\n  got 7 values, expected 38528");
  EXPECT_EQ(geometry([](Geometry& g) { g.specular.assign(g.z_m.size(), 0); }),
            "error: geometry has specular or exponent without the other\n  expected both, or neither for Lambertian surfaces");
  EXPECT_EQ(geometry([](Geometry& g) { g.normal[3 * 225 + 2] = 0.5f; }),
            "error: geometry.normal's length, pixel (column 1, row 1) is out of range\n  got 0.5, expected 0.999 to 1.001");
  EXPECT_EQ(geometry([](Geometry& g) { g.diffuse[0] = nan; }),
            "error: geometry.diffuse, pixel (column 0, row 0) is out of range\n  got nan, expected 0 to 1");
  EXPECT_EQ(geometry([](Geometry& g) {
              g.specular.assign(g.z_m.size(), 0.6f), g.exponent.assign(g.z_m.size(), 20);
            }),
            "error: geometry.diffuse, pixel (column 0, row 0): diffuse + specular is more than 1\n  a surface cannot send back more light than it gets");
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
  EXPECT_EQ(light([](PixelLight& l) { l.ambient_e_per_s.assign(2, 0); }), "error: pixel light.ambient_e_per_s has the wrong size\n  got 2 values, expected 38528");
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
            "error: pixel light.path_length_m, moment 2, light 1, pixel (column 3, row 0) is out of range\n  got -1, expected 0 to 1000000");
}

TEST(own_arrays, leave_the_truth_out_where_it_is_not_wanted) {
  const Camera camera = plain_camera();
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
  Camera five = load_camera("pico-flexx", {.mode = "MODE_5_35FPS_600"}), dark = plain_camera(), blind = plain_camera();
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
                (1e6 + camera.pixel.dark_current_e_per_s) * camera.mode.sequence[0].integration_time_s, 1) << "the grey frame";
  }
}
