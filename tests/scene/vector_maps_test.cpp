// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
// Pictures of normals: what kernels read of them.
#include "scene/vector_maps.h"

#include <gtest/gtest.h>

using namespace tofray;

TEST(vector_maps, of_normals_have_unit_length_and_the_mean_of_their_directions) {
  VectorMap map;
  map.width = 2, map.height = 1;
  map.values = {{3, 0, 4}, {0, -0.5F, 1.2F}};  // of any length: 5, 1.3
  const scene::Levels levels = scene::levels_of_normals(map);
  ASSERT_EQ(levels.size(), 3U);
  const float directions[3][2] = {{0.6F, 0}, {0, -0.5F / 1.3F}, {0.8F, 1.2F / 1.3F}};
  for (std::size_t k = 0; k < 3; ++k) {
    const std::vector<float>& texels = levels[k]->texels;
    ASSERT_GE(texels.size(), 3U);
    EXPECT_FLOAT_EQ(texels[0], directions[k][0]) << k;
    EXPECT_FLOAT_EQ(texels[1], directions[k][1]) << k;
    EXPECT_FLOAT_EQ(texels[2], (directions[k][0] + directions[k][1]) / 2) << k;  // the level of one texel
  }
}
