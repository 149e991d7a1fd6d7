// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
// What a mesh's corners say besides their place: smooth normals, and pictures of the reflectivity.
#include <gtest/gtest.h>

#include <algorithm>
#include <functional>

#include "brdf/list.h"
#include "scene/map_levels.h"
#include "support/meshes.h"
#include "support/pixels.h"
#include "support/random.h"
#include "support/random_scene.h"
#include "support/text.h"
#include "tofray/tofray.h"

using namespace tofray;
using namespace tofray::test;

namespace {

Vec3 normal_at(const Truth& truth, std::size_t i) {
  const auto at = [&](std::size_t k) { return static_cast<double>(truth.normal[3 * i + k]); };
  return {at(0), at(1), at(2)};
}

/// A ball of triangles with the normals of the ball.
Mesh smooth_ball(int cuts, double radius) {
  const ClosedMesh corners = icosphere(cuts);
  TriangleMesh out = single(corners);
  out.normals = out.vertices;
  for (auto& v : out.vertices)
    for (float& x : v) x *= static_cast<float>(radius);
  return shared(std::move(out));
}

/// Two triangles, 2 m × 2 m, seen straight on at 2 m; texture coordinates run over `u` and `v` from the left and from the top.
Scene card(std::shared_ptr<const ReflectivityMap> map, std::array<float, 2> u = {0, 1}, std::array<float, 2> v = {0, 1}) {
  TriangleMesh quad;
  quad.vertices = {{-1, -1, 2}, {1, -1, 2}, {1, 1, 2}, {-1, 1, 2}};
  quad.triangles = {{0, 1, 2}, {0, 2, 3}};
  quad.texcoords = {{u[0], v[0]}, {u[1], v[0]}, {u[1], v[1]}, {u[0], v[1]}};
  Scene scene;
  scene.materials = {{"card", Material::Brdf::lambert, 0.5}};
  scene.materials[0].map = std::move(map);
  scene.objects.push_back(object(shared(std::move(quad))));
  return scene;
}

std::shared_ptr<ReflectivityMap> picture(int width, int height, const std::function<double(int, int)>& value) {
  auto out = std::make_shared<ReflectivityMap>();
  out->width = width, out->height = height;
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) out->values.push_back(static_cast<float>(value(x, y)));
  return out;
}

SimulatorOptions expected_values() { return {.noise = Noise::off, .truth = true}; }

/// Bilinear in double, one level, by the words of ReflectivityMap.
double reference(const ReflectivityMap& map, double u, double v) {
  const auto wrapped = [](double a, ReflectivityMap::Wrap wrap) {
    if (wrap == ReflectivityMap::Wrap::clamp) return std::clamp(a, 0.0, 1.0);
    if (wrap == ReflectivityMap::Wrap::repeat) return a - std::floor(a);
    const double pair = a - 2 * std::floor(a / 2);
    return std::min(pair, 2 - pair);
  };
  const auto texel = [&](int x, int y) {
    const auto within = [](int i, int size, ReflectivityMap::Wrap wrap) {
      return wrap == ReflectivityMap::Wrap::repeat ? (i + size) % size : std::clamp(i, 0, size - 1);
    };
    return static_cast<double>(
        map.values[static_cast<std::size_t>(within(y, map.height, map.wrap_v) * map.width + within(x, map.width, map.wrap_u))]);
  };
  const double x = wrapped(u, map.wrap_u) * map.width - 0.5, y = wrapped(v, map.wrap_v) * map.height - 0.5;
  const int column = static_cast<int>(std::floor(x)), row = static_cast<int>(std::floor(y));
  const double right = x - column, low = y - row;
  return (1 - low) * ((1 - right) * texel(column, row) + right * texel(column + 1, row)) +
         low * ((1 - right) * texel(column, row + 1) + right * texel(column + 1, row + 1));
}

}  // namespace

TEST(smooth_normals, are_those_of_the_ball_that_the_corners_lie_on) {
  Random random(1);
  for (int trial = 0; trial < 4; ++trial) {
    Scene scene = wall(4, 0.8);
    Object ball = object(smooth_ball(3, 0.5));
    ball.position = {0.1, 0, 1.5};
    ball.rotation = {random.direction(), random.between(-3, 3)};
    if (trial % 2 == 1) ball.velocity_m_per_s = {3, -2, 5};
    scene.camera.pose = random_pose(random);
    scene.camera.pose.look_at = ball.position;
    scene.objects.push_back(ball);
    const Camera camera = lit_camera(96, 80, 90);
    const Frame smooth = Simulator(scene, camera, expected_values()).frame(0);
    auto flat_triangles = std::make_shared<TriangleMesh>(*std::get<Mesh>(ball.shape).triangles);
    flat_triangles->normals.clear();
    std::get<Mesh>(scene.objects[1].shape).triangles = flat_triangles;
    const Frame flat = Simulator(scene, camera, expected_values()).frame(0);
    scene.objects[1].shape = Sphere{ball.position, 0.5};
    scene.objects[1].position = {};
    const Frame round = Simulator(scene, camera, expected_values()).frame(0);
    double worst = 0, worst_flat = 0, count = 0;
    for (std::size_t i = 0; i < round.truth.object_id.size(); ++i) {
      if (smooth.truth.object_id[i] != 1) continue;
      const Vec3 n = normal_at(smooth.truth, i);
      ASSERT_NEAR(base::length(n), 1, 1e-5);
      const Vec3 p{static_cast<double>(smooth.truth.position_m[3 * i]), static_cast<double>(smooth.truth.position_m[3 * i + 1]),
                   static_cast<double>(smooth.truth.position_m[3 * i + 2])};
      ASSERT_LT(base::dot(n, p), 0) << "turned away from the camera";
      ASSERT_EQ(smooth.truth.z_m[i], flat.truth.z_m[i]);
      if (round.truth.object_id[i] != 1 || base::dot(normal_at(round.truth, i), p) / base::length(p) > -0.3) continue;
      worst = std::fmax(worst, base::length(n - normal_at(round.truth, i)));
      worst_flat = std::fmax(worst_flat, base::length(normal_at(flat.truth, i) - normal_at(round.truth, i)));
      ++count;
    }
    EXPECT_GT(count, 1000);
    EXPECT_LT(worst, 0.02) << trial;
    EXPECT_GT(worst_flat, 0.05) << trial;
  }
}

// The light stands at the camera, so that what a surface sends back depends on one angle, that to the smooth normal: Oren and Nayar's
// A + B·sin θ·tan θ over Lambert's.                                                                   [theory: oren-nayar]
TEST(smooth_normals, are_those_that_materials_see) {
  const Vec3 normal = base::normalized(Vec3{0.5, -0.3, -1});
  Scene scene = card(nullptr);
  auto mesh = std::make_shared<TriangleMesh>(*std::get<Mesh>(scene.objects[0].shape).triangles);
  mesh->normals.assign(4, {static_cast<float>(normal[0]), static_cast<float>(normal[1]), static_cast<float>(normal[2])});
  std::get<Mesh>(scene.objects[0].shape).triangles = mesh;
  const Frame matt = Simulator(scene, lit_camera(64, 64, 60), expected_values()).frame(0);
  scene.materials[0].brdf = Material::Brdf::oren_nayar, scene.materials[0].roughness_rad = 0.6;
  const Frame rough = Simulator(scene, lit_camera(64, 64, 60), expected_values()).frame(0);
  const double a = 1 - 0.5 * 0.36 / (0.36 + 0.33), b = 0.45 * 0.36 / (0.36 + 0.09);
  int count = 0;
  for (std::size_t i = 0; i < matt.truth.object_id.size(); ++i) {
    if (matt.truth.object_id[i] != 0) continue;
    const Vec3 p{static_cast<double>(matt.truth.position_m[3 * i]), static_cast<double>(matt.truth.position_m[3 * i + 1]),
                 static_cast<double>(matt.truth.position_m[3 * i + 2])};
    const double cosine = -base::dot(normal, p) / base::length(p);
    ASSERT_GT(cosine, 0.3);
    ASSERT_NEAR(static_cast<double>(rough.truth.radiance_w_m2_sr[i]) / static_cast<double>(matt.truth.radiance_w_m2_sr[i]),
                a + b * (1 - cosine * cosine) / cosine, 1e-5)
        << i;
    ++count;
  }
  EXPECT_GT(count, 1000);
}

TEST(smooth_normals, of_length_zero_leave_the_triangle_flat) {
  Scene scene = card(nullptr);
  auto mesh = std::make_shared<TriangleMesh>(*std::get<Mesh>(scene.objects[0].shape).triangles);
  mesh->normals.assign(4, {0, 0, 0});
  std::get<Mesh>(scene.objects[0].shape).triangles = mesh;
  const Frame frame = Simulator(scene, lit_camera(32, 32, 60), expected_values()).frame(0);
  for (std::size_t i = 0; i < frame.truth.object_id.size(); ++i)
    if (frame.truth.object_id[i] == 0) {
      ASSERT_EQ(normal_at(frame.truth, i), (Vec3{0, 0, -1}));
    }
}

// At every pixel, for each way to go on beyond the edge: the texture coordinate is a linear function of the place, which is known.
TEST(reflectivity_map, is_interpolated_between_texels_and_goes_on_beyond_its_edges) {
  Random random(2);
  for (const auto wrap : {ReflectivityMap::Wrap::repeat, ReflectivityMap::Wrap::mirror, ReflectivityMap::Wrap::clamp}) {
    const auto map = picture(3, 5, [&](int, int) { return random.uniform(); });
    map->wrap_u = wrap, map->wrap_v = ReflectivityMap::Wrap::clamp;
    const Scene scene = card(map, {-1.7F, 2.4F}, {-0.2F, 1.1F});
    const Frame frame = Simulator(scene, lit_camera(97, 81, 90), expected_values()).frame(0);
    int seen = 0;
    for (std::size_t i = 0; i < frame.truth.object_id.size(); ++i) {
      if (frame.truth.object_id[i] != 0) continue;
      const double x = static_cast<double>(frame.truth.position_m[3 * i]), y = static_cast<double>(frame.truth.position_m[3 * i + 1]);
      const double expected = 0.5 * reference(*map, -1.7 + 4.1 * (x + 1) / 2, -0.2 + 1.3 * (y + 1) / 2);
      ASSERT_NEAR(static_cast<double>(frame.truth.reflectivity[i]), expected, 2e-5) << static_cast<int>(wrap) << " " << i;
      ++seen;
    }
    EXPECT_GT(seen, 2000);
  }
}

// Texels much smaller than a pixel: it sees their mean, not one of them by chance.
TEST(reflectivity_map, of_fine_texels_is_a_mean) {
  const auto checks = picture(512, 512, [](int x, int y) { return (x + y) % 2; });
  const Frame frame = Simulator(card(checks), lit_camera(64, 64, 60), expected_values()).frame(0);
  int seen = 0;
  for (std::size_t i = 0; i < frame.truth.object_id.size(); ++i)
    if (frame.truth.object_id[i] == 0) {
      ASSERT_NEAR(static_cast<double>(frame.truth.reflectivity[i]), 0.25, 1e-6) << i;
      ++seen;
    }
  EXPECT_GT(seen, 1000);
  // Four texels a pixel in either direction: the level that has two of them in one, and the next, halfway.
  const auto stripes = picture(1024, 1, [](int x, int) { return x % 64 < 32 ? 1 : 0; });
  const Frame coarse = Simulator(card(stripes), lit_camera(64, 64, 60), expected_values()).frame(0);
  float least = 1, most = 0;
  for (std::size_t i = 0; i < coarse.truth.object_id.size(); ++i)
    if (coarse.truth.object_id[i] == 0)
      least = std::min(least, coarse.truth.reflectivity[i]), most = std::max(most, coarse.truth.reflectivity[i]);
  EXPECT_LT(least, 0.1F);
  EXPECT_GT(most, 0.4F);
}

// What a pixel sees of the card, in texels: the level's number is half of its logarithm to base two.
TEST(reflectivity_map, changes_level_where_texels_are_as_large_as_pixels) {
  // A map of one level of ones and means that nothing would make: levels tell themselves apart.
  const auto white = picture(256, 256, [](int, int) { return 1.0; });
  scene::MapLevels levels(*white);
  ASSERT_EQ(levels.view.levels, 9);
  for (int level = 0; level < levels.view.levels; ++level) {
    const int size = 256 >> level;
    for (int i = 0; i < size * size; ++i)
      levels.texels[static_cast<std::size_t>(levels.view.start[level] + i)] = static_cast<float>(level) / 10;
  }
  brdf::MapView view = levels.view;
  view.texels = levels.texels.data();
  for (const double texels : {0.0, 1e-3, 1.0, 2.0, 4.0, 16.0, 100.0, 65536.0, 1e12}) {
    const double expected = std::clamp(0.5 * std::log2(std::max(texels, 1.0)), 0.0, 8.0) / 10;
    const float got = brdf::map_value<float>(view, 0.3F, 0.8F, static_cast<float>(texels / 65536));
    EXPECT_NEAR(static_cast<double>(got), expected, 1e-5) << texels;
  }
}

// A card of a quarter of the size at a quarter of the distance looks the same.
TEST(reflectivity_map, has_the_level_of_what_a_pixel_sees_at_any_size) {
  Random random(4);
  const auto stripes = picture(512, 512, [&](int, int) { return random.uniform(); });
  const Scene large = card(stripes);
  Scene small = large;
  auto mesh = std::make_shared<TriangleMesh>(*std::get<Mesh>(large.objects[0].shape).triangles);
  for (auto& v : mesh->vertices)
    for (float& x : v) x *= 0.25F;
  std::get<Mesh>(small.objects[0].shape).triangles = mesh;
  const Frame far = Simulator(large, lit_camera(64, 64, 60), expected_values()).frame(0),
              near = Simulator(small, lit_camera(64, 64, 60), expected_values()).frame(0);
  ASSERT_EQ(far.truth.object_id, near.truth.object_id);
  for (std::size_t i = 0; i < far.truth.object_id.size(); ++i)
    if (far.truth.object_id[i] == 0) {
      ASSERT_NEAR(far.truth.reflectivity[i], near.truth.reflectivity[i], 1e-5F) << i;
    }
}

// Askew by 60 degrees a pixel sees twice as much of the card, as if the picture were twice as dense; along its axis nothing else changes.
TEST(reflectivity_map, has_the_level_of_what_a_pixel_sees_askew) {
  Random random(6);
  std::vector<double> values(512);
  for (double& value : values) value = random.uniform();
  const auto stripes = picture(512, 1, [&](int x, int) { return values[static_cast<std::size_t>(x)]; });
  const Scene dense = card(stripes, {0, 1}, {0, 512});
  Scene askew = card(stripes, {0, 1}, {0, 256});
  auto mesh = std::make_shared<TriangleMesh>(*std::get<Mesh>(askew.objects[0].shape).triangles);
  for (auto& v : mesh->vertices) v = {v[0], 0.5F * v[1], 2 + v[1] * static_cast<float>(std::sqrt(0.75))};
  std::get<Mesh>(askew.objects[0].shape).triangles = mesh;
  const Frame straight = Simulator(dense, lit_camera(64, 65, 60), expected_values()).frame(0),
              turned = Simulator(askew, lit_camera(64, 65, 60), expected_values()).frame(0);
  int count = 0;
  for (std::size_t i = 32 * 64; i < 33 * 64; ++i)
    if (straight.truth.object_id[i] == 0 && turned.truth.object_id[i] == 0) {
      ASSERT_NEAR(straight.truth.reflectivity[i], turned.truth.reflectivity[i], 2e-4F) << i;
      ++count;
    }
  EXPECT_GT(count, 50);
}

TEST(map_levels, keep_the_mean_of_pictures_of_any_size) {
  Random random(3);
  for (const auto& [width, height] :
       {std::pair(1, 1), std::pair(1, 7), std::pair(9, 1), std::pair(5, 3), std::pair(64, 64), std::pair(33, 17)}) {
    const auto map = picture(width, height, [&](int, int) { return random.uniform(); });
    const scene::MapLevels levels(*map);
    double mean = 0;
    for (const float a : map->values) mean += static_cast<double>(a) / (width * height);
    for (int level = 0; level < levels.view.levels; ++level) {
      const int texels = levels.view.width[level] * levels.view.height[level];
      double of_level = 0;
      for (int i = 0; i < texels; ++i)
        of_level += static_cast<double>(levels.texels[static_cast<std::size_t>(levels.view.start[level] + i)]) / texels;
      EXPECT_NEAR(of_level, mean, 1e-6) << width << " x " << height << " level " << level;
    }
    EXPECT_EQ(levels.view.width[levels.view.levels - 1], 1);
    EXPECT_EQ(levels.view.height[levels.view.levels - 1], 1);
    EXPECT_EQ(static_cast<std::size_t>(levels.view.texel_count), levels.texels.size());
  }
}

// A map scales what the matt part sends back, light and truth alike; highlights stay.
TEST(reflectivity_map, scales_the_matt_part_of_every_material) {
  Material phong{"", Material::Brdf::phong, 0.5, 0.3, 12}, rough{"", Material::Brdf::oren_nayar, 0.6, 0, 1, 0.4};
  Material metal{"", Material::Brdf::ggx, 0.5, 0.3}, sheet{"", Material::Brdf::retro, 0.4};
  sheet.retro = 0.2, sheet.spread_rad = 0.3;
  const auto half = picture(1, 1, [](int, int) { return 0.5; });
  for (const Material& one : {Material{"", Material::Brdf::lambert, 0.6}, phong, rough, metal, sheet}) {
    Scene mapped = card(half), by_number = card(nullptr);
    mapped.materials[0] = one, mapped.materials[0].map = half;
    by_number.materials[0] = one, by_number.materials[0].diffuse = 0.5 * one.diffuse;
    const Frame a = Simulator(mapped, lit_camera(32, 32, 60), expected_values()).frame(0);
    const Frame b = Simulator(by_number, lit_camera(32, 32, 60), expected_values()).frame(0);
    int seen = 0;
    for (std::size_t i = 0; i < a.truth.object_id.size(); ++i) {
      if (a.truth.object_id[i] != 0) continue;
      ++seen;
      ASSERT_NEAR(a.truth.reflectivity[i], b.truth.reflectivity[i], 1e-6F) << static_cast<int>(one.brdf);
      ASSERT_NEAR(a.truth.radiance_w_m2_sr[i], b.truth.radiance_w_m2_sr[i], 1e-5F * b.truth.radiance_w_m2_sr[i])
          << static_cast<int>(one.brdf);
    }
    EXPECT_GT(seen, 500);
  }
}

// In code, too, what is wrong is told.
TEST(mesh_details, have_to_fit) {
  const auto refusal = [](const std::function<void(TriangleMesh&, Material&)>& change) {
    Scene scene = card(picture(2, 2, [](int, int) { return 1; }));
    auto mesh = std::make_shared<TriangleMesh>(*std::get<Mesh>(scene.objects[0].shape).triangles);
    change(*mesh, scene.materials[0]);
    std::get<Mesh>(scene.objects[0].shape).triangles = mesh;
    try {
      const Simulator simulator(scene, lit_camera(8, 8, 60), expected_values());
    } catch (const Error& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  const auto map = [](int width, int height, std::vector<float> values) {
    return std::make_shared<ReflectivityMap>(ReflectivityMap{width, height, std::move(values)});
  };
  EXPECT_EQ(refusal([](TriangleMesh&, Material&) {}), "");
  EXPECT_TRUE(has(refusal([](TriangleMesh& m, Material&) { m.texcoords.pop_back(); }), "not as many texture coordinates as vertices"));
  EXPECT_TRUE(has(refusal([](TriangleMesh& m, Material&) { m.normals.assign(3, {0, 0, 1}); }), "not as many normals as vertices"));
  EXPECT_TRUE(has(refusal([](TriangleMesh& m, Material&) { m.texcoords[2][1] = std::nanf(""); }), "texture coordinates of vertex 2"));
  EXPECT_TRUE(has(refusal([](TriangleMesh& m, Material&) { m.normals.assign(4, {0, 0, 3}); }), "normals of vertex 0"));
  EXPECT_EQ(refusal([](TriangleMesh& m, Material&) { m.normals.assign(4, {0, 0, 2}), m.texcoords[1] = {1e6F, -1e6F}; }), "");
  EXPECT_TRUE(has(refusal([](TriangleMesh& m, Material&) { m.texcoords[1][0] = 1.5e6F; }), "texture coordinates of vertex 1"));
  EXPECT_TRUE(has(refusal([&](TriangleMesh&, Material& m) { m.map = map(2, 2, {1, 1, 1}); }), "not as many values as pixels"));
  EXPECT_TRUE(has(refusal([&](TriangleMesh&, Material& m) { m.map = map(0, 2, {}); }), "no size that it may have"));
  EXPECT_TRUE(
      has(refusal([&](TriangleMesh&, Material& m) { m.map = map(40000, 1, std::vector<float>(40000)); }), "no size that it may have"));
  EXPECT_TRUE(has(refusal([&](TriangleMesh&, Material& m) { m.map = map(1, 2, {0.5F, 1.5F}); }), "value 1 of the reflectivity map"));
}
