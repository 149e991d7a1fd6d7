// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
// Each cause of a wrong depth, made large in a scene of its own: it is named first, with what closed forms or two frames say.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "support/pi.h"
#include "support/pixels.h"
#include "tofray/causes.h"
#include "tofray/error.h"
#include "tofray/pixel.h"

using namespace tofray;
using namespace tofray::test;

namespace {

/// Two modulation frequencies, weak enough light that no code clips.
Camera camera_of_two() {
  Camera camera = lit_camera(17, 13, 60);
  camera.illumination[0].power_w = 0.02;
  camera.decoding.noise_threshold_m = 10, camera.decoding.flying_check = false;
  camera.mode.sequence.clear();
  for (const double hz : {80e6, 60e6})
    for (int k = 0; k < 4; ++k) camera.mode.sequence.push_back({true, hz, k * pi / 2, 1e-3});
  return camera;
}

SimulatorOptions quiet(Noise noise = Noise::off) {
  SimulatorOptions options;
  options.noise = noise, options.backend = Backend::cpu, options.threads = 1, options.seed = 5;
  return options;
}

constexpr PixelRegion whole_image{0, 0, 16, 12};

/// Mean of z − gt_z over the image.
double mean_error(const Scene& scene, const Camera& camera, const SimulatorOptions& options, std::uint64_t index = 0) {
  const Frame frame = Simulator(scene, camera, options).frame(index);
  double sum = 0;
  int count = 0;
  for (std::size_t i = 0; i < frame.depth.z_m.size(); ++i) {
    const double error = static_cast<double>(frame.depth.z_m[i]) - static_cast<double>(frame.truth.z_m[i]);
    if (std::isfinite(error)) sum += error, ++count;
  }
  return sum / count;
}

double sum_of(const ErrorSplit& split) {
  double out = split.rest_m;
  for (const ErrorCause& one : split.causes) out += one.error_m;
  return out;
}

/// The first cause is this one, and all of them together are the error.
void expect_first(const ErrorSplit& split, const std::string& cause) {
  ASSERT_FALSE(split.causes.empty());
  EXPECT_EQ(split.causes[0].cause, cause);
  EXPECT_NEAR(sum_of(split), split.error_m, 1e-9);
  EXPECT_GT(split.valid, 0);
}

double share_of(const ErrorSplit& split, const std::string& cause) {
  for (const ErrorCause& one : split.causes)
    if (one.cause == cause) return one.error_m;
  return std::nan("");
}

TEST(error_causes, that_the_scene_does_not_have_are_left_out) {
  const ErrorSplit split = error_causes(wall(1.2, 0.5), camera_of_two(), quiet(), 0, whole_image);
  EXPECT_TRUE(split.causes.empty()) << split.causes[0].cause;
  EXPECT_NEAR(split.error_m, 0, 1e-4);
  EXPECT_EQ(split.rest_m, split.error_m);
  EXPECT_EQ(split.pixels, 17 * 13);
  EXPECT_EQ(split.valid, 17 * 13);
}

TEST(error_causes, noise_is_all_of_the_error_before_a_plain_wall) {
  const Camera camera = camera_of_two();
  const Scene scene = wall(1.2, 0.5);
  for (const auto& [u, v] : {std::pair{0, 0}, {8, 6}, {16, 12}}) {
    const ErrorSplit split = error_causes(scene, camera, quiet(Noise::exact), 3, {u, v, u, v});
    expect_first(split, "noise");
    const auto pixel = static_cast<std::size_t>(v * 17 + u);
    const Frame frame = Simulator(scene, camera, quiet(Noise::exact)).frame(3), expected = Simulator(scene, camera, quiet()).frame(3);
    EXPECT_FLOAT_EQ(static_cast<float>(split.error_m), frame.depth.z_m[pixel] - frame.truth.z_m[pixel]);
    EXPECT_NEAR(share_of(split, "noise"), static_cast<double>(frame.depth.z_m[pixel]) - static_cast<double>(expected.depth.z_m[pixel]),
                1e-7);
    EXPECT_NEAR(split.rest_m, 0, 1e-4);
    EXPECT_NEAR(split.sigma_m, static_cast<double>(frame.depth.noise_m[pixel] * frame.depth.z_m[pixel] / frame.depth.range_m[pixel]), 1e-7);
  }
}

TEST(error_causes, multipath_bends_a_corner) {
  Scene corner = wall(1.5, 0.8);
  corner.objects.push_back(object(Plane{{0.35, 0, 0}, {-1, 0, 0}}));
  const double direct = mean_error(corner, camera_of_two(), quiet());
  corner.transport.bounces = 2, corner.transport.samples = 16;
  const ErrorSplit split = error_causes(corner, camera_of_two(), quiet(), 0, whole_image);
  expect_first(split, "multipath");
  EXPECT_GT(share_of(split, "multipath"), 0.01) << "ways by another wall are longer";
  EXPECT_NEAR(share_of(split, "multipath"), mean_error(corner, camera_of_two(), quiet()) - direct, 1e-6);
  EXPECT_NEAR(split.rest_m, 0, 1e-3);
}

TEST(error_causes, wiggling_of_a_third_harmonic_is_its_closed_form) {
  Camera camera = camera_of_two();
  camera.mode.sequence.resize(4);
  camera.decoding.wiggling_correction = false;
  Waveform& light = camera.illumination[0].waveform;
  light = {};
  light.duty = 0.5, light.harmonics = 2;
  camera.sensor.width = camera.sensor.height = 1, camera.lens.cx_px = camera.lens.cy_px = 0;
  for (const double z : {0.2, 0.3, 0.6}) {
    camera.illumination[0].power_w = 0.01 * z * z;
    const ErrorSplit split = error_causes(wall(z, 0.5), camera, quiet(), 0, {0, 0, 0, 0});
    expect_first(split, "wiggling");
    // Of four samples the third harmonic falls onto the first as its conjugate: Z = a1 e^{i phi} + a3 e^{-3 i phi}, of
    // [theory: rectangular-light] with a3 = -sinc(1.5)/3 / sinc(0.5) a1 = 1/9 a1.
    const double wave = 299'792'458 / (2 * 80e6), phi = 2 * pi * z / wave;
    const double measured = std::atan2(std::sin(phi) - std::sin(3 * phi) / 9, std::cos(phi) + std::cos(3 * phi) / 9);
    EXPECT_NEAR(share_of(split, "wiggling"), std::remainder(measured - phi, 2 * pi) / (2 * pi) * wave, 2e-4) << z;
    EXPECT_GT(std::abs(share_of(split, "wiggling")), 1e-3) << z;
  }
}

TEST(error_causes, noise_is_not_counted_again_by_other_causes) {
  Camera camera = camera_of_two();  // corrects its harmonics: they leave nothing
  camera.pixel.contrast = {{60e6}, {0.7}};
  camera.illumination[0].waveform = {};
  double most = 0;
  for (const int u : {2, 8, 15}) {
    const ErrorSplit split = error_causes(wall(1.2, 0.5), camera, quiet(Noise::exact), 1, {u, 6, u, 6});
    expect_first(split, "noise");
    most = std::max(most, std::abs(share_of(split, "noise")));
    EXPECT_NEAR(share_of(split, "wiggling"), 0, 5e-5) << u;
    EXPECT_NEAR(split.rest_m, 0, 5e-5) << u;
  }
  EXPECT_GT(most, 1e-3) << "hardly any noise: the test tries nothing";
}

TEST(error_causes, a_wrong_cycle_is_whole_cycles_whatever_led_to_it) {
  Camera camera = camera_of_two();
  // Beyond the ambiguity range of 7.495 m: one period short.
  const ErrorSplit beyond = error_causes(wall(8, 1), camera, quiet(), 0, {8, 6, 8, 6});
  expect_first(beyond, "wrong_cycle");
  EXPECT_NEAR(share_of(beyond, "wrong_cycle"), -299'792'458 / (2 * 20e6), 2e-3);
  EXPECT_NEAR(beyond.rest_m, 0, 2e-3);
  camera.mode.sequence.resize(4);  // 80 MHz alone: 1.874 m
  const ErrorSplit one = error_causes(wall(2, 1), camera, quiet(), 0, {8, 6, 8, 6});
  expect_first(one, "wrong_cycle");
  EXPECT_NEAR(share_of(one, "wrong_cycle"), -299'792'458 / (2 * 80e6), 1e-3);
}

TEST(error_causes, weak_light_makes_wrong_cycles_and_what_is_left_is_noise_within_one) {
  Camera camera = camera_of_two();
  camera.illumination[0].power_w = 4e-3, camera.pixel.read_noise_e = 4;
  const Scene scene = wall(3.1, 0.5);
  const Frame frame = Simulator(scene, camera, quiet(Noise::exact)).frame(0);
  int wrong = 0;
  for (int v = 0; v < 13; ++v)
    for (int u = 0; u < 17; ++u) {
      const auto pixel = static_cast<std::size_t>(v * 17 + u);
      const double error = static_cast<double>(frame.depth.z_m[pixel]) - static_cast<double>(frame.truth.z_m[pixel]);
      if (!(std::abs(error) > 1) || wrong == 3) continue;
      ++wrong;
      const ErrorSplit split = error_causes(scene, camera, quiet(Noise::exact), 0, {u, v, u, v});
      expect_first(split, "wrong_cycle");
      EXPECT_LT(std::abs(share_of(split, "noise")), 0.7) << "the noise is within the right cycle";
      EXPECT_NEAR(split.rest_m, 0, 0.01);
    }
  EXPECT_GT(wrong, 0) << "the light is too strong for the test";
}

TEST(error_causes, a_wrong_cycle_counts_along_the_ray_in_corners_too) {
  Camera camera = camera_of_two();
  camera.lens.fx_px = camera.lens.fy_px = 9;
  camera.illumination[0].power_w = 0.01, camera.pixel.read_noise_e = 4;
  const Scene scene = wall(2.2, 0.5);
  const Frame frame = Simulator(scene, camera, quiet(Noise::exact)).frame(0);
  int wrong = 0;
  for (int v = 0; v < 13; ++v)
    for (int u = 0; u < 17; ++u) {
      const PixelChain chain = pixel_chain(frame, camera, u, v);
      const double cosine = chain.z_m / chain.range_m;
      if (!(std::abs(chain.z_m - chain.true_z_m) > 1) || !(cosine < 0.85) || chain.candidates.empty() || wrong == 3) continue;
      ++wrong;
      double nearest = 1e9;
      for (const UnwrapCandidate& one : chain.candidates)
        if (std::abs(one.range_m - chain.true_range_m) < std::abs(nearest - chain.true_range_m)) nearest = one.range_m;
      const ErrorSplit split = error_causes(scene, camera, quiet(Noise::exact), 0, {u, v, u, v});
      EXPECT_NEAR(share_of(split, "wrong_cycle"), (chain.candidates.front().range_m - nearest) * cosine, 1e-4) << u << "," << v;
    }
  EXPECT_GT(wrong, 0) << "no pixel aside is on a wrong cycle";
}

TEST(error_causes, motion_is_off_at_the_time_of_the_truth) {
  Scene scene;
  scene.materials = wall(2, 0.5).materials;
  Object ball = object(Sphere{{-1, 0, 2}, 0.3});
  ball.velocity_m_per_s = {1, 0, -0.3};
  scene.objects = {ball};
  const Camera camera = camera_of_two();
  const auto index = static_cast<std::uint64_t>(camera.mode.frame_rate_hz);  // after a second it is on the axis; before, nothing is there
  const ErrorSplit split = error_causes(scene, camera, quiet(), index, {8, 6, 8, 6});
  ASSERT_EQ(split.valid, 1);
  EXPECT_TRUE(std::isfinite(share_of(split, "motion")));
}

TEST(error_causes, a_pixel_on_an_edge_is_mixed) {
  Scene scene = wall(2, 0.5);
  scene.objects.push_back(object(Rectangle{{0.51, 0, 1.6}, {1, 4}}));
  SimulatorOptions options = quiet();
  options.subpixel = 8;
  const Camera camera = camera_of_two();
  const Frame frame = Simulator(scene, camera, options).frame(0);
  int edge = 0;
  for (int u = 0; u < 17; ++u) {
    const auto pixel = static_cast<std::size_t>(6 * 17 + u);
    if (frame.truth.mixed[pixel] == 0) continue;
    ++edge;
    const ErrorSplit split = error_causes(scene, camera, options, 0, {u, 6, u, 6});
    expect_first(split, "mixed_pixel");
    SimulatorOptions middle = options;
    middle.subpixel = 1;
    const Frame without = Simulator(scene, camera, middle).frame(0);
    const auto error = [&](const Frame& one) {
      return static_cast<double>(one.depth.z_m[pixel]) - static_cast<double>(one.truth.z_m[pixel]);
    };
    EXPECT_NEAR(share_of(split, "mixed_pixel"), error(frame) - error(without), 1e-6);
    EXPECT_GT(std::abs(share_of(split, "mixed_pixel")), 0.01);
  }
  EXPECT_EQ(edge, 1);
}

TEST(error_causes, a_wall_that_comes_nearer_is_off_by_its_motion) {
  Camera camera = camera_of_two();
  Scene scene = wall(1.5, 0.5);
  scene.objects[0].velocity_m_per_s = {0, 0, -3};
  for (const std::uint64_t index : {0u, 2u}) {
    const ErrorSplit split = error_causes(scene, camera, quiet(), index, {4, 3, 12, 9});
    expect_first(split, "motion");
    EXPECT_GT(std::abs(split.error_m), 1e-3);
    EXPECT_NEAR(share_of(split, "motion"), split.error_m, 2e-4) << "standing still, it is right";
  }
  // Motion along that way by keyframes.
  Scene keyed = scene;
  keyed.objects[0].velocity_m_per_s = {0, 0, 0};
  keyed.objects[0].keyframes = {{0, {0, 0, 0}, {}}, {0.4, {0, 0, -1.2}, {}}};
  const double by_velocity = share_of(error_causes(scene, camera, quiet(), 2, {4, 3, 12, 9}), "motion");
  EXPECT_NEAR(share_of(error_causes(keyed, camera, quiet(), 2, {4, 3, 12, 9}), "motion"), by_velocity, 1e-5);
}

TEST(error_causes, what_turns_stands_as_it_is_turned) {
  Scene scene = wall(2.5, 0.5);
  Object box = object(Box{{-0.25, -0.25, 1.15}, {0.25, 0.25, 1.65}});
  box.rotation = {{0, 1, 0}, 0.4, {}};
  box.angular_velocity_rad_per_s = {0, 3, 0};
  scene.objects.push_back(box);
  const Camera camera = camera_of_two();
  const ErrorSplit split = error_causes(scene, camera, quiet(), 4, {8, 6, 8, 6});
  const Frame frame = Simulator(scene, camera, quiet()).frame(4);
  ASSERT_EQ(frame.truth.object_id[6 * 17 + 8], 1);
  expect_first(split, "motion");
  EXPECT_NEAR(share_of(split, "motion"), split.error_m, 1e-4) << "turned to where it is at the time of the truth, it is right";
}

TEST(error_causes, light_that_the_lens_scatters_off_a_near_wall_pulls_the_far_one) {
  Scene scene = wall(3, 0.5);
  scene.objects.push_back(object(Rectangle{{-0.3, 0, 0.6}, {0.5, 2}}));
  Camera camera = camera_of_two();
  camera.lens.scatter.kind = Scatter::Kind::gaussians;
  camera.lens.scatter.share = 0.15, camera.lens.scatter.sigma_px = {8};
  const ErrorSplit split = error_causes(scene, camera, quiet(), 0, {14, 2, 16, 10});
  expect_first(split, "scatter");
  EXPECT_LT(share_of(split, "scatter"), -0.01);
  EXPECT_NEAR(share_of(split, "scatter"), split.error_m, 1e-3);
}

TEST(error_causes, crosstalk_filter_interference_and_drift_are_found_too) {
  Scene step = wall(3, 0.5);
  step.objects.push_back(object(Rectangle{{-0.3, 0, 0.6}, {0.6, 2}}));
  const auto without = [&](const Camera& with, const Camera& off, const std::string& cause, const PixelRegion& region) {
    const ErrorSplit split = error_causes(step, with, quiet(), 0, region);
    EXPECT_NEAR(share_of(split, cause), split.error_m - error_causes(step, off, quiet(), 0, region).error_m, 1e-6) << cause;
    EXPECT_GT(std::abs(share_of(split, cause)), 1e-4) << cause;
    expect_first(split, cause);
  };
  Camera camera = camera_of_two();
  camera.pixel.crosstalk_left_right = 0.02;
  without(camera, camera_of_two(), "crosstalk", whole_image);
  camera = camera_of_two(), camera.decoding.filter.kind = ImageFilter::Kind::gaussian;
  without(camera, camera_of_two(), "filter", {0, 0, 16, 12});
  camera = camera_of_two(), camera.interference.share = 0.3, camera.interference.phase_rad = 1;
  without(camera, camera_of_two(), "interference", {12, 0, 16, 12});
  camera = camera_of_two(), camera.temperature.celsius = 45, camera.temperature.drift_m_per_kelvin = 1e-3;
  without(camera, camera_of_two(), "drift", {12, 0, 16, 12});
}

TEST(error_causes, of_a_region_beyond_the_image_are_refused) {
  for (const PixelRegion& wrong : {PixelRegion{0, 0, 17, 0}, {0, 0, 0, 13}, {-1, 0, 0, 0}, {0, -1, 0, 0}, {2, 0, 1, 0}, {0, 2, 0, 1}})
    EXPECT_THROW(error_causes(wall(1), camera_of_two(), quiet(), 0, wrong), Error);
}

TEST(error_causes, where_nothing_has_a_depth_there_is_no_error) {
  const ErrorSplit split = error_causes(Scene(), camera_of_two(), quiet(), 0, whole_image);
  EXPECT_EQ(split.valid, 0);
  EXPECT_TRUE(std::isnan(split.error_m));
  EXPECT_TRUE(split.causes.empty());
}

TEST(error_causes, a_frame_that_was_stopped_is_simulated_again) {
  FrameProgress progress;
  SimulatorOptions options = quiet(Noise::exact);
  options.progress = &progress;
  ErrorCauses causes(wall(1.2, 0.5), camera_of_two(), options, 0, whole_image);
  progress.stop = true;
  EXPECT_TRUE(causes.step());
  EXPECT_EQ(causes.result().valid, 0) << "what it holds means nothing";
  progress.stop = false;
  int steps = 0;
  while (causes.step()) ++steps;
  EXPECT_EQ(steps, 2) << "all as they are, and without noise";
  const ErrorSplit at_once = error_causes(wall(1.2, 0.5), camera_of_two(), quiet(Noise::exact), 0, whole_image);
  EXPECT_EQ(causes.result().error_m, at_once.error_m);
  EXPECT_EQ(share_of(causes.result(), "noise"), share_of(at_once, "noise"));
}

}  // namespace
