// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
// Pictures of normals, of metal and roughness, and what a mesh's vertices say of their reflectivity.
#include <gtest/gtest.h>

#include <algorithm>
#include <functional>

#include "support/meshes.h"
#include "support/pixels.h"
#include "support/random.h"
#include "support/random_scene.h"
#include "support/text.h"
#include "tofray/tofray.h"

using namespace tofray;
using namespace tofray::test;

namespace {

using base::operator+;
using base::operator-;
using base::operator*;

using Texel = std::array<float, 3>;

std::shared_ptr<VectorMap> vectors(int width, int height, const std::function<Vec3(int, int)>& value) {
  auto out = std::make_shared<VectorMap>();
  out->width = width, out->height = height;
  out->wrap_u = out->wrap_v = ReflectivityMap::Wrap::clamp;
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      const Vec3 v = value(x, y);
      out->values.push_back({static_cast<float>(v[0]), static_cast<float>(v[1]), static_cast<float>(v[2])});
    }
  return out;
}
std::shared_ptr<VectorMap> vectors(const Vec3& all) {
  return vectors(1, 1, [&](int, int) { return all; });
}

/// A parallelogram: its first corner, and its sides, along which its own coordinates a and b go from 0 to 1.
struct Patch {
  Vec3 corner, side_a, side_b;
  std::array<std::array<double, 2>, 3> uv;  ///< at (0, 0), (1, 0) and (0, 1)

  [[nodiscard]] std::array<double, 2> uv_at(double a, double b) const {
    const auto of = [&](std::size_t k) { return uv[0][k] + a * (uv[1][k] - uv[0][k]) + b * (uv[2][k] - uv[0][k]); };
    return {of(0), of(1)};
  }
  [[nodiscard]] TriangleMesh mesh() const {
    TriangleMesh out;
    for (const auto& [a, b] : {std::pair(0, 0), std::pair(1, 0), std::pair(1, 1), std::pair(0, 1)}) {
      const Vec3 p = corner + static_cast<double>(a) * side_a + static_cast<double>(b) * side_b;
      out.vertices.push_back({static_cast<float>(p[0]), static_cast<float>(p[1]), static_cast<float>(p[2])});
      const auto [u, v] = uv_at(a, b);
      out.texcoords.push_back({static_cast<float>(u), static_cast<float>(v)});
    }
    out.triangles = {{0, 1, 2}, {0, 2, 3}};
    return out;
  }
  /// The place with these texture coordinates, by Cramer's rule.
  [[nodiscard]] Vec3 at(double u, double v) const {
    const double ua = uv[1][0] - uv[0][0], va = uv[1][1] - uv[0][1], ub = uv[2][0] - uv[0][0], vb = uv[2][1] - uv[0][1];
    const double whole = ua * vb - ub * va, du = u - uv[0][0], dv = v - uv[0][1];
    return corner + ((du * vb - ub * dv) / whole) * side_a + ((ua * dv - du * va) / whole) * side_b;
  }
};

/// 2 m × 2 m, seen straight on at 2 m, its front toward the camera; u to the right, v downward.
Patch card_patch() { return {{-1, -1, 2}, {0, 2, 0}, {2, 0, 0}, {{{0, 0}, {0, 1}, {1, 0}}}}; }

Scene scene_of(TriangleMesh mesh, const Material& material) {
  Scene scene;
  scene.materials = {material};
  scene.objects.push_back(object(shared(std::move(mesh))));
  return scene;
}

Frame seen(const Scene& scene, int size = 48) {
  return Simulator(scene, lit_camera(size, size, 0.9 * size), {.noise = Noise::off, .truth = true}).frame(0);
}
template <class Values>
Vec3 three(const Values& all, std::size_t i) {
  return {static_cast<double>(all[3 * i]), static_cast<double>(all[3 * i + 1]), static_cast<double>(all[3 * i + 2])};
}

template <class Check>
int each_seen(const Frame& frame, const Check& check) {
  int count = 0;
  for (std::size_t i = 0; i < frame.truth.object_id.size(); ++i)
    if (frame.truth.object_id[i] == 0) check(i), ++count;
  return count;
}

const Material matt{"", Material::Brdf::lambert, 0.6};

}  // namespace

// As glTF has it: red to the right, green up, on a picture whose v grows downward.
TEST(leaning_normals, point_right_up_and_out_of_a_card) {
  for (const Vec3& lean : {Vec3{0.3, 0, 0.9539392}, Vec3{0, 0.3, 0.9539392}, Vec3{-0.2, 0.4, 0.8944272}, Vec3{0, 0, 1}}) {
    Material leaning = matt;
    leaning.normals = vectors(lean);
    const Frame frame = seen(scene_of(card_patch().mesh(), leaning));
    const int count = each_seen(frame, [&](std::size_t i) {
      const Vec3 n = three(frame.truth.normal, i);
      ASSERT_LT(base::length(n - Vec3{lean[0], -lean[1], -lean[2]}), 2e-6) << n[0] << " " << n[1] << " " << n[2];
    });
    EXPECT_GT(count, 1000);
  }
}

// Any parallelogram, anywhere, with any linear texture coordinates, mirrored ones too, seen from either side: the axes are what a small
// step of u and of v do, in double.
TEST(leaning_normals, follow_the_texture_coordinates) {
  Random random(11);
  int all = 0;
  for (int trial = 0; trial < 60; ++trial) {
    const Vec3 lean = base::normalized(Vec3{random.between(-0.6, 0.6), random.between(-0.6, 0.6), 1});
    Patch patch{{}, random.between(0.8, 1.5) * random.direction(), random.between(0.8, 1.5) * random.direction(), {}};
    const Vec3 across = base::cross(patch.side_a, patch.side_b);
    if (base::length(across) < 0.3) continue;
    patch.corner = Vec3{0, 0, 2.5} - 0.5 * (patch.side_a + patch.side_b);
    for (auto& corner : patch.uv) corner = {random.between(-2, 2), random.between(-2, 2)};
    const double area = (patch.uv[1][0] - patch.uv[0][0]) * (patch.uv[2][1] - patch.uv[0][1]) -
                        (patch.uv[1][1] - patch.uv[0][1]) * (patch.uv[2][0] - patch.uv[0][0]);
    if (std::abs(area) < 0.1) continue;
    Material leaning = matt;
    leaning.normals = vectors(lean);
    const bool by_corners = trial % 2 == 1;
    TriangleMesh mesh = patch.mesh();
    const Vec3 outward = base::normalized(across);
    if (by_corners)
      mesh.normals.assign(4, {static_cast<float>(outward[0]), static_cast<float>(outward[1]), static_cast<float>(outward[2])});
    const Vec3 x = base::normalized(patch.at(1e-3, 0) - patch.at(0, 0)), down = patch.at(0, 1e-3) - patch.at(0, 0);
    const Vec3 y = base::normalized(base::dot(down, x) * x - down);
    const Vec3 out = lean[0] * x + lean[1] * y + lean[2] * outward;
    const Frame frame = seen(scene_of(mesh, leaning), 24);
    all += each_seen(frame, [&](std::size_t i) {
      const Vec3 p = base::normalized(three(frame.truth.position_m, i));
      const double side = base::dot(outward, p) < 0 ? 1 : -1;
      if (side * base::dot(out, p) > -0.03) return;  // turned back until it faces the camera
      const Vec3 n = three(frame.truth.normal, i);
      // Texture coordinates are rounded to 2^-23 of 2, their determinant is 0.1 at least of sides of 0.3: 1e-5.
      ASSERT_LT(base::length(n - side * out), 3e-5) << trial;
    });
  }
  EXPECT_GT(all, 2000);
}

// Between texels it is the direction of the mean, and what the light does follows it.
TEST(leaning_normals, are_interpolated_and_turn_the_light_with_them) {
  Random random(12);
  const auto map = vectors(5, 3, [&](int, int) { return base::normalized(Vec3{random.between(-0.5, 0.5), random.between(-0.5, 0.5), 1}); });
  Material leaning = matt;
  leaning.normals = map;
  const Frame frame = seen(scene_of(card_patch().mesh(), leaning), 96), flat = seen(scene_of(card_patch().mesh(), matt), 96);
  const Vec3 light = lit_camera().illumination[0].position;
  const auto texel = [&](int x, int y) {
    const Texel& t = map->values[static_cast<std::size_t>(std::clamp(y, 0, 2) * 5 + std::clamp(x, 0, 4))];
    return Vec3{static_cast<double>(t[0]), static_cast<double>(t[1]), static_cast<double>(t[2])};
  };
  double largest = 0;
  const int count = each_seen(frame, [&](std::size_t i) {
    const Vec3 p = three(frame.truth.position_m, i);
    const double x = (p[0] + 1) / 2 * 5 - 0.5, y = (p[1] + 1) / 2 * 3 - 0.5, right = x - std::floor(x), low = y - std::floor(y);
    const int column = static_cast<int>(std::floor(x)), row = static_cast<int>(std::floor(y));
    const Vec3 mean = (1 - low) * ((1 - right) * texel(column, row) + right * texel(column + 1, row)) +
                      low * ((1 - right) * texel(column, row + 1) + right * texel(column + 1, row + 1));
    const Vec3 lean = base::normalized(mean), expected{lean[0], -lean[1], -lean[2]};
    ASSERT_LT(base::length(three(frame.truth.normal, i) - expected), 3e-5) << i;
    const Vec3 to_light = base::normalized(light - p);
    const double more = base::dot(expected, to_light) / -to_light[2];
    ASSERT_NEAR(static_cast<double>(frame.truth.radiance_w_m2_sr[i]), more * static_cast<double>(flat.truth.radiance_w_m2_sr[i]),
                1e-4 * static_cast<double>(flat.truth.radiance_w_m2_sr[i]));
    largest = std::fmax(largest, std::abs(more - 1));
  });
  EXPECT_GT(count, 4000);
  EXPECT_GT(largest, 0.05);
}

// On smooth normals the axes are what is left of u across them, and what stands on both.
TEST(leaning_normals, stand_on_smooth_normals) {
  Material leaning = matt;
  const Vec3 lean = base::normalized(Vec3{0.3, 0.4, 1}), normal = base::normalized(Vec3{0.4, 0.25, -1});
  leaning.normals = vectors(lean);
  TriangleMesh mesh = card_patch().mesh();
  mesh.normals.assign(4, {static_cast<float>(normal[0]), static_cast<float>(normal[1]), static_cast<float>(normal[2])});
  const Frame frame = seen(scene_of(mesh, leaning));
  const Vec3 x = base::normalized(Vec3{1, 0, 0} - normal[0] * normal), y = base::cross(normal, x);
  ASSERT_LT(y[1], 0) << "up, against v";
  const Vec3 expected = lean[0] * x + lean[1] * y + lean[2] * normal;
  EXPECT_GT(each_seen(frame, [&](std::size_t i) { ASSERT_LT(base::length(three(frame.truth.normal, i) - expected), 3e-6); }), 1000);
}

// A file's vectors need not be of unit length: it is their directions that are mixed.
TEST(leaning_normals, are_mixed_as_directions) {
  const auto two = [](double left, double right) {
    Material out = matt;
    out.normals = vectors(2, 1, [=](int x, int) { return x == 0 ? left * Vec3{0.6, 0, 0.8} : right * Vec3{-0.6, 0.48, 0.64}; });
    return seen(scene_of(card_patch().mesh(), out));
  };
  const Frame units = two(1, 1), others = two(0.6, 1.4);
  EXPECT_GT(
      each_seen(units, [&](std::size_t i) { ASSERT_LT(base::length(three(units.truth.normal, i) - three(others.truth.normal, i)), 1e-6); }),
      1000);
}

// What a pixel does not resolve has the direction of its mean: of slopes that cancel none.
TEST(leaning_normals, finer_than_pixels_are_a_mean) {
  Material leaning = matt;
  leaning.normals = vectors(512, 512, [](int x, int y) { return Vec3{(x + y) % 2 == 0 ? 0.6 : -0.6, 0, 0.8}; });
  const Frame frame = seen(scene_of(card_patch().mesh(), leaning));
  EXPECT_GT(each_seen(frame, [&](std::size_t i) { ASSERT_LT(base::length(three(frame.truth.normal, i) - Vec3{0, 0, -1}), 1e-5); }), 1000);
}

// Without coordinates that say which way u grows nothing leans.
TEST(leaning_normals, need_texture_coordinates_that_grow) {
  Material leaning = matt;
  leaning.normals = vectors(Vec3{0.6, 0, 0.8});
  TriangleMesh mesh = card_patch().mesh();
  mesh.texcoords.assign(4, {0.5F, 0.5F});
  const Frame frame = seen(scene_of(mesh, leaning));
  EXPECT_GT(each_seen(frame, [&](std::size_t i) { ASSERT_EQ(three(frame.truth.normal, i), (Vec3{0, 0, -1})); }), 1000);
}

// One texel says what the material's numbers would.
TEST(finish, of_one_texel_is_the_materials_own) {
  Random random(13);
  for (int trial = 0; trial < 12; ++trial) {
    Material by_number{"", Material::Brdf::ggx, random.uniform(), random.uniform()}, by_map{"", Material::Brdf::ggx, 0.5, 0.5};
    by_number.alpha = std::pow(random.between(0.1, 1), 2);
    by_map.finish = vectors({by_number.diffuse, by_number.specular, by_number.alpha});
    const Frame a = seen(scene_of(card_patch().mesh(), by_map)), b = seen(scene_of(card_patch().mesh(), by_number));
    EXPECT_GT(each_seen(a,
                        [&](std::size_t i) {
                          // Between 1,024 steps of the root of alpha the share of light is a line: 1e-6 off.
                          ASSERT_NEAR(a.truth.reflectivity[i], b.truth.reflectivity[i], 3e-6F) << trial;
                          ASSERT_NEAR(a.truth.radiance_w_m2_sr[i], b.truth.radiance_w_m2_sr[i], 2e-5F * b.truth.radiance_w_m2_sr[i])
                              << trial;
                        }),
              1000);
  }
}

// How much of it is matt says the picture, too: that part alone is scaled by shades.
TEST(finish, says_how_much_is_matt) {
  Material by_number{"", Material::Brdf::ggx, 0.7, 0.1}, by_map{"", Material::Brdf::ggx, 0.2, 0.6};
  by_number.alpha = 0.4;
  by_map.finish = vectors({by_number.diffuse, by_number.specular, by_number.alpha});
  TriangleMesh mesh = card_patch().mesh();
  mesh.shades.assign(4, 0.3F);
  const Frame a = seen(scene_of(mesh, by_map)), b = seen(scene_of(mesh, by_number));
  EXPECT_GT(each_seen(a,
                      [&](std::size_t i) {
                        ASSERT_NEAR(a.truth.reflectivity[i], b.truth.reflectivity[i], 3e-6F);
                        ASSERT_NEAR(a.truth.radiance_w_m2_sr[i], b.truth.radiance_w_m2_sr[i], 2e-5F * b.truth.radiance_w_m2_sr[i]);
                      }),
            1000);
}

// Halfway between two texels the ground, F_0 and the square of alpha are halfway.
TEST(finish, is_interpolated) {
  Material two{"", Material::Brdf::ggx, 0.5, 0.5};
  two.finish = vectors(2, 1, [](int x, int) { return x == 0 ? Vec3{0.8, 0.04, 0.3} : Vec3{0, 0.9, 0.7}; });
  const Frame frame = seen(scene_of(card_patch().mesh(), two), 97);
  const auto ground = [](double diffuse, double f0) { return (1 - f0) * diffuse; };
  const auto part_at = [&](std::size_t i) {
    return std::clamp((static_cast<double>(frame.truth.position_m[3 * i]) + 1) / 2 * 2 - 0.5, 0.0, 1.0);
  };
  for (const std::size_t column : {8U, 30U, 40U, 48U, 55U, 66U, 90U}) {
    const double part = part_at(48 * 97 + column);
    Material mean{"", Material::Brdf::ggx, 0, 0.04 + part * 0.86};
    mean.diffuse = (ground(0.8, 0.04) + part * (0 - ground(0.8, 0.04))) / (1 - mean.specular);
    mean.alpha = std::sqrt(0.09 + part * (0.49 - 0.09));
    const Frame same = seen(scene_of(card_patch().mesh(), mean), 97);
    int count = 0;
    each_seen(frame, [&](std::size_t i) {
      if (std::abs(part_at(i) - part) > 1e-5) return;
      ++count;
      const double expected = static_cast<double>(same.truth.radiance_w_m2_sr[i]);
      ASSERT_NEAR(static_cast<double>(frame.truth.radiance_w_m2_sr[i]), expected, 1e-4 * expected) << part;
    });
    EXPECT_GT(count, 20) << part;
  }
}

// Across a triangle a shade is the mean of its corners' by area, which on a flat triangle is a linear function of the place.
TEST(shades, scale_the_matt_part_from_corner_to_corner) {
  const auto at_corner = [](double x, double y) { return 0.5 + 0.2 * x - 0.25 * y; };
  Material shiny{"", Material::Brdf::ggx, 0.5, 0.3};
  Material pictured = matt;
  pictured.map = std::make_shared<ReflectivityMap>(ReflectivityMap{1, 1, {0.5F}});
  for (const Material& material : {matt, shiny, pictured}) {
    TriangleMesh mesh = card_patch().mesh();
    for (const auto& v : mesh.vertices)
      mesh.shades.push_back(static_cast<float>(at_corner(static_cast<double>(v[0]), static_cast<double>(v[1]))));
    if (material.map == nullptr) mesh.texcoords.clear();
    const Frame frame = seen(scene_of(mesh, material));
    Material black = material;
    black.diffuse = 0;
    const Frame bright = seen(scene_of(card_patch().mesh(), material)), dark = seen(scene_of(card_patch().mesh(), black));
    const int count = each_seen(frame, [&](std::size_t i) {
      const Vec3 p = three(frame.truth.position_m, i);
      const double shade = at_corner(p[0], p[1]);
      const auto check = [&](const auto& got, const auto& full, const auto& none) {
        const double most = static_cast<double>(full[i]), least = static_cast<double>(none[i]);
        ASSERT_NEAR(static_cast<double>(got[i]), least + shade * (most - least), 1e-5 * most);
      };
      check(frame.truth.reflectivity, bright.truth.reflectivity, dark.truth.reflectivity);
      check(frame.truth.radiance_w_m2_sr, bright.truth.radiance_w_m2_sr, dark.truth.radiance_w_m2_sr);
    });
    EXPECT_GT(count, 1000);
  }
}

TEST(lean_and_finish, have_to_fit) {
  const auto refusal = [](const std::function<void(TriangleMesh&, Material&)>& change) {
    TriangleMesh mesh = card_patch().mesh();
    Material material{"", Material::Brdf::ggx, 0.5, 0.04};
    change(mesh, material);
    try {
      const Simulator simulator(scene_of(mesh, material), lit_camera(8, 8, 60));
    } catch (const Error& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  const auto one = [](const Vec3& value) { return vectors(value); };
  EXPECT_EQ(refusal([&](TriangleMesh& mesh, Material& m) {
              m.normals = one({0, 0.6, 0.8}), m.finish = one({1, 1, 1}), mesh.shades.assign(4, 1);
            }),
            "");
  EXPECT_TRUE(has(refusal([&](TriangleMesh&, Material& m) {
                    m.normals = one({0.6, 0, 0});
                  }),
                  "value 0 of the map of normals is no direction out of the surface\n  got [0.6"));
  EXPECT_TRUE(has(refusal([&](TriangleMesh&, Material& m) { m.normals = one({0, 0, 0.4}); }), "a length of 0.5 to 1.5"));
  EXPECT_TRUE(has(refusal([&](TriangleMesh&, Material& m) { m.normals = one({std::nan(""), 0, 1}); }), "value 0 of the map of normals"));
  EXPECT_TRUE(has(refusal([&](TriangleMesh&, Material& m) { m.finish = one({1, 1.5, 1}); }), "value 0 of the map of the finish"));
  EXPECT_TRUE(has(refusal([&](TriangleMesh&, Material& m) { m.finish = one({1, 1, 0}); }), "an alpha of 0.001 to 1"));
  EXPECT_TRUE(has(refusal([&](TriangleMesh&, Material& m) {
                    m.finish = one({1, 1, 1}), m.brdf = Material::Brdf::lambert;
                  }),
                  "the material has a map of its finish\n  expected the brdf ggx"));
  EXPECT_TRUE(has(refusal([&](TriangleMesh&, Material& m) {
                    auto map = vectors(2, 2, [](int, int) { return Vec3{0, 0, 1}; });
                    map->values.pop_back();
                    m.normals = map;
                  }),
                  "the map of normals has not as many values as pixels\n  got 3, expected 4"));
  EXPECT_TRUE(has(refusal([&](TriangleMesh& mesh, Material&) { mesh.shades.assign(3, 1); }), "not as many shades as vertices"));
  EXPECT_TRUE(
      has(refusal([&](TriangleMesh& mesh, Material&) { mesh.shades.assign(4, 1.5F); }), "the shade of vertex 0 of the mesh is out"));
  EXPECT_TRUE(has(refusal([&](TriangleMesh& mesh, Material&) { mesh.shades.assign(4, std::nanf("")); }), "the shade of vertex 0"));
}
