// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
// Of several modulation frequencies, confidence says how likely the cycle is that was chosen.   [theory: confidence, cycle-likelihood]
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <vector>

#include "tofray/tofray.h"

using namespace tofray;

namespace {

constexpr double limit = 2;  // [m] of noise at which confidence is 0: far above all of it here

struct Judged {
  double said = 0, right = 0;  // means over the pixels
};

/// Pixels about the middle before a wall in the sun.
Judged judge(double z, double reflectivity, double klx) {
  Camera camera = load_camera("pico-flexx");
  camera.readout = {1, 80, 54, 64, 64};
  camera.decoding.noise_threshold_m = limit, camera.decoding.flying_check = false, camera.decoding.filter = {};
  Scene scene;
  scene.materials.push_back({"grey", Material::Brdf::lambert, reflectivity, 0, 1});
  scene.objects.push_back({});
  scene.objects[0].shape = Plane{{0, 0, z}, {0, 0, -1}};
  if (klx > 0) scene.ambient = {Ambient::Spectrum::sun_am15, Ambient::Quantity::illuminance_lx, 1e3 * klx, {}, {}, {}};
  const Frame frame = Simulator(scene, camera, {.seed = 3}).frame(0);
  Judged out;
  double count = 0;
  for (std::size_t i = 0; i < frame.depth.range_m.size(); ++i) {
    if ((frame.depth.flags[i] & flags_invalid) != 0) continue;
    const double noise = static_cast<double>(frame.depth.noise_m[i]),
                 off = static_cast<double>(frame.depth.range_m[i] - frame.truth.range_m[i]);
    out.said += frame.depth.confidence[i] / (255 * (1 - noise / limit)), out.right += std::abs(off) < 0.9 ? 1 : 0, ++count;
  }
  EXPECT_GT(count, 200);
  out.said /= count, out.right /= count;
  return out;
}

}  // namespace

// 4096 pixels: the share is known to 0.8 %. Phases that spread by 0.7 rad and more are no longer Gaussian, and σ̂ is too low there (theory 4.4):
// p is too sure of them.
TEST(confidence, is_how_likely_the_cycle_is) {
  const std::vector<std::array<double, 3>> cases = {{1.5, 0.1, 50}, {1.0, 0.05, 50}, {1.2, 0.1, 50}, {1.5, 0.2, 50}, {2.0, 0.4, 10}};
  int unsure = 0;
  for (const auto& [z, reflectivity, klx] : cases) {
    const Judged judged = judge(z, reflectivity, klx);
    EXPECT_NEAR(judged.said, judged.right, 0.06) << z << " m, " << reflectivity << ", " << klx << " klx: " << judged.right;
    unsure += judged.right > 0.6 && judged.right < 0.97 ? 1 : 0;
  }
  EXPECT_GE(unsure, 3);
  const Judged weak = judge(2.5, 0.1, 50);
  EXPECT_LT(weak.right, 0.5);
  EXPECT_LT(weak.said, 0.6);
  EXPECT_GT(judge(1, 0.8, 0).said, 0.999);
}

// Wrong cycles agree with each other, and no noise says that they are wrong: of valid pixels 10.3, 5.4 and 2.8 % were off by more than 4 σ̂.
TEST(confidence, keeps_wrong_cycles_out_of_an_adaptive_filter) {
  for (const char* const mode : {"MODE_9_25FPS_450", "MODE_9_15FPS_700", "MODE_9_10FPS_1000"}) {
    const Camera camera = load_camera("pico-flexx", {.mode = mode});
    ASSERT_EQ(camera.decoding.filter.kind, ImageFilter::Kind::adaptive);
    const Frame frame = Simulator(load_scene("room"), camera, {.seed = 1}).frame(0);
    double valid = 0, wrong = 0;
    for (std::size_t i = 0; i < frame.depth.range_m.size(); ++i) {
      if ((frame.depth.flags[i] & flags_invalid) != 0) continue;
      ++valid, wrong += std::abs(frame.depth.range_m[i] - frame.truth.range_m[i]) > 4 * frame.depth.noise_m[i] ? 1 : 0;
    }
    EXPECT_GT(valid, 0.4 * static_cast<double>(frame.depth.range_m.size())) << mode;
    EXPECT_LT(wrong, 0.015 * valid) << mode;
  }
}
