// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
// Meshes that a picture cuts out: what is behind a hole is seen through it, lit through it, and light that bounces goes through it.
#include <gtest/gtest.h>

#include <functional>

#include "backend/cpu/cpu.h"
#include "scene/map_levels.h"
#include "scene/vector_maps.h"
#include "support/meshes.h"
#include "support/pixels.h"
#include "support/random.h"
#include "tofray/tofray.h"

using namespace tofray;
using namespace tofray::test;

namespace {

std::shared_ptr<ReflectivityMap> opacity_picture(int width, int height, const std::function<double(int, int)>& value) {
  auto out = std::make_shared<ReflectivityMap>();
  out->width = width, out->height = height, out->wrap_u = out->wrap_v = ReflectivityMap::Wrap::clamp;
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) out->values.push_back(static_cast<float>(value(x, y)));
  return out;
}

/// 8 × 8 squares. Bilinear between four texels of which two are 1 it is ½ on the squares' edges: xy + (1 − x)(1 − y) = ½ where x or y is.
constexpr int squares = 8;
std::shared_ptr<ReflectivityMap> checks() {
  return opacity_picture(squares, squares, [](int x, int y) { return (x + y) % 2; });
}
/// Whether the card of checks has a surface at x, y of it, −1…1; and how far the nearest edge is.
bool is_checked(double x, double y) {
  const auto square = [](double a) { return static_cast<int>(std::floor((a + 1) / 2 * squares)); };
  return (square(x) + square(y)) % 2 == 1;
}
double to_edge(double a) {
  const double place = (a + 1) / 2 * squares;
  return std::abs(place - std::round(place)) * 2 / squares;
}

/// 2 m × 2 m in front of the camera, in two triangles; texture coordinates from the left and from the top.
TriangleMesh sheet(double z) {
  const auto away = static_cast<float>(z);
  TriangleMesh out;
  out.vertices = {{-1, -1, away}, {1, -1, away}, {1, 1, away}, {-1, 1, away}};
  out.triangles = {{0, 1, 2}, {0, 2, 3}};
  out.texcoords = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
  return out;
}

/// A card 1 m away before a wall 2.5 m away.
Scene card_before_wall(const std::shared_ptr<const ReflectivityMap>& opacity) {
  Scene scene = wall(2.5, 0.8);
  scene.materials.push_back({"card", Material::Brdf::lambert, 0.5});
  scene.materials[1].opacity = opacity;
  scene.objects.push_back(object(shared(sheet(1)), 1));
  return scene;
}

Vec3 position_at(const Truth& truth, std::size_t i) {
  const auto at = [&](std::size_t k) { return static_cast<double>(truth.position_m[3 * i + k]); };
  return {at(0), at(1), at(2)};
}

std::vector<Isa> sets_that_run() {
  std::vector<Isa> out;
  for (const Isa isa : backend::every_isa)
    if (backend::can_run(isa)) out.push_back(isa);
  return out;
}

}  // namespace

// At every pixel: the ray meets the card where x = X·z, y = Y·z, and the wall behind each hole.
TEST(cut_out, lets_each_pixel_see_the_exact_depth_behind_its_holes) {
  const Camera camera = lit_camera(96, 80, 60);
  for (const Isa isa : sets_that_run()) {
    const Frame frame = Simulator(card_before_wall(checks()), camera, {.noise = Noise::off, .isa = isa, .truth = true}).frame(0);
    int on_card = 0, through = 0;
    for (std::size_t i = 0; i < frame.truth.z_m.size(); ++i) {
      const double x = (static_cast<double>(i % 96) - camera.lens.cx_px) / camera.lens.fx_px,
                   y = (static_cast<double>(i / 96) - camera.lens.cy_px) / camera.lens.fy_px;
      if (std::abs(x) < 1 && std::abs(y) < 1 && std::fmin(to_edge(x), to_edge(y)) < 1e-6) continue;
      const bool card = std::abs(x) < 1 && std::abs(y) < 1 && is_checked(x, y);
      ASSERT_EQ(frame.truth.object_id[i], card ? 1 : 0) << i << " at " << x << ", " << y;
      ASSERT_NEAR(static_cast<double>(frame.truth.z_m[i]), card ? 1 : 2.5, 2e-6) << i;
      on_card += card, through += !card && std::abs(x) < 1 && std::abs(y) < 1;
    }
    EXPECT_GT(on_card, 2000);
    EXPECT_GT(through, 2000);
  }
}

// The lamp stands aside: what of the wall it lights is known from where the line between them meets the card.
TEST(cut_out, lets_light_through_its_holes_alone) {
  Camera camera = lit_camera(96, 80, 60);
  const Vec3 lamp{0.6, -0.35, 0.1};
  camera.illumination[0].position = lamp, camera.illumination[0].pattern.half_angle_rad = 1.5;
  Scene scene = card_before_wall(checks());
  scene.ambient.spectrum = Ambient::Spectrum::sun_am15, scene.ambient.amount = 0.1;
  scene.ambient.direction = Vec3{0.25, 0.125, 1};
  for (const Isa isa : sets_that_run()) {
    const Frame frame = Simulator(scene, camera, {.noise = Noise::off, .isa = isa, .truth = true}).frame(0);
    int lit = 0, dark = 0, in_the_sun = 0;
    for (std::size_t i = 0; i < frame.truth.z_m.size(); ++i) {
      if (frame.truth.object_id[i] != 0) continue;
      const Vec3 p = position_at(frame.truth, i);
      const auto reached_from = [&](const Vec3& toward, bool& sure) {
        const double share = (1 - p[2]) / toward[2], x = p[0] + share * toward[0], y = p[1] + share * toward[1];
        sure = std::fmin(to_edge(x), to_edge(y)) > 1e-4;
        return std::abs(x) > 1 || std::abs(y) > 1 || !is_checked(x, y);
      };
      bool sure = false;
      const bool by_lamp = reached_from(lamp - p, sure);
      if (sure) {
        ASSERT_EQ(frame.truth.radiance_w_m2_sr[i] > 0, by_lamp) << i;
        lit += by_lamp, dark += !by_lamp;
      }
      const bool by_sun = reached_from({-0.25, -0.125, -1}, sure);
      if (sure) {
        ASSERT_EQ(frame.truth.ambient_e_per_s[i] > 0, by_sun) << i;
        in_the_sun += by_sun;
      }
    }
    EXPECT_GT(lit, 1000);
    EXPECT_GT(dark, 500);
    EXPECT_GT(in_the_sun, 1000);
  }
}

namespace {

/// Four stripes, of which the second and the last are there: as a picture of one sheet, and as two narrow ones. Slanted before a wall in a
/// corner, so that light goes to and fro behind it.
Scene striped(bool by_picture, bool moving) {
  Scene scene = wall(2, 0.9);
  scene.objects.push_back(object(Plane{{1.4, 0, 0}, {-1, 0, 0}}));
  scene.materials.push_back({"stripes", Material::Brdf::lambert, 0.7});
  TriangleMesh mesh = sheet(0);
  if (by_picture) {
    scene.materials[1].opacity = opacity_picture(4, 1, [](int x, int) { return x % 2; });
  } else {
    mesh = {};
    for (const float x : {-0.5F, 0.5F}) {
      const auto first = static_cast<std::int32_t>(mesh.vertices.size());
      for (const auto& corner : {std::array{x, -1.0F, 0.0F}, {x + 0.5F, -1.0F, 0.0F}, {x + 0.5F, 1.0F, 0.0F}, {x, 1.0F, 0.0F}})
        mesh.vertices.push_back(corner);
      mesh.triangles.push_back({first, first + 1, first + 2}), mesh.triangles.push_back({first, first + 2, first + 3});
    }
  }
  scene.objects.push_back(object(shared(std::move(mesh)), 1));
  scene.objects[2].position = {0.1, 0.05, 1.2}, scene.objects[2].rotation = {{0.2, 1, 0}, 0.4};
  if (moving) scene.objects[2].velocity_m_per_s = {4, -3, 1};
  scene.ambient.spectrum = Ambient::Spectrum::sun_am15, scene.ambient.amount = 0.1;
  scene.ambient.direction = Vec3{0.1, 0.3, 1};
  return scene;
}

template <class Vector>
double share_that_differs(const Vector& a, const Vector& b, double relative) {
  EXPECT_EQ(a.size(), b.size());
  std::size_t other = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    const auto x = static_cast<double>(a[i]), y = static_cast<double>(b[i]);
    other += std::isnan(x) != std::isnan(y) || std::abs(x - y) > relative * std::abs(y) + 1e-9;
  }
  return static_cast<double>(other) / static_cast<double>(a.size());
}

}  // namespace

// Stripes of a picture are those of triangles: to the camera, the lamp, the sun and to light that bounces, where they stand and where they
// move. (Rounding decides at edges, in a few of 7680 pixels, and what bounces past one of them.)
TEST(cut_out, is_what_the_same_mesh_cut_by_hand_is) {
  Camera camera = lit_camera(96, 80, 60);
  camera.illumination[0].position = {0.2, -0.1, 0};
  for (const bool moving : {false, true})
    for (const int bounces : {0, 2}) {
      Frame frames[2];
      for (const bool by_picture : {false, true}) {
        Scene scene = striped(by_picture, moving);
        scene.transport.bounces = bounces, scene.transport.samples = 4;
        frames[by_picture] = Simulator(scene, camera, {.noise = Noise::off, .truth = true}).frame(0);
      }
      const Truth &cut = frames[1].truth, &by_hand = frames[0].truth;
      std::size_t on_it = 0;
      for (const std::int32_t id : cut.object_id) on_it += id == 2;
      EXPECT_GT(on_it, 800U);
      EXPECT_LT(share_that_differs(cut.object_id, by_hand.object_id, 0), 2e-3) << moving << bounces;
      EXPECT_LT(share_that_differs(cut.z_m, by_hand.z_m, 1e-5), 2e-3) << moving << bounces;
      EXPECT_LT(share_that_differs(cut.radiance_w_m2_sr, by_hand.radiance_w_m2_sr, 1e-3), 5e-3) << moving << bounces;
      EXPECT_LT(share_that_differs(cut.ambient_e_per_s, by_hand.ambient_e_per_s, 1e-3), 1e-2) << moving << bounces;
      EXPECT_LT(share_that_differs(frames[1].raw.tap_a, frames[0].raw.tap_a, 1e-3), 2e-2) << moving << bounces;
    }
}

// One triangle behind another in the same mesh: what is cut out of the nearer one shows the farther one, not what is behind the mesh.
TEST(cut_out, shows_its_own_triangles_behind_its_holes) {
  TriangleMesh two = sheet(1);
  const TriangleMesh behind = sheet(1.5);
  for (std::size_t i = 0; i < 4; ++i) {
    two.vertices.push_back(behind.vertices[i]);
    two.texcoords.push_back({0.9F * 0.125F, 0.3F * 0.125F + 0.125F});  // in one square, which is there
  }
  for (const auto& [a, b, c] : behind.triangles) two.triangles.push_back({a + 4, b + 4, c + 4});
  Scene scene = card_before_wall(checks());
  scene.objects[1].shape = shared(std::move(two));
  const Frame frame = Simulator(scene, lit_camera(64, 64, 80), {.noise = Noise::off, .truth = true}).frame(0);
  int near = 0, far = 0;
  for (const float z : frame.truth.z_m) near += std::abs(z - 1) < 1e-5F, far += std::abs(z - 1.5F) < 1e-5F;
  EXPECT_GT(near, 1000);
  EXPECT_GT(far, 1000);
  EXPECT_EQ(near + far, 64 * 64);
}

TEST(cut_out, follows_a_mesh_that_changes_its_shape) {
  class Bending : public MeshMotion {
   public:
    void at(double time_s, std::vector<std::array<float, 3>>& vertices, std::vector<std::array<float, 3>>& normals) const override {
      const auto away = static_cast<float>(1 + 2 * time_s);
      vertices = sheet(1).vertices, normals.clear();
      for (auto& v : vertices) v[2] = away;
    }
  };
  Scene scene = card_before_wall(checks());
  std::get<Mesh>(scene.objects[1].shape).motion = std::make_shared<Bending>();
  const Frame frame = Simulator(scene, lit_camera(64, 64, 80), {.noise = Noise::off, .truth = true}).frame(3);
  int through = 0, on_it = 0;
  for (const std::int32_t id : frame.truth.object_id) through += id == 0, on_it += id == 1;
  EXPECT_GT(through, 1000);
  EXPECT_GT(on_it, 1000);
}

TEST(cut_out, is_nothing_without_texture_coordinates) {
  Scene scene = card_before_wall(checks());
  TriangleMesh plain = sheet(1);
  plain.texcoords.clear();
  scene.objects[1].shape = shared(std::move(plain));
  const Frame frame = Simulator(scene, lit_camera(32, 32, 80), {.noise = Noise::off, .truth = true}).frame(0);
  for (const std::int32_t id : frame.truth.object_id) ASSERT_EQ(id, 1);
}

// 0.2 and 0.4 are there, 0.9 is not: neither their mean nor what lies between them and a hole knows it.
TEST(map_levels, leave_out_what_is_cut_out) {
  const auto map = opacity_picture(4, 2, [](int x, int y) { return x >= 2 || y == 1 ? 0.9 : x == 0 ? 0.2 : 0.4; });
  const auto there = opacity_picture(4, 2, [](int x, int y) { return x < 2 && y == 0 ? 0.5 : 0.49; });
  const scene::MapLevels levels(*map, there.get());
  ASSERT_EQ(levels.view.levels, 3);
  const auto texel = [&](int level, int x, int y) {
    return levels.texels[static_cast<std::size_t>(levels.view.start[level] + y * levels.view.width[level] + x)];
  };
  EXPECT_EQ(texel(0, 0, 0), 0.2F);
  EXPECT_EQ(texel(0, 1, 0), 0.4F);
  for (int level = 0; level < 3; ++level)
    for (int y = 0; y < levels.view.height[level]; ++y)
      for (int x = 0; x < levels.view.width[level]; ++x)
        if (level > 0 || y > 0 || x > 1) {
          EXPECT_NEAR(texel(level, x, y), 0.3F, 1e-7F) << level << " " << x << " " << y;
        }
}

// Of four texels a quarter is there, of the four beside them all: the mean of both counts the quarter a quarter as much.
TEST(map_levels, weigh_texels_by_how_much_of_them_is_there) {
  const auto map = opacity_picture(4, 2, [](int x, int y) { return x >= 2 ? 0.5 : x == 0 && y == 0 ? 1.0 : 0.0; });
  const auto there = opacity_picture(4, 2, [](int x, int y) { return x >= 2 || (x == 0 && y == 0) ? 1 : 0; });
  const scene::MapLevels levels(*map, there.get());
  EXPECT_NEAR(levels.texels[static_cast<std::size_t>(levels.view.start[1])], 1.0F, 1e-7F);
  EXPECT_NEAR(levels.texels[static_cast<std::size_t>(levels.view.start[2])], (1 + 4 * 0.5F) / 5, 1e-7F);
  const auto finish = std::make_shared<VectorMap>();
  finish->width = 4, finish->height = 2;
  for (const float a : map->values) finish->values.push_back({0, a, 1});
  const scene::Levels five = scene::levels_of_finish(*finish, there.get());
  EXPECT_NEAR(five[1]->texels[static_cast<std::size_t>(five[1]->view.start[2])], 0.6F, 1e-6F);
}

TEST(cut_out, by_values_that_are_no_opacity_is_refused) {
  Scene scene = card_before_wall(opacity_picture(2, 1, [](int x, int) { return x == 0 ? 1 : -0.5; }));
  try {
    const Simulator simulator(scene, lit_camera(8, 8, 60), {});
    ADD_FAILURE() << "nothing is wrong with it";
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find("value 1 of the map of opacity is out of range"), std::string::npos) << error.what();
  }
}
