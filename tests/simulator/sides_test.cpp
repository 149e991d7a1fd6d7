// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
// No light comes through a surface: not by normals of corners or of pictures, not past an edge, not however far the lamp, not by bounces.
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "scene/motion.h"
#include "support/bounces.h"
#include "support/meshes.h"
#include "support/pixels.h"
#include "support/sanitizers.h"

using namespace tofray;
using namespace tofray::test;
using base::dot;
using base::normalized;
using base::operator*;
using base::operator+;

namespace {

Ambient sun_along(const Vec3& way) { return {Ambient::Spectrum::sun_am15, Ambient::Quantity::level, 1, {}, {}, way}; }

int lit(const std::vector<float>& values) {
  int out = 0;
  for (const float value : values) out += value > 0 ? 1 : 0;
  return out;
}

/// A lamp that shines everywhere, of `power_w`.
void put_lamp(Camera& camera, const Vec3& at, double power_w = 1) {
  camera.illumination[0].pattern.half_angle_rad = pi;
  camera.illumination[0].power_w = power_w;
  camera.illumination[0].position = at;
}

/// Two triangles across z = 0, all of whose corners have one normal.
Scene sheet(const Vec3& normal) {
  TriangleMesh mesh;
  mesh.vertices = {{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}};
  mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
  if (base::length(normal) > 0) {
    for (int i = 0; i < 4; ++i)
      mesh.normals.push_back({static_cast<float>(normal[0]), static_cast<float>(normal[1]), static_cast<float>(normal[2])});
  }
  Scene scene;
  scene.materials.push_back({"matt", Material::Brdf::lambert, 0.5, 0, 1});
  scene.objects.push_back(object(shared(std::move(mesh))));
  scene.objects[0].position = {0, 0, 1};
  return scene;
}

/// The unit sphere, of 20·4^cuts triangles.
TriangleMesh ball(int cuts, bool smooth) {
  TriangleMesh out = single(icosphere(cuts));
  if (smooth) out.normals = out.vertices;
  return out;
}

/// The camera within it, away from its middle.
Scene within(TriangleMesh mesh, double reflectivity = 0.9) {
  Scene scene;
  scene.materials.push_back({"white", Material::Brdf::lambert, reflectivity, 0, 1});
  scene.objects.push_back(object(shared(std::move(mesh))));
  scene.objects[0].position = {0.13, -0.07, 0.21};
  return scene;
}

/// A closed room of rectangles that reach beyond each other.
Scene room_of_rectangles() {
  const Vec3 low{-1, -0.7, -0.5}, high{0.8, 0.9, 1.5};
  Scene scene;
  scene.materials.push_back({"white", Material::Brdf::lambert, 0.9, 0, 1});
  for (std::size_t k = 0; k < 3; ++k) {
    for (const double at : {low[k], high[k]}) {
      Object face = object(Rectangle{{0, 0, 0}, {2.5, 2.5}});
      face.rotation = {k == 0 ? Vec3{0, 1, 0} : Vec3{1, 0, 0}, k == 2 ? 0 : pi / 2};
      face.position = 0.5 * (low + high), face.position[k] = at;
      scene.objects.push_back(face);
    }
  }
  return scene;
}

}  // namespace

// n·l of the facet decides whether light arrives, that of the shading normal how much of it counts.
TEST(light_from_behind, reaches_no_facet_whatever_normals_say) {
  const Vec3 lean = normalized(Vec3{0.5, 0, -0.866025});
  Camera camera = lit_camera(1, 1);
  put_lamp(camera, {5, 0, 2});
  Scene scene = sheet(lean);
  scene.ambient = sun_along({-5, 0, -1});
  const Frame behind = expected_frame(scene, camera);
  EXPECT_EQ(behind.truth.object_id[0], 0);
  EXPECT_EQ(behind.truth.irradiance_w_m2[0], 0.0F);
  EXPECT_EQ(behind.truth.ambient_e_per_s[0], 0.0F);
  // From the other side E = I·(n·l)/r² with the normal of the corners.
  put_lamp(camera, {5, 0, 0}, 4 * pi);
  scene.ambient = sun_along({-5, 0, 1});
  const Frame before = expected_frame(scene, camera);
  const double r2 = 26, cosine = dot(lean, Vec3{5, 0, -1}) / std::sqrt(r2);
  EXPECT_NEAR(before.truth.irradiance_w_m2[0], cosine / r2, 1e-6 * cosine / r2);
  EXPECT_GT(before.truth.ambient_e_per_s[0], 0.0F);
}

// Nor a picture of normals: its lean is that of the sheet above, over all of it.
TEST(light_from_behind, reaches_no_facet_whatever_a_picture_of_normals_says) {
  Scene scene = sheet({0, 0, 0});
  TriangleMesh mesh = *std::get<Mesh>(scene.objects[0].shape).triangles;
  mesh.texcoords = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
  scene.objects[0].shape = shared(std::move(mesh));
  for (const float side : {0.7f, -0.7f}) {
    auto map = std::make_shared<VectorMap>();
    map->width = map->height = 1;
    map->values = {{side, 0, std::sqrt(1 - side * side)}};
    scene.materials[0].normals = map;
    Camera camera = lit_camera(16, 16, 20);
    for (const double x : {5.0, -5.0}) {
      put_lamp(camera, {x, 0, 2});
      scene.ambient = sun_along({-x, 0, -1});
      const Frame frame = expected_frame(scene, camera);
      EXPECT_EQ(lit(frame.truth.irradiance_w_m2), 0) << side << " " << x;
      EXPECT_EQ(lit(frame.truth.ambient_e_per_s), 0) << side << " " << x;
    }
  }
}

// Closed: whatever it is made of, however far the lamp, there is no light inside.
TEST(closed_mesh, is_dark_inside_whatever_stands_outside) {
  for (const bool smooth : {false, true}) {
    for (int cuts = 0; cuts <= (with_sanitizers ? 2 : 5); ++cuts) {
      Scene scene = within(ball(cuts, smooth));
      for (const Vec3& way : {Vec3{0.3, 0.5, 0.8}, Vec3{-1, 0.1, 0.02}, Vec3{0.2, -0.9, -0.4}}) {
        scene.ambient = sun_along(way);
        for (const double far : {0.1, 1.0, 5.0, 40.0, 97.0}) {
          Camera camera = lit_camera(with_sanitizers ? 32 : 160, with_sanitizers ? 24 : 120, with_sanitizers ? 16 : 80);
          put_lamp(camera, scene.objects[0].position + (1 + far) * normalized(-1.0 * way), 100);
          const Frame frame = expected_frame(scene, camera);
          EXPECT_EQ(lit(frame.truth.irradiance_w_m2), 0) << smooth << " " << cuts << " " << far;
          EXPECT_EQ(lit(frame.truth.ambient_e_per_s), 0) << smooth << " " << cuts << " " << far;
        }
      }
    }
  }
}

TEST(closed_room, is_dark_inside_whatever_stands_outside) {
  Scene scene = room_of_rectangles();
  for (const Vec3& into : {Vec3{0.8, 0.9, 1.5}, Vec3{-1, 0.9, 1.5}, Vec3{0.8, -0.7, -0.5}}) {
    scene.camera.pose = {{0, 0, 0}, into, {0, -1, 0}};
    for (const Vec3& way : {Vec3{0.3, 0.5, 0.8}, Vec3{-1, 0.3, 0.2}, Vec3{0.2, -0.9, -0.4}, Vec3{1, 1, 1}}) {
      scene.ambient = sun_along(way);
      for (const double far : {3.0, 10.0, 60.0, 100.0}) {
        Camera camera = lit_camera(with_sanitizers ? 32 : 320, with_sanitizers ? 24 : 240, with_sanitizers ? 16 : 160);
        // The lamp stands where the camera's axes put it.
        put_lamp(camera, -1.0 * far * normalized(way), 100);
        const Frame frame = expected_frame(scene, camera);
        EXPECT_EQ(lit(frame.truth.irradiance_w_m2), 0) << far;
        EXPECT_EQ(lit(frame.truth.ambient_e_per_s), 0);
      }
    }
  }
}

// Seen from within, light that goes on and on finds no way out, nor the sun one in.
TEST(closed_mesh, keeps_light_that_bounces) {
  for (const int cuts : {1, 3}) {
    Scene scene = within(ball(cuts, false));
    const Camera camera = lit_camera(with_sanitizers ? 16 : 64, with_sanitizers ? 16 : 64, with_sanitizers ? 12 : 48);
    for (const bool parallel : {false, true}) {
      scene.ambient = sun_along({0.3, 0.5, 0.8});
      if (!parallel) scene.ambient.direction = {};
      int leaks = 0;
      for (unsigned long long seed = 0; seed < (with_sanitizers ? 1 : 3); ++seed)
        leaks += lit(frame_with_bounces(scene, camera, 8, 64, seed).truth.ambient_e_per_s);
      // Of 5·10⁷ rays to the sun one or two end where nobody knows on which side of an edge they are.
      EXPECT_LE(leaks, parallel ? 2 : 0) << cuts;
    }
  }
}

// A wall turns away behind a corner: there it is dark to the corner itself, however far the lamp.
TEST(shadow, begins_at_the_corner_however_far_the_lamp) {
  for (const double far : {0.5, 5.0, 40.0, 80.0}) {
    Scene scene;
    scene.materials.push_back({"white", Material::Brdf::lambert, 0.5, 0, 1});
    // The floor y = 0.2 m; upright on it, across x = 0, what keeps the lamp at −x off it.
    scene.objects.push_back(object(Plane{{0, 0.2, 0}, {0, -1, 0}}));
    Object upright = object(Rectangle{{0, 0, 0}, {4, 0.4}});
    upright.rotation = {{0, 1, 0}, pi / 2}, upright.position = {0, 0.1, 2};
    scene.objects.push_back(upright);
    Camera camera = lit_camera(129, 129, 3000);
    scene.camera.pose = {{0.05, -1, 1.5}, {0.02, 0.2, 1.5}, {0, 0, 1}};
    // In the camera's axes: x to the world's −x or x, whichever way it is turned; the lamp is put on the far side of the upright.
    const Vec3 aside = scene::camera_frame(scene.camera.pose).rotation * Vec3{-far, -0.5 * far - 0.1, 0};
    put_lamp(camera, aside, 100);
    const Truth t = truth(scene, camera);
    int floor = 0, dark = 0;
    for (std::size_t i = 0; i < t.object_id.size(); ++i) {
      if (t.object_id[i] != 0) continue;
      ++floor, dark += t.irradiance_w_m2[i] == 0.0F ? 1 : 0;
    }
    EXPECT_GT(floor, 1000);
    EXPECT_EQ(dark, floor) << far;
  }
}
