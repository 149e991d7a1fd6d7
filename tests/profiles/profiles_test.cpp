// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
// Every built-in camera in each of its modes: what it measures without noise, and with it.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <string>
#include <vector>

#include "camera/readout/image_camera.h"
#include "load/builtin.h"
#include "support/pixels.h"
#include "support/sanitizers.h"

using namespace tofray;
using namespace tofray::test;

namespace {

constexpr double speed_of_light = 299792458.0;

/// Half the path after which all modulation frequencies are back at the phases they began with: c/2 over their greatest common divisor.
double repeats_after(const Mode& mode) {
  long long common = 0;
  for (const RawFrame& raw : mode.sequence)
    if (raw.lit) common = std::gcd(common, std::llround(raw.modulation_frequency_hz));
  return speed_of_light / (2 * static_cast<double>(common));
}

/// A single pixel on the axis.
Camera on_the_axis(Camera camera) {
  camera = camera::ImageCamera(camera);
  camera.sensor.width = camera.sensor.height = 1;
  camera.lens.cx_px = camera.lens.cy_px = 0;
  return camera;
}

/// A camera of the same view with an eighth of the pixels along each side, none of which is taken for flying: that would choose among the
/// errors.
Camera coarse(Camera camera) {
  camera = camera::ImageCamera(camera);
  Lens& lens = camera.lens;
  camera.sensor.width /= 8, camera.sensor.height /= 8;
  lens.fx_px /= 8, lens.fy_px /= 8;
  lens.cx_px = (lens.cx_px + 0.5) / 8 - 0.5, lens.cy_px = (lens.cy_px + 0.5) / 8 - 0.5;
  camera.decoding.flying_near_limit_m = camera.decoding.flying_far_limit_m = 1e3;
  camera.decoding.filter = {};  // over pixels this wide the range of a flat wall bends
  return camera;
}

std::vector<std::string> profiles() {
  std::vector<std::string> names;
  for (const auto& one : load::builtin_profiles()) names.push_back(one.name);
  return names;
}

class EveryCamera : public testing::TestWithParam<std::string> {
 protected:
  std::vector<Camera> in_each_mode() const {
    std::vector<Camera> all;
    for (const std::string& mode : load_camera(GetParam()).mode_names) all.push_back(load_camera(GetParam(), {.mode = mode}));
    return all;
  }
};

// From 0.2 m to 0.98 of where the range begins anew; the nearer the darker, so that nothing clips. What is left is the table of the
// wiggling's inverse, some micrometres; three lights in a row, read as if they were one, 0.02 mm [theory: several-lights]; and single
// precision, 2e-7 of up to 60 m.
TEST_P(EveryCamera, unwraps_its_whole_range_in_each_mode) {
  const int walls = often(50);
  for (const Camera& camera : in_each_mode()) {
    const double first = 0.2, last = 0.98 * repeats_after(camera.mode);
    ASSERT_GT(last, 1) << camera.mode.name;
    for (int i = 0; i < walls; ++i) {
      const double z = first + (last - first) * i / (walls - 1);
      const Frame frame = expected_frame(wall(z, std::min(1.0, 0.1 * z * z)), on_the_axis(camera));
      const double range = static_cast<double>(frame.depth.range_m[0]);
      ASSERT_NEAR(range, z, 1e-3) << camera.mode.name << ", flags " << int{frame.depth.flags[0]};
    }
  }
}

/// Pixels within 30 degrees of the axis: lens and light of every camera reach as far.
std::vector<std::size_t> near_the_axis(const Frame& frame) {
  std::vector<std::size_t> found;
  for (std::size_t i = 0; i < frame.truth.z_m.size(); ++i)
    if (frame.truth.z_m[i] > frame.truth.range_m[i] * 0.866F) found.push_back(i);
  return found;
}

double median(std::vector<double> all) {
  std::nth_element(all.begin(), all.begin() + static_cast<std::ptrdiff_t>(all.size() / 2), all.end());
  return all[all.size() / 2];
}

// Its reference scene: a wall of 80 % at 1 m, which every mode of every camera reaches. At most 5 % of the pixels may be saturated or
// dark, and all numbers of the others are finite. Their errors are as large as they say: half of the absolute values of normal errors lie
// below 0.674 of their standard deviation, where the density is 0.636, so that the median of n has a standard error of 1/(2·0.636·√n).
// Four of them are exceeded by one of 16,000 modes; the seed is fixed. 0.03 is for what a pixel's estimate of its noise is off by in the
// dark (theory 4.4).
TEST_P(EveryCamera, sees_a_white_wall_in_each_mode) {
  for (const Camera& camera : in_each_mode()) {
    const Frame frame = Simulator(wall(1, 0.8), coarse(camera), {.seed = 3, .threads = 1}).frame(0);
    int invalid = 0;
    std::vector<double> errors;
    const std::vector<std::size_t> pixels = near_the_axis(frame);
    ASSERT_GT(pixels.size(), 100U) << camera.mode.name;
    for (const std::size_t i : pixels) {
      constexpr int no_number = flag_saturated | flag_low_signal | flag_no_return | flag_outside_lens;
      if ((frame.depth.flags[i] & no_number) != 0) {
        ++invalid;
        continue;
      }
      ASSERT_TRUE(std::isfinite(frame.depth.range_m[i]) && std::isfinite(frame.depth.noise_m[i]) && frame.depth.noise_m[i] > 0) << i;
      errors.push_back(static_cast<double>(std::abs(frame.depth.range_m[i] - frame.truth.range_m[i]) / frame.depth.noise_m[i]));
    }
    ASSERT_LE(invalid, static_cast<int>(pixels.size()) / 20) << camera.mode.name;
    EXPECT_NEAR(median(errors), 0.674, 4 * 0.786 / std::sqrt(static_cast<double>(errors.size())) + 0.03) << camera.mode.name;
  }
}

INSTANTIATE_TEST_SUITE_P(all, EveryCamera, testing::ValuesIn(profiles()), [](const auto& one) {
  std::string name = one.param;
  std::replace(name.begin(), name.end(), '-', '_');
  return name;
});

}  // namespace

TEST(built_in_cameras, are_these) {
  EXPECT_EQ(profiles(), (std::vector<std::string>{"adtf3175", "azure-kinect-nfov-binned", "azure-kinect-nfov", "azure-kinect-wfov-binned",
                                                  "azure-kinect-wfov", "custom", "flexx2", "imx556", "kinect-v2", "o3d303-binned", "o3d303",
                                                  "opt8241", "pico-flexx", "pico-monstar"}));
  for (const auto& one : load::builtin_profiles()) {
    EXPECT_EQ(load_camera(one.name).name, one.name);
    EXPECT_GT(one.description.size(), 20U) << one.name;
  }
}

// Light was fitted to published noise in a mode with its own exposure: a wall of that reflectivity, in the dark, a pixel on the axis.
// At these points the fit leaves less than 15 %, as the page of the cameras says; with an exposure or a light that was not the
// fitted one it is more.
TEST(built_in_cameras, have_the_published_noise_that_their_light_was_fitted_to) {
  struct Published {
    const char* camera;
    const char* mode;
    double distance_m, reflectivity, noise_mm;
  };
  for (const Published& one : {Published{"flexx2", "MODE_9_5FPS", 2, 0.8, 3.29}, Published{"flexx2", "MODE_9_5FPS", 3, 0.8, 6.02},
                               Published{"o3d303", "under5m_low", 1.268, 0.8, 8.7}, Published{"o3d303", "under5m_low", 2.288, 0.8, 20.8},
                               Published{"o3d303", "under5m_low", 1.73, 0.8, 21.2}, Published{"adtf3175", "LR_NATIVE", 4, 0.15, 15},
                               Published{"azure-kinect-nfov", "DEPTH_30FPS", 3.86, 0.15, 17},
                               Published{"azure-kinect-wfov-binned", "DEPTH_30FPS", 2.88, 0.15, 17}}) {
    const Camera camera = load_camera(one.camera, {.mode = one.mode});
    const Frame frame = expected_frame(wall(one.distance_m, one.reflectivity), on_the_axis(camera));
    EXPECT_NEAR(1e3 * static_cast<double>(frame.depth.noise_m[0]), one.noise_mm, 0.15 * one.noise_mm)
        << one.camera << ", " << one.distance_m;
  }
}

namespace {

/// What the middle of the sensor measures of a wall: the standard deviation of z, as it is and in whole millimetres, and the amplitude.
struct Spread {
  double z_mm, whole_mm, amplitude_e;
};

Spread spread_of(Camera camera, double distance_m, double reflectivity) {
  camera.sensor.width = camera.sensor.height = 64;
  camera.lens.cx_px = camera.lens.cy_px = 31.5;
  camera.decoding.flying_check = false;
  const Frame frame = Simulator(wall(distance_m, reflectivity), camera, {.seed = 5, .threads = 1}).frame(0);
  const auto count = static_cast<double>(frame.depth.z_m.size());
  double of_z = 0, of_whole = 0, amplitude = 0;
  for (std::size_t i = 0; i < frame.depth.z_m.size(); ++i) {
    const double z = 1e3 * static_cast<double>(frame.depth.z_m[i]), truth = 1e3 * static_cast<double>(frame.truth.z_m[i]);
    of_z += (z - truth) * (z - truth), of_whole += (std::round(z) - truth) * (std::round(z) - truth);
    amplitude += static_cast<double>(frame.depth.amplitude_e[i]);
  }
  return {std::sqrt(of_z / count), std::sqrt(of_whole / count), amplitude / count};
}

}  // namespace

// The shape of noise that was measured on an Azure Kinect's frame, against the infrared picture's brightness: noise·√brightness is flat
// within 20 % over a factor of 19, rises below that, and whole millimetres put a floor of 1/√12 mm below all of it. Here the factor of 19
// begins at 200 electrons of amplitude, and 4096 pixels know their standard deviation to 1.1 %.
TEST(built_in_cameras, the_azure_kinect_has_the_three_regimes_of_measured_noise) {
  const Camera camera = load_camera("azure-kinect-nfov");
  double least = 1e9, most = 0;
  for (const double reflectivity : {0.05, 0.1, 0.2, 0.4, 0.6, 0.95}) {
    const Spread bright = spread_of(camera, 1, reflectivity);
    ASSERT_GT(bright.amplitude_e, 190) << reflectivity;
    const double product = bright.z_mm * std::sqrt(bright.amplitude_e);
    least = std::min(least, product), most = std::max(most, product);
  }
  EXPECT_LT(most, 1.2 * least) << "shot noise alone";
  double before = most;
  for (const double reflectivity : {0.02, 0.014}) {
    const Spread dim = spread_of(camera, 1, reflectivity);
    const double product = dim.z_mm * std::sqrt(dim.amplitude_e);
    EXPECT_GT(product, 1.05 * before) << dim.amplitude_e << " electrons: the read noise of the taps";
    before = product;
  }
  // A quarter of a millimetre off a whole one, where rounding neither adds nor takes variance beside its 1/12.
  const Spread brightest = spread_of(load_camera("azure-kinect-nfov-binned"), 0.50025, 0.5);
  EXPECT_LT(brightest.z_mm, 0.6);
  EXPECT_NEAR(brightest.whole_mm, std::hypot(brightest.z_mm, std::sqrt(1.0 / 12)), 0.03 * brightest.whole_mm);
}

// What binning means: four pixels' area and electrons, the same view; half the focal length in pixels, centres halfway between.
TEST(built_in_cameras, that_are_binned_are_the_others_two_by_two) {
  for (const std::string field : {"nfov", "wfov"}) {
    const Camera fine = load_camera("azure-kinect-" + field), binned = load_camera("azure-kinect-" + field + "-binned");
    EXPECT_EQ(fine.sensor.width, 2 * binned.sensor.width);
    EXPECT_EQ(fine.sensor.height, 2 * binned.sensor.height);
    EXPECT_NEAR(2 * fine.sensor.pixel_pitch_m, binned.sensor.pixel_pitch_m, 1e-12);
    EXPECT_NEAR(fine.lens.fx_px, 2 * binned.lens.fx_px, 0.02);  // two decimals in the files
    EXPECT_NEAR(fine.lens.fy_px, 2 * binned.lens.fy_px, 0.02);
    EXPECT_NEAR(fine.lens.cx_px + 0.5, 2 * (binned.lens.cx_px + 0.5), 0.02);
    EXPECT_NEAR(fine.lens.cy_px + 0.5, 2 * (binned.lens.cy_px + 0.5), 0.02);
    EXPECT_EQ(2 * fine.pixel.read_noise_e, binned.pixel.read_noise_e);
    EXPECT_EQ(4 * fine.pixel.full_well_e, binned.pixel.full_well_e);
    EXPECT_EQ(4 * fine.pixel.dark_current_e_per_s, binned.pixel.dark_current_e_per_s);
    EXPECT_EQ(fine.illumination[0].power_w, binned.illumination[0].power_w);
  }
  const Lens narrow = load_camera("azure-kinect-nfov").lens, wide = load_camera("azure-kinect-wfov").lens;
  EXPECT_EQ(narrow.fx_px, wide.fx_px);
  EXPECT_NEAR(wide.cx_px - narrow.cx_px, 192, 1e-9);  // the narrow field is a part of the sensor
  EXPECT_NEAR(wide.cy_px - narrow.cy_px, 180, 1e-9);
}
