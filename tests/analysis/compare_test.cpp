// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
// What compare() says of two images against what was put between them.
#include "tofray/compare.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>
#include <numeric>
#include <random>

#include "tofray/error.h"
#include "tofray/load.h"
#include "tofray/simulator.h"

using namespace tofray;

namespace {

constexpr float nothing_there = std::numeric_limits<float>::quiet_NaN();

Depth z_image(int width, int height, const std::function<double(int, int)>& z_of) {
  Depth out;
  out.width = width, out.height = height;
  for (int v = 0; v < height; ++v)
    for (int u = 0; u < width; ++u) out.z_m.push_back(static_cast<float>(z_of(u, v)));
  out.range_m = out.z_m;
  out.flags.assign(out.z_m.size(), 0);
  return out;
}

std::string comparison_refusal(const std::function<void()>& call) {
  try {
    call();
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::bad_input);
    return error.what();
  }
  return "nothing was wrong";
}

}  // namespace

TEST(compare, says_what_is_between_two_images) {
  const Depth b = z_image(4, 1, [](int, int) { return 2.0; });
  const Depth a = z_image(4, 1, [](int u, int) { return 2 + (u == 3 ? 0.04 : 0.01 * (u - 1)); });  // -10, 0, 10, 40 mm
  const Comparison found = compare(a, b);
  EXPECT_EQ(found.all.pixels, 4);
  EXPECT_NEAR(found.all.bias_m, 0.01, 1e-6);
  EXPECT_NEAR(found.all.median_m, 0.005, 1e-6);
  EXPECT_NEAR(found.all.sigma_m, std::sqrt((4e-4 + 1e-4 + 0 + 9e-4) / 3), 1e-6);
  EXPECT_NEAR(found.all.spread_m, 1.4826 * 0.010, 1e-6);  // 15, 5, 5, 35 mm from the median
  EXPECT_NEAR(found.all.rmse_m, std::sqrt((1e-4 + 0 + 1e-4 + 16e-4) / 4), 1e-6);
  EXPECT_NEAR(found.all.p50_m, 0.010, 1e-6);
  EXPECT_NEAR(found.all.p95_m, 0.010 + 0.85 * 0.030, 1e-6);
  EXPECT_NEAR(found.map_m[3], 0.04, 1e-6);
  EXPECT_EQ(std::accumulate(found.histogram.begin(), found.histogram.end(), std::int64_t{0}), 4);
  CompareRequest shifted;
  shifted.fit_shift = true;
  EXPECT_NEAR(compare(a, b, shifted).shift_m, 0.005, 1e-6);
  EXPECT_NEAR(compare(a, b, shifted).all.median_m, 0, 1e-6);
}

TEST(compare, drops_no_pixel_without_saying_so) {
  Depth a = z_image(6, 1, [](int, int) { return 1.0; });
  Depth b = a;
  a.z_m[0] = nothing_there, a.flags[0] = flag_saturated;
  b.z_m[1] = b.z_m[5] = 0;
  a.z_m[2] = b.z_m[2] = nothing_there;
  const Comparison found = compare(a, b);
  EXPECT_EQ(found.pixels, 6);
  EXPECT_EQ(found.both, 2);
  EXPECT_EQ(found.only_a, 2);
  EXPECT_EQ(found.only_b, 1);
  EXPECT_EQ(found.neither, 1);
  EXPECT_TRUE(std::isnan(found.map_m[0]) && !std::isnan(found.map_m[3]));
  ASSERT_EQ(found.by_flag.size(), 1U);
  EXPECT_EQ(found.by_flag[0].flag, "saturated");
  EXPECT_EQ(found.by_flag[0].only_in_b, 1);
  EXPECT_EQ(found.by_flag[0].of.pixels, 0);
}

TEST(compare, parts_pixels_by_distance_in_b) {
  const Depth b = z_image(40, 1, [](int u, int) { return 1 + 0.01 * u; });
  const Depth a = z_image(40, 1, [](int u, int) { return 1 + 0.01 * u + (u < 20 ? 0.001 : 0.002); });
  CompareRequest request;
  request.distances_m = {1, 1.195, 1.305};
  const Comparison found = compare(a, b, request);
  ASSERT_EQ(found.by_distance.size(), 2U);
  EXPECT_EQ(found.by_distance[0].of.pixels, 20);
  EXPECT_NEAR(found.by_distance[0].of.bias_m, 0.001, 1e-6);
  EXPECT_EQ(found.by_distance[1].of.pixels, 11);  // 31 to 39 are beyond
  EXPECT_NEAR(found.by_distance[1].of.bias_m, 0.002, 1e-6);
  std::int64_t all = 0;
  for (const DifferencesAt& one : compare(a, b).by_distance) all += one.of.pixels;
  EXPECT_EQ(all, 40);
}

TEST(compare, calls_two_pixels_on_either_side_of_a_step_the_edge) {
  const Depth b = z_image(20, 3, [](int u, int) { return u < 10 ? 1.0 : 1.2; });
  const Depth a = z_image(20, 3, [](int u, int) { return u < 10 ? 1.0 : 1.2 + (u < 12 ? 0.01 : 0); });
  const Comparison found = compare(a, b);
  EXPECT_EQ(found.edges.pixels, 3 * 4);
  EXPECT_EQ(found.flats.pixels, 3 * 16);
  EXPECT_NEAR(found.edges.bias_m, 0.005, 1e-6);
  EXPECT_EQ(found.flats.rmse_m, 0);
  CompareRequest request;
  request.edge_step_m = 0.3;
  EXPECT_EQ(compare(a, b, request).edges.pixels, 0);
  request.edge_step_m = 0.05, request.edge_px = 0;
  EXPECT_EQ(compare(a, b, request).edges.pixels, 0);
}

TEST(compare, chi2_is_one_where_noise_m_is_the_noise) {
  std::mt19937 random(3);
  std::normal_distribution<double> normal;
  Depth a = z_image(100, 100, [&](int, int) { return 2 + 0.003 * normal(random); }),
        b = z_image(100, 100, [&](int, int) { return 2 + 0.004 * normal(random); });
  a.noise_m.assign(10000, 0.003F), b.noise_m.assign(10000, 0.004F);
  const Comparison honest = compare(a, b);
  EXPECT_NEAR(honest.chi2, 1, 4 * honest.chi2_error);
  EXPECT_NEAR(honest.chi2_error, std::sqrt(2 / 1e4), 1e-3);
  EXPECT_EQ(honest.chi2_pixels, 10000);
  a.range_m[7] += 1.875F;  // a wrong cycle
  EXPECT_EQ(compare(a, b).chi2_outliers, 1);
  EXPECT_NEAR(compare(a, b).chi2, honest.chi2, 2e-3);
  for (float& noise : a.noise_m) noise = 0.0015F;
  EXPECT_NEAR(compare(a, b).chi2, 25 / (2.25 + 16), 0.06);
  Depth truth = z_image(100, 100, [](int, int) { return 2.0; });
  EXPECT_NEAR(compare(b, truth).chi2, 1, 0.06);
  truth.range_m.clear();
  EXPECT_TRUE(std::isnan(compare(b, truth).chi2));
}

TEST(compare, noise_of_two_frames_is_what_noise_m_says) {
  for (const char* scene : {"card", "corner", "step-and-rod"}) {
    Simulator simulator(load_scene(scene), load_camera("azure-kinect-nfov-binned", {"", {{"decoding.filter.kind", "none"}}, {}}));
    const Comparison found = compare(simulator.frame(0).depth, simulator.frame(1).depth);
    EXPECT_NEAR(found.chi2, 1, 0.02) << scene;
    EXPECT_GT(found.chi2_pixels, 30000) << scene;
  }
}

TEST(compare, range_is_not_z_and_amplitudes_are_correlated) {
  Depth a = z_image(30, 20, [](int, int) { return 1.0; }), b = a;
  for (float& range : a.range_m) range = 1.5F;
  for (int i = 0; i < 600; ++i) a.amplitude_e.push_back(static_cast<float>(i)), b.amplitude_e.push_back(static_cast<float>(1000 - i));
  EXPECT_EQ(compare(a, b).all.bias_m, 0);
  EXPECT_NEAR(compare(a, b).amplitude_correlation, -1, 1e-9);
  CompareRequest range;
  range.range = true;
  EXPECT_NEAR(compare(a, b, range).all.bias_m, 0.5, 1e-6);
}

TEST(compare, refuses_what_cannot_be_compared) {
  const Depth a = z_image(4, 3, [](int, int) { return 1.0; });
  EXPECT_NE(comparison_refusal([&] { (void)compare(a, z_image(3, 4, [](int, int) { return 1.0; })); }).find("got 4 x 3 and 3 x 4"),
            std::string::npos);
  EXPECT_NE(comparison_refusal([&] { (void)compare(a, Depth{}); }).find("B has no depth"), std::string::npos);
  EXPECT_NE(comparison_refusal([&] { (void)compare(a, z_image(4, 3, [](int, int) { return 0.0; })); }).find("no pixel has a depth in both"),
            std::string::npos);
  CompareRequest request;
  request.distances_m = {2, 1};
  EXPECT_NE(comparison_refusal([&] { (void)compare(a, a, request); }).find("do not rise"), std::string::npos);
  request = {}, request.range = true;
  Depth z_alone = a;
  z_alone.range_m.clear();
  EXPECT_NE(comparison_refusal([&] { (void)compare(a, z_alone, request); }).find("B has no range"), std::string::npos);
  request = {}, request.region = {0, 0, 5, 3};
  EXPECT_NE(comparison_refusal([&] { (void)compare(a, a, request); }).find("the region is not in the image"), std::string::npos);
}
