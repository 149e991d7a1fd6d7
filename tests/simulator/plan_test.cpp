// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
// The plan of a frame: which passes it takes, in which order.
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "support/pixels.h"
#include "tofray/tofray.h"

using namespace tofray;
using namespace tofray::test;

namespace {

/// "pass: part" of each step.
std::vector<std::string> plan_of(const Scene& scene, const Camera& camera, const SimulatorOptions& options = {}) {
  std::vector<std::string> out;
  for (const PlanStep& step : Simulator(scene, camera, options).plan())
    out.push_back(step.part.empty() ? step.name : step.name + ": " + step.part);
  return out;
}

using Plan = std::vector<std::string>;

}  // namespace

TEST(plan, of_one_look_at_the_scene_is_one_pass) {
  Camera camera = lit_camera(40, 30, 45);
  camera.decoding.flying_check = false;
  EXPECT_EQ(plan_of(wall(1.5), camera), (Plan{"from_rays"}));
  camera.decoding.flying_check = true;
  EXPECT_EQ(plan_of(wall(1.5), camera), (Plan{"from_rays", "flying_pixels", "write_depth"}));
  camera.pixel.column_noise_e = 5;
  EXPECT_EQ(plan_of(wall(1.5), camera), (Plan{"line_noise", "from_rays", "flying_pixels", "write_depth"}));
  camera.pixel.blooming_share = 0.1, camera.pixel.blooming_limit_e = 100;
  EXPECT_EQ(plan_of(wall(1.5), camera), (Plan{"line_noise", "from_rays", "blooming", "flying_pixels", "write_depth"}));
}

// Filters that keep edges come before the check for flying pixels, others after it.
TEST(plan, has_the_filter_before_or_after_flying_pixels) {
  Camera camera = lit_camera(40, 30, 45);
  camera.decoding.filter.kind = ImageFilter::Kind::bilateral;
  EXPECT_EQ(plan_of(wall(1.5), camera),
            (Plan{"from_rays", "range_filter", "write_depth: what the filter left", "flying_pixels", "write_depth"}));
  camera.decoding.filter.kind = ImageFilter::Kind::gaussian;
  EXPECT_EQ(plan_of(wall(1.5), camera), (Plan{"from_rays", "flying_pixels", "range_filter", "write_depth: what the filter left"}));
}

TEST(plan, of_light_that_is_a_sum_goes_through_the_light_image) {
  Camera camera = lit_camera(40, 30, 45);
  camera.decoding.flying_check = false;
  SimulatorOptions options;
  options.subpixel = 2;
  EXPECT_EQ(plan_of(wall(1.5), camera, options),
            (Plan{"from_rays: ground truth", "from_rays: light, sample 1 of 4", "from_rays: light, sample 2 of 4",
                  "from_rays: light, sample 3 of 4", "from_rays: light, sample 4 of 4", "from_arrays: from the light image"}));
  options.truth = false;
  options.subpixel = 1;
  Scene scene = wall(1.5);
  scene.transport.bounces = 2;
  EXPECT_EQ(plan_of(scene, camera, options),
            (Plan{"from_rays: light, sample 1 of 1", "bounces: paths, step 1 of 1", "sum_light", "from_arrays: from the light image"}));
  scene.transport.smooth = true;
  EXPECT_EQ(plan_of(scene, camera, options), (Plan{"from_rays: light, sample 1 of 1", "bounces: paths, step 1 of 1", "smooth", "sum_light",
                                                   "from_arrays: from the light image"}));
}

TEST(plan, asks_for_more_paths_in_rounds) {
  Camera camera = lit_camera(40, 30, 45);
  camera.decoding.flying_check = false;
  Scene scene = wall(1.5);
  scene.transport.bounces = 1, scene.transport.samples = 4, scene.transport.max_samples = 8;
  SimulatorOptions options;
  options.truth = false;
  EXPECT_EQ(plan_of(scene, camera, options),
            (Plan{"from_rays: light, sample 1 of 1", "bounces: paths, step 1 of 2", "path_error", "path_noise",
                  "bounces: paths, step 2 of 2", "path_error", "path_noise", "sum_light", "from_arrays: from the light image"}));
}

TEST(plan, has_each_kernel_of_the_lens) {
  Camera camera = lit_camera(40, 30, 45);
  camera.decoding.flying_check = false;
  camera.pixel.crosstalk_left_right = 0.02;
  SimulatorOptions options;
  options.truth = false;
  EXPECT_EQ(plan_of(wall(1.5), camera, options), (Plan{"from_rays: light, sample 1 of 1", "scatter_rows: kernel 1 of 1",
                                                       "scatter_columns: kernel 1 of 1", "from_arrays: from the light image"}));
}

TEST(plan, counts_pieces_and_leaves_frames_as_they_are) {
  Camera camera = lit_camera(70, 30, 45);
  camera.pixel.row_noise_e = 5;
  Simulator simulator(wall(1.5), camera);
  const std::vector<PlanStep> plan = simulator.plan();
  ASSERT_EQ(plan.size(), 4U);
  EXPECT_EQ(plan[0].over, "raw frames");
  EXPECT_EQ(plan[0].pieces, static_cast<std::int64_t>(camera.mode.sequence.size()));
  EXPECT_EQ(plan[1].over, "tiles");
  EXPECT_EQ(plan[1].pieces, 3 * 4) << "of 32 x 8 pixels";
  EXPECT_EQ(plan[2].over, "bands of rows");
  EXPECT_EQ(plan[2].pieces, 4) << "of 8 rows";
  EXPECT_FALSE(plan[2].does.empty());
  EXPECT_EQ(simulator.frame(1).raw.tap_a, Simulator(wall(1.5), camera).frame(1).raw.tap_a);
}
