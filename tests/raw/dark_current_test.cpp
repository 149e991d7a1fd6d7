// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
// Dark current against temperature: i·2^((T − T_ref)/d).                                                            [theory: dark-current]
#include <gtest/gtest.h>

#include <cmath>

#include "support/bench.h"
#include "tofray/tofray.h"

using namespace tofray;
using namespace tofray::test;

namespace {

constexpr double reference_degrees = 25;

/// 1000 e/s in raw frames of 1 ms that nothing else falls on, at so many degrees.
Camera warm(double celsius, double doubling_k, double dark_current = 1e6) {
  Camera camera = bench_camera();
  camera.pixel.dark_current_e_per_s = dark_current, camera.pixel.dark_current_doubling_k = doubling_k;
  camera.temperature.celsius = celsius, camera.temperature.reference_celsius = reference_degrees;
  return camera;
}

double dark_electrons(const Camera& camera) { return static_cast<double>(Bench(camera).expose({0, 0, 0})[0].a); }

}  // namespace

TEST(dark_current, doubles_with_the_kelvin_it_is_said_to_double_with) {
  for (const double doubling : {5.0, 8.0, 11.3}) {
    for (const double warmer : {-40.0, -8.0, 0.0, 1.0, 8.0, 45.0}) {
      const double expected = 1e3 * std::pow(2.0, warmer / doubling);
      EXPECT_NEAR(dark_electrons(warm(reference_degrees + warmer, doubling)) / expected, 1, 2e-7) << doubling << " " << warmer;  // a float
    }
  }
}

TEST(dark_current, is_the_same_at_all_temperatures_unless_it_is_said_to_double) {
  EXPECT_EQ(Pixel().dark_current_doubling_k, 0);
  for (const double celsius : {-50.0, 25.0, 90.0}) EXPECT_EQ(dark_electrons(warm(celsius, 0)), 1000);
  EXPECT_EQ(dark_electrons(warm(reference_degrees, 8)), 1000);  // and at the reference
}

// V̂ has the electrons of both taps: σ̂² grows by twice the dark electrons over V, and no other number changes.
TEST(dark_current, at_the_temperature_is_in_the_noise_that_depth_says_of_itself) {
  const auto noise_square = [](const Camera& camera) {
    const double noise = static_cast<double>(Bench(camera).measure({20000, 1.0, 0}).depth.noise);
    return noise * noise;
  };
  const double dark = 1e3 * std::pow(2.0, 24.0 / 8), light = 20000 + 1.0 / 12;  // s²/12 of 1 e⁻
  EXPECT_NEAR(noise_square(warm(49, 8)) / noise_square(warm(49, 8, 0)), 1 + 2 * dark / light, 1e-5);
}

// Beyond 1e12 e/s lies no camera, whatever its reference_degrees temperature.
TEST(dark_current, is_refused_where_the_temperature_makes_it_more_than_any_camera_has) {
  const auto load = [](const char* doubling, const char* actual) {
    return load_camera("pico-flexx", {{}, {{"pixel.dark_current_doubling", doubling}, {"temperature.actual", actual}}, {}});
  };
  EXPECT_NO_THROW(load("0.001 K", "-100 degC"));  // colder: none is left
  EXPECT_EQ(dark_electrons(warm(-100, 1e-3)), 0);
  EXPECT_NO_THROW(load("1000 K", "200 degC"));
  EXPECT_NO_THROW(load("6 K", "200 degC"));  // 1000 e/s · 2^29
  try {
    load("5.8 K", "200 degC");  // 1000 e/s · 2^30.2
    FAIL() << "taken";
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find("the dark current is more than any camera has"), std::string::npos) << error.what();
    EXPECT_NE(std::string(error.what()).find("dark_current_doubling"), std::string::npos) << error.what();
  }
}
