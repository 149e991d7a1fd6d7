// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
// From inside a closed mesh every ray hits, however close to a vertex or an edge, and however far the mesh is from zero.
#include <gtest/gtest.h>

#include <algorithm>

#include "support/meshes.h"
#include "support/random.h"
#include "support/rays.h"

using namespace tofray;
using namespace tofray::base;
using tofray::test::ClosedMesh;
using tofray::test::Random;

namespace {

/// A mesh somewhere in space, seen from inside.
struct Inside {
  ClosedMesh mesh;
  Vec3 origin;
  test::Seen seen;
  scene::FormsOf<shape::Triangle> forms{};

  Inside(int cuts, double offset, std::uint64_t seed) : mesh(test::icosphere(cuts)) {
    Random random(seed);
    const Vec3 shift = offset * Vec3{1, -0.7, 0.4};
    for (Vec3& v : mesh.vertices) v = random.between(0.8, 1.25) * v + shift;
    const Vec3 aside = random.point(0.15);
    origin = aside + shift;
    seen = mesh.seen(origin);
    forms = seen.forms().of<shape::Triangle>();
  }
  [[nodiscard]] bool hits(const test::Ray& ray, std::size_t i) const { return inverse_range(forms.at[i], ray) > 0; }
  /// Those that should be hit are tried first, all others only where these fail.
  [[nodiscard]] bool missed(const test::Ray& ray, const std::vector<std::size_t>& likely) const {
    for (const std::size_t i : likely) {
      if (hits(ray, i)) return false;
    }
    for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
      if (hits(ray, i)) return false;
    }
    return true;
  }
};

class Watertight : public testing::TestWithParam<double> {};

}  // namespace

// (Of the offsets together.)
TEST_P(Watertight, no_ray_of_ten_million_leaves) {
  const Inside scene(0, GetParam(), 1);
  ASSERT_EQ(scene.forms.count, 20);
  Random random(2);
  int missed = 0;
  for (int i = 0; i < 3'400'000; ++i) {
    // within a cube, which is quicker to draw than a sphere and covers all directions as well
    const Vec3 d = random.point(1);
    missed += scene.missed(test::ray(d), {});
  }
  EXPECT_EQ(missed, 0);
}

TEST_P(Watertight, no_ray_leaves_through_a_vertex) {
  const Inside scene(3, GetParam(), 3);
  std::vector<std::vector<std::size_t>> around(scene.mesh.vertices.size());
  for (std::size_t i = 0; i < scene.mesh.triangles.size(); ++i) {
    for (const int v : scene.mesh.triangles[i]) around[static_cast<std::size_t>(v)].push_back(i);
  }
  Random random(4);
  int missed = 0;
  for (std::size_t i = 0; i < 1000000; ++i) {
    const std::size_t v = i % around.size();
    const double stretch = random.between(0.5, 2);
    missed += scene.missed(test::ray(stretch * (scene.mesh.vertices[v] - scene.origin)), around[v]);
  }
  EXPECT_EQ(missed, 0);
}

TEST_P(Watertight, no_ray_leaves_through_an_edge) {
  const Inside scene(3, GetParam(), 5);
  struct Edge {
    int a, b;
    std::vector<std::size_t> triangles;
  };
  std::map<std::pair<int, int>, Edge> edges;
  for (std::size_t i = 0; i < scene.mesh.triangles.size(); ++i) {
    const auto& t = scene.mesh.triangles[i];
    for (std::size_t k = 0; k < 3; ++k) {
      const int a = std::min(t[k], t[(k + 1) % 3]), b = std::max(t[k], t[(k + 1) % 3]);
      Edge& edge = edges[{a, b}];
      edge.a = a, edge.b = b;
      edge.triangles.push_back(i);
    }
  }
  Random random(6);
  int missed = 0;
  for (int i = 0, round = 0; i < 1000000; ++round) {
    for (const auto& [key, edge] : edges) {
      const double share = round % 2 == 0 ? 0.5 : random.uniform(), stretch = random.between(0.5, 2);
      const Vec3 p = (1 - share) * scene.mesh.at(edge.a) + share * scene.mesh.at(edge.b);
      missed += scene.missed(test::ray(stretch * (p - scene.origin)), edge.triangles);
      ++i;
    }
  }
  EXPECT_EQ(missed, 0);
}
INSTANTIATE_TEST_SUITE_P(offset, Watertight, testing::Values(0.0, 1e3, 1.5e5));

// Vertices that single precision holds, seen from zero: the ray meets them exactly, and the sign of each edge is nothing but rounding.
TEST(watertight, no_ray_leaves_through_a_vertex_that_it_meets_exactly) {
  Random random(7);
  int missed = 0;
  for (int i = 0; i < 200000; ++i) {
    const int sides = 4 + random.below(5);  // the tip lies within: no gap reaches half a turn
    const auto single = [](const Vec3& v) { return test::direction(test::ray(v)); };
    const Vec3 axis = random.direction(), x = random.across(axis), y = cross(axis, x);
    const Vec3 tip = single(random.scale(0.1, 10) * axis);
    test::Seen fan;
    std::vector<Vec3> rim;
    for (int k = 0; k < sides; ++k) {
      const double angle = 2 * std::acos(-1.0) * (k + random.between(-0.3, 0.3)) / sides;
      rim.push_back(single(tip + random.between(0.1, 0.3) * (std::cos(angle) * x + std::sin(angle) * y)));
    }
    for (std::size_t k = 0; k < rim.size(); ++k)
      fan.add(shape::Triangle{{test::vec(tip), test::vec(rim[k]), test::vec(rim[(k + 1) % rim.size()])}}, {0, 0, 0});
    const auto forms = fan.forms().of<shape::Triangle>();
    bool hit = false;
    for (int k = 0; k < forms.count; ++k) hit = hit || inverse_range(forms.at[k], test::ray(tip)) > 0;
    missed += !hit;
  }
  EXPECT_EQ(missed, 0);
}
