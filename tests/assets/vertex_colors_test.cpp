// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
// Colours of vertices of PLY and OBJ files, as programs show them: the reflectivity of what says nothing better.
#include <gtest/gtest.h>

#include <cmath>

#include "assets/mesh_load.h"
#include "load/load.h"
#include "support/samples.h"
#include "support/text.h"

using namespace tofray;
using test::has;

namespace {

/// Luminance of colours in sRGB: IEC 61966-2-1 and ITU-R BT.709.
double luminance_of(double red, double green, double blue) {
  const auto linear = [](double a) { return a <= 0.04045 ? a / 12.92 : std::pow((a + 0.055) / 1.055, 2.4); };
  return 0.2126 * linear(red) + 0.7152 * linear(green) + 0.0722 * linear(blue);
}

class vertex_colors : public testing::Test {
 protected:
  void save(const std::string& name, const std::string& bytes) const { out_test::write_file(folder_.path() / name, bytes); }
  [[nodiscard]] Scene scene(const std::string& keys) const {
    return load::scene_from_text("objects:\n  - mesh: {" + keys + "}\n", (folder_.path() / "s.yaml").string());
  }
  [[nodiscard]] std::string refused(const std::string& keys) const {
    return out_test::error_of([&] { (void)scene(keys); }).what();
  }
  static const Mesh& mesh(const Scene& scene, std::size_t object = 0) { return std::get<Mesh>(scene.objects.at(object).shape); }
  static void expect_shades(const Scene& scene, const std::vector<double>& expected, std::size_t object = 0) {
    const std::vector<float>& got = mesh(scene, object).triangles->shades;
    ASSERT_EQ(got.size(), expected.size());
    for (std::size_t i = 0; i < got.size(); ++i) EXPECT_NEAR(static_cast<double>(got[i]), expected[i], 1e-6) << i;
  }
  static std::string ply(const std::string& type, const std::string& colors) {
    std::string rows = colors;
    return "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty " + type + " red\nproperty float y\nproperty " + type +
           " green\nproperty " + type + " blue\nproperty float z\nelement face 1\nproperty list uchar int vertex_indices\nend_header\n" +
           rows + "3 0 1 2\n";
  }

  out_test::TemporaryFolder folder_;
};

}  // namespace

TEST_F(vertex_colors, of_a_ply_file_are_its_reflectivity) {
  save("a.ply", ply("uchar", "0 255 0 51 0 0\n1 0 0 102 204 0\n0 255 1 255 255 0\n"));
  const std::vector<double> expected = {luminance_of(1, 0.2, 0), luminance_of(0, 0.4, 0.8), 1};
  const Scene got = scene("file: a.ply");
  EXPECT_EQ(got.objects.at(0).name, "a/no material");
  EXPECT_EQ(got.materials.at(0).brdf, Material::Brdf::lambert);
  EXPECT_EQ(got.materials.at(0).diffuse, 1);
  EXPECT_EQ(mesh(got).guessed, 1);
  expect_shades(got, expected);
  save("a.ply", ply("ushort", "0 65535 0 13107 0 0\n1 0 0 26214 52428 0\n0 65535 1 65535 65535 0\n"));
  expect_shades(scene("file: a.ply"), expected);
  save("a.ply", ply("float", "0 1 0 0.2 0 0\n1 0 0 0.4 0.8 0\n0 1 1 1 1 0\n"));
  expect_shades(scene("file: a.ply"), expected);
  EXPECT_TRUE(mesh(scene("file: a.ply, reflectivity: 0.3")).triangles->shades.empty());
  EXPECT_EQ(scene("file: a.ply, reflectivity: 0.3").materials.at(0).diffuse, 0.3);
}

TEST_F(vertex_colors, beyond_their_range_are_held_there) {
  save("a.ply", ply("float", "0 2 0 0 0 0\n1 -1 0 0 0 0\n0 nan 1 1 1 0\n"));
  const Scene got = scene("file: a.ply");
  expect_shades(got, {0.2126, 0, 0.7152 + 0.0722});
  ASSERT_EQ(mesh(got).notices.size(), 1U);
  EXPECT_EQ(mesh(got).notices[0], "colours beyond 0 to 1 (3) are held there");
}

TEST_F(vertex_colors, are_needed_where_nothing_says_a_material) {
  save("a.ply", ply("int", "0 1 0 1 1 0\n1 1 0 1 1 0\n0 1 1 1 1 0\n"));  // of how many?
  EXPECT_TRUE(has(refused("file: a.ply"), "s.yaml:2:11: error: mesh lacks a key\n  expected one of")) << refused("file: a.ply");
  EXPECT_TRUE(has(refused("file: a.ply"), "\"a.ply\" has neither colours of vertices nor a picture that can be read"));
  EXPECT_TRUE(has(refused("file: a.stl"), "mesh lacks a key"));
  EXPECT_FALSE(assets::has_own_materials("a.ply", (folder_.path() / "s.yaml").string(), ""));
  save("a.ply", ply("uchar", "0 1 0 1 1 0\n1 1 0 1 1 0\n0 1 1 1 1 0\n"));
  EXPECT_TRUE(assets::has_own_materials("a.ply", (folder_.path() / "s.yaml").string(), ""));
}

// A weight may stand before them. Vertices without are white, also those that come before; those that become several keep theirs.
TEST_F(vertex_colors, of_an_obj_file_follow_its_vertices) {
  save("a.obj", "v 0 0 0\nv 1 0 0 0 1 0 0.5\nv 0 1 0 0 0 1\nv nan 0 0 1 1 1\nvt 0 0\nvt 1 1\nf 1/1 2/1 3/1\nf 1/1 2/2 3/2\n");
  const Scene got = scene("file: a.obj");
  EXPECT_EQ(got.objects.at(0).name, "a/no material");
  EXPECT_EQ(got.materials.at(0).diffuse, 1);
  expect_shades(got, {1, 0.7152, 0.0722, 0.7152, 0.0722});
  EXPECT_TRUE(assets::has_own_materials("a.obj", (folder_.path() / "s.yaml").string(), ""));
}

// Materials say more than colours, where they say anything.
TEST_F(vertex_colors, give_way_to_materials) {
  save("a.mtl", "newmtl red\nKd 0.5 0 0\nnewmtl known\n#!nir_reflectivity 0.6\nnewmtl bare\n");
  save("a.obj",
       "mtllib a.mtl\nv 0 0 0 0 1 0\nv 1 0 0 0 1 0\nv 0 1 0 0 1 0\nf 1 2 3\nusemtl red\nf 1 2 3\nusemtl known\nf 1 2 3\nusemtl bare\nf 1 2 "
       "3\n");
  const Scene got = scene("file: a.obj");
  ASSERT_EQ(got.objects.size(), 4U);
  const auto material = [&](std::size_t i) { return got.materials.at(static_cast<std::size_t>(got.objects[i].material)); };
  const std::vector<double> green(3, 0.7152);
  expect_shades(got, green, 0), expect_shades(got, {}, 1), expect_shades(got, {}, 2), expect_shades(got, green, 3);
  EXPECT_EQ(material(0).diffuse, 1);
  EXPECT_NEAR(material(1).diffuse, 0.5 * 0.2126, 1e-12);
  EXPECT_EQ(material(2).diffuse, 0.6);
  EXPECT_EQ(material(3).diffuse, 1);
  EXPECT_EQ(mesh(got).guessed, 3);
  // The scene's own, of one object and not of another.
  const Scene both = load::scene_from_text("objects:\n  - mesh: {file: a.obj, materials: {bare: skin}}\n  - mesh: {file: a.obj}\n",
                                           (folder_.path() / "s.yaml").string());
  expect_shades(both, {}, 3), expect_shades(both, green, 7);
}
