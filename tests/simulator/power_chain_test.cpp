// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
// From the light source to electrons through the whole simulator.
#include <gtest/gtest.h>

#include <fstream>

#include "support/pixels.h"
#include "support/random.h"

using namespace tofray;
using namespace tofray::test;

namespace {

double value(const std::vector<float>& array, std::size_t i = 0) { return static_cast<double>(array.at(i)); }

}  // namespace

// From first principles, and as literal numbers: about ten roundings on the way from the frozen constants to electrons.
TEST(power_chain, one_watt_per_steradian_on_a_white_wall_at_one_metre) {
  const double radiance = 1 / pi, irradiance = pi * radiance / (4 * 0.9 * 0.9), watts = irradiance * 17.5e-6 * 17.5e-6;
  const double electrons = watts * 1e-3 * 850e-9 * 0.4 / (6.62607015e-34 * 299792458.0);
  ASSERT_NEAR(watts, 9.452160494e-11, 1e-9 * watts);
  ASSERT_NEAR(electrons, 161783.144, 1e-8 * electrons);
  const Truth t = truth(wall(1), lit_camera());
  EXPECT_NEAR(value(t.irradiance_w_m2), 1, roundings(4));
  EXPECT_NEAR(value(t.radiance_w_m2_sr), radiance, radiance * roundings(6));
  EXPECT_NEAR(value(t.power_w), watts, watts * roundings(8));
  EXPECT_NEAR(value(t.signal_e), electrons, electrons * roundings(10));
}

// Irradiance on the sensor has no focal length in it, only the F-number; area, fill factor, T, time, QE and wavelength are factors.
TEST(power_chain, has_each_factor_once) {
  const Scene scene = wall(1, 0.5);
  const double before = value(truth(scene, lit_camera()).signal_e);
  const auto ratio = [&](const auto& change) {
    Camera camera = lit_camera();
    change(camera);
    return value(truth(scene, camera).signal_e) / before;
  };
  const double tolerance = roundings(16);
  EXPECT_NEAR(ratio([](Camera& c) { c.lens.fx_px = c.lens.fy_px = 1000; }), 1, tolerance);
  EXPECT_NEAR(ratio([](Camera& c) { c.lens.f_number = 1.8; }), 0.25, tolerance);
  EXPECT_NEAR(ratio([](Camera& c) { c.lens.transmission = 0.7; }), 0.7, tolerance);
  EXPECT_NEAR(ratio([](Camera& c) { c.sensor.pixel_pitch_m *= 2; }), 4, 4 * tolerance);
  EXPECT_NEAR(ratio([](Camera& c) { c.sensor.fill_factor = 0.3; }), 0.3, tolerance);
  EXPECT_NEAR(ratio([](Camera& c) {
                for (RawFrame& f : c.mode.sequence) f.integration_time_s *= 3;
              }),
              3, 3 * tolerance);
  EXPECT_NEAR(ratio([](Camera& c) { c.pixel.quantum_efficiency.y[0] = 0.1; }), 0.25, tolerance);
  EXPECT_NEAR(ratio([](Camera& c) { c.illumination[0].illumination_wavelength_m = 940e-9; }), 940.0 / 850, tolerance * 2);
  EXPECT_NEAR(ratio([](Camera& c) { c.illumination[0].power_w *= 5; }), 5, 5 * tolerance);
}

TEST(power_chain, unlit_raw_frames_get_none_of_the_cameras_own_light) {
  Camera camera = lit_camera();
  camera.mode.sequence.insert(camera.mode.sequence.begin(), RawFrame{false, 0, 0, 1e-3});
  const Truth t = truth(wall(1), camera);
  EXPECT_EQ(t.signal_e[0], 0);
  EXPECT_GT(t.signal_e[1], 0);
}

TEST(power_chain, falls_with_the_square_of_the_distance_from_ten_centimetres_to_a_hundred_metres) {
  double sum_x = 0, sum_y = 0, sum_xx = 0, sum_xy = 0;
  const int steps = 61;
  for (int i = 0; i < steps; ++i) {
    const double z = std::pow(10, -1 + 3.0 * i / (steps - 1));
    const double irradiance = value(truth(wall(z), lit_camera()).irradiance_w_m2);
    EXPECT_NEAR(irradiance * z * z, 1, 1e-6) << z;
    const double x = std::log(z), y = std::log(irradiance);
    sum_x += x, sum_y += y, sum_xx += x * x, sum_xy += x * y;
  }
  EXPECT_NEAR((steps * sum_xy - sum_x * sum_y) / (steps * sum_xx - sum_x * sum_x), -2, 1e-6);
}

// The wall turns about the point on the axis; light and camera stay.
TEST(power_chain, follows_the_cosine_law) {
  const double facing = value(truth(wall(2), lit_camera()).irradiance_w_m2);
  for (int degrees = 0; degrees < 90; ++degrees) {
    const double angle = degrees * pi / 180;
    Scene scene = wall(2);
    scene.objects[0].shape = Plane{{0, 0, 2}, {0.6 * std::sin(angle), 0.8 * std::sin(angle), -std::cos(angle)}};
    EXPECT_NEAR(value(truth(scene, lit_camera()).irradiance_w_m2) / facing, std::cos(angle), 1e-6) << degrees;
  }
}

// The light goes round the point that the camera sees; from behind the wall it gives nothing.
TEST(power_chain, lights_a_surface_from_the_cameras_side_only) {
  for (int degrees = -175; degrees <= 180; degrees += 5) {
    const double angle = degrees * pi / 180;
    Camera camera = lit_camera();
    Illumination& light = camera.illumination[0];
    light.position = {std::sin(angle), 0, 2 - std::cos(angle)};
    light.axis = {-std::sin(angle), 0, std::cos(angle)};
    const double expected = std::fabs(degrees) < 90 ? std::cos(angle) : 0;
    EXPECT_NEAR(value(truth(wall(2), camera).irradiance_w_m2), expected, 1e-6) << degrees;
  }
}

// One scene and camera, written in other units.
TEST(power_chain, does_not_depend_on_the_units_in_the_file) {
  const auto signal = [](const std::string& length, const std::string& power, const std::string& time) {
    const std::string path = std::string(TOFRAY_BINARY_DIR) + "/units_test.yaml";
    std::ofstream(path) << "camera: {profile: pico-flexx, integration_time: " << time << "}\n"
                        << "objects:\n  - plane: {point: [0 m, 0 m, " << length << "], normal: [0, 0, -1], reflectivity: 0.5}\n";
    const Scene scene = load_scene(path);
    return truth(scene, load_camera(scene, {{}, {{"illumination.0.power", power}}, {}})).signal_e;
  };
  const std::vector<float> si = signal("1.5 m", "0.3 W", "0.001 s");
  for (const std::vector<float>& other : {signal("1500 mm", "300 mW", "1 ms"), signal("150 cm", "0.3 W", "1000 us")}) {
    ASSERT_EQ(other.size(), si.size());
    for (std::size_t i = 0; i < si.size(); ++i) ASSERT_NEAR(value(other, i), value(si, i), 1e-6 * value(si, i));
  }
  EXPECT_GT(value(si, si.size() / 2), 100);
}

// A view of 62 x 45 degrees, seen at its corners and edges.
TEST(power_chain, vignetting_is_the_fourth_power_of_the_cosine) {
  Camera camera = lit_camera(3, 3);
  camera.lens.fx_px = 1 / std::tan(31 * pi / 180), camera.lens.fy_px = 1 / std::tan(22.5 * pi / 180);
  const Truth t = truth(wall(1), camera);
  const double full = (17.5e-6 * 17.5e-6) * pi / (4 * 0.9 * 0.9);
  const double corner = 0.425734410, side = 0.539836668, top = 0.728553391;
  const double expected[9] = {corner, top, corner, side, 1, side, corner, top, corner};
  for (std::size_t i = 0; i < 9; ++i) {
    EXPECT_NEAR(value(t.power_w, i) / (value(t.radiance_w_m2_sr, i) * full), expected[i], 1e-6) << i;
  }
}

TEST(power_chain, vignetting_can_be_switched_off_or_given_by_a_table) {
  Camera camera = lit_camera(3, 3, 1);
  camera.lens.vignetting = Lens::Vignetting::off;
  const Truth off = truth(wall(1), camera);
  camera.lens.vignetting = Lens::Vignetting::table;
  camera.lens.vignetting_table = {{0, pi / 4, 1.2}, {0.9, 0.6, 0.1}};  // the pixels beside the middle one look 45 degrees aside
  const Truth table = truth(wall(1), camera);
  const double full = (17.5e-6 * 17.5e-6) * pi / (4 * 0.9 * 0.9);
  const auto factor = [&](const Truth& t, std::size_t i) { return value(t.power_w, i) / (value(t.radiance_w_m2_sr, i) * full); };
  for (const std::size_t i : {0, 1, 4, 8}) EXPECT_NEAR(factor(off, i), 1, roundings(6)) << i;
  EXPECT_NEAR(factor(table, 4), 0.9, 1e-6);
  for (const std::size_t i : {1, 3, 5, 7}) EXPECT_NEAR(factor(table, i), 0.6, 1e-6) << i;
}

// E_s = I·cos/r², ℓ and r from the light's own place: a wall seen and lit at slant, each pixel by itself.
TEST(power_chain, each_pixel_gets_what_the_closed_form_says) {
  Camera camera = lit_camera(21, 15, 12);
  camera.illumination[0].position = {0.3, -0.2, 0.1};
  camera.illumination[0].axis = {-0.1, 0.2, 1};
  camera.illumination[0].pattern = {};  // Lambertian: I = P·cos/π
  camera.illumination[0].power_w = 2;
  Scene scene = wall(1.5, 0.7);
  const Vec3 n = base::normalized({0.2, -0.3, -1});
  scene.objects[0].shape = Plane{{0, 0, 1.5}, n};
  const Truth t = truth(scene, camera);
  const Vec3 axis = base::normalized(camera.illumination[0].axis);
  for (std::size_t i = 0; i < t.range_m.size(); ++i) {
    const Vec3 d{(static_cast<double>(i % 21) - 10) / 12, (std::floor(static_cast<double>(i) / 21) - 7) / 12, 1};
    const double depth = 1.5 * n[2] / base::dot(n, d);
    ASSERT_GT(depth, 0);
    const Vec3 p = depth * d, l = camera.illumination[0].position - p;
    const double r = base::length(l), cosine = base::dot(n, l) / r, lobe = -base::dot(axis, l) / r;
    const double irradiance = 2 * lobe / pi * cosine / (r * r);
    ASSERT_GT(lobe, 0.1);
    ASSERT_GT(cosine, 0.1);
    EXPECT_NEAR(value(t.irradiance_w_m2, i), irradiance, 1e-5 * irradiance) << i;  // the lobe goes through log2 and exp2
    EXPECT_NEAR(value(t.radiance_w_m2_sr, i), 0.7 / pi * irradiance, 1e-5 * irradiance) << i;
  }
}

// A lamp that touches its wall lights it with 1e12 W/m², not without end.
TEST(power_chain, ends_at_an_irradiance_that_nothing_stands) {
  Camera camera = lit_camera();
  camera.illumination[0].position = {0, 0, 1 - 0x1p-22};
  const Truth held = truth(wall(1, 0.8), camera);
  EXPECT_NEAR(static_cast<double>(held.radiance_w_m2_sr[0]) / (0.8 / pi * 1e12), 1, 1e-6);
  camera.illumination[0].position = {0, 0, 1 - 0x1p-19};  // E = I/d² = 2.7e11 W/m²
  EXPECT_NEAR(static_cast<double>(truth(wall(1, 0.8), camera).radiance_w_m2_sr[0]) / (0.8 / pi * 0x1p38), 1, 1e-6);
}
