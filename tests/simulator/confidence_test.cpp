// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
// Of several modulation frequencies, confidence says how likely the cycle is that was chosen.                 [theory: eq. 4.10, 4.31]
#include <gtest/gtest.h>

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
Judged judge(double z, double reflectivity, double klx, const ImageFilter& filter = {}) {
  Camera camera = load_camera("pico-flexx");
  camera.readout = {1, 80, 54, 64, 64};
  camera.decoding.noise_threshold_m = limit, camera.decoding.flying_check = false, camera.decoding.filter = filter;
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

// 4096 pixels: the share is known to 0.8 %. σ̂ of weak signals is a little low (theory 4.4), and p with it a little too sure.
TEST(confidence, is_how_likely_the_cycle_is) {
  for (const auto& [z, reflectivity, klx] :
       {std::tuple{2.5, 0.10, 50.0}, {2.5, 0.2, 20.0}, {1.5, 0.1, 50.0}, {3.0, 0.3, 50.0}, {2.0, 0.8, 0.0}}) {
    const Judged judged = judge(z, reflectivity, klx);
    EXPECT_NEAR(judged.said, judged.right, 0.06) << z << " m, " << reflectivity << ", " << klx << " klx: " << judged.right;
  }
  EXPECT_LT(judge(2.5, 0.1, 50).right, 0.75) << "cycles are wrong there";
  EXPECT_GT(judge(1, 0.8, 0).said, 0.999);
}

// What an adaptive filter leaves valid is right as often as 0.9 at least: wrong cycles that agree with each other were not taken.
TEST(confidence, keeps_wrong_cycles_out_of_an_adaptive_filter) {
  const ImageFilter filter{.kind = ImageFilter::Kind::adaptive, .radius_px = 2, .goal_m = 0.07};
  const Judged filtered = judge(2.5, 0.2, 20, filter);
  EXPECT_GT(filtered.right, 0.97);
}
