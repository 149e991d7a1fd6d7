// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
// What the camera says of its noise against how its ranges scatter, for each camera that comes along, over the wave: harmonics bend the
// amplitude as they bend the phase.
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "support/sanitizers.h"
#include "support/statistics.h"
#include "tofray/tofray.h"

using namespace tofray;
using namespace tofray::test;

namespace {

constexpr int middle_side = 32;

/// 32 × 32 pixels about the middle, and all that they measure.
Camera of_the_middle(Camera camera) {
  camera.readout = {1, camera.sensor.width / 2 - middle_side / 2, camera.sensor.height / 2 - middle_side / 2, middle_side, middle_side};
  camera.lens.scatter = {}, camera.pixel.crosstalk_left_right = camera.pixel.crosstalk_up_down = 0, camera.interference = {};
  camera.auto_exposure = {};
  Decoding& d = camera.decoding;
  d.noise_threshold_m = 1e3, d.amplitude_threshold_e = 0, d.flying_check = false, d.filter = {}, d.temporal_frames = 1;
  d.asymmetry_reject = d.multipath_reject = false;
  return camera;
}

/// How much more ranges scatter than the camera says they do, of a wall of 50 % at z; 0 where it is too noisy or too bright to say.
double scatter_over_said(const Camera& camera, double z) {
  Scene scene;
  scene.materials.push_back({"grey", Material::Brdf::lambert, 0.5, 0, 1});
  scene.objects.push_back({});
  scene.objects[0].shape = Plane{{0, 0, z}, {0, 0, -1}};
  const Depth expected = Simulator(scene, camera, {.noise = Noise::off}).frame(0).depth;
  double said = 0;
  for (std::size_t i = 0; i < expected.noise_m.size(); ++i) {
    if ((expected.flags[i] & flags_invalid) != 0) return 0;
    said += std::pow(static_cast<double>(expected.noise_m[i]), 2) / (middle_side * middle_side);
  }
  if (std::sqrt(said) > 0.03 * z || std::sqrt(said) > 0.05) return 0;
  Simulator noisy(scene, camera, {.seed = 5, .truth = false});
  const int frames = with_sanitizers ? 3 : 8;
  std::vector<Moments> range(middle_side * middle_side, Moments(z));
  Frame frame;
  for (int n = 0; n < frames; ++n) {
    noisy.frame(static_cast<std::uint64_t>(n), frame);
    for (std::size_t i = 0; i < range.size(); ++i) range[i].add(static_cast<double>(frame.depth.range_m[i]));
  }
  double variance = 0;
  for (const Moments& one : range) variance += one.variance() / (middle_side * middle_side);
  return std::sqrt(variance / said);
}

}  // namespace

// 1024 pixels, 8 frames: a deviation is known to 1/√(2·7168), 0.8 %. The mean of both taps' charge changes little over the wave.
TEST(noise_m, is_how_ranges_scatter_whatever_the_waveform) {
  int compared = 0;
  for (const char* const name : {"pico-flexx", "flexx2", "pico-monstar", "imx556", "kinect-v2", "azure-kinect-nfov", "azure-kinect-wfov",
                                 "o3d303", "opt8241", "adtf3175", "custom"}) {
    const Camera camera = of_the_middle(load_camera(name));
    for (const double z : {0.6, 0.71, 0.83, 0.94, 1.07}) {
      const double ratio = scatter_over_said(camera, z);
      if (ratio == 0) continue;
      EXPECT_NEAR(ratio, 1, with_sanitizers ? 0.08 : 0.035) << name << " at " << z;
      ++compared;
    }
  }
  EXPECT_GT(compared, 30);
}

// A square wave of one frequency, of four harmonics: |g| swings from 1.17 to 0.87, and what is said of the noise would with it.
TEST(noise_m, of_a_square_wave_is_as_large_as_ranges_scatter) {
  CameraOptions mode;
  mode.mode = "MODE_5_35FPS_600";
  Camera camera = of_the_middle(load_camera("pico-flexx", mode));
  for (Illumination& one : camera.illumination) one.waveform.duty = 0.5, one.waveform.rise_time_s = 0, one.waveform.bandwidth_hz = 0;
  camera.pixel.bandwidth_hz = 0, camera.pixel.read_noise_e = 5;
  camera.illumination[0].power_w *= 4;
  for (int i = 0; i < 8; ++i) {
    const double z = 0.9 + 0.06 * i;
    const double ratio = scatter_over_said(camera, z);
    ASSERT_GT(ratio, 0) << z;
    EXPECT_NEAR(ratio, 1, with_sanitizers ? 0.08 : 0.03) << z;
  }
}
