// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include "analysis/tessellation.h"

#include <gtest/gtest.h>

#include <cmath>
#include <memory>

#include "analysis/bodies.h"
#include "analysis/stand.h"
#include "support/pi.h"

namespace tofray::test {
namespace {

using namespace analysis;
using Corners = std::vector<std::array<float, 9>>;

Vec corner(const std::array<float, 9>& triangle, std::size_t i) {
  return {static_cast<double>(triangle[3 * i]), static_cast<double>(triangle[3 * i + 1]), static_cast<double>(triangle[3 * i + 2])};
}

/// Of what the triangles enclose, above 0 where they are seen from outside in the right-handed sense.
double volume_of(const Corners& corners) {
  double sum = 0;
  for (const auto& one : corners) sum += shape::dot(corner(one, 0), shape::cross(corner(one, 1), corner(one, 2))) / 6;
  return sum;
}
double area_of(const Corners& corners) {
  double sum = 0;
  for (const auto& one : corners) sum += shape::length(shape::cross(corner(one, 1) - corner(one, 0), corner(one, 2) - corner(one, 0))) / 2;
  return sum;
}

Object object_of(decltype(Object::shape) shape) {
  Object out;
  out.shape = std::move(shape);
  return out;
}

TEST(tessellation, encloses_what_closed_shapes_do) {
  struct Closed {
    decltype(Object::shape) shape;
    double volume, area;
  };
  const double r = 0.3, h = 0.7;
  for (const Closed& one :
       {Closed{Sphere{{1, 2, 3}, r}, 4.0 / 3 * pi * r * r * r, 4 * pi * r * r},
        Closed{Box{{1, 2, 3}, {1.2, 2.4, 3.8}}, 0.2 * 0.4 * 0.8, 2 * (0.08 + 0.16 + 0.32)},
        Closed{Cylinder{{1, 2, 3}, {1, 2, -1}, r, h}, pi * r * r * h, 2 * pi * r * (r + h)},
        Closed{Capsule{{1, 2, 3}, {1, 2.7, 3}, r}, pi * r * r * h + 4.0 / 3 * pi * r * r * r, 2 * pi * r * h + 4 * pi * r * r},
        Closed{Cone{{1, 2, 3}, {0, -1, 1}, r, h}, pi * r * r * h / 3, pi * r * (r + std::hypot(r, h))}}) {
    const Object object = object_of(one.shape);
    const Corners corners = object_triangles(object, 0, 8);
    EXPECT_NEAR(volume_of(corners), one.volume, 0.005 * one.volume) << kind_of(object);
    EXPECT_NEAR(area_of(corners), one.area, 0.005 * one.area) << kind_of(object);
  }
}

TEST(tessellation, of_flat_shapes_has_their_area_and_faces_their_normal) {
  const Corners disk = object_triangles(object_of(Disk{{1, 2, 3}, {1, 0, -2}, 0.4}), 0, 8);
  EXPECT_NEAR(area_of(disk), pi * 0.16, 0.005 * pi * 0.16);
  for (const auto& one : disk) {
    EXPECT_NEAR(shape::dot(corner(one, 0), {1, 0, -2}), 0, 1e-6);
    EXPECT_GT(shape::dot(shape::cross(corner(one, 1) - corner(one, 0), corner(one, 2) - corner(one, 0)), {1, 0, -2}), 0);
  }
  EXPECT_NEAR(area_of(object_triangles(object_of(Rectangle{{1, 2, 3}, {0.4, 0.3}}), 0, 8)), 0.12, 1e-7);
  EXPECT_NEAR(area_of(object_triangles(object_of(Triangle{{{{0, 0, 1}, {1, 0, 1}, {0, 2, 1}}}}), 0, 8)), 1, 1e-6);
  const Corners plane = object_triangles(object_of(Plane{{1, 2, 3}, {1, 1, 1}}), 0, 8);
  EXPECT_NEAR(area_of(plane), 256, 1e-3);
  for (const auto& one : plane)
    for (std::size_t i = 0; i < 3; ++i) EXPECT_NEAR(shape::dot(corner(one, i), {1, 1, 1}), 0, 1e-5);
}

TEST(tessellation, of_a_plane_reaches_beyond_all_else) {
  Scene scene;
  scene.objects = {object_of(Plane{{0, 1, 0}, {0, -1, 0}}), object_of(Sphere{{0, 0, 30}, 0.5})};
  scene.camera.pose.position = {-40, 0, 0}, scene.camera.pose.look_at = {0, 0, 30};
  const SceneTriangles triangles = scene_triangles(scene, 0);
  double least = 1e9;
  for (std::size_t i = 0; i < 2; ++i)
    for (std::size_t k = 0; k < 9; ++k)
      if (k % 3 != 1) least = std::min(least, std::abs(static_cast<double>(triangles.corners[i][k])));
  EXPECT_EQ(least, 128) << "twice 40 m, to the next power of two";
}

TEST(tessellation, is_in_the_object_s_own_frame_whatever_moves_it) {
  Object object = object_of(Box{{1, 2, 3}, {1.2, 2.4, 3.8}});
  const Corners still = object_triangles(object, 0, 8);
  object.position = {4, 5, 6}, object.rotation = {{1, 2, 3}, 0.7};
  object.velocity_m_per_s = {0.5, 0, 0}, object.angular_velocity_rad_per_s = {0, 0.3, 0};
  EXPECT_EQ(object_triangles(object, 2, 8), still);
  const ObjectPose pose = pose_of(object, 2);
  EXPECT_NEAR(pose.origin.x, 1.1 + 4 + 1, 1e-12);
  EXPECT_NEAR(pose.origin.y, 2.2 + 5, 1e-12);
  // Its box in the world is the box of its turned corners.
  Scene scene;
  scene.objects = {object};
  const Body body = bodies_at(scene, 2)[0];
  Vec low{1e9, 1e9, 1e9}, high{-1e9, -1e9, -1e9};
  for (const auto& one : still)
    for (std::size_t i = 0; i < 3; ++i) {
      const Vec at = pose.turn * corner(one, i) + pose.origin;
      for (int k = 0; k < 3; ++k) low[k] = std::min(low[k], at[k]), high[k] = std::max(high[k], at[k]);
    }
  for (int k = 0; k < 3; ++k) {
    EXPECT_NEAR(low[k], body.low[k], 1e-6);
    EXPECT_NEAR(high[k], body.high[k], 1e-6);
  }
}

TriangleMesh strip(int triangles) {
  TriangleMesh out;
  for (int i = 0; i < triangles + 2; ++i)
    out.vertices.push_back({static_cast<float>(i), static_cast<float>(i % 2), static_cast<float>(i % 3)});
  for (int i = 0; i < triangles; ++i) out.triangles.push_back({i, i + 1, i + 2});
  return out;
}

TEST(tessellation, of_too_many_triangles_makes_boxes_of_the_largest_objects) {
  Scene scene;
  for (const int count : {500, 2000, 100}) {
    Mesh mesh;
    mesh.triangles = std::make_shared<const TriangleMesh>(strip(count));
    scene.objects.push_back(object_of(mesh));
  }
  const auto drawn = [&](std::size_t most) {
    const SceneTriangles all = scene_triangles(scene, 0, most);
    EXPECT_LE(all.corners.size(), most);
    EXPECT_EQ(all.corners.size(), all.objects.size());
    std::string out;
    for (const analysis::Drawn one : all.drawn)
      out += one == analysis::Drawn::shape ? "shape " : one == analysis::Drawn::box ? "box " : "none ";
    return out;
  };
  EXPECT_EQ(drawn(2600), "shape shape shape ");
  EXPECT_EQ(drawn(2599), "shape box shape ");
  EXPECT_EQ(drawn(612), "shape box shape ");
  EXPECT_EQ(drawn(611), "box box shape ");
  EXPECT_EQ(drawn(36), "box box box ");
  EXPECT_EQ(drawn(35), "box none box ");
  EXPECT_EQ(drawn(0), "none none none ");
  const SceneTriangles boxes = scene_triangles(scene, 0, 36);
  float largest = 0;
  for (std::size_t i = 0; i < boxes.corners.size(); ++i)
    if (boxes.objects[i] == 1)
      for (const float each : boxes.corners[i]) largest = std::max(largest, each);
  EXPECT_EQ(largest, 2001) << "the box holds the mesh";
}

/// Moves each vertex along x by the time.
class Shifts : public MeshMotion {
 public:
  explicit Shifts(TriangleMesh mesh) : mesh_(std::move(mesh)) {}
  void at(double time_s, std::vector<std::array<float, 3>>& vertices, std::vector<std::array<float, 3>>& normals) const override {
    vertices = mesh_.vertices, normals = mesh_.normals;
    for (auto& one : vertices) one[0] += static_cast<float>(time_s);
  }

 private:
  TriangleMesh mesh_;
};

TEST(tessellation, of_a_mesh_that_changes_its_shape_is_what_it_is_at_the_time) {
  Mesh mesh;
  mesh.triangles = std::make_shared<const TriangleMesh>(strip(4));
  mesh.motion = std::make_shared<const Shifts>(strip(4));
  const Object object = object_of(mesh);
  const Corners now = object_triangles(object, 0, 8), later = object_triangles(object, 3, 8);
  ASSERT_EQ(later.size(), 4u);
  EXPECT_EQ(later[1][0], now[1][0] + 3);
  EXPECT_EQ(later[1][1], now[1][1]);
}

}  // namespace
}  // namespace tofray::test
