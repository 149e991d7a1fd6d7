// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
// A mesh is seen, lit and shaded as its triangles are one by one, standing or moving; a ball of many triangles as a ball.
#include <gtest/gtest.h>

#include <algorithm>

#include "support/random_scene.h"

using namespace tofray;
using namespace tofray::test;

namespace {

/// The triangles as objects of their own, turned about the mesh's zero.
void add_triangles(const Object& whole, Scene& scene) {
  const TriangleMesh& mesh = *std::get<Mesh>(whole.shape).triangles;
  const auto& vertices = mesh.vertices;
  const auto& triangles = mesh.triangles;
  const double a = whole.rotation.angle_rad, c = std::cos(a), s = std::sin(a);
  const Vec3 k = base::normalized(whole.rotation.axis);
  for (const auto& triangle : triangles) {
    Triangle one;
    for (std::size_t i = 0; i < 3; ++i) {
      const auto& v = vertices[static_cast<std::size_t>(triangle[i])];
      const Vec3 p{static_cast<double>(v[0]), static_cast<double>(v[1]), static_cast<double>(v[2])};
      one.vertices[i] = c * p + s * base::cross(k, p) + ((1 - c) * base::dot(k, p)) * k + whole.position;
    }
    scene.objects.push_back(object(one, whole.material));
    scene.objects.back().velocity_m_per_s = whole.velocity_m_per_s;
  }
}

/// How many of the values differ by more than rounding: outlines and shadows' edges.
template <class Vector>
double share_that_differs(const Vector& a, const Vector& b, double relative, double absolute) {
  EXPECT_EQ(a.size(), b.size());
  std::size_t other = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    const auto x = static_cast<double>(a[i]), y = static_cast<double>(b[i]);
    if (std::isnan(x) != std::isnan(y) || std::abs(x - y) > absolute + relative * std::abs(y)) ++other;
  }
  return static_cast<double>(other) / static_cast<double>(a.size());
}

Camera camera_with_a_light_aside() {
  Camera camera = lit_camera(96, 80, 90);
  camera.illumination[0].position = {0.3, -0.2, 0.1};
  camera.illumination[0].power_w = 4;
  return camera;
}

SimulatorOptions without_noise() {
  SimulatorOptions out;
  out.noise = Noise::off, out.truth = true;
  return out;
}

}  // namespace

TEST(mesh_in_a_scene, is_seen_and_shaded_as_its_triangles_are) {
  Random random(1);
  for (int trial = 0; trial < 12; ++trial) {
    Scene scene = wall(3, 0.8);
    scene.materials.push_back({"paint", Material::Brdf::phong, 0.4, 0.3, 12});
    if (trial % 3 == 1) scene.ambient = {Ambient::Spectrum::sun_am15, Ambient::Quantity::level, 0.2, {}, {}, Vec3{0.5, 1, 0.7}};
    scene.camera.pose = random_pose(random);
    Object stone_of_many = object(shared(single(stone(random, 2, 0.5, {0.05, 0, 0}))), 1);
    stone_of_many.position = {0, 0, 1.6};
    stone_of_many.rotation = {random.direction(), random.between(-3, 3)};
    if (trial % 3 == 2) stone_of_many.velocity_m_per_s = {8, -4, 3};
    Scene apart = scene;
    add_triangles(stone_of_many, apart);
    scene.objects.push_back(stone_of_many);
    const Camera camera = camera_with_a_light_aside();
    const Frame whole = Simulator(scene, camera, without_noise()).frame(0), pieces = Simulator(apart, camera, without_noise()).frame(0);
    std::size_t on_it = 0;
    for (std::size_t i = 0; i < whole.truth.object_id.size(); ++i) {
      on_it += whole.truth.object_id[i] == 1;
    }
    EXPECT_GT(on_it, 300U);
    EXPECT_LT(share_that_differs(whole.truth.z_m, pieces.truth.z_m, 1e-5, 0), 0.002) << trial;
    EXPECT_LT(share_that_differs(whole.truth.normal, pieces.truth.normal, 0, 1e-4), 0.006) << trial;
    EXPECT_LT(share_that_differs(whole.raw.tap_a, pieces.raw.tap_a, 1e-3, 0.05), 0.01) << trial;
    EXPECT_LT(share_that_differs(whole.raw.tap_b, pieces.raw.tap_b, 1e-3, 0.05), 0.01) << trial;
  }
}

TEST(mesh_in_a_scene, of_many_triangles_is_a_ball) {
  Scene ball = wall(4, 0.8);
  Scene mesh = ball;
  ball.objects.push_back(object(Sphere{{0.1, 0, 1.5}, 0.5}));
  ClosedMesh corners = icosphere(6);
  for (Vec3& v : corners.vertices) v = 0.5 * v;
  mesh.objects.push_back(object(shared(single(corners))));
  mesh.objects.back().position = {0.1, 0, 1.5};
  const Camera camera = camera_with_a_light_aside();
  const Frame a = Simulator(mesh, camera, without_noise()).frame(0), b = Simulator(ball, camera, without_noise()).frame(0);
  double largest = 0, light = 0, count = 0;
  for (std::size_t i = 0; i < a.truth.z_m.size(); ++i) {
    if (a.truth.object_id[i] != 1 || b.truth.object_id[i] != 1) continue;
    const auto at = [&](const std::vector<float>& array) {
      return Vec3{static_cast<double>(array[3 * i]), static_cast<double>(array[3 * i + 1]), static_cast<double>(array[3 * i + 2])};
    };
    const Vec3 p = at(b.truth.position_m);
    const double slant = -base::dot(at(b.truth.normal), p) / base::length(p);
    if (slant < 0.3) continue;  // what is seen almost edge-on
    largest = std::fmax(largest, slant * base::length(p - at(a.truth.position_m)));
    const auto lit = static_cast<double>(b.depth.amplitude_e[i]);
    if (lit > 1) light += static_cast<double>(a.depth.amplitude_e[i]) / lit - 1, ++count;
  }
  EXPECT_GT(count, 1000);
  double nearest = 0.5;  // of the faces' middles to the ball's
  for (const auto& t : corners.triangles)
    nearest = std::fmin(nearest, base::length(1.0 / 3 * (corners.at(t[0]) + corners.at(t[1]) + corners.at(t[2]))));
  EXPECT_LT(largest, 1.1 * (0.5 - nearest));
  EXPECT_NEAR(light / count, 0, 1e-3);
}

TEST(mesh_in_a_scene, of_one_triangle_is_that_triangle) {
  const Triangle one{{{{-0.3, -0.2, 1.5}, {0.4, -0.1, 1.4}, {0, 0.3, 1.6}}}};
  TriangleMesh mesh{{{-0.3F, -0.2F, 1.5F}, {0.4F, -0.1F, 1.4F}, {0, 0.3F, 1.6F}}, {{0, 1, 2}}};
  Scene alone = wall(3, 0.8), meshed = alone;
  alone.objects.push_back(object(one)), meshed.objects.push_back(object(shared(std::move(mesh))));
  const Frame a = Simulator(alone, camera_with_a_light_aside(), without_noise()).frame(0);
  const Frame b = Simulator(meshed, camera_with_a_light_aside(), without_noise()).frame(0);
  EXPECT_GT(std::count(b.truth.object_id.begin(), b.truth.object_id.end(), 1), 200);
  EXPECT_LT(share_that_differs(b.truth.z_m, a.truth.z_m, 1e-6, 0), 0.002);
  EXPECT_LT(share_that_differs(b.raw.tap_a, a.raw.tap_a, 1e-3, 0.05), 0.01);
}

// Two objects may have the same triangles: each is where it is placed, with its own name and material.
TEST(mesh_in_a_scene, may_be_placed_twice) {
  Scene scene = wall(3, 0.8);
  scene.materials.push_back({"dark", Material::Brdf::lambert, 0.1, 0, 1});
  const Mesh both = shared(single(stone(*std::make_unique<Random>(2), 1, 0.2, {0, 0, 0})));
  for (int i = 0; i < 2; ++i) {
    scene.objects.push_back(object(both, i));
    scene.objects.back().position = {i == 0 ? -0.35 : 0.35, 0, 1.5};
  }
  const Frame frame = Simulator(scene, camera_with_a_light_aside(), without_noise()).frame(0);
  double sum[2] = {}, count[2] = {};
  for (std::size_t i = 0; i < frame.truth.object_id.size(); ++i) {
    const int which = frame.truth.object_id[i] - 1;
    if (which < 0) continue;
    EXPECT_EQ(frame.truth.reflectivity[i], which == 0 ? 0.8f : 0.1f);
    sum[which] += static_cast<double>(frame.truth.position_m[3 * i]), ++count[which];
  }
  ASSERT_GT(count[0], 100);
  ASSERT_GT(count[1], 100);
  EXPECT_NEAR(sum[0] / count[0], -0.35, 0.03);
  EXPECT_NEAR(sum[1] / count[1], 0.35, 0.03);
}

TEST(mesh_in_a_scene, without_triangles_is_not_seen) {
  Scene scene = wall(2, 0.8);
  const Frame bare = Simulator(scene, camera_with_a_light_aside(), without_noise()).frame(0);
  scene.objects.push_back(object(shared({})));
  const Frame frame = Simulator(scene, camera_with_a_light_aside(), without_noise()).frame(0);
  EXPECT_EQ(frame.truth.z_m, bare.truth.z_m);
  EXPECT_EQ(frame.raw.tap_a, bare.raw.tap_a);
}

TEST(mesh_in_a_scene, set_in_code_is_checked) {
  const auto refusal = [](const Mesh& mesh) -> std::string {
    Scene scene = wall(2);
    scene.objects.push_back(object(mesh));
    try {
      Simulator(scene, lit_camera(2, 2), without_noise());
    } catch (const Error& error) {
      EXPECT_EQ(error.kind(), ErrorKind::bad_input);
      return error.what();
    }
    return "";
  };
  const auto has = [](const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; };
  TriangleMesh good{{{0, 0, 1}, {1, 0, 1}, {0, 1, 1}}, {{0, 1, 2}}};
  EXPECT_EQ(refusal(shared(good)), "");
  EXPECT_TRUE(has(refusal(Mesh{}), "objects[1].shape")) << refusal(Mesh{});
  EXPECT_TRUE(has(refusal(Mesh{}), "the mesh has no triangles"));
  for (const std::int32_t corner : {-1, 3, 0x7fffffff}) {
    TriangleMesh bad = good;
    bad.triangles[0][1] = corner;
    EXPECT_TRUE(has(refusal(shared(bad)), "triangle 0 of the mesh has a corner that there is not")) << refusal(shared(bad));
  }
  for (const float x : {std::nanf(""), INFINITY, 1.01e5f}) {
    TriangleMesh bad = good;
    bad.vertices[2][0] = x;
    EXPECT_TRUE(has(refusal(shared(bad)), "vertex 2 of the mesh is beyond the world")) << refusal(shared(bad));
  }
}
