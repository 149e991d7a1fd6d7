// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
// What a glTF file says of metal, roughness, refraction and vertices' colours, as scenes have it; and what scenes say in its place.
#include <gtest/gtest.h>

#include <cmath>

#include "gltf/gltf_files.h"
#include "image/image_files.h"
#include "load/load.h"
#include "support/samples.h"
#include "support/text.h"

using namespace tofray;
using gltf_test::File;
using test::has;

namespace {

using Doc = gltf_test::Document;
using Sentences = std::vector<std::string>;

/// sRGB 188 is 0.50289 linear: white and grey beside each other have a mean luminance of 0.751445.
constexpr double grey_texel = 0.50289, mean_texel = 0.5 * (1 + grey_texel);

class gltf_material : public testing::Test {
 protected:
  void SetUp() override { std::filesystem::create_directories(folder_.path() / "in"); }
  void save(const File& file, const std::string& name = "a.glb") const { out_test::write_file(folder_.path() / "in" / name, file.glb()); }

  /// One triangle of this material, with coordinates in a picture of 2 × 1, white and grey; image 1 is of metal and roughness.
  [[nodiscard]] static File sheet(const Doc& material) {
    File file;
    const int mesh = file.mesh(
        {{"POSITION", file.floats(gltf_test::corner_positions, "VEC3")}, {"TEXCOORD_0", file.floats({0, 0, 1, 0, 0, 1}, "VEC2")}});
    file.primitive(mesh)["material"] = 0;
    file.node({{"mesh", mesh}});
    file.add("materials", material);
    for (const char* const pixels : {"\0\xFF\xFF\xFF\xBC\xBC\xBC", "\0\xFF\x00\xFF\x00\x66\x33"}) {
      const std::string row(pixels, 7);
      file.add("images", {{"bufferView", file.view(image_test::hand_png(2, 1, 8, image_test::rgb, row))}, {"mimeType", "image/png"}});
      file.add("textures", {{"source", file.json["images"].size() - 1}});
    }
    return file;
  }
  [[nodiscard]] Scene scene(const std::string& keys = "", const std::string& before = "") const {
    return load::scene_from_text(before + "objects:\n  - mesh: {file: a.glb" + keys + "}\n", (folder_.path() / "in/s.yaml").string());
  }
  [[nodiscard]] Material of(const Doc& material) const {
    save(sheet(material));
    return scene().materials.at(0);
  }
  [[nodiscard]] std::string refused(const std::string& keys = "") const {
    const Error error = out_test::error_of([&] { (void)scene(keys); });
    EXPECT_EQ(error.kind(), ErrorKind::bad_input) << error.what();
    return error.what();
  }
  static const Mesh& mesh(const Scene& scene, std::size_t object = 0) { return std::get<Mesh>(scene.objects.at(object).shape); }

  out_test::TemporaryFolder folder_;
};

Doc pbr(const Doc& said) { return {{"pbrMetallicRoughness", said}}; }

void expect_ggx(const Material& got, double diffuse, double specular, double alpha) {
  EXPECT_EQ(got.brdf, Material::Brdf::ggx);
  EXPECT_NEAR(got.diffuse, diffuse, 1e-12);  // roundings of a few products
  EXPECT_NEAR(got.specular, specular, 1e-12);
  EXPECT_NEAR(got.alpha, alpha, 1e-12);
}

/// Two triangles of 1/2 and 2 m², each of one colour.
File two_coloured(const Doc& material) {
  File file;
  const int corners = file.floats({0, 0, 0, 1, 0, 0, 0, 1, 0, 5, 0, 0, 7, 0, 0, 5, 2, 0}, "VEC3");
  const int colors = file.floats({1, 0, 0, 1, 0, 0, 1, 0, 0, 0, 1, 0, 0, 1, 0, 0, 1, 0}, "VEC3");
  const int mesh = file.mesh({{"POSITION", corners}, {"COLOR_0", colors}});
  file.node({{"mesh", mesh}});
  if (material.is_null()) return file;
  file.add("materials", material);
  file.primitive(mesh)["material"] = 0;
  return file;
}

}  // namespace

TEST_F(gltf_material, of_metal_and_roughness_is_ggx) {
  const double rho = 0.2126 * 0.8 + 0.7152 * 0.5 + 0.0722 * 0.1;
  const Doc color = {0.8, 0.5, 0.1, 1};
  expect_ggx(of(pbr({{"baseColorFactor", color}, {"metallicFactor", 0}, {"roughnessFactor", 0.5}})), rho, 0.04, 0.25);
  expect_ggx(of(pbr({{"baseColorFactor", color}, {"metallicFactor", 1}, {"roughnessFactor", 0.3}})), 0, rho, 0.09);
  expect_ggx(of(pbr({{"baseColorFactor", color}, {"metallicFactor", 0.25}})), 0.75 * rho, 0.03 + 0.25 * rho, 1);
  // As the format has it, who says nothing of metal means one; and no mirror is narrower than a material may be.
  expect_ggx(of(pbr({{"baseColorFactor", color}, {"roughnessFactor", 0}})), 0, rho, 1e-3);
  expect_ggx(of(pbr(Doc::object())), 0, 1, 1);
}

TEST_F(gltf_material, without_metal_and_roughness_or_unlit_is_matt) {
  const Material plain = of({{"name", "plain"}});
  EXPECT_EQ(plain.brdf, Material::Brdf::lambert);
  EXPECT_NEAR(plain.diffuse, 1, 1e-12);
  Doc unlit = pbr({{"baseColorFactor", {0.5, 0.5, 0.5, 1}}, {"metallicRoughnessTexture", {{"index", 1}}}});
  unlit["extensions"] = {{"KHR_materials_unlit", Doc::object()}};
  const Material flat = of(unlit);
  EXPECT_EQ(flat.brdf, Material::Brdf::lambert);
  EXPECT_NEAR(flat.diffuse, 0.5, 1e-12);
  EXPECT_EQ(mesh(scene()).notices, Sentences{});
}

TEST_F(gltf_material, takes_metal_and_roughness_from_texel_to_texel) {
  // Blue: 255 and 51 of 255, a mean of 0.6; green: 0 and 102, a mean of 0.2. They are no sRGB.
  const Material got = of(pbr({{"baseColorFactor", {0.5, 0.5, 0.5, 1}},
                               {"metallicFactor", 0.5},
                               {"roughnessFactor", 0.75},
                               {"metallicRoughnessTexture", {{"index", 1}}}}));
  expect_ggx(got, 0.7 * 0.5, 0.04 * 0.7 + 0.3 * 0.5, 0.15 * 0.15);
  ASSERT_NE(got.finish, nullptr);
  EXPECT_EQ(got.map, nullptr);
  ASSERT_EQ(got.finish->values.size(), 2U);
  const auto expect_texel = [&](const VectorMap& map, std::size_t i, double diffuse, double specular, double alpha) {
    EXPECT_NEAR(static_cast<double>(map.values[i][0]), diffuse, 1e-5);
    EXPECT_NEAR(static_cast<double>(map.values[i][1]), specular, 1e-5);
    EXPECT_NEAR(static_cast<double>(map.values[i][2]), alpha, 1e-6);
  };
  // m = 0.5 and 0.1, r = 0 (held to the narrowest mirror) and 0.3.
  expect_texel(*got.finish, 0, 0.5 * 0.5, 0.04 * 0.5 + 0.5 * 0.5, 1e-3);
  expect_texel(*got.finish, 1, 0.9 * 0.5, 0.04 * 0.9 + 0.1 * 0.5, 0.09);
  EXPECT_EQ(mesh(scene()).notices, Sentences{});
  // With a picture of the base colour, of which the texels are white and grey.
  const Material both = of(pbr({{"baseColorTexture", {{"index", 0}}}, {"metallicRoughnessTexture", {{"index", 1}}}}));
  EXPECT_EQ(both.map, nullptr);
  expect_texel(*both.finish, 0, 0, 1, 1e-3);
  expect_texel(*both.finish, 1, 0.8 * grey_texel, 0.04 * 0.8 + 0.2 * grey_texel, 0.16);
  // One that lies elsewhere, or on triangles without coordinates, has its mean.
  const Sentences told{"metal and roughness of material \"material 0\" are the means of a picture"};
  const Doc shifted = {{"index", 1}, {"extensions", {{"KHR_texture_transform", {{"offset", {0.5, 0}}}}}}};
  const Material elsewhere = of(pbr({{"baseColorTexture", {{"index", 0}}}, {"metallicRoughnessTexture", shifted}}));
  EXPECT_EQ(elsewhere.finish, nullptr);
  EXPECT_NE(elsewhere.map, nullptr);
  EXPECT_EQ(mesh(scene()).notices, told);
  File without = sheet(pbr({{"metallicRoughnessTexture", {{"index", 1}}}}));
  without.primitive(0)["attributes"].erase("TEXCOORD_0");
  save(without);
  EXPECT_EQ(scene().materials.at(0).finish, nullptr);
  EXPECT_EQ(mesh(scene()).notices, told);
}

// 4096 × 4096 texels, of which 2048 × 2048 are kept.
TEST_F(gltf_material, reduces_large_pictures_to_means) {
  // Columns of 0 and 255: red and green 0 and 1, so that the normal's parts across have a mean of 0, and roughness one of a half.
  std::string rows;
  for (int y = 0; y < 4096; ++y) {
    rows += '\0';
    for (int x = 0; x < 4096; ++x) rows += std::string(x % 2 == 0 ? "\0\0\xFF" : "\xFF\xFF\xFF", 3);
  }
  File file = sheet({{"normalTexture", {{"index", 2}}}, {"pbrMetallicRoughness", {{"metallicRoughnessTexture", {{"index", 2}}}}}});
  file.add("images", {{"bufferView", file.view(image_test::hand_png(4096, 4096, 8, image_test::rgb, rows))}, {"mimeType", "image/png"}});
  file.add("textures", {{"source", 2}});
  save(file);
  const Material got = scene().materials.at(0);
  for (const auto& map : {got.normals, got.finish}) {
    ASSERT_NE(map, nullptr);
    ASSERT_EQ(map->width, 2048);
    ASSERT_EQ(map->height, 2048);
  }
  for (const std::size_t i : {std::size_t{0}, std::size_t{1}, std::size_t{2048 * 2048 - 1}}) {
    EXPECT_NEAR(static_cast<double>(got.normals->values[i][0]), 0, 1e-6);
    EXPECT_NEAR(static_cast<double>(got.normals->values[i][2]), 1, 1e-6);
    EXPECT_NEAR(static_cast<double>(got.finish->values[i][2]), 0.25, 1e-6);
  }
}

// Red 255, green 0 and 102 of 255, blue 255 and 51: 2c − 1, times the scale across, blue not below 0.001.
TEST_F(gltf_material, takes_normals_from_texel_to_texel) {
  const auto expect_leaning = [](const Material& got, double scale) {
    ASSERT_NE(got.normals, nullptr);
    ASSERT_EQ(got.normals->values.size(), 2U);
    const auto expected = [&](double x, double y, double z) {
      const double length = std::sqrt(scale * scale * (x * x + y * y) + z * z);
      return std::array<double, 3>{scale * x / length, scale * y / length, z / length};
    };
    const std::array<double, 3> texels[] = {expected(1, -1, 1), expected(-1, -0.2, 0.001)};
    for (std::size_t i = 0; i < 2; ++i)
      for (std::size_t k = 0; k < 3; ++k) EXPECT_NEAR(static_cast<double>(got.normals->values[i][k]), texels[i][k], 1e-6) << i << k;
  };
  Doc said = {{"name", "Bumps"}, {"normalTexture", {{"index", 1}}}};
  expect_leaning(of(said), 1);
  said["normalTexture"]["scale"] = 0.5;
  expect_leaning(of(said), 0.5);
  EXPECT_EQ(mesh(scene()).notices, Sentences{});
  expect_leaning(scene(", materials: {Bumps: skin}").materials.at(0), 0.5);
  EXPECT_EQ(scene(", materials: {Bumps: skin}").materials.at(0).name, "skin");
  said["extras"] = {{"nir_reflectivity", 0.7}};
  expect_leaning(of(said), 0.5);
  said["pbrMetallicRoughness"] = {{"baseColorTexture", {{"index", 0}, {"extensions", {{"KHR_texture_transform", {{"scale", {2, 2}}}}}}}}};
  EXPECT_EQ(of(said).normals, nullptr);
  EXPECT_EQ(mesh(scene()).notices,
            Sentences{"the picture of normals of material \"Bumps\" is left out: it is grey, or lies elsewhere on the "
                      "triangles than the first picture"});
}

// sRGB 102 is 0.13287 linear, 51 is 0.033105: magenta, and a green.
TEST_F(gltf_material, of_a_coloured_picture_has_its_luminance) {
  const Material got = of(pbr({{"baseColorTexture", {{"index", 1}}}, {"metallicFactor", 0}}));
  ASSERT_NE(got.map, nullptr);
  EXPECT_NEAR(got.diffuse * static_cast<double>(got.map->values.at(0)), 0.2126 + 0.0722, 1e-5);
  EXPECT_NEAR(got.diffuse * static_cast<double>(got.map->values.at(1)), 0.7152 * 0.13287 + 0.0722 * 0.033105, 1e-5);
}

TEST_F(gltf_material, of_metal_with_a_picture_reflects_its_mean) {
  const Doc texture = {{"index", 0}};
  const Material metal = of(pbr({{"baseColorTexture", texture}, {"roughnessFactor", 0.5}}));
  EXPECT_NEAR(metal.specular, mean_texel, 1e-5);
  EXPECT_EQ(metal.diffuse, 0);
  EXPECT_EQ(metal.map, nullptr);
  const Material half = of(pbr({{"baseColorTexture", texture}, {"metallicFactor", 0.5}}));
  EXPECT_NEAR(half.specular, 0.02 + 0.5 * mean_texel, 1e-5);
  EXPECT_NEAR(half.diffuse, 0.5, 1e-6);
  ASSERT_NE(half.map, nullptr);
  EXPECT_NEAR(static_cast<double>(half.map->values.at(1)), grey_texel, 1e-5);
}

TEST_F(gltf_material, takes_refraction_and_its_factor) {
  const auto with = [&](const Doc& extensions) {
    Doc said = pbr({{"baseColorFactor", {0.5, 0.5, 0.5, 1}}, {"metallicFactor", 0}});
    said["extensions"] = extensions;
    return of(said);
  };
  expect_ggx(with({{"KHR_materials_ior", {{"ior", 3}}}}), 0.5, 0.25, 1);
  expect_ggx(with({{"KHR_materials_ior", Doc::object()}}), 0.5, 0.04, 1);
  expect_ggx(with({{"KHR_materials_ior", {{"ior", 0}}}}), 0.5, 1, 1);
  expect_ggx(with({{"KHR_materials_ior", {{"ior", 3}}}, {"KHR_materials_specular", {{"specularFactor", 0.5}}}}), 0.5, 0.125, 1);
}

TEST_F(gltf_material, takes_colours_of_vertices) {
  const double red = 0.2126, green = 0.7152;
  const Doc half = pbr({{"baseColorFactor", {0.5, 0.5, 0.5, 1}}, {"metallicFactor", 0}});
  const auto expect_shades = [&](const Scene& got) {
    const std::vector<float>& shades = mesh(got).triangles->shades;
    ASSERT_EQ(shades.size(), 6U);
    for (std::size_t i = 0; i < 6; ++i) EXPECT_NEAR(static_cast<double>(shades[i]), i < 3 ? red : green, 1e-6) << i;
  };
  save(two_coloured(half));
  EXPECT_NEAR(scene().materials.at(0).diffuse, 0.5, 1e-12);
  expect_shades(scene());
  EXPECT_EQ(mesh(scene()).notices, Sentences{});
  // What the scene says in its place is the same everywhere.
  EXPECT_TRUE(mesh(scene(", materials: {material 0: skin}")).triangles->shades.empty());
  EXPECT_TRUE(mesh(scene(", reflectivity: 0.5")).triangles->shades.empty());
  save(two_coloured(pbr({{"baseColorFactor", {0.5, 0.5, 0.5, 1}}, {"metallicFactor", 1}})));
  EXPECT_NEAR(scene().materials.at(0).specular, 0.5 * (0.2 * red + 0.8 * green), 1e-12);
  EXPECT_EQ(mesh(scene()).notices, Sentences{"colours of vertices vary at material \"material 0\": of what is metal their mean is used"});
  save(two_coloured(nullptr));
  EXPECT_NEAR(scene().materials.at(0).diffuse, 1, 1e-12);
  expect_shades(scene());
  EXPECT_EQ(mesh(scene()).guessed, 1);
  File one = two_coloured(half);
  one.json["meshes"][0]["primitives"][0]["attributes"]["COLOR_0"] =
      one.accessor<std::uint8_t>({0, 51, 0, 9, 0, 51, 0, 99, 0, 51, 0, 255, 0, 51, 0, 255, 0, 51, 0, 255, 0, 51, 0, 255}, "VEC4", true);
  save(one);
  EXPECT_NEAR(scene().materials.at(0).diffuse, 0.5 * 0.2 * green, 1e-8);  // 51 of 255 as a float
  EXPECT_EQ(mesh(scene()).notices, Sentences{});
  // Floats beyond 0 to 1 are held there.
  one.json["meshes"][0]["primitives"][0]["attributes"]["COLOR_0"] =
      one.floats({-1, 1.5F, 0, -1, 1.5F, 0, -1, 1.5F, 0, -1, 1.5F, 0, -1, 1.5F, 0, -1, 1.5F, 0}, "VEC3");
  save(one);
  EXPECT_NEAR(scene().materials.at(0).diffuse, 0.5 * green, 1e-12);
  Doc known = half;
  known["extras"] = {{"nir_reflectivity", 0.6}};
  save(two_coloured(known));
  EXPECT_EQ(scene().materials.at(0).diffuse, 0.6);
  EXPECT_TRUE(mesh(scene()).triangles->shades.empty());
  EXPECT_EQ(mesh(scene()).notices, Sentences{});
}

TEST_F(gltf_material, may_be_one_that_tofray_knows) {
  Doc said = pbr({{"baseColorTexture", {{"index", 0}}}});
  said["name"] = "Sign", said["extras"] = {{"nir_material", "retro-sheet"}};
  const Material sheet_of_a_sign = of(said);
  EXPECT_EQ(sheet_of_a_sign.name, "retro-sheet");
  EXPECT_EQ(sheet_of_a_sign.brdf, Material::Brdf::retro);
  EXPECT_EQ(sheet_of_a_sign.map, nullptr);
  EXPECT_EQ(mesh(scene()).guessed, 0);
  said["extras"] = {{"nir_material", "skinn"}};
  save(sheet(said));
  EXPECT_TRUE(has(refused(),
                  "in/a.glb: error: materials[0].extras.nir_material names no material of tofray; did you mean \"skin\"?\n"
                  "  got \"skinn\", of the material \"Sign\"; `tofray list materials` names those that there are"))
      << refused();
  EXPECT_EQ(scene(", reflectivity: 0.4").materials.at(0).diffuse, 0.4);
}

TEST_F(gltf_material, gives_way_to_what_the_scene_says) {
  File file = two_coloured(nullptr);
  const Doc plain = file.json["meshes"][0]["primitives"][0];
  for (const char* const name : {"Seat", "Legs", "Wood"}) {
    file.add("materials", {{"name", name}, {"pbrMetallicRoughness", {{"metallicFactor", 0}}}});
    file.json["meshes"][0]["primitives"].push_back(plain);
    file.json["meshes"][0]["primitives"].back()["material"] = file.json["materials"].size() - 1;
  }
  save(file);
  const std::string own = "materials: {oak: {reflectivity: 0.6}}\n";
  const Scene got =
      scene(", name: chair, materials: {Seat: cotton-white, Legs: {brdf: ggx, diffuse: 0.1, specular: 0.9, alpha: 0.2}, Wood: oak}", own);
  ASSERT_EQ(got.objects.size(), 4U);
  const auto material = [&](std::size_t i) { return got.materials.at(static_cast<std::size_t>(got.objects.at(i).material)); };
  EXPECT_EQ(got.objects[1].name, "chair/Seat");
  EXPECT_EQ(material(1).name, "cotton-white");
  EXPECT_EQ(material(1).diffuse, 0.8);
  expect_ggx(material(2), 0.1, 0.9, 0.2);
  EXPECT_EQ(material(3).diffuse, 0.6);
  EXPECT_EQ(mesh(got).guessed, 1);
  const Scene all = scene(", materials: {no material: skin, Seat: oak, Legs: oak, Wood: {reflectivity: 0.4}}", own);
  EXPECT_EQ(mesh(all).guessed, 0);
  EXPECT_EQ(mesh(all).notices, Sentences{});
  for (const Material& one : all.materials) EXPECT_GT(one.diffuse, 0) << "one that nothing wears";
  // Another object of the same file keeps the file's own.
  const Scene both = load::scene_from_text("objects:\n  - mesh: {file: a.glb, materials: {Seat: skin}}\n  - mesh: {file: a.glb}\n",
                                           (folder_.path() / "in/s.yaml").string());
  EXPECT_EQ(mesh(both, 0).guessed, 3);
  EXPECT_EQ(mesh(both, 4).guessed, 4);
  EXPECT_EQ(mesh(both, 0).triangles, mesh(both, 4).triangles);
  // The file's picture goes with its material.
  save(sheet(pbr({{"baseColorTexture", {{"index", 0}}}, {"metallicFactor", 0}})));
  EXPECT_NE(scene().materials.at(0).map, nullptr);
  EXPECT_EQ(scene(", materials: {material 0: wood}").materials.at(0).map, nullptr);
}

TEST_F(gltf_material, of_a_scene_has_a_name_of_the_files) {
  File file = two_coloured({{"name", "Seat"}});
  save(file);
  EXPECT_TRUE(has(refused(", materials: {Seet: skin}"),
                  "s.yaml:2:37: error: \"a.glb\" has no material \"Seet\"; did you mean \"Seat\"?\n  its materials: Seat"))
      << refused(", materials: {Seet: skin}");
  EXPECT_TRUE(has(refused(", materials: {Seat: skinn}"), "s.yaml:2:43: error: no material \"skinn\"; did you mean \"skin\"?"))
      << refused(", materials: {Seat: skinn}");
  EXPECT_TRUE(has(refused(", materials: {Seat: {reflectivity: 2}}"), "s.yaml:2:58: error: reflectivity is out of range"))
      << refused(", materials: {Seat: {reflectivity: 2}}");
  EXPECT_TRUE(
      has(refused(", materials: {Seat: {brdf: phong, diffuse: 0.8, specular: 0.4, exponent: 3}}"), "diffuse + specular is more than 1"));
  EXPECT_TRUE(has(refused(", materials: {}"), "materials has the wrong number of entries"));
  EXPECT_TRUE(has(refused(", materials: {Seat: [1]}"), "Seat is not what belongs here"));
  EXPECT_TRUE(has(refused(", materials: {Seat: skin}, reflectivity: 0.5"), "mesh has \"reflectivity\" and \"materials\""));
  for (int i = 0; i < 30; ++i) file.add("materials", {{"name", "m" + std::to_string(i)}});
  save(file);
  EXPECT_TRUE(has(refused(", materials: {nothing like it: skin}"), "m24, m25 and 11 more"))
      << refused(", materials: {nothing like it: skin}");
  out_test::write_file(folder_.path() / "in/a.stl",
                       "solid\nfacet\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\nendloop\nendfacet\nendsolid\n");
  const Error error = out_test::error_of([&] {
    (void)load::scene_from_text("objects:\n  - mesh: {file: a.stl, materials: {Seat: skin}}\n", (folder_.path() / "in/s.yaml").string());
  });
  EXPECT_TRUE(has(error.what(), "s.yaml:2:36: error: materials are those of glTF and OBJ files")) << error.what();
}

// A small file may ask for much: a picture of metal is read once, and its pixels count.
TEST_F(gltf_material, reads_no_more_pixels_than_the_limit) {
  const std::string rows(8192 * (1 + 8192 / 8), '\0');
  const auto with_pictures = [&](int pictures, int materials) {
    File file = sheet({{"name", "a"}});
    const std::string png = image_test::hand_png(8192, 8192, 1, image_test::grey, rows);
    for (int i = 0; i < pictures; ++i) {
      file.add("images", {{"bufferView", file.view(png)}, {"mimeType", "image/png"}});
      file.add("textures", {{"source", file.json["images"].size() - 1}});
    }
    const Doc one = file.json["meshes"][0]["primitives"][0];
    for (int i = 0; i < materials; ++i) {
      file.add("materials", pbr({{"metallicRoughnessTexture", {{"index", 2 + i % pictures}}}}));
      file.json["meshes"][0]["primitives"].push_back(one);
      file.json["meshes"][0]["primitives"].back()["material"] = i + 1;
    }
    save(file);
  };
  with_pictures(1, 3);
  EXPECT_EQ(scene().objects.size(), 4U);
  with_pictures(2, 2);
  const Error error = out_test::error_of([&] { (void)scene(); });
  EXPECT_EQ(error.kind(), ErrorKind::limit);
  EXPECT_TRUE(has(error.what(), "s.yaml:2:18: error: the scene's meshes wear too many pixels of pictures")) << error.what();
}
