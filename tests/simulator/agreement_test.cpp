// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
// Depth against ground truth without noise, on every scene that comes with tofray.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "support/files.h"
#include "support/scenes.h"
#include "tofray/tofray.h"

using namespace tofray;
using namespace tofray::test;

namespace {

struct Agreement {
  double worst_range = 0, worst_z = 0;  ///< [m]
  int compared = 0, seen = 0;           ///< pixels with a valid depth among those that one surface fills
};

/// Whether a pixel's eight neighbours see the same object.
bool one_surface(const Truth& t, int x, int y) {
  for (int dy = -1; dy <= 1; ++dy) {
    for (int dx = -1; dx <= 1; ++dx) {
      const int u = std::clamp(x + dx, 0, t.width - 1), v = std::clamp(y + dy, 0, t.height - 1);
      if (t.object_id[static_cast<std::size_t>(v * t.width + u)] != t.object_id[static_cast<std::size_t>(y * t.width + x)]) return false;
    }
  }
  return t.object_id[static_cast<std::size_t>(y * t.width + x)] >= 0;
}

Agreement compare(const std::string& name, Waveform::Kind kind) {
  Scene scene = load_scene(name);
  for (Object& object : scene.objects) object.velocity_m_per_s = {0, 0, 0};  // one place in all raw frames
  Camera camera = load_camera(scene);
  for (Illumination& light : camera.illumination) light.waveform.kind = kind;
  camera.lens.scatter = {}, camera.decoding.filter = {};  // each pixel its own light alone, and its own range
  const Frame frame = Simulator(scene, camera, {.noise = Noise::off}).frame(0);
  Agreement out;
  for (int y = 0; y < frame.truth.height; ++y) {
    for (int x = 0; x < frame.truth.width; ++x) {
      const std::size_t i = static_cast<std::size_t>(y * frame.truth.width + x);
      if (!one_surface(frame.truth, x, y)) continue;
      ++out.seen;
      if ((frame.depth.flags[i] & flags_invalid) != 0) continue;
      ++out.compared;
      out.worst_range = std::max(out.worst_range, std::abs(static_cast<double>(frame.depth.range_m[i] - frame.truth.range_m[i])));
      out.worst_z = std::max(out.worst_z, std::abs(static_cast<double>(frame.depth.z_m[i] - frame.truth.z_m[i])));
    }
  }
  return out;
}

class Scenes : public testing::TestWithParam<std::string> {};

}  // namespace

TEST_P(Scenes, have_the_depth_of_their_ground_truth_with_a_sine) {
  const Agreement a = compare(GetParam(), Waveform::Kind::sine);
  EXPECT_LT(a.worst_range, 1e-4);
  EXPECT_LT(a.worst_z, 1e-4);
  EXPECT_GT(a.compared, 0.6 * a.seen) << a.seen;  // shadows and what is too close have no depth
  EXPECT_GT(a.seen, 1000);
}

// Duty ¼, edges, the gate's pole, four harmonics; the wiggling table takes them out.
TEST_P(Scenes, have_the_depth_of_their_ground_truth_with_the_profile_s_waveform) {
  const Agreement a = compare(GetParam(), Waveform::Kind::rectangular);
  EXPECT_LT(a.worst_range, 5e-4);
  EXPECT_LT(a.worst_z, 5e-4);
  EXPECT_GT(a.compared, 0.6 * a.seen) << a.seen;
}

INSTANTIATE_TEST_SUITE_P(all, Scenes, testing::ValuesIn(scenes_of_one_point_light()),
                         [](const auto& which) { return test_name(which.param); });

TEST(scenes, are_there) { EXPECT_GE(scene_names().size(), 9u); }

TEST(scenes, of_one_point_light_are_those_named) {
  for (const std::string& name : scene_names()) {
    const Scene scene = load_scene(name);
    const std::vector<Illumination> lights = load_camera(scene).illumination;
    const bool one_point = lights.size() == 1 && lights[0].ring_leds == 1 && lights[0].area.kind == Area::Kind::none;
    EXPECT_EQ(test::is_of_one_point_light(name), one_point && scene.transport.bounces == 0) << name;
  }
}
