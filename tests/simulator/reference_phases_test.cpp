// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
// 3, 4, 5, 6 and 8 reference phases through the whole simulator: what harmonics do to the range of a square light.
//                                                                                                  [theory: wiggling, wiggling-correction]
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <vector>

#include "support/pixels.h"

using namespace tofray;
using namespace tofray::test;

namespace {

constexpr double modulation = 60.24e6, speed_of_light = 299792458.0;
constexpr int paths = 4096;

/// A row of pixels; half duty against the square gate: a triangle, of which harmonics 1 to 15 are kept.
Camera square_by_square(int phases) {
  Camera camera = lit_camera(paths, 1);
  Waveform& waveform = camera.illumination[0].waveform;
  waveform = {};
  waveform.harmonics = 8;
  camera.decoding.wiggling_correction = false, camera.decoding.noise_threshold_m = 1e3;
  camera.mode.sequence.clear();
  for (int k = 0; k < phases; ++k) camera.mode.sequence.push_back({true, modulation, two_pi * k / phases, 1e-3});
  return camera;
}

/// Half a path for each pixel, over one period and no path at 0.
double half_path(int i) { return speed_of_light / (2 * modulation) * (i + 0.5) / paths; }

/// The error that N phases make of a_m = 8/(πm)², m up to `highest`, from the sum over raw frames.
double expected_error(int phases, double phi, int highest) {
  std::complex<double> z{0, 0};
  for (int k = 0; k < phases; ++k) {
    double difference = 0;
    for (int m = 1; m <= highest; m += 2) difference += 8 / (pi * pi * m * m) * std::cos(m * (phi + two_pi * k / phases));
    z += difference * std::polar(1.0, -two_pi * k / phases - phi);
  }
  return std::arg(z);
}

}  // namespace

// Largest error: .019495, .071115, .004058, .019495, .008018 rad of the whole triangle; without the harmonics beyond 15 those below, which the
// closed form gives. A phase in single precision: 2e-6 rad. Each error is taken for the range of one pixel.
TEST(reference_phases, wiggle_as_the_closed_form_says) {
  const struct {
    int phases;
    double largest, whole;
  } known[] = {{3, .020155, .019495}, {4, .071358, .071115}, {5, .004082, .004058}, {6, .020155, .019495}, {8, .010680, .008018}};
  for (const auto& [phases, largest, whole] : known) {
    const Camera camera = square_by_square(phases);
    PixelLight light;
    light.width = paths, light.height = 1;
    light.power_w.assign(paths, 1e-12f);
    for (int i = 0; i < paths; ++i) light.path_length_m.push_back(static_cast<float>(2 * half_path(i)));
    const Frame frame = Simulator({}, camera, {.noise = Noise::off, .threads = 1}).frame(0, light);
    double worst = 0;
    for (int i = 0; i < paths; ++i) {
      const double phi = 4 * pi * modulation / speed_of_light * half_path(i);
      double error = 4 * pi * modulation / speed_of_light * static_cast<double>(frame.depth.range_m[static_cast<std::size_t>(i)]) - phi;
      error -= two_pi * std::round(error / two_pi);
      ASSERT_NEAR(error, expected_error(phases, phi, 15), 5e-6) << phases << " " << i;
      worst = std::max(worst, std::abs(error));
    }
    EXPECT_NEAR(worst, largest, 1e-5) << phases;
    double of_all = 0;
    for (int i = 0; i < 400; ++i) of_all = std::max(of_all, std::abs(expected_error(phases, two_pi * (i + 0.5) / 400, 1999)));
    EXPECT_NEAR(of_all, whole, 2e-5) << phases;
  }
}

// With the table the same raw frames give the true range.
TEST(reference_phases, wiggle_no_more_with_the_table) {
  for (const int phases : {3, 4, 5, 6, 8}) {
    Camera camera = square_by_square(phases);
    camera.decoding.wiggling_correction = true;
    PixelLight light;
    light.width = paths, light.height = 1;
    light.power_w.assign(paths, 1e-12f);
    for (int i = 0; i < paths; ++i) light.path_length_m.push_back(static_cast<float>(2 * half_path(i)));
    const Frame frame = Simulator({}, camera, {.noise = Noise::off, .threads = 1}).frame(0, light);
    for (int i = 8; i < paths - 8; ++i)  // what wraps around the ends is elsewhere
      ASSERT_NEAR(static_cast<double>(frame.depth.range_m[static_cast<std::size_t>(i)]), half_path(i), 1e-5) << phases << " " << i;
  }
}
