// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
// Ground truth of meshes: which triangle a pixel sees, and which texture coordinates are there, against the user's own triangles in double.
#include <gtest/gtest.h>

#include <algorithm>

#include "support/meshes.h"
#include "support/random.h"
#include "support/random_scene.h"
#include "support/seen.h"

using namespace tofray;
using namespace tofray::test;

namespace {

using Pair = std::array<float, 2>;

/// Two triangles, 1 m × 1 m about (x, 0, 2), seen straight on: number 0 above the falling diagonal, number 1 below it.
TriangleMesh square(float x) {
  TriangleMesh out;
  out.vertices = {{x - 0.5F, -0.5F, 2}, {x + 0.5F, -0.5F, 2}, {x + 0.5F, 0.5F, 2}, {x - 0.5F, 0.5F, 2}};
  out.triangles = {{0, 1, 2}, {0, 2, 3}};
  return out;
}

Scene scene_of(std::vector<TriangleMesh> meshes) {
  Scene scene;
  scene.materials = {{"", Material::Brdf::lambert, 0.5}};
  for (TriangleMesh& mesh : meshes) scene.objects.push_back(object(shared(std::move(mesh))));
  return scene;
}

Pair texcoord_at(const Truth& truth, std::size_t i) { return {truth.texcoord[2 * i], truth.texcoord[2 * i + 1]}; }
bool has_texcoord(const Truth& truth, std::size_t i) {
  const auto [u, v] = texcoord_at(truth, i);
  EXPECT_EQ(std::isnan(u), std::isnan(v)) << i;
  return !std::isnan(u);
}

/// Shares of a triangle's corners in the foot of a point, and how far above the triangle it is [m].
struct Shares {
  std::array<double, 3> corner;
  double above;
};
Shares shares(const TriangleMesh& mesh, std::int32_t number, const Vec3& p) {
  const auto vertex = [&](std::size_t k) {
    const auto& v = mesh.vertices[static_cast<std::size_t>(mesh.triangles[static_cast<std::size_t>(number)][k])];
    return Vec3{static_cast<double>(v[0]), static_cast<double>(v[1]), static_cast<double>(v[2])};
  };
  const Vec3 a = vertex(0), one = vertex(1) - a, two = vertex(2) - a, from = p - a, n = base::cross(one, two);
  const double square = base::dot(n, n), second = base::dot(base::cross(from, two), n) / square,
               third = base::dot(base::cross(one, from), n) / square;
  return {{1 - second - third, second, third}, base::dot(from, n) / std::sqrt(square)};
}

}  // namespace

TEST(triangle_id, of_a_square_s_halves_is_that_of_the_half) {
  TriangleMesh other_way = square(0.6F);
  std::swap(other_way.triangles[0], other_way.triangles[1]);
  const Truth seen = truth(scene_of({square(-0.6F), other_way}), lit_camera(160, 80, 90));
  std::array<int, 4> count{};
  for (std::size_t i = 0; i < seen.object_id.size(); ++i) {
    if (seen.object_id[i] < 0) {
      ASSERT_EQ(seen.triangle_id[i], -1) << i;
      continue;
    }
    const Vec3 p = vector_at(seen.position_m, i);
    const double across = p[0] - (seen.object_id[i] == 0 ? -0.6 : 0.6) - p[1];
    if (std::abs(across) < 1e-5) continue;  // on the diagonal
    ASSERT_EQ(seen.triangle_id[i], (across > 0) == (seen.object_id[i] == 0) ? 0 : 1) << i;
    ++count[static_cast<std::size_t>(2 * seen.object_id[i] + seen.triangle_id[i])];
  }
  for (const int each : count) EXPECT_GT(each, 500);
}

// Meshes of more than one block of triangles, turned, moved and moving, among other shapes, seen by a camera that is turned, too.
TEST(triangle_id, names_the_triangle_that_holds_the_point) {
  int meshes = 0, with_texcoords = 0, others = 0;
  double largest_texcoord_error = 0;
  for (int trial = 0; trial < 12; ++trial) {
    Random random(static_cast<std::uint64_t>(trial) + 70);
    Scene scene = random_scene(random, 24, trial % 2 == 1);
    for (int more = 0; more < 3; ++more) {
      TriangleMesh triangles = single(stone(random, 2 + more, 0.5, {0.4 * more - 0.4, 0.1, 1.2}));
      if (more != 1) add_details(random, triangles);
      Object one = object(shared(std::move(triangles)));
      one.position = {0.1, -0.05, 0.2};
      one.rotation = {random.direction(), 0.3};
      if (trial % 2 == 1) one.velocity_m_per_s = random.point(2);
      scene.objects.push_back(one);
    }
    scene.camera.pose = random_pose(random);
    const Truth seen = Simulator(scene, lit_camera(120, 90, 100), {.noise = Noise::off}).frame(0).truth;
    for (std::size_t i = 0; i < seen.object_id.size(); ++i) {
      const std::int32_t id = seen.object_id[i];
      const Mesh* mesh = id < 0 ? nullptr : std::get_if<Mesh>(&scene.objects[static_cast<std::size_t>(id)].shape);
      if (mesh == nullptr) {
        ASSERT_EQ(seen.triangle_id[i], -1) << i;
        ASSERT_FALSE(has_texcoord(seen, i)) << i;
        ++others;
        continue;
      }
      const TriangleMesh& of = *mesh->triangles;
      ASSERT_GE(seen.triangle_id[i], 0) << i;
      ASSERT_LT(seen.triangle_id[i], static_cast<std::int32_t>(of.triangles.size())) << i;
      const Vec3 p = in_object(scene, scene.objects[static_cast<std::size_t>(id)], vector_at(seen.position_m, i), seen.time_s);
      const Shares found = shares(of, seen.triangle_id[i], p);
      ASSERT_NEAR(found.above, 0, 2e-6) << "trial " << trial << ", pixel " << i;
      for (const double share : found.corner) ASSERT_GT(share, -2e-4) << "trial " << trial << ", pixel " << i;
      ++meshes;
      ASSERT_EQ(has_texcoord(seen, i), !of.texcoords.empty()) << i;
      if (of.texcoords.empty()) continue;
      const auto& corners = of.triangles[static_cast<std::size_t>(seen.triangle_id[i])];
      for (std::size_t k = 0; k < 2; ++k) {
        double expected = 0;
        for (std::size_t c = 0; c < 3; ++c)
          expected += found.corner[c] * static_cast<double>(of.texcoords[static_cast<std::size_t>(corners[c])][k]);
        largest_texcoord_error = std::max(largest_texcoord_error, std::abs(static_cast<double>(texcoord_at(seen, i)[k]) - expected));
      }
      ++with_texcoords;
    }
  }
  EXPECT_GT(meshes, 10000);
  EXPECT_GT(with_texcoords, 5000);
  EXPECT_GT(others, 10000);
  EXPECT_LT(largest_texcoord_error, 1e-3);
}

TEST(texcoord, is_linear_over_a_square) {
  TriangleMesh mesh = square(0);
  mesh.texcoords = {{-1.5F, 0.25F}, {2.5F, 0.25F}, {2.5F, 0.75F}, {-1.5F, 0.75F}};
  const Truth seen = truth(scene_of({mesh}), lit_camera(97, 81, 90));
  int count = 0;
  for (std::size_t i = 0; i < seen.object_id.size(); ++i) {
    ASSERT_EQ(has_texcoord(seen, i), seen.object_id[i] == 0) << i;
    if (seen.object_id[i] != 0) continue;
    const Vec3 p = vector_at(seen.position_m, i);
    ASSERT_NEAR(static_cast<double>(seen.texcoord[2 * i]), -1.5 + 4 * (p[0] + 0.5), 2e-6) << i;
    ASSERT_NEAR(static_cast<double>(seen.texcoord[2 * i + 1]), 0.25 + 0.5 * (p[1] + 0.5), 1e-6) << i;
    ++count;
  }
  EXPECT_GT(count, 1000);
}

// Side by side within one pack: normals alone, texture coordinates alone, neither, both.
TEST(texcoord, is_that_of_the_corners_and_else_none) {
  std::vector<TriangleMesh> meshes;
  for (int k = 0; k < 4; ++k) {
    meshes.push_back(square(-1.5F + static_cast<float>(k)));
    if (k == 0 || k == 3) meshes.back().normals.assign(4, {0, 0, -1});
    if (k == 1 || k == 3) meshes.back().texcoords.assign(4, {static_cast<float>(k), 0});
  }
  for (const Isa isa : {Isa::scalar, Isa::best}) {
    const Truth seen = Simulator(scene_of(meshes), lit_camera(24, 8, 12), {.noise = Noise::off, .isa = isa}).frame(0).truth;
    std::array<int, 5> count{};
    for (std::size_t i = 0; i < seen.object_id.size(); ++i) {
      const std::int32_t id = seen.object_id[i];
      ASSERT_EQ(has_texcoord(seen, i), id == 1 || id == 3) << i;
      if (id == 1 || id == 3) {
        ASSERT_NEAR(texcoord_at(seen, i)[0], static_cast<float>(id), 1e-6F) << i;
        ASSERT_EQ(texcoord_at(seen, i)[1], 0) << i;
      }
      ++count[static_cast<std::size_t>(id + 1)];
    }
    for (const int each : count) EXPECT_GT(each, 20);
  }
}
