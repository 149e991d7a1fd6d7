// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
// Numbers of quality against what was put into the frames.
#include "tofray/quality.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>
#include <random>

#include "tofray/error.h"
#include "tofray/load.h"
#include "tofray/simulator.h"

using namespace tofray;

namespace {

constexpr float no_z = std::numeric_limits<float>::quiet_NaN();
constexpr double focal = 50;

/// A frame of a pinhole whose z is what `z_of` says, with all that goes with it.
Depth pinhole_frame(int width, int height, const std::function<double(int, int)>& z_of) {
  Depth out;
  out.width = width, out.height = height;
  for (int v = 0; v < height; ++v)
    for (int u = 0; u < width; ++u) {
      const double z = z_of(u, v), x = (u - 0.5 * (width - 1)) / focal * z, y = (v - 0.5 * (height - 1)) / focal * z;
      out.z_m.push_back(static_cast<float>(z)), out.range_m.push_back(static_cast<float>(std::sqrt(x * x + y * y + z * z)));
      for (const double one : {x, y, z}) out.points_m.push_back(static_cast<float>(one));
      out.flags.push_back(0), out.amplitude_e.push_back(100);
    }
  return out;
}

void make_invalid(Depth& depth, std::size_t pixel) {
  depth.z_m[pixel] = depth.range_m[pixel] = no_z;
  depth.flags[pixel] = flag_low_signal;
}

Truth truth_of_wall(int width, int height, double z) {
  const Depth wall = pinhole_frame(width, height, [&](int, int) { return z; });
  Truth out;
  out.width = width, out.height = height, out.z_m = wall.z_m, out.range_m = wall.range_m, out.position_m = wall.points_m;
  return out;
}

std::string quality_refusal(const std::function<void()>& call) {
  try {
    call();
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::bad_input);
    return error.what();
  }
  return "nothing was wrong";
}

}  // namespace

TEST(quality, fill_rate_counts_the_pixels_of_the_region_that_have_a_depth) {
  Depth depth = pinhole_frame(10, 8, [](int, int) { return 1.0; });
  make_invalid(depth, 0), make_invalid(depth, 23), make_invalid(depth, 24);  // columns 3 and 4 of row 2
  EXPECT_DOUBLE_EQ(quality({depth}).fill_rate_percent, 100 * 77.0 / 80);
  EXPECT_DOUBLE_EQ(quality({depth}, {{3, 2, 4, 1}, "", 0}).fill_rate_percent, 50);
  EXPECT_DOUBLE_EQ(quality({depth}, {{4, 2, 5, 1}, "", 0}).fill_rate_percent, 80);
  EXPECT_DOUBLE_EQ(quality({depth}, {{5, 2, 5, 1}, "", 0}).fill_rate_percent, 100);
  depth.z_m[30] = 0;  // as in pictures
  EXPECT_DOUBLE_EQ(quality({depth}).fill_rate_percent, 100 * 76.0 / 80);
}

TEST(quality, a_tilted_wall_has_its_distance_tilt_and_no_error) {
  // z = 2 + 0.3 x in the camera's frame, which a pinhole sees at z = 2/(1 - 0.3 (u - c)/f).
  const Depth depth = pinhole_frame(40, 30, [](int u, int) { return 2 / (1 - 0.3 * (u - 19.5) / focal); });
  const Quality found = quality({depth});
  EXPECT_NEAR(found.plane_distance_m, 2, 1e-6);
  EXPECT_NEAR(found.plane_tilt_rad, std::atan(0.3), 1e-6);
  EXPECT_LT(found.plane_fit_rms_m, 1e-6);
  EXPECT_LT(found.total_noise_m, 1e-6);
}

TEST(quality, plane_fit_rms_leaves_out_half_a_percent_at_either_end) {
  // 400 points: two are cut at either end, among them the only two that are off.
  const Depth depth = pinhole_frame(20, 20, [](int u, int v) { return u == 3 && v == 3 ? 1.001 : u == 16 && v == 16 ? 0.999 : 1.0; });
  EXPECT_LT(quality({depth}).plane_fit_rms_m, 1.5e-5);
  const Depth small = pinhole_frame(10, 19, [](int u, int v) { return u == 3 && v == 3 ? 1.001 : u == 6 && v == 15 ? 0.999 : 1.0; });
  EXPECT_GT(quality({small}).plane_fit_rms_m, 9e-5);  // of 190 none
}

TEST(quality, z_accuracy_is_above_zero_where_the_wall_is_seen_too_far) {
  const Depth depth = pinhole_frame(20, 20, [](int, int) { return 2.02; });
  EXPECT_NEAR(quality({depth}, {{}, "", 2.0}).z_accuracy_percent, 1, 1e-4);
  const Depth truth = depth_of(truth_of_wall(20, 20, 2.04));
  EXPECT_NEAR(quality({depth}, {}, &truth).z_accuracy_percent, -100 * 0.02 / 2.04, 1e-4);
  EXPECT_TRUE(std::isnan(quality({depth}).z_accuracy_percent));
}

TEST(quality, noise_is_split_into_what_changes_and_what_stays) {
  std::mt19937 random(5);
  std::normal_distribution<double> normal;
  constexpr int width = 60, height = 50, count = 12;
  std::vector<double> pattern;
  for (int i = 0; i < width * height; ++i) pattern.push_back(0.003 * normal(random));
  std::vector<Depth> frames;
  for (int i = 0; i < count; ++i) {
    frames.push_back(pinhole_frame(
        width, height, [&](int u, int v) { return 1.5 + pattern[static_cast<std::size_t>(v * width + u)] + 0.002 * normal(random); }));
    frames.back().noise_m.assign(static_cast<std::size_t>(width * height), 0.002F);
  }
  const Quality found = quality(frames);
  EXPECT_NEAR(found.temporal_noise_m, 0.002, 4 * 0.002 / std::sqrt(2.0 * width * height * (count - 1)));
  EXPECT_NEAR(found.spatial_noise_m, 0.003, 4 * 0.003 / std::sqrt(2.0 * width * height));
  EXPECT_NEAR(found.total_noise_m, std::hypot(0.002, 0.003), 2e-4);
  // noise_m is of the range, which is noisier than z by 1/cos.
  EXPECT_NEAR(found.noise_chi2, 1.16, 0.05);
  EXPECT_NEAR(quality({frames[0], frames[1]}).spatial_noise_m, 0.003, 4 * 0.003 / std::sqrt(2.0 * width * height));
  const Quality one = quality({frames[0]});
  EXPECT_NEAR(one.total_noise_m, std::hypot(0.002, 0.003), 2e-4);
  EXPECT_TRUE(std::isnan(one.temporal_noise_m) && std::isnan(one.temporal_noise_percent) && std::isnan(one.spatial_noise_m));
}

TEST(quality, temporal_noise_of_realsense_is_the_median_pixels_with_divisor_n) {
  // Of each pixel 1 and 1 + 2 s: sigma is s with divisor n, the median 1 + s.
  const auto frame = [](int which) { return pinhole_frame(3, 1, [which](int u, int) { return which == 0 ? 1.0 : 1 + 0.02 * (u + 1); }); };
  EXPECT_NEAR(quality({frame(0), frame(1)}).temporal_noise_percent, 100 * 0.02 / 1.02, 1e-5);
  std::vector<Depth> frames = {frame(0), frame(1), frame(0), frame(1)};
  for (Depth& depth : frames) make_invalid(depth, 2);  // a pixel that is never valid counts as 0
  EXPECT_NEAR(quality(frames).temporal_noise_percent, 100 * 0.01 / 1.01, 1e-5);
}

TEST(quality, bias_is_of_all_valid_pixels_and_the_mean_is_no_median) {
  Depth depth = pinhole_frame(4, 1, [](int u, int) { return u == 3 ? 1.5 : 1.01; });
  const Depth truth = depth_of(truth_of_wall(4, 1, 1));
  const Quality found = quality({depth}, {}, &truth);
  EXPECT_NEAR(found.bias_m, (3 * 0.01 + 0.5) / 4, 1e-6);
  EXPECT_NEAR(found.bias_median_m, 0.01, 1e-6);
  EXPECT_NEAR(found.rmse_m, std::sqrt((3 * 1e-4 + 0.25) / 4), 1e-6);
  make_invalid(depth, 3);
  EXPECT_NEAR(quality({depth}, {}, &truth).bias_m, 0.01, 1e-6);
}

TEST(quality, a_step_has_its_height_width_and_shift) {
  const auto step = [](double middle, double ramp) {
    return [=](int u, int) { return 1 + 0.5 * std::clamp((u - middle) / ramp + 0.5, 0.0, 1.0); };
  };
  const Depth blurred = pinhole_frame(40, 20, step(21, 6));
  Truth truth;
  const Depth sharp = pinhole_frame(40, 20, step(19.5, 0.1));
  truth.width = 40, truth.height = 20, truth.z_m = sharp.z_m, truth.range_m = sharp.range_m, truth.position_m = sharp.points_m;
  const Depth right = depth_of(truth);
  const Quality found = quality({blurred}, {}, &right);
  EXPECT_NEAR(found.edge_step_m, 0.5, 1e-6);
  EXPECT_NEAR(found.edge_width_px, 0.8 * 6, 1e-4);
  EXPECT_NEAR(found.edge_shift_px, 1.5, 1e-4);          // the near surface, on the left, is too wide
  EXPECT_NEAR(found.flying_pixels_percent, 100, 1e-9);  // 19 to 23
  EXPECT_NEAR(quality({sharp}).edge_width_px, 0.8, 1e-4);
  EXPECT_EQ(quality({sharp}).flying_pixels_percent, 0);
  const Depth turned = pinhole_frame(20, 40, [&](int u, int v) { return 2.5 - step(19.5, 5)(v, u); });  // far above, near below
  EXPECT_NEAR(quality({turned}).edge_width_px, 4, 1e-4);
}

TEST(quality, neither_a_wall_nor_a_ramp_has_a_step) {
  std::mt19937 random(1);
  std::normal_distribution<double> normal;
  EXPECT_TRUE(std::isnan(quality({pinhole_frame(40, 30, [&](int, int) { return 1 + 0.01 * normal(random); })}).edge_step_m));
  EXPECT_TRUE(std::isnan(quality({pinhole_frame(40, 30, [](int u, int) { return 1 + 0.01 * u; })}).edge_step_m));
}

TEST(quality, a_makers_conditions_choose_the_region_and_tell_what_is_missing) {
  const Depth depth = pinhole_frame(100, 80, [](int, int) { return 1.0; });
  const Quality found = quality({depth}, {{}, "basler", 0});
  EXPECT_EQ(found.region.u, 30);
  EXPECT_EQ(found.region.v, 20);
  EXPECT_EQ(found.region.width, 40);
  EXPECT_EQ(found.region.height, 40);
  ASSERT_EQ(found.notes.size(), 1U);
  EXPECT_EQ(found.notes[0], "Basler blaze takes 25 frames; these are 1");
  EXPECT_EQ(quality({depth}, {{1, 2, 3, 4}, "basler", 0}).region.width, 3);
}

TEST(quality, refuses_what_cannot_be_measured) {
  const Depth depth = pinhole_frame(4, 3, [](int, int) { return 1.0; });
  EXPECT_NE(quality_refusal([] { (void)quality({}); }).find("there is no frame"), std::string::npos);
  EXPECT_NE(quality_refusal([&] {
              (void)quality({depth, pinhole_frame(3, 3, [](int, int) { return 1.0; })});
            }).find("frame 1 has another size than frame 0"),
            std::string::npos);
  EXPECT_NE(quality_refusal([] { (void)quality({Depth{}}); }).find("frame 0 has no depth"), std::string::npos);
  EXPECT_NE(quality_refusal([&] {
              (void)quality({depth}, {{2, 0, 3, 1}, "", 0});
            }).find("the region is not in the image"),
            std::string::npos);
  EXPECT_NE(quality_refusal([&] { (void)quality({depth}, {{}, "baslr", 0}); }).find("did you mean \"basler\"?"), std::string::npos);
  EXPECT_NE(quality_refusal([&] { (void)quality({depth}, {{}, "", -1}); }).find("the true distance cannot be -1 m"), std::string::npos);
  Depth dark = depth;
  for (std::size_t i = 0; i < 12; ++i) make_invalid(dark, i);
  EXPECT_NE(quality_refusal([&] { (void)quality({dark, dark}); }).find("no pixel of the region has a depth"), std::string::npos);
  Depth broken = depth;
  broken.flags.pop_back();
  EXPECT_NE(quality_refusal([&] { (void)quality({broken}); }).find("flags has another size than the image"), std::string::npos);
}

// noise_m is honest where the camera knows its ambient light: ten scenes, or a scene seen by another camera.
TEST(quality, noise_of_ten_scenes_is_what_noise_m_says) {
  const std::pair<const char*, const char*> cases[] = {{"card", "azure-kinect-nfov-binned"},
                                                       {"corner", "azure-kinect-nfov-binned"},
                                                       {"step-and-rod", "azure-kinect-nfov-binned"},
                                                       {"demo", "azure-kinect-nfov-binned"},
                                                       {"penumbra", "azure-kinect-nfov-binned"},
                                                       {"card", "opt8241"},
                                                       {"corner", "o3d303"},
                                                       {"card", "o3d303-binned"},
                                                       {"card", "kinect-v2"},
                                                       {"corner", "opt8241"}};
  for (const auto& [scene, profile] : cases) {
    Simulator simulator(load_scene(scene), load_camera(profile, {"", {{"decoding.filter.kind", "none"}}, {}}));
    std::vector<Depth> frames;
    for (std::uint64_t i = 0; i < 6; ++i) frames.push_back(simulator.frame(i).depth);
    const Quality found = quality(frames);
    EXPECT_NEAR(found.noise_chi2, 1, 0.02) << scene << ", " << profile;
    EXPECT_LT(found.noise_chi2_error, 0.01) << scene << ", " << profile;
    for (Depth& depth : frames)
      for (float& noise : depth.noise_m) noise *= 1.02F;
    EXPECT_NEAR(quality(frames).noise_chi2, found.noise_chi2 / (1.02 * 1.02), 1e-3);
  }
}
