// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include "analysis/noise_over_time.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <memory>
#include <random>

#include "analysis/tessellation.h"
#include "tofray/error.h"
#include "tofray/quality.h"
#include "tofray/simulator.h"

namespace tofray::test {
namespace {

using namespace analysis;

constexpr int width = 12, height = 10;

/// Frames of a wall on which pixel 5 is never valid, 7 in every other frame, and 9 and 11 once far behind and before it.
std::vector<Depth> frames_of(int count, double sigma_m, double claimed_m) {
  std::vector<Depth> out;
  std::mt19937 chance(11);
  std::normal_distribution<double> noise(0, sigma_m);
  for (int k = 0; k < count; ++k) {
    Depth one;
    one.width = width, one.height = height;
    for (int i = 0; i < width * height; ++i) {
      const double range = 2 + 0.01 * i + noise(chance) + (k == 3 ? (i == 9 ? 0.2 : i == 11 ? -0.2 : 0) : 0);
      const bool valid = i != 5 && (i != 7 || k % 2 == 0);
      one.range_m.push_back(static_cast<float>(range)), one.z_m.push_back(static_cast<float>(valid ? 0.8 * range : NAN));
      one.noise_m.push_back(static_cast<float>(claimed_m)), one.flags.push_back(valid ? 0 : flag_saturated);
    }
    out.push_back(std::move(one));
  }
  return out;
}

NoiseOverTime taken(const std::vector<Depth>& frames) {
  NoiseOverTime out;
  for (const Depth& one : frames) out.add(one);
  return out;
}

TEST(noise_over_time, is_sigma_and_mean_of_the_frames_in_which_a_pixel_is_valid) {
  const std::vector<Depth> frames = frames_of(20, 0.004, 0.004);
  const NoiseOverTime noise = taken(frames);
  EXPECT_EQ(noise.frames(), 20);
  const auto sigma = noise.sigma_m(), mean = noise.mean_m(), predicted = noise.predicted_m();
  const auto counts = noise.counts();
  for (std::size_t i = 0; i < counts.size(); ++i) {
    std::vector<double> z;
    for (const Depth& one : frames)
      if (one.flags[i] == 0) z.push_back(static_cast<double>(one.z_m[i]));
    ASSERT_EQ(counts[i], z.size());
    if (z.empty()) {
      EXPECT_TRUE(std::isnan(sigma[i]) && std::isnan(mean[i]) && std::isnan(predicted[i]));
      continue;
    }
    double middle = 0, squares = 0;
    for (const double each : z) middle += each / static_cast<double>(z.size());
    for (const double each : z) squares += (each - middle) * (each - middle);
    EXPECT_NEAR(static_cast<double>(mean[i]), middle, 1e-6);
    EXPECT_NEAR(static_cast<double>(sigma[i]), std::sqrt(squares / (static_cast<double>(z.size()) - 1)), 1e-7);
    EXPECT_NEAR(static_cast<double>(predicted[i]), 0.8 * 0.004, 1e-8);
  }
  EXPECT_EQ(counts[5], 0u);
  EXPECT_EQ(counts[7], 10u);
}

TEST(noise_over_time, agrees_with_quality_of_the_same_frames) {
  for (const double claimed : {0.004, 0.003}) {
    const std::vector<Depth> frames = frames_of(40, 0.004, claimed);
    const NoiseSummary summary = taken(frames).summary();
    const Quality all = quality(frames);
    EXPECT_NEAR(summary.chi2, all.noise_chi2, 1e-4 * all.noise_chi2) << "pixels 9 and 11 are left out by both";
    EXPECT_NEAR(summary.chi2, std::pow(0.004 / claimed, 2), 0.2 * summary.chi2);
    EXPECT_NEAR(100 * summary.fill, all.fill_rate_percent, 1e-9);
    EXPECT_NEAR(summary.sigma_median_m, 0.8 * 0.004, 0.0003);
    EXPECT_NEAR(summary.predicted_median_m, 0.8 * claimed, 1e-8);
  }
  EXPECT_GT(quality(frames_of(40, 0.004, 0.004)).outliers_percent, 0);
}

TEST(noise_over_time, of_one_frame_has_no_sigma) {
  const NoiseOverTime noise = taken(frames_of(1, 0.004, 0.004));
  EXPECT_TRUE(std::isnan(noise.sigma_m()[0]));
  EXPECT_FALSE(std::isnan(noise.mean_m()[0]));
  EXPECT_TRUE(std::isnan(noise.summary().sigma_median_m));
  EXPECT_TRUE(std::isnan(NoiseOverTime().summary().fill));
}

TEST(noise_over_time, of_frames_of_two_sizes_is_refused) {
  NoiseOverTime noise = taken(frames_of(1, 0.004, 0.004));
  Depth other = frames_of(1, 0.004, 0.004)[0];
  other.width = height, other.height = width;
  EXPECT_THROW(noise.add(other), Error);
}

/// A mesh that grows.
class Grows : public MeshMotion {
 public:
  void at(double time_s, std::vector<std::array<float, 3>>& vertices, std::vector<std::array<float, 3>>& normals) const override {
    const auto size = static_cast<float>(1 + time_s);
    vertices = {{0, 0, 0}, {size, 0, 0}, {0, size, 0}}, normals.clear();
  }
};

TEST(standing_still, is_the_scene_of_that_moment_at_all_times) {
  Scene scene;
  Object ball, box, mesh, still;
  ball.shape = Sphere{{0, 0, 2}, 0.2};
  ball.keyframes = {{0, {0, 0, 0}, {}}, {4, {0.4, 0, 0}, {{0, 1, 0}, 0.8}}};
  box.shape = Box{{0.5, 0.5, 2}, {0.7, 0.8, 2.3}};
  box.rotation = {{1, 0, 0}, 0.3}, box.position = {0, 0.1, 0};
  box.velocity_m_per_s = {0, 0.1, -0.2}, box.angular_velocity_rad_per_s = {0, 0, 0.7};
  Mesh grows;
  auto triangles = std::make_shared<TriangleMesh>();
  triangles->vertices = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, triangles->triangles = {{0, 1, 2}};
  grows.triangles = triangles, grows.motion = std::make_shared<const Grows>();
  mesh.shape = grows, mesh.position = {-1, 0, 3};
  still.shape = Plane{{0, 0, 4}, {0, 0, -1}}, still.rotation = {{0, 1, 0}, 0.1};
  scene.objects = {ball, box, mesh, still};
  Pose from, to;
  to.position = {0.4, 0, 0}, to.look_at = {0.4, 0, 1};
  scene.camera.keyframes = {{0, from}, {4, to}};
  const Scene stands = standing_still(scene, 1.5);
  EXPECT_EQ(camera_pose(stands, 77), camera_pose(scene, 1.5));
  EXPECT_NEAR(stands.camera.pose.position[0], 0.15, 1e-12);
  // As tessellation.h has it, whose poses are tested against frames.
  for (std::size_t i = 0; i < 4; ++i) {
    const ObjectPose was = pose_of(scene.objects[i], 1.5), is = pose_of(stands.objects[i], 88);
    for (int k = 0; k < 3; ++k) {
      EXPECT_NEAR(is.origin[k], was.origin[k], 1e-12) << i;
      for (int j = 0; j < 3; ++j) EXPECT_NEAR(is.turn.row[k][j], was.turn.row[k][j], 1e-12) << i;
    }
  }
  EXPECT_NEAR(stands.objects[0].position[0], 0.15, 1e-12);
  EXPECT_TRUE(stands.objects[0].keyframes.empty());
  EXPECT_NEAR(stands.objects[1].position[1], 0.1 + 0.15, 1e-12);
  EXPECT_NEAR(stands.objects[1].position[2], -0.3, 1e-12);
  EXPECT_EQ(stands.objects[1].angular_velocity_rad_per_s, (Vec3{0, 0, 0}));
  const auto& shape = std::get<Mesh>(stands.objects[2].shape);
  EXPECT_EQ(shape.motion, nullptr);
  EXPECT_EQ(shape.triangles->vertices[1][0], 2.5f);
  EXPECT_EQ(stands.objects[3].rotation.angle_rad, 0.1) << "what stands still stays as it was";
}

}  // namespace
}  // namespace tofray::test
