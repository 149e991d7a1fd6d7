// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
// Simulators of one process share rays, tables and hierarchies: none may get what another one's numbers make.
#include <gtest/gtest.h>

#include <algorithm>
#include <memory>

#include "base/shared.h"
#include "support/members.h"
#include "support/meshes.h"
#include "support/pixels.h"
#include "support/same_frame.h"
#include "support/whole_pixel.h"

using namespace tofray;
using namespace tofray::test;

namespace {

SimulatorOptions two_samples() {
  SimulatorOptions options;
  options.threads = 1, options.subpixel = 2, options.seed = 3;
  return options;
}

/// With a pattern as a table, all effects and two modulation frequencies.
Camera rich_camera() {
  Camera c = lit_camera(6, 4, 5);
  turn_on_every_effect(c);
  c.lens.k1 = 0.05, c.lens.k2 = 0.01, c.lens.k3 = 0.001, c.lens.p1 = 1e-3, c.lens.p2 = -1e-3;
  c.lens.vignetting = Lens::Vignetting::table, c.lens.vignetting_table = {{0, 0.5, 1.2}, {1, 0.8, 0.3}};
  c.lens.scatter = {Scatter::Kind::gaussians, 0.1, {1, 2}, {2, 1}, {}, 0, 0};
  Illumination& light = c.illumination[0];
  light.power_w = 5;
  light.waveform.kind = Waveform::Kind::rectangular, light.waveform.harmonics = 2;
  light.pattern.kind = Pattern::Kind::table, light.pattern.columns = 3, light.pattern.rows = 2;
  light.pattern.half_range_x_rad = light.pattern.half_range_y_rad = 0.9, light.pattern.samples = {1, 2, 3, 4, 5, 6};
  for (int k = 0; k < 4; ++k) c.mode.sequence.push_back({true, 1.5 * c.mode.sequence[0].modulation_frequency_hz, k * pi / 2, 1e-3});
  return c;
}

Camera flat_top_camera() {
  Camera c = rich_camera();
  c.lens.distortion = Lens::Distortion::fisheye, c.lens.vignetting = Lens::Vignetting::cos4;
  c.illumination[0].pattern = {};
  c.illumination[0].pattern.kind = Pattern::Kind::flat_top;
  c.illumination[0].pattern.width_rad = 1, c.illumination[0].pattern.height_rad = 0.8;
  return c;
}

/// Nothing where the camera makes no sense.
std::unique_ptr<Frame> frame_of(const Scene& scene, const Camera& camera) {
  try {
    return std::make_unique<Frame>(Simulator(scene, camera, two_samples()).frame(0));
  } catch (const Error&) {
    return nullptr;
  }
}

/// Each number of the camera in turn is changed a little: what a simulator of it finds of one that had the number before, changes nothing.
void expect_each_number_counts(const Camera& given) {
  const Scene scene = sunny_wall();
  int compared = 0;
  const auto compare = [&](const Camera& changed, const std::string& path) {
    base::forget_kept();
    const auto alone = frame_of(scene, changed);
    if (alone == nullptr) return;
    base::forget_kept();
    const Simulator before(scene, given, two_samples());
    const auto after = frame_of(scene, changed);
    ASSERT_NE(after, nullptr) << path;
    EXPECT_EQ(first_difference(*alone, *after), "") << path;
    ++compared;
  };
  Camera changed = given;
  each_member(changed, [&](const model::Row&, const model::Slot& slot, const std::string& path) {
    each_real(slot, [&](double& number) {
      const double was = number;
      number = was == 0 ? 1e-3 : 1.03 * was;
      compare(changed, path);
      number = was;
    });
    if (auto* const* whole = std::get_if<int*>(&slot)) {
      ++**whole;
      compare(changed, path);
      --**whole;
    }
    if (const auto* choice = std::get_if<model::ChoiceSlot>(&slot)) {
      const int was = choice->get(choice->at);
      choice->set(choice->at, was == 0 ? 1 : 0);
      compare(changed, path);
      choice->set(choice->at, was);
    }
  });
  EXPECT_GE(compared, 100);
}

}  // namespace

TEST(simulators_of_one_process, share_no_result_of_another_lens_light_or_pixel) {
  expect_each_number_counts(rich_camera());
  expect_each_number_counts(flat_top_camera());
}

TEST(simulators_of_one_process, share_no_hierarchy_of_another_mesh) {
  Scene scene = wall(2);
  scene.materials.push_back({"grey", Material::Brdf::lambert, 0.4, 0, 1});
  const auto mesh = std::make_shared<TriangleMesh>();
  mesh->vertices = {{-0.5F, -0.5F, 0}, {0.5F, -0.5F, 0}, {0.5F, 0.5F, 0}, {-0.5F, 0.5F, 0}};
  mesh->triangles = {{0, 1, 2}, {0, 2, 3}};
  Mesh shown;
  shown.triangles = mesh;
  scene.objects.push_back(object(shown, 1));
  scene.objects.back().position = {0, 0, 1};
  const Camera camera = lit_camera(16, 12, 14);
  const auto simulated = [&] { return Simulator(scene, camera, two_samples()).frame(0); };
  const auto covered = [](const Frame& frame) { return std::count(frame.truth.object_id.begin(), frame.truth.object_id.end(), 1); };
  const Frame whole = simulated();
  // A list of triangles, changed in place by its owner, between two simulators.
  mesh->triangles.pop_back();
  const Frame half = simulated();
  EXPECT_LT(covered(half), covered(whole));
  EXPECT_GT(covered(half), 0);
  for (auto& vertex : mesh->vertices) vertex[0] *= 0.5F;
  EXPECT_LT(covered(simulated()), covered(half));
  mesh->shades = {0.5F, 0.5F, 0.5F, 0.5F};
  const Frame shaded = simulated();
  base::forget_kept();
  EXPECT_EQ(first_difference(shaded, simulated()), "");
  EXPECT_NE(first_difference(shaded, half), "");
}

TEST(simulators_of_one_process, compute_the_same_on_any_number_of_threads_that_find_the_rays) {
  Camera camera = lit_camera(160, 120, 130);
  camera.lens.k1 = -0.1, camera.lens.k2 = 0.02, camera.lens.p1 = 1e-3;
  std::unique_ptr<Frame> first;
  for (const int threads : {1, 2, 5, 0}) {
    base::forget_kept();
    SimulatorOptions options;
    options.threads = threads;
    auto frame = std::make_unique<Frame>(Simulator(wall(1), camera, options).frame(0));
    if (first == nullptr)
      first = std::move(frame);
    else
      EXPECT_EQ(first_difference(*first, *frame), "") << threads;
  }
}
