// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
// Arrays that only those have who ask for them: raw frames without noise, what each modulation frequency says, flow from each raw frame, classes.
#include <gtest/gtest.h>

#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <set>
#include <string>
#include <vector>

#include "camera/lens/distort.h"
#include "support/pixels.h"
#include "tofray/tofray.h"

using namespace tofray;
using namespace tofray::test;

namespace {

Frame with_arrays(const Scene& scene, const Camera& camera, const std::vector<std::string>& arrays, SimulatorOptions options = {},
                  std::uint64_t index = 0) {
  options.arrays = arrays;
  return Simulator(scene, camera, options).frame(index);
}

/// Everything that charge goes through on its way to a code.
Camera charged_camera() {
  Camera camera = lit_camera(40, 30, 45);
  camera.mode.sequence.push_back({false, 0, 0, 4e-4});
  camera.pixel.prnu = 0.02, camera.pixel.dsnu_dn = 0.4, camera.pixel.phase_offset_rad = 0.02;
  camera.pixel.tap_gain_mismatch = 0.01, camera.pixel.tap_offset_mismatch_e = 20;
  camera.pixel.dark_current_e_per_s = 4e4;
  camera.pixel.suppression_threshold_e = 3000, camera.pixel.suppression_budget_e = 4e4;
  camera.pixel.column_noise_e = 30, camera.pixel.row_noise_e = 20;
  camera.pixel.full_well_e = 3e4;
  return camera;
}

Scene steps_in_the_sun() {
  Scene scene = sunny_wall(0.4);
  scene.ambient.amount = 0.02;
  scene.objects.push_back(object(Box{{-0.2, -0.15, 0.5}, {0.05, 0.1, 0.6}}));
  scene.objects.push_back(object(Sphere{{0.2, 0.1, 0.12}, 0.05}));  // fills the wells
  return scene;
}

Scene corner() {
  Scene scene = wall(1.2, 0.8);
  scene.objects.push_back(object(Plane{{0.3, 0, 0}, {-1, 0, 0}}));
  scene.objects.push_back(object(Box{{-0.3, -0.2, 0.8}, {0, 0.1, 1}}));
  scene.transport.bounces = 2, scene.transport.samples = 16;
  return scene;
}

std::size_t codes_apart(const std::vector<float>& expected, const Array<std::uint16_t>& raw) {
  std::size_t apart = 0;
  for (std::size_t i = 0; i < expected.size(); ++i) apart += std::nearbyint(expected[i]) != static_cast<float>(raw[i]);
  return apart;
}

}  // namespace

TEST(raw_without_noise, rounds_to_the_codes_of_a_frame_without_noise) {
  for (const bool moves : {false, true}) {
    for (const Scene& still : {steps_in_the_sun(), corner()}) {
      Scene scene = still;
      if (moves) scene.objects.back().velocity_m_per_s = {3, 0, 0};
      const Camera camera = charged_camera();
      const Frame noisy = with_arrays(scene, camera, {"raw", "gt_raw_dn"}, {.seed = 5});
      const Frame clean = with_arrays(scene, camera, {"raw"}, {.seed = 5, .noise = Noise::off});
      ASSERT_EQ(noisy.truth.raw_dn.size(), clean.raw.raw.size());
      EXPECT_EQ(codes_apart(noisy.truth.raw_dn, clean.raw.raw), 0U);
      EXPECT_GT(codes_apart(noisy.truth.raw_dn, noisy.raw.raw), clean.raw.raw.size() / 8) << "there is noise";
    }
  }
}

TEST(raw_without_noise, rounds_to_the_codes_of_each_built_in_camera) {
  for (const char* name : {"pico-flexx", "flexx2", "kinect-v2", "o3d303", "opt8241", "imx556", "adtf3175"}) {
    Camera camera = load_camera(std::string(name));
    camera.readout = {1, 0, 0, 32, 32};
    const Frame noisy = with_arrays(steps_in_the_sun(), camera, {"raw", "gt_raw_dn"});
    const Frame clean = with_arrays(steps_in_the_sun(), camera, {"raw"}, {.noise = Noise::off});
    EXPECT_EQ(codes_apart(noisy.truth.raw_dn, clean.raw.raw), 0U) << name;
  }
}

TEST(raw_without_noise, is_the_mean_of_noisy_raw_frames) {
  const Camera camera = lit_camera(4, 4, 45);
  constexpr int frames = 400;
  Simulator simulator(wall(1.2, 0.5), camera, {.arrays = {"raw", "gt_raw_dn"}});
  std::vector<double> sum(4 * 16), square(4 * 16);
  Frame frame;
  for (int i = 0; i < frames; ++i) {
    simulator.frame(static_cast<std::uint64_t>(i), frame);
    for (std::size_t k = 0; k < sum.size(); ++k) {
      const double code = frame.raw.raw[k];
      sum[k] += code, square[k] += code * code;
    }
  }
  for (std::size_t k = 0; k < sum.size(); ++k) {
    const double mean = sum[k] / frames, error = std::sqrt((square[k] / frames - mean * mean) / frames);
    EXPECT_NEAR(static_cast<double>(frame.truth.raw_dn[k]), mean, 4.5 * error) << k;
  }
}

TEST(direct_raw, is_that_of_the_scene_without_bounces) {
  for (const bool moves : {false, true}) {
    Scene scene = corner();
    scene.ambient.spectrum = Ambient::Spectrum::sun_am15, scene.ambient.amount = 0.01, scene.ambient.direction = Vec3{0.2, 0.3, 1};
    if (moves) scene.objects.back().velocity_m_per_s = {3, 0, 0};
    Scene direct = scene;
    direct.transport.bounces = 0;
    Camera camera = charged_camera();
    camera.pixel.full_well_e = 1e6, camera.adc.step_e_per_dn = 60;  // nothing is held anywhere
    const Frame all = with_arrays(scene, camera, {"gt_raw_dn", "gt_raw_direct_dn", "gt_indirect_e"});
    const Frame alone = with_arrays(direct, camera, {"gt_raw_dn", "gt_raw_direct_dn"});
    EXPECT_TRUE(alone.truth.raw_direct_dn.empty()) << "it comes with bounces";
    ASSERT_EQ(all.truth.raw_direct_dn.size(), alone.truth.raw_dn.size());
    double farthest = 0, most = 0;
    for (std::size_t i = 0; i < alone.truth.raw_dn.size(); ++i) {
      if (i / 1200 == 4) continue;  // ambient light is all that there is, what comes by several surfaces too
      farthest = std::fmax(farthest, std::fabs(static_cast<double>(all.truth.raw_direct_dn[i] - alone.truth.raw_dn[i])));
      most = std::fmax(most, std::fabs(static_cast<double>(all.truth.raw_dn[i] - alone.truth.raw_dn[i])));
    }
    EXPECT_GT(most, 10) << "bounces change something";
    EXPECT_LT(farthest, 0.05 * most);
  }
}

TEST(by_frequency, says_the_depth_s_own_range_of_one_frequency) {
  const Camera camera = lit_camera(20, 15, 45);
  const Frame frame = with_arrays(wall(1.2, 0.5), camera,
                                  {"range_m", "amplitude_e", "range_by_frequency_m", "amplitude_by_frequency_e", "cycle_by_frequency"});
  EXPECT_EQ(frame.depth.modulations, 1);
  ASSERT_EQ(frame.depth.range_by_frequency_m.size(), frame.depth.range_m.size());
  for (std::size_t i = 0; i < frame.depth.range_m.size(); ++i) {
    if (std::isnan(frame.depth.range_m[i])) continue;  // too noisy to be a depth
    EXPECT_NEAR(frame.depth.range_by_frequency_m[i], frame.depth.range_m[i], 1e-6F);
    EXPECT_EQ(frame.depth.amplitude_by_frequency_e[i], frame.depth.amplitude_e[i]);
    EXPECT_EQ(frame.depth.cycle_by_frequency[i], 0);
  }
}

TEST(by_frequency, counts_the_cycles_of_each_and_says_what_they_make_of_them) {
  Camera camera = load_camera(std::string("kinect-v2"));
  camera.readout = {1, 200, 180, 64, 48};
  for (const double z : {0.9, 2.3, 4.4}) {
    const Frame frame =
        with_arrays(wall(z, 0.9), camera,
                    {"amplitude_e", "gt_range_m", "range_by_frequency_m", "amplitude_by_frequency_e", "cycle_by_frequency", "raw"},
                    {.noise = Noise::off});
    const std::size_t pixels = frame.truth.range_m.size();
    std::vector<double> frequencies;
    for (const double f : frame.raw.modulation_frequency_hz)
      if (f > 0 && (frequencies.empty() || frequencies.back() != f)) frequencies.push_back(f);
    ASSERT_EQ(frame.depth.modulations, static_cast<int>(frequencies.size()));
    ASSERT_EQ(frequencies.size(), 3U);
    for (std::size_t i = 0; i < pixels; ++i) {
      double amplitude = 0;
      for (std::size_t j = 0; j < 3; ++j) {
        const std::size_t at = j * pixels + i;
        const double reach = 299792458.0 / (2 * frequencies[j]), range = static_cast<double>(frame.truth.range_m[i]);
        ASSERT_NEAR(static_cast<double>(frame.depth.range_by_frequency_m[at]), range, 2e-3);
        // The light stands a few centimetres beside the lens: half the path is a little longer than the range.
        const double into = range / reach - std::floor(range / reach);
        if (into > 0.02 && into < 0.98) {
          ASSERT_EQ(frame.depth.cycle_by_frequency[at], static_cast<int>(std::floor(range / reach)));
        }
        amplitude += static_cast<double>(frame.depth.amplitude_by_frequency_e[at]) / 3;
      }
      ASSERT_NEAR(amplitude / static_cast<double>(frame.depth.amplitude_e[i]), 1, 1e-5);
    }
  }
}

TEST(by_frequency, comes_of_recordings_too) {
  Camera camera = load_camera(std::string("pico-flexx"));
  const Scene scene = wall(1.2, 0.5);
  const std::vector<std::string> arrays{"raw", "range_by_frequency_m", "cycle_by_frequency"};
  const Frame frame = with_arrays(scene, camera, arrays);
  const Depth depth = process(frame.raw, camera, {.arrays = arrays});
  ASSERT_EQ(depth.range_by_frequency_m.size(), frame.depth.range_by_frequency_m.size());
  EXPECT_EQ(depth.cycle_by_frequency, frame.depth.cycle_by_frequency);
  for (std::size_t i = 0; i < depth.range_by_frequency_m.size(); ++i)
    ASSERT_EQ(std::bit_cast<std::uint32_t>(depth.range_by_frequency_m[i]),
              std::bit_cast<std::uint32_t>(frame.depth.range_by_frequency_m[i]));
  EXPECT_TRUE(process(frame.raw, camera).range_by_frequency_m.empty()) << "nobody asks";
}

TEST(by_frequency, knows_nothing_of_what_has_no_light) {
  Scene scene = wall(-1);
  const Frame frame = with_arrays(scene, lit_camera(4, 3), {"range_by_frequency_m", "cycle_by_frequency"}, {.noise = Noise::off});
  for (std::size_t i = 0; i < 12; ++i) {
    EXPECT_TRUE(std::isnan(frame.depth.range_by_frequency_m[i]));
    EXPECT_EQ(frame.depth.cycle_by_frequency[i], -1);
  }
}

namespace {

/// Where the image of what a pixel sees in raw frame k is, less where it is when the truth holds, by two scenes that stand still.
struct Seen {
  Truth then;
  double time_s;
};

Vec3 vector_of(const std::vector<float>& array, std::size_t i) {
  return {static_cast<double>(array[3 * i]), static_cast<double>(array[3 * i + 1]), static_cast<double>(array[3 * i + 2])};
}
camera::Point2 image_of(const Camera& camera, const Vec3& p) { return camera::project(camera.lens, {p[0] / p[2], p[1] / p[2]}); }

Camera slow_camera() {
  Camera camera = lit_camera(64, 48, 60);
  camera.mode.frame_rate_hz = 5;
  for (RawFrame& k : camera.mode.sequence) k.integration_time_s = 8e-3;
  camera.readout_time_s = 5e-3;
  return camera;
}

}  // namespace

TEST(phase_flow, goes_from_each_raw_frame_to_where_the_point_is_when_the_truth_holds) {
  const Camera camera = slow_camera();
  Scene scene = wall(2.5, 0.5);
  scene.objects.push_back(object(Sphere{{-0.2, 0, 1.2}, 0.25}));
  scene.objects.back().velocity_m_per_s = {2.5, -1, 0.8};
  const SimulatorOptions options{.noise = Noise::off, .exposure_samples = 3};
  for (const bool light_image : {false, true}) {
    SimulatorOptions with = options;
    with.subpixel = light_image ? 2 : 1;
    const Frame frame = with_arrays(scene, camera, {"gt_phase_flow_px", "gt_object_id", "tap_a"}, with);
    const std::size_t pixels = frame.truth.object_id.size();
    ASSERT_EQ(frame.truth.phase_flow_px.size(), 2 * 4 * pixels);
    for (std::size_t k = 0; k < 4; ++k) {
      const double when = frame.raw.start_time_s[k] + frame.raw.integration_time_s[k] / 2;
      Scene then = scene;
      then.objects.back().velocity_m_per_s = {0, 0, 0};
      then.objects.back().position = when * scene.objects.back().velocity_m_per_s;
      const Truth seen = truth(then, camera);
      int balls = 0, walls = 0;
      for (std::size_t i = 0; i < pixels; ++i) {
        const double u = static_cast<double>(frame.truth.phase_flow_px[2 * (k * pixels + i)]),
                     v = static_cast<double>(frame.truth.phase_flow_px[2 * (k * pixels + i) + 1]);
        if (seen.object_id[i] == 0) {
          ASSERT_TRUE(u == 0 && v == 0) << "the wall stands still";
          ++walls;
          continue;
        }
        const Vec3 p = vector_of(seen.position_m, i);
        const camera::Point2 from = image_of(camera, p),
                             to = image_of(camera, p + (frame.truth.time_s - when) * scene.objects.back().velocity_m_per_s);
        ASSERT_NEAR(u, to.x - from.x, 2e-3) << k << " " << i;
        ASSERT_NEAR(v, to.y - from.y, 2e-3) << k << " " << i;
        if (k != 2) {
          ASSERT_GT(std::hypot(u, v), 0.3) << "it would be no test";
        }
        ++balls;
      }
      EXPECT_GT(balls, 200);
      EXPECT_GT(walls, 200);
    }
  }
}

TEST(phase_flow, follows_what_turns_and_a_camera_that_moves) {
  const Camera camera = slow_camera();
  Scene scene = wall(2.5, 0.5);
  scene.objects.push_back(object(Box{{-0.3, -0.2, 1.2}, {0.2, 0.2, 1.5}}));
  scene.objects.back().angular_velocity_rad_per_s = {0, 0, 6};  // about its own centre, (−0.05, 0, 1.35)
  scene.camera.keyframes = {{0, {{0, 0, 0}, {0, 0, 1}, {0, -1, 0}}}, {0.1, {{0.2, 0, 0}, {0.2, 0, 1}, {0, -1, 0}}}};
  const Frame frame = with_arrays(scene, camera, {"gt_phase_flow_px"}, {.noise = Noise::off});
  const std::size_t pixels = 64 * 48;
  for (std::size_t k = 0; k < 4; ++k) {
    const double when = frame.raw.start_time_s[k] + frame.raw.integration_time_s[k] / 2, later = frame.truth.time_s - when;
    Scene then = scene;
    then.camera.keyframes.clear();
    then.camera.pose = {{2 * when, 0, 0}, {2 * when, 0, 1}, {0, -1, 0}};
    then.objects.back().angular_velocity_rad_per_s = {0, 0, 0};
    then.objects.back().rotation = {{0, 0, 1}, 6 * when};
    const Truth seen = truth(then, camera);
    for (std::size_t i = 0; i < pixels; ++i) {
      Vec3 p = vector_of(seen.position_m, i);
      const camera::Point2 from = image_of(camera, p);
      p[0] += 2 * when;  // the world, then the point turns, then the camera at its later place
      if (seen.object_id[i] == 1) {
        const double x = p[0] + 0.05, y = p[1], c = std::cos(6 * later), s = std::sin(6 * later);
        p[0] = c * x - s * y - 0.05, p[1] = s * x + c * y;
      }
      p[0] -= 2 * frame.truth.time_s;
      const camera::Point2 to = image_of(camera, p);
      ASSERT_NEAR(static_cast<double>(frame.truth.phase_flow_px[2 * (k * pixels + i)]), to.x - from.x, 3e-3) << k << " " << i;
      ASSERT_NEAR(static_cast<double>(frame.truth.phase_flow_px[2 * (k * pixels + i) + 1]), to.y - from.y, 3e-3) << k << " " << i;
    }
  }
}

TEST(phase_flow, is_0_where_all_stands_still_and_nan_where_nothing_is) {
  Scene scene;
  scene.materials = wall(1).materials;
  scene.objects.push_back(object(Sphere{{0, 0, 1.2}, 0.25}));
  const Frame frame = with_arrays(scene, slow_camera(), {"gt_phase_flow_px", "gt_object_id"});
  std::set<std::uint32_t> on_it, beside;
  for (std::size_t k = 0; k < 4; ++k)
    for (std::size_t i = 0; i < 64 * 48; ++i)
      for (std::size_t axis = 0; axis < 2; ++axis)
        (frame.truth.object_id[i] == 0 ? on_it : beside)
            .insert(std::bit_cast<std::uint32_t>(frame.truth.phase_flow_px[2 * (k * 64 * 48 + i) + axis]));
  EXPECT_EQ(on_it, (std::set<std::uint32_t>{0U}));
  EXPECT_EQ(beside, (std::set<std::uint32_t>{0x7fc00000U}));
}

TEST(phase_flow, is_nan_where_a_moving_camera_sees_nothing_at_all) {
  Scene scene;
  scene.camera.keyframes = {{0, {{0, 0, 0}, {0, 0, 1}, {0, -1, 0}}}, {0.1, {{0.2, 0, 0}, {0, 0, 1}, {0, -1, 0}}}};
  const Frame frame = with_arrays(scene, slow_camera(), {"gt_phase_flow_px"});
  for (const float one : frame.truth.phase_flow_px) ASSERT_EQ(std::bit_cast<std::uint32_t>(one), 0x7fc00000U);
}

TEST(classes, count_by_the_scene_s_list_or_by_their_letters) {
  Scene scene = wall(2);
  scene.objects[0].class_name = "wall";
  scene.objects.push_back(object(Sphere{{0, 0, 1}, 0.1}));
  scene.objects.back().class_name = "ball";
  scene.objects.push_back(object(Sphere{{0.3, 0, 1}, 0.1}));
  const Camera camera = lit_camera(40, 30, 40);
  const auto seen = [&](int object) {
    const Truth truth = with_arrays(scene, camera, {"gt_class_id", "gt_object_id"}).truth;
    std::set<int> out;
    for (std::size_t i = 0; i < truth.object_id.size(); ++i)
      if (truth.object_id[i] == object) out.insert(truth.class_id[i]);
    return out;
  };
  EXPECT_EQ(seen(0), std::set<int>{1});
  EXPECT_EQ(seen(1), std::set<int>{0});
  EXPECT_EQ(seen(2), std::set<int>{-1}) << "it has none";
  scene.classes = {"chair", "wall", "table", "ball"};
  EXPECT_EQ(seen(0), std::set<int>{1});
  EXPECT_EQ(seen(1), std::set<int>{3});
  scene.objects.erase(scene.objects.begin());
  EXPECT_EQ(seen(-1), std::set<int>{-1}) << "nothing is there";
  scene.classes = {"chair"};
  try {
    Simulator(scene, camera);
    FAIL();
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find("of a class that the scene's classes have not"), std::string::npos) << error.what();
  }
}

TEST(labels, come_only_to_those_who_ask) {
  const Frame frame = Simulator(corner(), lit_camera(8, 6, 20)).frame(0);
  EXPECT_TRUE(frame.truth.raw_dn.empty() && frame.truth.raw_direct_dn.empty() && frame.truth.phase_flow_px.empty());
  EXPECT_TRUE(frame.truth.class_id.empty() && frame.depth.range_by_frequency_m.empty() && frame.depth.cycle_by_frequency.empty());
  EXPECT_TRUE(frame.depth.amplitude_by_frequency_e.empty());
}
