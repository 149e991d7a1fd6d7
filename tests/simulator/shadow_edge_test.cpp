// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
// Where shadows end.
#include <gtest/gtest.h>

#include "support/pixels.h"

using namespace tofray;
using namespace tofray::test;

namespace {

constexpr double wall_z = 2, screen_z = 1;

/// A screen that covers everything beyond x > edge at 1 m, before a wall at 2 m; camera at zero, lights at z = 0.
Scene screen_before_wall(double edge) {
  Scene scene = wall(wall_z);
  scene.objects.push_back(object(Triangle{{{{edge, -50, screen_z}, {edge, 50, screen_z}, {edge + 80, 0, screen_z}}}}));
  return scene;
}

/// One row of pixels across the wall, and what the light makes of each.
struct Row {
  int width;
  double focal;
  Truth t;
  [[nodiscard]] double x_on_wall(double column) const { return (column - 0.5 * (width - 1)) / focal * wall_z; }
  /// Column between the last pixel of the wall that is lit and the first that is dark, going right.
  [[nodiscard]] double edge_column() const {
    for (int i = 0; i + 1 < width; ++i) {
      const auto k = static_cast<std::size_t>(i);
      if (t.irradiance_w_m2[k] > 0 && !(t.irradiance_w_m2[k + 1] > 0)) return i + 0.5;
    }
    return -1;
  }
};

Row look(const Scene& scene, const std::vector<Vec3>& lights, int width, double focal, double center_column_shift = 0) {
  Camera camera = plain_camera(width, 1, focal);
  camera.lens.cx_px += center_column_shift;
  for (const Vec3& position : lights) {
    camera.illumination.push_back(one_watt_per_steradian(position));
    camera.illumination.back().pattern.kind = Pattern::Kind::lambertian;
  }
  return {width, focal, truth(scene, camera)};
}

}  // namespace

// The screen's edge is seen at x = 0.2 on the wall (twice 0.1); the shadow of a light at b begins at 0.2 − b.
TEST(shadow, begins_where_similar_triangles_say) {
  const double edge = 0.1;
  for (const double beside : {-0.05, -0.1, -0.2, -0.4}) {
    const Row row = look(screen_before_wall(edge), {{beside, 0, 0}}, 400, 400);
    // the shadow lies behind the screen: nothing of the wall that is seen is dark
    EXPECT_GT(beside + (edge - beside) * wall_z / screen_z, edge * wall_z);
    for (int i = 0; i < row.width; ++i) {
      if (row.t.object_id[static_cast<std::size_t>(i)] != 0) continue;
      EXPECT_GT(row.t.irradiance_w_m2[static_cast<std::size_t>(i)], 0) << i;
    }
  }
  for (const double beside : {0.01547, 0.05, 0.1, 0.3}) {
    const Row row = look(screen_before_wall(edge), {{beside, 0, 0}}, 400, 400);
    const double expected = beside + (edge - beside) * wall_z / screen_z, column = row.edge_column();
    ASSERT_GT(column, 0);
    EXPECT_EQ(row.t.object_id[static_cast<std::size_t>(column) + 1], 0);
    EXPECT_NEAR((row.x_on_wall(column) - expected) / (wall_z / 400), 0, 0.5) << beside;
  }
}

// Light at the camera's place sees what the camera sees: no shadow at all.
TEST(shadow, is_unseen_from_the_light_itself) {
  const Row row = look(screen_before_wall(0.1), {{0, 0, 0}}, 400, 400);
  for (const float e : row.t.irradiance_w_m2) EXPECT_GT(e, 0);
}

// Eight lights in a row of width s make a stair from full light to none of width w = s(z2 − z1)/z1, in eight equal steps.
TEST(shadow, of_an_area_light_has_a_penumbra_of_the_right_width) {
  const double s = 0.07, first = 0.1, edge = 0.05;
  std::vector<Vec3> lights;
  for (int i = 0; i < 8; ++i) lights.push_back({first + s * i / 7, 0, 0});
  // a telescope: 20 000 px of focal length, one pixel is 0.1 mm on the wall
  const double focal = 20000, middle = 2 * edge - first - 0.5 * s;
  const Row row = look(screen_before_wall(edge), lights, 1600, focal, -middle / wall_z * focal);
  std::vector<double> steps;
  for (std::size_t i = 0; i + 1 < row.t.irradiance_w_m2.size(); ++i) {
    const double here = static_cast<double>(row.t.irradiance_w_m2[i]), next = static_cast<double>(row.t.irradiance_w_m2[i + 1]);
    if (here - next > 0.01 * here) steps.push_back((static_cast<double>(i) + 0.5));
  }
  ASSERT_EQ(steps.size(), 8u);
  EXPECT_EQ(row.t.irradiance_w_m2.back(), 0);
  const double width = (steps.back() - steps.front()) / focal * wall_z;
  EXPECT_NEAR(width, s * (wall_z - screen_z) / screen_z, 0.01 * s);
  for (std::size_t i = 1; i < 8; ++i) EXPECT_NEAR((steps[i] - steps[i - 1]) / focal * wall_z, s / 7, 2 * wall_z / focal);
}
