// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
// Meshes that need no file.
#include "assets/builtin_mesh.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "base/vec.h"

using namespace tofray;

namespace {

Vec3 vertex(const TriangleMesh& mesh, std::int32_t i) {
  const auto& v = mesh.vertices.at(static_cast<std::size_t>(i));
  return {v[0], v[1], v[2]};
}

Vec3 normal(const TriangleMesh& mesh, const std::array<std::int32_t, 3>& t) {
  using base::operator-;
  return base::cross(vertex(mesh, t[1]) - vertex(mesh, t[0]), vertex(mesh, t[2]) - vertex(mesh, t[0]));
}

/// Each edge belongs to two triangles, which pass it in opposite directions.
std::size_t edges_once_each_way(const TriangleMesh& mesh) {
  std::set<std::pair<std::int32_t, std::int32_t>> edges;
  for (const auto& t : mesh.triangles)
    for (std::size_t k = 0; k < 3; ++k) EXPECT_TRUE(edges.emplace(t[k], t[(k + 1) % 3]).second);
  std::size_t both = 0;
  for (const auto& [a, b] : edges) both += edges.count({b, a});
  return both;
}

}  // namespace

TEST(bumpy_ball, is_an_icosahedron_before_it_is_cut) {
  const TriangleMesh ball = assets::bumpy_ball(0);
  ASSERT_EQ(ball.vertices.size(), 12U);
  ASSERT_EQ(ball.triangles.size(), 20U);
  for (const auto& t : ball.triangles)
    for (std::size_t k = 0; k < 3; ++k) {
      const Vec3 a = base::normalized(vertex(ball, t[k])), b = base::normalized(vertex(ball, t[(k + 1) % 3]));
      EXPECT_NEAR(base::dot(a, b), 1 / std::sqrt(5.0), 1e-6);
    }
  EXPECT_EQ(edges_once_each_way(ball), 60U);
}

TEST(bumpy_ball, is_closed_round_and_bumpy) {
  const TriangleMesh ball = assets::bumpy_ball(4);
  ASSERT_EQ(ball.triangles.size(), 20U * 256);
  ASSERT_EQ(ball.vertices.size(), 10U * 256 + 2);
  EXPECT_EQ(edges_once_each_way(ball), 60U * 256);
  double least = 1, most = 0, shortest = 2, longest = 0;
  for (const auto& t : ball.triangles) {
    EXPECT_GT(base::dot(normal(ball, t), vertex(ball, t[0])), 0) << "faces outward";
    const Vec3 a = base::normalized(vertex(ball, t[0])), b = base::normalized(vertex(ball, t[1]));
    using base::operator-;
    shortest = std::min(shortest, base::length(a - b)), longest = std::max(longest, base::length(a - b));
    least = std::min(least, base::length(vertex(ball, t[0]))), most = std::max(most, base::length(vertex(ball, t[0])));
  }
  EXPECT_LT(longest, 1.4 * shortest) << "cut evenly";
  EXPECT_GE(least, 0.46 - 1e-6);
  EXPECT_LE(most, 0.54 + 1e-6);
  EXPECT_GT(most - least, 0.05);
}

TEST(wavy_floor, is_flat_but_for_its_waves) {
  const TriangleMesh floor = assets::wavy_floor(40);
  ASSERT_EQ(floor.vertices.size(), 41U * 41);
  ASSERT_EQ(floor.triangles.size(), 2U * 1600);
  const auto wave = [](double x) { return std::cos(5 * std::acos(x)); };  // Chebyshev's polynomial of degree 5
  for (const auto& v : floor.vertices)
    EXPECT_NEAR(v[1], 0.02 * wave(std::clamp<double>(v[0] / 2, -1, 1)) * wave(std::clamp<double>(v[2] / 2, -1, 1)), 1e-6);
  double area = 0;
  for (const auto& t : floor.triangles) {
    const Vec3 n = normal(floor, t);
    EXPECT_GT(n[1] * normal(floor, floor.triangles[0])[1], 0) << "all face one way";
    area += std::abs(n[1]) / 2;
  }
  EXPECT_NEAR(area, 16, 1e-5) << "4 m x 4 m, each part once";
}
