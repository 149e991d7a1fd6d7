// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <set>

#include "support/files.h"
#include "support/own_arrays.h"
#include "support/quarter.h"
#include "tofray/tofray.h"

using namespace tofray;
using namespace tofray::test;

class material_id : public testing::TestWithParam<std::string> {};

TEST_P(material_id, is_that_of_the_object_that_is_seen) {
  const Scene scene = load_scene(GetParam());
  const Frame frame = Simulator(scene, camera_of(scene), {.noise = Noise::off}).frame(3);
  const Truth& truth = frame.truth;
  ASSERT_EQ(truth.material_id.size(), truth.object_id.size());
  for (std::size_t i = 0; i < truth.object_id.size(); ++i) {
    const std::int32_t object = truth.object_id[i];
    ASSERT_EQ(truth.material_id[i], object < 0 ? -1 : scene.objects[static_cast<std::size_t>(object)].material) << "pixel " << i;
  }
}

INSTANTIATE_TEST_SUITE_P(of_every_scene, material_id, testing::ValuesIn(scene_names()),
                         [](const auto& which) { return test_name(which.param); });

TEST(material_id, is_shared_by_objects_and_none_where_nothing_is_seen) {
  Scene scene;
  for (const double reflectivity : {0.2, 0.8}) scene.materials.push_back({"", Material::Brdf::lambert, reflectivity, 0, 1});
  for (const auto& [x, material] : {std::pair(-0.4, 1), std::pair(0.0, 0), std::pair(0.4, 1)})
    scene.objects.push_back({"", Sphere{{x, 0, 1}, 0.1}, material});
  const Frame frame = Simulator(scene, load_camera("pico-flexx")).frame(0);
  const auto at = [&](int u) { return frame.truth.material_id[static_cast<std::size_t>(86 * 224 + u)]; };
  // fx = 212 px: a sphere 0.4 m aside at 1 m is 85 px from the middle
  EXPECT_EQ(at(112 - 85), 1);
  EXPECT_EQ(at(112), 0);
  EXPECT_EQ(at(112 + 85), 1);
  EXPECT_EQ(at(112 + 42), -1);
}
