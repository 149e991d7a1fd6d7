// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
// Boxes within boxes: every triangle in one leaf, every box round what it holds, never too deep.
#include "scene/hierarchy.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <set>

#include "support/meshes.h"
#include "support/random.h"
#include "support/sanitizers.h"

using namespace tofray;
using namespace tofray::test;
using namespace tofray::base;

namespace {

struct Walk {
  const scene::Hierarchy& built;
  const TriangleMesh& mesh;
  std::multiset<std::int32_t> numbers = {};
  int deepest = 0, triangles = 0;

  void node(std::int32_t index, int level, const float* low, const float* high) {
    deepest = std::max(deepest, level);
    const shape::MeshNode& node = built.nodes.at(static_cast<std::size_t>(index));
    ASSERT_LE(node.children, shape::mesh_width);
    for (int i = 0; i < node.children; ++i) {
      float its_low[3], its_high[3];
      for (int k = 0; k < 3; ++k) {
        its_low[k] = node.low[k][i], its_high[k] = node.high[k][i];
        ASSERT_GE(its_low[k], low[k]);
        ASSERT_LE(its_high[k], high[k]);
      }
      if (node.child[i] >= 0)
        this->node(node.child[i], level + 1, its_low, its_high);
      else
        leaf(node.child[i], its_low, its_high);
    }
  }

  void leaf(std::int32_t code, const float* low, const float* high) {
    const int count = shape::count_of(code);
    ASSERT_GT(count, 0);
    ASSERT_LE(count, shape::block_width);
    const shape::MeshTriangles& block = built.triangles.at(static_cast<std::size_t>(shape::block_of(code)));
    triangles += count;
    for (int i = 0; i < shape::block_width; ++i) {
      if (i < count) numbers.insert(block.number[i]);
      ASSERT_EQ(numbers.count(block.number[i]), 1U);
      for (std::size_t c = 0; c < 3; ++c)
        for (std::size_t k = 0; k < 3; ++k) {
          ASSERT_TRUE(block.corner[c][k][i] >= low[k] && block.corner[c][k][i] <= high[k]);
          const auto& corners = mesh.triangles[static_cast<std::size_t>(block.number[i])];
          ASSERT_EQ(block.corner[c][k][i], mesh.vertices[static_cast<std::size_t>(corners[c])][k]);
        }
    }
  }
};

void check(const TriangleMesh& mesh, const scene::Hierarchy& built) {
  ASSERT_FALSE(built.nodes.empty());
  constexpr float all = std::numeric_limits<float>::infinity();
  const float low[3] = {-all, -all, -all}, high[3] = {all, all, all};
  Walk walk{built, mesh};
  walk.node(0, 1, low, high);
  ASSERT_EQ(walk.triangles, static_cast<int>(mesh.triangles.size()));
  ASSERT_EQ(walk.numbers.size(), mesh.triangles.size());
  std::int32_t next = 0;
  for (const std::int32_t number : walk.numbers) ASSERT_EQ(number, next++);
  EXPECT_LE(walk.deepest, shape::most_mesh_levels);
}

void check(const TriangleMesh& mesh) { check(mesh, scene::build_hierarchy(mesh)); }

/// Small triangles, each with corners of its own about a place.
template <class Place>
TriangleMesh crumbs(int count, const Place& place) {
  TriangleMesh out;
  for (int i = 0; i < count; ++i) {
    const auto [at, size] = place(i);
    for (int c = 0; c < 3; ++c) {
      out.vertices.push_back(at);
      if (c > 0) out.vertices.back()[static_cast<std::size_t>(c)] += size;
    }
    out.triangles.push_back({3 * i, 3 * i + 1, 3 * i + 2});
  }
  return out;
}
using Crumb = std::pair<std::array<float, 3>, float>;
float float_of(Random& random) { return static_cast<float>(random.between(-3, 3)); }

}  // namespace

TEST(hierarchy, holds_every_triangle_once_in_boxes_that_are_round_it) {
  for (int cuts = 0; cuts < 6; ++cuts) check(single(icosphere(cuts)));
}

TEST(hierarchy, is_good_for_few_triangles) {
  for (int count = 0; count < 40; ++count)
    check(crumbs(count, [](int i) { return Crumb{{static_cast<float>(i * i % 7), static_cast<float>(i % 3), 1}, 0.5f}; }));
}

// Where the cheapest cut always takes one triangle off a heap, boxes would lie in each other a thousand deep.
TEST(hierarchy, is_never_too_deep) {
  check(crumbs(20000, [](int) { return Crumb{{1, 2, 3}, 1e-3f}; }));
  check(crumbs(20000, [](int i) { return Crumb{{std::exp2(static_cast<float>(-i % 149)), 0, 0}, 1e-30f}; }));
  check(crumbs(5000, [](int i) { return Crumb{{std::pow(1.017f, static_cast<float>(i)) * 1e-30f, 0, 0}, 0}; }));
  check(crumbs(3000, [](int i) { return Crumb{{0, 0, 0}, std::pow(1.03f, static_cast<float>(i)) * 1e-30f}; }));
}

TEST(hierarchy, is_good_for_triangles_of_any_size_and_place) {
  Random random(1);
  for (int trial = 0; trial < 100; ++trial) {
    check(crumbs(random.below(300), [&](int) {
      const Vec3 at = random.scale(1e-6, 1e5) * random.direction();
      return Crumb{{static_cast<float>(at[0]), static_cast<float>(at[1]), static_cast<float>(at[2])},
                   static_cast<float>(random.scale(1e-30, 1e5))};
    }));
  }
}

// Three heaps far apart, of which one has most triangles: each box is about one of them.
TEST(hierarchy, is_cut_where_nothing_is) {
  Random random(5);
  const scene::Hierarchy built = scene::build_hierarchy(crumbs(700, [&](int i) {
    const float heap = i < 500 ? 0.0F : i < 600 ? 100.0F : 250.0F;
    return Crumb{{heap + float_of(random), float_of(random), float_of(random)}, 0.1F};
  }));
  const shape::MeshNode& root = built.nodes[0];
  for (int i = 0; i < root.children; ++i) EXPECT_LT(root.high[0][i] - root.low[0][i], 10) << i;
}

TEST(hierarchy, is_the_same_with_any_number_of_threads) {
  Random random(6);
  const TriangleMesh mesh = crumbs(with_sanitizers ? 210'000 : 300'000, [&](int) {
    return Crumb{{float_of(random), float_of(random), float_of(random)}, 0.01F};
  });
  const scene::Hierarchy one = scene::build_hierarchy(mesh, 1);
  check(mesh, one);
  for (const int threads : {2, 7}) {
    const scene::Hierarchy other = scene::build_hierarchy(mesh, threads);
    ASSERT_EQ(other.nodes.size(), one.nodes.size());
    ASSERT_EQ(other.triangles.size(), one.triangles.size());
    EXPECT_EQ(std::memcmp(other.nodes.data(), one.nodes.data(), one.nodes.size() * sizeof one.nodes[0]), 0);
    EXPECT_EQ(std::memcmp(other.triangles.data(), one.triangles.data(), one.triangles.size() * sizeof one.triangles[0]), 0);
  }
}

TEST(hierarchy, that_is_refitted_holds_its_triangles_where_they_went) {
  for (const int count : {0, 1, 16, 17, 300, 20000}) {
    Random random(static_cast<std::uint64_t>(count) + 3);
    const TriangleMesh mesh = crumbs(count, [&](int) { return Crumb{{float_of(random), float_of(random), float_of(random)}, 0.1F}; });
    const scene::Hierarchy built = scene::build_hierarchy(mesh);
    TriangleMesh moved = mesh;
    for (auto& v : moved.vertices)
      for (float& x : v) x = -2.0F * x + static_cast<float>(random.between(-0.5, 0.5));
    scene::Hierarchy out;
    scene::refit(built, moved, out);
    check(moved, out);
    for (int k = 0; k < 3 && count > 0; ++k) {
      float low = std::numeric_limits<float>::infinity(), high = -low;
      for (const auto& triangle : moved.triangles)
        for (const std::int32_t corner : triangle) {
          const float x = moved.vertices[static_cast<std::size_t>(corner)][static_cast<std::size_t>(k)];
          low = std::min(low, x), high = std::max(high, x);
        }
      EXPECT_NEAR(out.center[k] + out.half[k], static_cast<double>(high), 1e-12);
      EXPECT_NEAR(out.center[k] - out.half[k], static_cast<double>(low), 1e-12);
    }
    scene::refit(built, mesh, out);  // and back, into memory that is in use
    check(mesh, out);
  }
}

TEST(hierarchy, steps_are_those_of_its_triangles_corners) {
  Random random(9);
  TriangleMesh mesh = crumbs(100, [&](int) { return Crumb{{float_of(random), float_of(random), float_of(random)}, 0.1F}; });
  const scene::Hierarchy built = scene::build_hierarchy(mesh);
  const auto shifted = [&](double by) {
    scene::Vertices out = mesh.vertices;
    for (std::size_t i = 0; i < out.size(); ++i) out[i][i % 3] += static_cast<float>(by * static_cast<double>(i));
    return out;
  };
  const auto steps = scene::steps_of(built, mesh, shifted(-0.25), shifted(0.5), 0.125, mesh.vertices, shifted(2));
  ASSERT_EQ(steps.size(), built.triangles.size());
  for (std::size_t b = 0; b < steps.size(); ++b)
    for (std::size_t i = 0; i < shape::block_width; ++i)
      for (std::size_t c = 0; c < 3; ++c) {
        const auto vertex = static_cast<std::size_t>(mesh.triangles[static_cast<std::size_t>(built.triangles[b].number[i])][c]);
        for (std::size_t k = 0; k < 3; ++k) {
          const double moves = vertex % 3 == k ? static_cast<double>(vertex) : 0;
          ASSERT_NEAR(steps[b].velocity[c][k][i], 3 * moves, 1e-3);
          ASSERT_NEAR(steps[b].step[c][k][i], 2 * moves, 1e-3);
        }
      }
}
