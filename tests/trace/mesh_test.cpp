// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
// Meshes: nothing leaks, the hierarchy finds what a look at every triangle finds, and a ball of triangles covers a ball's solid angle.
#include "shape/mesh.h"

#include <gtest/gtest.h>

#include <limits>

#include "scene/hierarchy.h"
#include "support/meshes.h"
#include "support/pi.h"
#include "support/random.h"
#include "support/random_scene.h"
#include "support/rays.h"

using namespace tofray;
using namespace tofray::test;

namespace {

/// A mesh as it lies in the camera's frame.
struct Lying {
  scene::Hierarchy built;
  shape::Mesh mesh;

  explicit Lying(const TriangleMesh& triangles)
      : built(scene::build_hierarchy(triangles)), mesh(shape::Mesh::placed(built, {{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}}, {0, 0, 0}})) {}
  [[nodiscard]] shape::MeshForm seen_from(const Vec3& origin) const { return shape::seen_from(mesh, vec(origin)); }
  /// Triangles as they lie in memory, some of them more than once.
  [[nodiscard]] int places() const { return shape::block_width * static_cast<int>(built.triangles.size()); }
  [[nodiscard]] const shape::MeshTriangles& block(int place) const {
    return built.triangles[static_cast<std::size_t>(place / shape::block_width)];
  }
  [[nodiscard]] float corner(int place, int c, int k) const { return block(place).corner[c][k][place % shape::block_width]; }
  [[nodiscard]] std::int32_t number(int place) const { return block(place).number[place % shape::block_width]; }
};

flow::Hit<float> look(const shape::MeshForm& form, const Ray& ray) {
  flow::Hit<float> hit = flow::no_hit<float>();
  nearest_in(form, ray, hit);
  return hit;
}

/// The same, triangle by triangle.
shape::MeshHit<float> look_at_all(const Lying& lying, const shape::MeshForm& form, const Ray& ray, float shortest) {
  const shape::MeshRay<float> in = in_mesh(form, {ray.x, ray.y, ray.z});
  const shape::Sheared<float> along = shape::sheared(in.direction, shape::longest_of(in.direction));
  shape::MeshHit<float> best{std::numeric_limits<float>::max(), 0x7fffffff, -1};
  for (int i = 0; i < lying.places(); ++i) {
    float t = 0;
    const auto corner = [&](int c, int k) { return lying.corner(i, c, k) - in.origin[k]; };
    if (!shape::meet<true>(corner, along, t) || !(t > shortest)) continue;
    const std::int32_t number = lying.number(i);
    if (t < best.t || (t == best.t && number < best.number)) best = {t, number, i};
  }
  return best;
}

void same_as_all(const Lying& lying, const shape::MeshForm& form, const Ray& ray, int& met) {
  const flow::Hit<float> hit = look(form, ray);
  const shape::MeshHit<float> best = look_at_all(lying, form, ray, shape::nearest_mesh);
  ASSERT_EQ(hit.w > 0, best.triangle >= 0);
  if (best.triangle < 0) return;
  ++met;
  ASSERT_EQ(hit.w, 1 / best.t);
  ASSERT_EQ(hit.triangle, best.triangle);
  const float first = look_at_all(lying, form, ray, 0).t;
  ASSERT_TRUE(stands_before(form, ray, std::nextafter(first, 2 * first), true));
  ASSERT_FALSE(stands_before(form, ray, first, true));
}

/// Seen from inside, somewhere far from zero.
struct Within {
  ClosedMesh corners;
  Vec3 origin;
  Lying lying;
  shape::MeshForm form;

  static ClosedMesh moved(double offset, Random& random) {
    ClosedMesh out = icosphere(3);
    for (Vec3& v : out.vertices) v = random.between(0.8, 1.25) * v + offset * Vec3{1, -0.7, 0.4};
    return out;
  }
  Within(double offset, Random random)
      : corners(moved(offset, random)),
        origin(random.point(0.15) + offset * Vec3{1, -0.7, 0.4}),
        lying(single(corners)),
        form(lying.seen_from(origin)) {}
  [[nodiscard]] bool missed(const Vec3& d) const { return !(look(form, ray(d)).w > 0); }
  /// Where a corner is for the rays: as single precision holds it.
  [[nodiscard]] Vec3 corner(int i) const {
    Vec3 out{};
    for (std::size_t k = 0; k < 3; ++k) {
      const float from = form.origin[k], at = static_cast<float>(corners.at(i)[k]);
      out[k] = static_cast<double>(at) - static_cast<double>(from);
    }
    return out;
  }
};

class WatertightMesh : public testing::TestWithParam<double> {};

}  // namespace

// (Of the three offsets together.)
TEST_P(WatertightMesh, no_ray_of_ten_million_leaves) {
  const Within scene(GetParam(), Random(1));
  Random random(2);
  int missed = 0;
  for (int i = 0; i < 3'400'000; ++i) missed += scene.missed(random.point(1));
  EXPECT_EQ(missed, 0);
}

TEST_P(WatertightMesh, no_ray_leaves_through_a_vertex_or_an_edge) {
  const Within scene(GetParam(), Random(3));
  Random random(4);
  int missed = 0;
  for (int i = 0; i < 1'000'000; ++i) {
    const auto& t = scene.corners.triangles[static_cast<std::size_t>(i) % scene.corners.triangles.size()];
    const auto a = static_cast<std::size_t>(random.below(3)), b = (a + 1) % 3;
    const double stretch = random.below(2) == 0 ? 1 : random.between(0.5, 2), share = random.below(2) == 0 ? 0.5 : random.uniform();
    missed += scene.missed(stretch * scene.corner(t[a]));
    missed += scene.missed(stretch * (share * scene.corner(t[a]) + (1 - share) * scene.corner(t[b])));
  }
  EXPECT_EQ(missed, 0);
}
INSTANTIATE_TEST_SUITE_P(offset, WatertightMesh, testing::Values(0.0, 1e3, 1.5e5));

TEST(mesh, hierarchy_finds_what_a_look_at_every_triangle_finds) {
  Random random(5);
  int met = 0;
  for (int trial = 0; trial < 20; ++trial) {
    const Lying lying(single(stone(random, trial % 5, random.scale(1e-3, 1e3), random.point(2))));
    for (int view = 0; view < 10; ++view) {
      const Vec3 origin = random.scale(1e-3, 1e3) * random.direction();
      const shape::MeshForm form = lying.seen_from(origin);
      for (int i = 0; i < 200; ++i) {
        const int place = random.below(lying.places());
        Vec3 at{};
        for (int k = 0; k < 3; ++k) at[static_cast<std::size_t>(k)] = static_cast<double>(lying.corner(place, random.below(3), k));
        const Vec3 aim = i % 2 == 0 ? at : at + 0.1 * lying.mesh.half.x * random.direction();
        same_as_all(lying, form, ray(aim - origin), met);
        if (HasFatalFailure()) return;
      }
    }
  }
  EXPECT_GT(met, 20000);
}

TEST(mesh, garbage_is_found_as_by_a_look_at_every_triangle) {
  Random random(6);
  int met = 0;
  for (int trial = 0; trial < 1000; ++trial) {
    const TriangleMesh garbage = test::garbage(random, random.below(60));
    const int count = static_cast<int>(garbage.vertices.size()) / 3;
    const Lying lying(garbage);
    const Vec3 origin = trial % 2 == 0 ? Vec3{0, 0, 0} : random.scale(1e-3, 1e5) * random.direction();
    const shape::MeshForm form = lying.seen_from(origin);
    for (int i = 0; i < 50; ++i) {
      Vec3 aim = random.direction();
      if (i % 3 != 0 && count > 0) {
        const auto& v = garbage.vertices[static_cast<std::size_t>(random.below(3 * count))];
        aim = Vec3{static_cast<double>(v[0]), static_cast<double>(v[1]), static_cast<double>(v[2])} - origin + 1e-3 * random.below(2) * aim;
      }
      if (i % 6 == 1 && !garbage.triangles.empty()) {  // at an edge
        const auto& triangle = garbage.triangles[static_cast<std::size_t>(random.below(static_cast<int>(garbage.triangles.size())))];
        const auto &a = garbage.vertices[static_cast<std::size_t>(triangle[0])],
                   &b = garbage.vertices[static_cast<std::size_t>(triangle[1])];
        const double share = random.uniform();
        for (std::size_t k = 0; k < 3; ++k)
          aim[k] = (1 - share) * static_cast<double>(a[k]) + share * static_cast<double>(b[k]) - origin[k];
      }
      if (base::length(aim) < 1e-6) aim = random.direction();
      same_as_all(lying, form, ray(aim), met);
      if (HasFatalFailure()) FAIL() << trial << " " << i;
      const flow::Hit<float> hit = look(form, ray(aim));
      ASSERT_TRUE(std::isfinite(hit.w));
      shape::Facet facet{};
      facet_of(lying.mesh, 0, facet);
      if (!(hit.w > 0)) continue;
      const shape::Direction<float> n = shape::Mesh::normal<float>(facet, hit.triangle);
      ASSERT_TRUE(std::isfinite(n.x) && std::isfinite(n.y) && std::isfinite(n.z));
      ASSERT_LE(n.x * n.x + n.y * n.y + n.z * n.z, 1.001f);
    }
  }
  EXPECT_GT(met, 10000);
}

// 2π(1 − √(1 − (R/d)²)), with R between the ball of the corners and the ball within the faces.
TEST(mesh, a_ball_of_triangles_covers_the_solid_angle_of_a_ball) {
  const ClosedMesh ball = icosphere(6);
  double least = 1;
  for (const auto& t : ball.triangles) least = std::fmin(least, base::length(1.0 / 3 * (ball.at(t[0]) + ball.at(t[1]) + ball.at(t[2]))));
  const Lying lying(single(ball));
  Random random(7);
  for (const double away : {1.05, 2.0, 10.0}) {
    const shape::MeshForm form = lying.seen_from(away * random.direction());
    constexpr int rays = 1'000'000;
    int met = 0;
    for (int i = 0; i < rays; ++i) met += look(form, ray(random.direction())).w > 0;
    const auto share = [&](double r) { return 0.5 * (1 - std::sqrt(1 - r * r / (away * away))); };
    const double sigma = std::sqrt(share(1) * (1 - share(1)) / rays), got = static_cast<double>(met) / rays;
    EXPECT_LT(got, share(1) + 5 * sigma) << away;
    EXPECT_GT(got, share(least) - 5 * sigma) << away;
  }
}

// The plane of a triangle of a millimetre, ten metres away and almost edge-on, is met where it is.
TEST(mesh, range_is_that_of_the_plane) {
  Random random(8);
  for (int i = 0; i < 20000; ++i) {
    const double size = random.scale(1e-3, 1);
    const Vec3 middle = random.between(0.1, 10) * random.direction();
    TriangleMesh one;
    for (int c = 0; c < 3; ++c) {
      const Vec3 at = middle + size * random.direction();
      one.vertices.push_back({static_cast<float>(at[0]), static_cast<float>(at[1]), static_cast<float>(at[2])});
    }
    one.triangles = {{0, 1, 2}};
    const Lying lying(one);
    const auto corner = [&](std::size_t c) {
      return Vec3{static_cast<double>(one.vertices[c][0]), static_cast<double>(one.vertices[c][1]),
                  static_cast<double>(one.vertices[c][2])};
    };
    const Vec3 n = base::cross(corner(1) - corner(0), corner(2) - corner(0));
    const Ray to = ray(1.0 / 3 * (corner(0) + corner(1) + corner(2)));
    const flow::Hit<float> hit = look(lying.seen_from({0, 0, 0}), to);
    const double slant = std::abs(base::dot(n, direction(to))) / (base::length(n) * base::length(direction(to)));
    if (slant < 1e-4 || base::length(n) < 1e-2 * size * size) continue;
    ASSERT_GT(hit.w, 0);
    const double t = base::dot(n, corner(0)) / base::dot(n, direction(to)), away = base::length(middle);
    // Corners are rounded to 2^-24 of their distance: along the ray that is 1/slant as much.
    ASSERT_NEAR(1 / static_cast<double>(hit.w), t, 4 * std::exp2(-24) * (1 + 1 / slant)) << away << " " << slant;
  }
}
