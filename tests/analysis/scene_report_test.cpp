// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
// What a camera sees of a scene, and what of a scene is seldom meant: against what is known by hand.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "support/pi.h"
#include "support/pixels.h"
#include "support/text.h"
#include "tofray/analysis.h"
#include "tofray/error.h"

using namespace tofray;
using namespace tofray::test;

namespace {

template <class Shape>
Object object_of(Shape shape, const std::string& name = {}) {
  Object out;
  out.shape = std::move(shape);
  out.name = name;
  return out;
}

Scene scene_of(std::vector<Object> objects) {
  Scene out;
  out.materials.resize(1);
  out.materials[0].diffuse = 0.5;
  out.objects = std::move(objects);
  return out;
}

/// 61 × 61 pixels, 100 pixels to a tangent of 1.
Camera small_camera() { return lit_camera(61, 61, 100); }

SceneReport report_of(std::vector<Object> objects) { return scene_report(scene_of(std::move(objects)), small_camera()); }

bool finds(const SceneReport& report, SceneFinding::Kind kind) {
  return std::any_of(report.findings.begin(), report.findings.end(), [&](const SceneFinding& one) { return one.kind == kind; });
}

/// Two triangles for each side of a cube from −half to half; outward unless turned.
Mesh cube(float half, int first_side = 0, int last_side = 6, bool turned = false) {
  TriangleMesh out;
  for (const float x : {-half, half})
    for (const float y : {-half, half})
      for (const float z : {-half, half}) out.vertices.push_back({x, y, z});
  const int sides[6][4] = {{0, 1, 3, 2}, {4, 6, 7, 5}, {0, 4, 5, 1}, {2, 3, 7, 6}, {0, 2, 6, 4}, {1, 5, 7, 3}};
  for (int i = first_side; i < last_side; ++i) {
    const auto& s = sides[i];
    for (std::array<std::int32_t, 3> one : {std::array<std::int32_t, 3>{s[0], s[1], s[2]}, {s[0], s[2], s[3]}}) {
      if (turned) std::swap(one[1], one[2]);
      out.triangles.push_back(one);
    }
  }
  Mesh mesh;
  mesh.triangles = std::make_shared<const TriangleMesh>(std::move(out));
  return mesh;
}

}  // namespace

TEST(scene_report, knows_ranges_shares_and_boxes_of_a_ball_before_a_wall) {
  const SceneReport report = report_of({object_of(Plane{{0, 0, 2}, {0, 0, -1}}, "wall"), object_of(Sphere{{0, 0, 1}, 0.1})});
  EXPECT_EQ(report.pixels, 61 * 61);
  EXPECT_EQ(report.no_surface, 0);
  ASSERT_EQ(report.objects.size(), 2U);
  const ObjectInView &wall = report.objects[0], &ball = report.objects[1];
  EXPECT_EQ(wall.name, "objects.0 (wall)");
  EXPECT_EQ(ball.name, "objects.1 (sphere)");
  EXPECT_TRUE(wall.endless);
  EXPECT_NEAR(ball.nearest_m.value(), 0.9, 1e-6);
  EXPECT_EQ(report.nearest_m, ball.nearest_m);
  EXPECT_EQ(report.farthest_m, wall.farthest_m);
  EXPECT_NEAR(wall.farthest_m.value(), 2 * std::sqrt(1 + 2 * 0.3 * 0.3), 1e-6);
  // The ball's outline: a disk of tangent r/√(d² − r²); its rim of some 2πr pixels is right by half of it.
  const double radius = 100 * 0.1 / std::sqrt(1 - 0.01);
  EXPECT_NEAR(static_cast<double>(ball.pixels), pi * radius * radius, pi * radius);
  EXPECT_EQ(ball.pixels + wall.pixels, report.pixels);
  EXPECT_NEAR(ball.low[2], 0.9, 1e-12);
  EXPECT_NEAR(ball.high[0], 0.1, 1e-12);
  EXPECT_TRUE(report.findings.empty());
}

TEST(scene_report, counts_rays_that_hit_nothing_or_too_far) {
  const double reach = report_of({}).ambiguity_range_m;
  ASSERT_GT(reach, 0);
  const SceneReport report = report_of({object_of(Rectangle{{0.5 * (reach + 1), 0, reach + 1}, {reach + 1, 10 * reach}})});
  // A half of the view, but for the middle column.
  EXPECT_NEAR(static_cast<double>(report.no_surface), 30.5 * 61, 31);
  EXPECT_EQ(report.beyond_reach, report.pixels - report.no_surface);
  EXPECT_TRUE(finds(report, SceneFinding::Kind::beyond_reach));
}

TEST(scene_report, tells_pixels_without_a_ray_from_rays_that_hit_nothing) {
  Camera camera = small_camera();
  camera.lens.k1 = -3;  // ends at a radius of (2/3)/√9 = 0.22: the corners have no ray
  const SceneReport report = scene_report(scene_of({object_of(Sphere{{0, 0, 1}, 0.02})}), camera);
  EXPECT_GT(report.outside_lens, 100);
  EXPECT_EQ(report.outside_lens + report.no_surface + report.objects[0].pixels, report.pixels);
  EXPECT_EQ(scene_report(scene_of({object_of(Sphere{{0, 0, 1}, 0.02})}), small_camera()).outside_lens, 0);
}

TEST(scene_report, follows_what_moves_to_the_time_of_the_truth) {
  Object moving = object_of(Sphere{{0, 0, 1}, 0.1});
  moving.velocity_m_per_s = {0, 0, 2};
  const Scene scene = scene_of({moving});
  Truth truth;
  truth.width = truth.height = 1, truth.time_s = 3;
  truth.object_id = {0}, truth.range_m = {6.9F};
  const SceneReport report = scene_report(scene, small_camera(), truth);
  EXPECT_NEAR(report.objects[0].low[2], 6.9, 1e-12);
  EXPECT_NEAR(report.objects[0].high[2], 7.1, 1e-12);
  EXPECT_EQ(report.time_s, 3);
}

TEST(object_places, say_where_each_object_is_and_how_it_is_turned) {
  Object box = object_of(Box{{-0.1, -0.2, 0.9}, {0.1, 0.2, 1.1}});
  box.name = "crate", box.class_name = "thing";
  box.position = {1, 0, 0}, box.angular_velocity_rad_per_s = {0, 0, 0.5 * std::numbers::pi}, box.velocity_m_per_s = {0, 0, 2};
  const std::vector<ObjectPlace> places = object_places(scene_of({box, object_of(Plane{{0, 0, 3}, {0, 0, -1}})}), 1);
  ASSERT_EQ(places.size(), 2U);
  EXPECT_EQ(places[0].name + places[0].class_name, "cratething");
  const Vec3 at{1, 0, 3}, low{0.8, -0.1, 2.9}, high{1.2, 0.1, 3.1};  // a quarter turn about z, two metres on
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_NEAR(places[0].position[i], at[i], 1e-12);
    EXPECT_NEAR(places[0].low[i], low[i], 1e-12);
    EXPECT_NEAR(places[0].high[i], high[i], 1e-12);
  }
  const Quaternion turned{0, 0, std::sqrt(0.5), std::sqrt(0.5)};
  for (std::size_t i = 0; i < 4; ++i) EXPECT_NEAR(places[0].rotation[i], turned[i], 1e-12);
  EXPECT_TRUE(places[1].endless && !places[0].endless);
}

TEST(scene_report, knows_a_camera_within_a_mesh_by_its_solid_angle) {
  const auto around = [](Mesh mesh, const Vec3& position) {
    Object object = object_of(std::move(mesh));
    object.position = position;
    object.rotation = {{1, 2, 3}, 0.7};
    return report_of({object, object_of(Plane{{0, 0, 20}, {0, 0, -1}})}).objects[0].around_camera;
  };
  EXPECT_TRUE(around(cube(2), {0, 0, 0}));
  EXPECT_TRUE(around(cube(2, 0, 6, true), {0, 0, 0})) << "a room, whose faces look inward";
  EXPECT_TRUE(around(cube(2, 0, 5), {0, 0, 0})) << "a room without one wall: 5/6 of all directions";
  EXPECT_FALSE(around(cube(2, 0, 4), {0, 0, 0})) << "a tube";
  EXPECT_FALSE(around(cube(2), {0, 0, 4.5})) << "within its box at most";
}

TEST(scene_report, turns_a_mesh_as_its_object_says) {
  const auto around = [](double angle) {
    Object object = object_of(cube(2));
    object.position = {0, 0, 2.5}, object.rotation = {{0, 1, 0}, angle};  // an edge reaches 2.83 back, a side 2
    return report_of({object}).objects[0].around_camera;
  };
  EXPECT_TRUE(around(pi / 4));
  EXPECT_FALSE(around(0));
}

TEST(scene_report, takes_no_parts_of_one_file_for_copies) {
  Object one = object_of(cube(0.1F)), other = one;
  one.position = other.position = {0, 0, 1};
  EXPECT_TRUE(finds(report_of({one, other}), SceneFinding::Kind::same_place));
  one.key = other.key = "objects.0";
  EXPECT_FALSE(finds(report_of({one, other}), SceneFinding::Kind::same_place));
}

TEST(scene_report, takes_parts_of_one_file_together) {
  Object left = object_of(cube(2, 0, 3), "room/left"), right = object_of(cube(2, 3, 6), "room/right");
  EXPECT_FALSE(report_of({left, right}).objects[0].around_camera) << "two files of half a cube";
  left.key = right.key = "objects.0";
  left.where = right.where = "scene.yaml:3:5";
  const SceneReport report = report_of({left, right});
  EXPECT_TRUE(report.objects[0].around_camera && report.objects[1].around_camera);
  ASSERT_EQ(report.findings.size(), 1U);
  EXPECT_EQ(report.findings[0].kind, SceneFinding::Kind::around_camera);
  EXPECT_FALSE(report.findings[0].warning);
  EXPECT_EQ(report.findings[0].where, "scene.yaml:3:5");
}

TEST(scene_report, warns_of_a_mesh_that_is_out_of_scale_only) {
  const auto warned = [](float half, double z, double scale = 1) {
    Object mesh = object_of(cube(half));
    std::get<Mesh>(mesh.shape).scale = scale;
    mesh.position = {0, 0, z};
    return finds(report_of({mesh}), SceneFinding::Kind::mesh_size);
  };
  EXPECT_TRUE(warned(200, 0.5));
  EXPECT_TRUE(warned(0.002F, 0.5, 0.001));
  EXPECT_FALSE(warned(0.002F, 0.5)) << "a grain";
  EXPECT_FALSE(warned(0.2F, 1));
  EXPECT_FALSE(warned(4, 5)) << "a hall within reach";
  EXPECT_TRUE(warned(8, 60)) << "16 m, and all beyond reach";
}

TEST(scene_report, calls_no_moving_camera_turned_away) {
  Scene scene = scene_of({object_of(Plane{{0, 0, -3}, {0, 0, 1}}), object_of(Sphere{{0, 0, 1}, 0.1})});
  scene.camera.pose = {{0, 0, 0}, {0, 0, -1}, {0, -1, 0}};
  EXPECT_TRUE(finds(scene_report(scene, small_camera()), SceneFinding::Kind::behind_camera));
  scene.camera.keyframes = {{0, scene.camera.pose}, {1, {{0, 0, 0}, {0.1, 0, -1}, {0, -1, 0}}}};
  scene.camera.pose = {};
  EXPECT_FALSE(finds(scene_report(scene, small_camera()), SceneFinding::Kind::behind_camera));
}

TEST(scene_report, notes_what_light_may_reach_round_a_corner) {
  Scene scene = scene_of({object_of(Plane{{0, 0, 2}, {0, 0, -1}}), object_of(Sphere{{1.5, 0, 0}, 0.1})});
  SceneReport report = scene_report(scene, small_camera());
  ASSERT_EQ(report.findings.size(), 1U);
  EXPECT_EQ(report.findings[0].kind, SceneFinding::Kind::nothing_in_view);
  EXPECT_TRUE(report.findings[0].warning);
  scene.transport.bounces = 2;
  report = scene_report(scene, small_camera());
  ASSERT_EQ(report.findings.size(), 1U);
  EXPECT_FALSE(report.findings[0].warning);
}

// A camera that hangs upside down has its floor above it in the image.
TEST(scene_report, leaves_cameras_alone_that_are_turned_about_their_axis) {
  Scene scene = scene_of({object_of(Plane{{0, 1, 0}, {0, -1, 0}}, "floor"), object_of(Sphere{{0, 0, 1}, 0.1})});
  for (const Vec3& up : {Vec3{0, 1, 0}, Vec3{1, 0, 0}}) {
    scene.camera.pose.up = up;
    EXPECT_FALSE(finds(scene_report(scene, small_camera()), SceneFinding::Kind::floor_above)) << up[0];
  }
  // In a world whose z is up.
  scene = scene_of({object_of(Plane{{0, 0, 1}, {0, 0, 1}}, "floor"), object_of(Sphere{{2, 0, 0}, 0.1})});
  scene.camera.pose = {{0, 0, 0}, {1, 0, 0}, {0, 0, 1}};
  EXPECT_TRUE(finds(scene_report(scene, small_camera()), SceneFinding::Kind::floor_above));
}

// The scene says which way is up, whatever turns the camera has: forward is x and up is z here, by a quaternion.
TEST(scene_report, takes_up_from_the_world_and_not_from_a_quaternion) {
  Scene scene = scene_of({object_of(Plane{{0, 0, -1}, {0, 0, 1}}, "floor"), object_of(Sphere{{2, 0, 0}, 0.1})});
  scene.camera.pose = {{0, 0, 0}, {0, 0, 1}, {0, -1, 0}, Quaternion{-0.5, 0.5, -0.5, 0.5}};
  scene.world_up = Scene::Up::z;
  EXPECT_FALSE(finds(scene_report(scene, small_camera()), SceneFinding::Kind::floor_above));
  std::get<Plane>(scene.objects[0].shape).point = {0, 0, 1};
  const SceneReport report = scene_report(scene, small_camera());
  EXPECT_TRUE(finds(report, SceneFinding::Kind::floor_above));
  EXPECT_NE(report.findings[0].more.find("by world_up"), std::string::npos) << report.findings[0].more;
}

TEST(scene_report, warns_not_of_a_narrow_housing_that_the_camera_looks_out_of) {
  Object housing = object_of(cube(0.2F, 0, 5));  // without the side towards +z
  const SceneReport report = report_of({housing, object_of(Plane{{0, 0, 2}, {0, 0, -1}}), object_of(Sphere{{0, 0, 1}, 0.1})});
  ASSERT_EQ(report.findings.size(), 1U);
  EXPECT_EQ(report.findings[0].kind, SceneFinding::Kind::around_camera);
  EXPECT_FALSE(report.findings[0].warning);
}

TEST(scene_report, finds_what_is_hidden_inside_a_closed_object) {
  const auto hidden = [](Object inner) {
    return finds(report_of({object_of(Box{{-0.3, -0.3, 1}, {0.3, 0.3, 1.6}}), std::move(inner)}), SceneFinding::Kind::inside_another);
  };
  EXPECT_TRUE(hidden(object_of(Sphere{{0, 0, 1.3}, 0.25})));
  EXPECT_TRUE(hidden(object_of(Box{{-0.2, -0.2, 1.1}, {0.2, 0.2, 1.5}})));
  EXPECT_FALSE(hidden(object_of(Sphere{{0, 0, 1.3}, 0.35}))) << "it sticks out";
  EXPECT_FALSE(hidden(object_of(Sphere{{0, 0, 2.5}, 0.1}))) << "it stands behind";
}

TEST(scene_report, refuses_the_truth_of_another_scene) {
  const auto refusal = [](Truth truth) {
    try {
      (void)scene_report(scene_of({object_of(Sphere{{0, 0, 1}, 0.1})}), small_camera(), truth);
    } catch (const Error& error) {
      EXPECT_EQ(error.kind(), ErrorKind::bad_input);
      return std::string(error.what());
    }
    return std::string();
  };
  Truth truth;
  EXPECT_TRUE(has(refusal(truth), "the truth lacks object_id or range_m"));
  truth.width = 2, truth.height = 1;
  truth.object_id = {0, 1}, truth.range_m = {1, 1};
  EXPECT_TRUE(has(refusal(truth), "the truth is of another scene"));
  truth.range_m = {1};
  EXPECT_TRUE(has(refusal(truth), "got 2 and 1 values, expected 2 of each"));
}
