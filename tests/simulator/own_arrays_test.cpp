// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
// Geometry or light of one's own in the place of the first stages.
#include "support/own_arrays.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <complex>

#include "backend/cpu/cpu.h"
#include "support/files.h"
#include "support/quarter.h"
#include "support/same_frame.h"
#include "support/scenes.h"
#include "support/statistics.h"

using namespace tofray;
using namespace tofray::test;

namespace {

class OwnArrays : public testing::TestWithParam<std::string> {};

/// The scene without ambient light and motion.
Scene still(Scene scene) {
  scene.ambient = {};
  for (Object& object : scene.objects) object.velocity_m_per_s = {0, 0, 0};
  return scene;
}

}  // namespace

// What a scene's own first stage found goes in again: the same frame comes out, to the last bit of every array.
TEST_P(OwnArrays, of_what_a_scene_showed_give_its_frame) {
  Scene scene = still(load_scene(GetParam()));
  scene.ambient.spectrum = Ambient::Spectrum::sun_am15, scene.ambient.amount = 0.05;  // uniform
  const Camera camera = camera_of(scene);
  for (const Noise noise : {Noise::off, Noise::exact}) {
    Simulator simulator(scene, camera, {.seed = 7, .noise = noise});
    const Frame frame = simulator.frame(3);
    EXPECT_EQ(first_difference(simulator.frame(3, geometry_of(scene, camera, frame)), without_what_geometry_lacks(frame)), "");
    EXPECT_EQ(first_difference(simulator.frame(3), frame), "") << "and the scene is there again";
  }
}

TEST_P(OwnArrays, of_the_light_that_a_scene_sent_give_its_raw_data_and_depth) {
  const Scene scene = still(load_scene(GetParam()));
  const Camera camera = camera_of(scene);
  for (const Noise noise : {Noise::off, Noise::exact}) {
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

INSTANTIATE_TEST_SUITE_P(all, OwnArrays, testing::ValuesIn(scenes_of_one_point_light()),
                         [](const auto& which) { return test_name(which.param); });

TEST(own_arrays, have_the_same_bytes_on_every_machine) {
  const Scene scene = load_scene("demo");
  const Camera camera = load_camera(scene);
  const Frame frame = Simulator(scene, camera).frame(0);
  Geometry seen = geometry_of(scene, camera, frame);
  seen.sun_shadow = seen.shadow;
  PixelLight light = light_of(camera, frame);
  light.ambient_e_per_s.assign(light.power_w.size(), 1e6f);
  Frame geometry_reference, light_reference;
  for (const Isa isa : backend::isas_here) {
    if (!backend::can_run(isa)) continue;
    for (const int threads : {1, 3}) {
      Simulator simulator(scene, camera, {.threads = threads, .backend = Backend::cpu, .isa = isa});
      const Frame from_geometry = simulator.frame(1, seen), from_light = simulator.frame(1, light);
      if (geometry_reference.raw.raw.empty()) geometry_reference = from_geometry, light_reference = from_light;
      EXPECT_EQ(first_difference(from_geometry, geometry_reference), "") << simulator.ran_on().isa << ", " << threads;
      EXPECT_EQ(first_difference(from_light, light_reference), "") << simulator.ran_on().isa << ", " << threads;
    }
  }
}

// Each raw frame takes its own moment, and nothing of another's.
TEST(own_arrays, of_each_raw_frame_are_taken_at_its_own_moment) {
  const Camera camera = pico();
  const auto phases = camera.mode.sequence.size();
  for (const Noise noise : {Noise::off, Noise::exact}) {
    Simulator simulator({}, camera, {.noise = noise});
    Geometry moving = wall(camera, 1, static_cast<int>(phases));
    const std::size_t pixels = moving.z_m.size() / phases;
    for (std::size_t i = 0; i < moving.z_m.size(); ++i) moving.z_m[i] = 1 + 0.1f * static_cast<float>(i / pixels);
    const Frame all = simulator.frame(2, moving);
    for (std::size_t k = 0; k < phases; ++k) {
      const Frame one = simulator.frame(2, wall(camera, 1 + 0.1f * static_cast<float>(k)));
      EXPECT_EQ(image(all.raw.tap_a, pixels, k), image(one.raw.tap_a, pixels, k)) << k;
      EXPECT_EQ(image(all.raw.tap_b, pixels, k), image(one.raw.tap_b, pixels, k)) << k;
      EXPECT_EQ(image(all.raw.raw, pixels, k), image(one.raw.raw, pixels, k)) << k;
      EXPECT_EQ(image(all.truth.signal_e, pixels, k), image(one.truth.signal_e, pixels, k)) << k;
    }
    EXPECT_EQ(all.truth.z_m, wall(camera, 1 + 0.1f * static_cast<float>(phases / 2)).z_m) << "the truth is that of the middle raw frame";
  }
}

TEST(own_arrays, of_each_raw_frame_have_all_lights_at_its_own_moment) {
  Camera camera = pico();
  camera.illumination.push_back(camera.illumination[0]);
  const auto phases = camera.mode.sequence.size();
  Simulator simulator({}, camera);
  PixelLight all;
  std::vector<PixelLight> each;
  for (std::size_t k = 0; k < phases; ++k) {
    PixelLight one = even_light(camera, 1e-13f * static_cast<float>(k + 1), 2);
    const PixelLight second = even_light(camera, 3e-13f, 2 + 0.1f * static_cast<float>(k));
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
    EXPECT_EQ(image(together.raw.tap_a, pixels, k), image(one.raw.tap_a, pixels, k)) << k;
    EXPECT_EQ(image(together.raw.tap_b, pixels, k), image(one.raw.tap_b, pixels, k)) << k;
    EXPECT_EQ(together.truth.power_w == one.truth.power_w, k == phases / 2);
  }
}

// S = P·t·λQE/(hc), ambient electrons as they are given, and depth is half the path: by hand.
TEST(own_arrays, of_light_become_the_electrons_of_the_closed_form) {
  const Camera camera = pico();
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
    EXPECT_NEAR(static_cast<double>(frame.truth.signal_e[k * pixels + at]), exposure.lit ? rate * exposure.integration_time_s : 0,
                1e-5 * expected);
  }
  EXPECT_NEAR(static_cast<double>(frame.depth.range_m[at]), 1.5, 2e-5);
}

// Two paths of one light: two phasors of the same length have the direction of their middle, and the cosine of half their angle as length.
TEST(own_arrays, of_several_paths_add_up_as_phasors) {
  Camera camera = pico();
  camera.decoding.multipath_limit_m = 100;
  camera.illumination.push_back(camera.illumination[0]);
  const Frame once = Simulator({}, pico(), {.noise = Noise::off}).frame(0, even_light(pico(), 2e-12f, 2.5f));
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

// Several paths need no second light source.
TEST(own_arrays, of_several_paths_may_come_from_one_light) {
  Camera camera = pico(), doubled = camera;
  doubled.illumination.push_back(doubled.illumination[0]);
  PixelLight light = even_light(camera, 1e-12f, 2.3f);
  const PixelLight longer = even_light(camera, 3e-13f, 2.7f);
  append(light.power_w, longer.power_w), append(light.path_length_m, longer.path_length_m);
  const Frame two_lights = Simulator({}, doubled).frame(4, light);
  light.light_of_path = {0, 0};
  const Frame one_light = Simulator({}, camera).frame(4, light);
  EXPECT_EQ(first_difference(one_light, two_lights), "");
  // 20 paths in any order
  PixelLight many = light;
  for (int i = 2; i < 20; ++i) append(many.power_w, longer.power_w), append(many.path_length_m, longer.path_length_m);
  many.light_of_path.assign(20, 0);
  PixelLight few = light;
  for (std::size_t i = 38528; i < few.power_w.size(); ++i) few.power_w[i] *= 19;
  const SimulatorOptions quiet{.noise = Noise::off};
  const Frame a = Simulator({}, camera, quiet).frame(0, many), b = Simulator({}, camera, quiet).frame(0, few);
  EXPECT_NEAR(static_cast<double>(a.depth.range_m[9000]), static_cast<double>(b.depth.range_m[9000]), 1e-6);
  EXPECT_NEAR(static_cast<double>(a.depth.amplitude_e[9000] / b.depth.amplitude_e[9000]), 1, 1e-6);
}

// Σ P·e^{imφ} of two paths, summed here in double precision, for every modulation frequency and harmonic, moment by moment.
TEST(own_arrays, of_phasors_are_the_light_of_their_paths) {
  Camera camera = pico();
  camera.illumination[0].waveform.kind = Waveform::Kind::rectangular;
  camera.illumination.push_back(camera.illumination[0]);
  camera.illumination[1].waveform.bandwidth_hz = 150e6;
  camera.pixel.delay_s = 2e-11, camera.refractive_index = 1.0003;
  const std::vector<double> frequencies = {80.32e6, 60.24e6};
  for (const int moments : {1, static_cast<int>(camera.mode.sequence.size())}) {
    PixelLight paths, sums;
    paths.width = sums.width = 224, paths.height = sums.height = 172, paths.moments = sums.moments = moments;
    paths.light_of_path = {0, 1, 0};
    const float power[3] = {1e-12f, 5e-13f, 2e-12f}, length[3] = {2.3f, 2.9f, 3.4f};
    for (int moment = 0; moment < moments; ++moment) {
      for (std::size_t i = 0; i < 3; ++i) {
        paths.power_w.insert(paths.power_w.end(), 38528, power[i]);
        paths.path_length_m.insert(paths.path_length_m.end(), 38528, length[i] + 0.05f * static_cast<float>(moment));
      }
      for (int l = 0; l < 2; ++l) {
        sums.power_w.insert(sums.power_w.end(), 38528, l == 0 ? power[0] + power[2] : power[1]);
        for (const double f : frequencies) {
          for (const int m : {1, 3, 5, 7}) {
            std::complex<double> z = 0;
            for (std::size_t i = 0; i < 3; ++i) {
              if (paths.light_of_path[i] != l) continue;
              const double metres = static_cast<double>(length[i] + 0.05f * static_cast<float>(moment));
              z += static_cast<double>(power[i]) * std::polar(1.0, m * two_pi * f * camera.refractive_index * metres / c);
            }
            sums.phasor_w.insert(sums.phasor_w.end(), 38528, std::complex<float>(z));
          }
        }
      }
    }
    const SimulatorOptions quiet{.noise = Noise::off};
    const Frame a = Simulator({}, camera, quiet).frame(0, paths), b = Simulator({}, camera, quiet).frame(0, sums);
    double most = 0;
    for (std::size_t i = 0; i < a.raw.tap_a.size(); ++i)
      most = std::max(most, std::abs(static_cast<double>(a.raw.tap_a[i] / b.raw.tap_a[i]) - 1));
    EXPECT_LT(most, 2e-6) << moments;
    EXPECT_NEAR(static_cast<double>(a.depth.range_m[5000]), static_cast<double>(b.depth.range_m[5000]), 3e-6);
  }
}

// Who knows fewer orders than the camera has leaves the others out.
TEST(own_arrays, of_phasors_may_end_before_the_camera_s_last_order) {
  Camera camera = pico();
  camera.illumination[0].waveform.kind = Waveform::Kind::rectangular;
  const auto frame = [&](int given, int filled) {
    PixelLight sums;
    sums.width = 224, sums.height = 172, sums.moments = 1;
    sums.power_w.assign(38528, 1e-12f);
    for (int j = 0; j < 2; ++j)
      for (int h = 0; h < given; ++h)
        sums.phasor_w.insert(sums.phasor_w.end(), 38528,
                             h < filled ? std::complex<float>(5e-13f + 1e-13f * static_cast<float>(j), 3e-13f) : 0);
    return Simulator({}, camera, {.noise = Noise::off}).frame(0, sums);
  };
  for (const int given : {1, 2, 3}) EXPECT_EQ(first_difference(frame(given, given), frame(4, given)), "") << given;
  EXPECT_NE(first_difference(frame(1, 1), frame(2, 2)), "");
}

TEST(own_arrays, of_shadows_keep_light_and_sun_away) {
  Scene scene;
  scene.ambient.spectrum = Ambient::Spectrum::sun_am15, scene.ambient.amount = 0.1, scene.ambient.direction = Vec3{0, 0.3, 1};
  const Camera camera = pico();
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
  const Camera left = pico();
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
