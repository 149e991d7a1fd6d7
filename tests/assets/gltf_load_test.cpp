// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
// glTF files that a scene names: materials, animations, cameras, the files that they name in turn.
#include <gtest/gtest.h>

#include "assets/mesh_load.h"
#include "files/sha256.h"
#include "gltf/gltf_files.h"
#include "image/image_files.h"
#include "load/load.h"
#include "support/samples.h"
#include "support/text.h"

using namespace tofray;
using Document = gltf_test::Document;
using gltf_test::File;
using gltf_test::triangle_file;
using out_test::write_file;
using test::has;

namespace {

namespace fs = std::filesystem;
using V = std::array<float, 3>;

/// A triangle of red and one of a material with a reflectivity, beside each other.
File two_materials() {
  File file;
  const int corners = file.floats(gltf_test::corner_positions, "VEC3");
  file.add("materials", {{"name", "paint"}, {"pbrMetallicRoughness", {{"baseColorFactor", {0.5, 0.25, 0.125, 1}}, {"metallicFactor", 0}}}});
  file.add("materials", {{"pbrMetallicRoughness", {{"baseColorFactor", {0.5, 0.5, 0.5, 1}}}}, {"extras", {{"nir_reflectivity", 0.9}}}});
  for (int i = 0; i < 2; ++i) {
    file.primitive(file.mesh({{"POSITION", corners}}))["material"] = i;
    file.node({{"mesh", i}, {"translation", {2 * i, 0, 0}}});
  }
  return file;
}

/// Three vertices with normals and texture coordinates, and a picture of 2 × 2: white, grey, red, black.
File card(const Document& texture) {
  File file;
  const int mesh = file.mesh({{"POSITION", file.floats(gltf_test::corner_positions, "VEC3")},
                              {"NORMAL", file.floats({0, 1, 0, 0, 1, 0, 0, 1, 0}, "VEC3")},
                              {"TEXCOORD_0", file.floats({0, 0, 1, 0, 0, 1}, "VEC2")}});
  file.primitive(mesh)["material"] = 0;
  file.node({{"mesh", mesh}});
  file.add("materials",
           {{"pbrMetallicRoughness", {{"baseColorFactor", {0.8, 0.5, 1, 1}}, {"baseColorTexture", texture}, {"metallicFactor", 0}}}});
  file.add("textures", {{"source", 0}, {"sampler", 0}});
  file.add("samplers", {{"wrapS", 33071}, {"wrapT", 33648}});
  const std::string pixels(
      "\0\xFF\xFF\xFF\xBC\xBC\xBC"
      "\0\xFF\0\0\0\0\0",
      14);
  file.add("images", {{"bufferView", file.view(image_test::hand_png(2, 2, 8, image_test::rgb, pixels))}, {"mimeType", "image/png"}});
  return file;
}

class gltf_in_scene : public testing::Test {
 protected:
  void SetUp() override {
    fs::create_directories(folder_.path() / "in/side");
    file("in/two.glb", two_materials().glb());
    file("in/corner.gltf", triangle_file().text());
    file("in/corner.obj", "v 1 2 3\nv 4 2 3\nv 1 7 3\nf 1 2 3\n");
  }
  void file(const std::string& name, const std::string& bytes) const { write_file(folder_.path() / name, bytes); }
  [[nodiscard]] std::string source() const { return (folder_.path() / "in/scene.yaml").string(); }
  [[nodiscard]] Scene scene(const std::string& keys, const assets::MeshFiles& files = {}) const {
    return load::scene_from_text("objects:\n  - mesh: {" + keys + "}\n", source(), {}, files);
  }
  [[nodiscard]] Mesh mesh(const std::string& keys, const assets::MeshFiles& files = {}) const {
    return std::get<Mesh>(scene(keys, files).objects.at(0).shape);
  }
  [[nodiscard]] V first(const std::string& keys) const { return mesh(keys).triangles->vertices.at(0); }
  [[nodiscard]] std::string refusal(const std::string& keys, ErrorKind kind = ErrorKind::bad_input,
                                    const assets::MeshFiles& files = {}) const {
    const Error error = out_test::error_of([&] { (void)scene(keys, files); });
    EXPECT_EQ(error.kind(), kind) << error.what();
    return error.what();
  }

  out_test::TemporaryFolder folder_;
};

double reflectivity(const Scene& scene, std::size_t object) {
  return scene.materials.at(static_cast<std::size_t>(scene.objects.at(object).material)).diffuse;
}

}  // namespace

TEST_F(gltf_in_scene, is_an_object_for_each_material) {
  const Scene got = load::scene_from_text(
      "materials: {paper: {reflectivity: 0.7}}\n"
      "objects:\n  - sphere: {center: [0, 0, 1], radius: 0.1 m, material: paper}\n"
      "  - mesh: {file: two.glb, name: toy, position: [1, 2, 3], velocity: [0, 1, 0]}\n  - mesh: {file: two.glb}\n"
      "  - sphere: {center: [0, 0, 1], radius: 0.1 m, reflectivity: 0.2}\n",
      source());
  ASSERT_EQ(got.objects.size(), 6U);
  std::vector<std::string> names;
  for (const Object& one : got.objects) names.push_back(one.name);
  EXPECT_EQ(names, (std::vector<std::string>{"", "toy/paint", "toy/material 1", "two/paint", "two/material 1", ""}));
  for (const std::size_t i : {1U, 2U}) {
    EXPECT_EQ(got.objects[i].position, (Vec3{1, 2, 3}));
    EXPECT_EQ(got.objects[i].velocity_m_per_s, (Vec3{0, 1, 0}));
    EXPECT_EQ(std::get<Mesh>(got.objects[i].shape).triangles, std::get<Mesh>(got.objects[i + 2].shape).triangles);
  }
  EXPECT_EQ(std::get<Mesh>(got.objects[2].shape).triangles->vertices.at(0), (V{2, 0, 0}));
  // 0.2126 · 0.5 + 0.7152 · 0.25 + 0.0722 · 0.125; rounding of three terms
  EXPECT_NEAR(reflectivity(got, 1), 0.294125, 1e-12);
  EXPECT_EQ(reflectivity(got, 2), 0.9);
  EXPECT_EQ(reflectivity(got, 0), 0.7);
  EXPECT_EQ(reflectivity(got, 5), 0.2);
}

TEST_F(gltf_in_scene, tells_how_many_reflectivities_are_a_guess) {
  const Scene got = scene("file: two.glb");
  EXPECT_EQ(std::get<Mesh>(got.objects.at(0).shape).guessed, 1);
  EXPECT_EQ(std::get<Mesh>(got.objects.at(1).shape).guessed, 0);
  EXPECT_EQ(mesh("file: two.glb, reflectivity: 0.3").guessed, 0);
}

TEST_F(gltf_in_scene, wears_the_picture_of_its_base_colour) {
  file("in/card.glb", card({{"index", 0}}).glb());
  const Scene got = scene("file: card.glb, scale: 2");
  ASSERT_EQ(got.objects.size(), 1U);
  const Material& material = got.materials.at(static_cast<std::size_t>(got.objects[0].material));
  ASSERT_NE(material.map, nullptr);
  EXPECT_EQ(material.map->width, 2);
  EXPECT_EQ(material.map->height, 2);
  EXPECT_EQ(material.map->wrap_u, ReflectivityMap::Wrap::clamp);
  EXPECT_EQ(material.map->wrap_v, ReflectivityMap::Wrap::mirror);
  // sRGB 255 is 1, 188 is 0.50289, 0 is 0; the factor is 0.8 of red, 0.5 of green, 1 of blue.
  const double white = 0.2126 * 0.8 + 0.7152 * 0.5 + 0.0722, grey = 0.50289 * white, red = 0.2126 * 0.8;
  EXPECT_NEAR(material.diffuse, white, 1e-6);
  const std::vector<float>& values = material.map->values;
  ASSERT_EQ(values.size(), 4U);
  EXPECT_EQ(values[0], 1);
  EXPECT_NEAR(static_cast<double>(values[1]), grey / white, 1e-5);
  EXPECT_NEAR(static_cast<double>(values[2]), red / white, 1e-6);
  EXPECT_EQ(values[3], 0);
  const TriangleMesh& mesh = *std::get<Mesh>(got.objects[0].shape).triangles;
  EXPECT_EQ(mesh.texcoords, (std::vector<std::array<float, 2>>{{0, 0}, {1, 0}, {0, 1}}));
  EXPECT_EQ(mesh.normals, (std::vector<V>{{0, -1, 0}, {0, -1, 0}, {0, -1, 0}}));  // y is down in the world, lengths stay
  EXPECT_EQ(mesh.vertices.at(1), (V{2, 0, 0}));
  EXPECT_EQ(std::get<Mesh>(got.objects[0].shape).guessed, 1);
}

// offset + turn·(scale·(u, v)): counterclockwise as one looks at the picture, whose v grows downward.
TEST_F(gltf_in_scene, takes_a_part_of_the_picture) {
  const Document transform = {{"offset", {0.5, 0.25}}, {"scale", {2, 3}}, {"rotation", 0.5235987755982988}};
  file("in/card.glb", card({{"index", 0}, {"extensions", {{"KHR_texture_transform", transform}}}}).glb());
  const Scene got = scene("file: card.glb");
  const TriangleMesh& mesh = *std::get<Mesh>(got.objects.at(0).shape).triangles;
  ASSERT_EQ(mesh.texcoords.size(), 3U);
  const double c = std::sqrt(0.75), s = 0.5;
  const double expected[3][2] = {{0.5, 0.25}, {0.5 + 2 * c, 0.25 - 2 * s}, {0.5 + 3 * s, 0.25 + 3 * c}};
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t k = 0; k < 2; ++k) EXPECT_NEAR(static_cast<double>(mesh.texcoords[i][k]), expected[i][k], 1e-6) << i << k;
}

TEST_F(gltf_in_scene, wears_no_picture_where_its_reflectivity_is_known) {
  File known = card({{"index", 0}});
  known.json["materials"][0]["extras"] = {{"nir_reflectivity", 0.6}};
  file("in/known.glb", known.glb()), file("in/card.glb", card({{"index", 0}}).glb());
  EXPECT_EQ(scene("file: known.glb").materials.at(0).map, nullptr);
  EXPECT_EQ(reflectivity(scene("file: known.glb"), 0), 0.6);
  const Scene own = scene("file: card.glb, reflectivity: 0.3");
  EXPECT_EQ(own.materials.at(0).map, nullptr);
  EXPECT_TRUE(std::get<Mesh>(own.objects[0].shape).triangles->texcoords.empty());
  EXPECT_EQ(std::get<Mesh>(own.objects[0].shape).triangles->normals.size(), 3U);
}

TEST_F(gltf_in_scene, without_texture_coordinates_has_half_its_colours_luminance) {
  File textured = two_materials();
  textured.json["materials"][0]["pbrMetallicRoughness"] = {{"baseColorTexture", {{"index", 0}}}, {"metallicFactor", 0}};
  textured.add("textures", {{"source", 0}});
  textured.add("images", {{"uri", "data:image/png;base64,"}});
  file("in/textured.glb", textured.glb());
  EXPECT_EQ(reflectivity(scene("file: textured.glb"), 0), 0.5);
}

// Normals and coordinates of the parts that have some; zeros for the others of the same material.
TEST_F(gltf_in_scene, parts_without_normals_stay_flat) {
  File both = card({{"index", 0}});
  const int corners = both.floats(gltf_test::corner_positions, "VEC3");
  both.primitive(both.mesh({{"POSITION", corners}}))["material"] = 0;
  both.node({{"mesh", 1}});
  file("in/both.glb", both.glb());
  const Scene got = scene("file: both.glb");
  const TriangleMesh& mesh = *std::get<Mesh>(got.objects.at(0).shape).triangles;
  ASSERT_EQ(mesh.normals.size(), 6U);
  EXPECT_EQ(mesh.normals[2], (V{0, -1, 0}));
  EXPECT_EQ(mesh.normals[3], (V{0, 0, 0}));
  ASSERT_EQ(mesh.texcoords.size(), 6U);
  EXPECT_EQ(mesh.texcoords[2], (std::array<float, 2>{0, 1}));
  EXPECT_EQ(mesh.texcoords[5], (std::array<float, 2>{0, 0}));
}

// A small file may ask for much: each material has a picture of its own factor. Those beyond the limit are not made.
TEST_F(gltf_in_scene, wears_no_more_pixels_than_the_limit) {
  File many = card({{"index", 0}});
  const std::string rows(4096 * (1 + 4096 / 8), '\0');
  many.json["images"][0] = {{"bufferView", many.view(image_test::hand_png(4096, 4096, 1, image_test::grey, rows))},
                            {"mimeType", "image/png"}};
  const Document corners = many.json["meshes"][0]["primitives"][0];
  for (int i = 1; i < 200; ++i) {
    many.add("materials", many.json["materials"][0]);
    many.json["meshes"][0]["primitives"].push_back(corners);
    many.json["meshes"][0]["primitives"][static_cast<std::size_t>(i)]["material"] = i;
  }
  file("in/many.glb", many.glb());
  const std::string said = refusal("file: many.glb", ErrorKind::limit);
  EXPECT_TRUE(has(said, "scene.yaml:2:18: error: the scene's meshes wear too many pixels of pictures")) << said;
}

TEST_F(gltf_in_scene, with_a_broken_picture_is_refused_by_the_pictures_number) {
  File broken = card({{"index", 0}});
  broken.json["images"][0] = {{"uri", "data:image/png;base64,iVBORw0KGgo="}};
  file("in/broken.glb", broken.glb());
  EXPECT_TRUE(has(refusal("file: broken.glb"), "broken.glb: image 0: error: ")) << refusal("file: broken.glb");
}

TEST_F(gltf_in_scene, without_material_reflects_one_half_and_says_so) {
  const Scene got = scene("file: corner.gltf");
  ASSERT_EQ(got.objects.size(), 1U);
  EXPECT_EQ(got.objects[0].name, "corner/no material");
  EXPECT_EQ(reflectivity(got, 0), 0.5);
  const Mesh& mesh = std::get<Mesh>(got.objects[0].shape);
  EXPECT_EQ(mesh.guessed, 0);
  ASSERT_EQ(mesh.notices.size(), 1U);
  EXPECT_TRUE(has(mesh.notices[0], "reflectivity of 0.5"));
}

TEST_F(gltf_in_scene, is_one_object_where_that_has_a_material) {
  for (const char* const own : {"reflectivity: 0.3", "material: {reflectivity: 0.3}"}) {
    const Scene got = scene("file: two.glb, name: toy, " + std::string(own));
    ASSERT_EQ(got.objects.size(), 1U);
    EXPECT_EQ(got.objects[0].name, "toy");
    EXPECT_EQ(reflectivity(got, 0), 0.3);
    const TriangleMesh& all = *std::get<Mesh>(got.objects[0].shape).triangles;
    EXPECT_EQ(all.triangles, (std::vector<std::array<std::int32_t, 3>>{{0, 1, 2}, {3, 4, 5}}));
    EXPECT_EQ(all.vertices.at(4), (V{3, 0, 0}));
  }
}

TEST_F(gltf_in_scene, has_y_up_and_a_scale) {
  EXPECT_EQ(mesh("file: corner.gltf").triangles->vertices.at(2), (V{0, -1, 0}));
  EXPECT_EQ(mesh("file: corner.gltf, scale: 0.5").triangles->vertices.at(2), (V{0, -0.5F, 0}));
  EXPECT_EQ(mesh("file: corner.gltf, up: z").triangles->vertices.at(2), (V{0, 0, 1}));
  fs::rename(folder_.path() / "in/corner.gltf", folder_.path() / "in/corner.GLTF");
  EXPECT_EQ(mesh("file: corner.GLTF").triangles->vertices.at(2), (V{0, -1, 0}));
}

TEST_F(gltf_in_scene, moves_by_its_first_animation) {
  file("in/moves.glb", gltf_test::animated_file().glb());
  EXPECT_EQ(first("file: moves.glb"), (V{0, 0, 0}));
  const std::vector<std::string> still{"its animation stands still: play: loop plays it, time: 0 s is one moment of it"};
  EXPECT_EQ(mesh("file: moves.glb, reflectivity: 0.5").notices, still);
  EXPECT_TRUE(mesh("file: moves.glb, reflectivity: 0.5, time: 0 s").notices.empty());
  EXPECT_EQ(first("file: moves.glb, time: 1 s"), (V{1.5F, 0, 0}));
  EXPECT_EQ(first("file: moves.glb, time: 500 ms"), (V{0.75F, 0, 0}));
  EXPECT_EQ(first("file: moves.glb, time: 9 s"), (V{3, 0, 0}));
}

/// A clip for each object, as Blender exports them: node 0 goes to (3, 0, 0) in 2 s, node 1 to (0, 0, 4) in 1 s, which has a name.
File with_two_animations() {
  File file = gltf_test::animated_file();
  file.node({{"mesh", 0}});
  const int clock = file.floats({0, 1}, "SCALAR"), to = file.floats({0, 0, 0, 0, 0, 4}, "VEC3");
  file.add("animations", {{"name", "jump"},
                          {"samplers", {{{"input", clock}, {"output", to}}}},
                          {"channels", {{{"sampler", 0}, {"target", {{"node", 1}, {"path", "translation"}}}}}}});
  return file;
}

// Vertex 0 is that of node 0, vertex 3 that of node 1; the file's (x, y, z) is the world's (x, −y, −z).
TEST_F(gltf_in_scene, plays_the_animation_that_is_chosen_or_all) {
  file("in/moves.glb", with_two_animations().glb());
  const auto at = [&](const std::string& keys) {
    const Mesh one = mesh("file: moves.glb, reflectivity: 0.5, " + keys);
    EXPECT_EQ(one.notices.size(), 1U) << keys;
    return std::pair{std::pair{one.triangles->vertices.at(0), one.triangles->vertices.at(3)}, one.notices.at(0)};
  };
  const V still{0, 0, 0}, first_goes{1.5F, 0, 0}, second_goes{0, 0, -4};
  const auto by_default = at("time: 1 s");
  EXPECT_EQ(by_default.first, (std::pair{first_goes, still}));
  EXPECT_EQ(by_default.second, "of its 2 animations number 0 plays, the others do not; animation: all, a name or a number chooses");
  EXPECT_EQ(at("time: 1 s, animation: 0").first, (std::pair{first_goes, still}));
  const auto chosen = at("time: 1 s, animation: jump");
  EXPECT_EQ(chosen.first, (std::pair{still, second_goes}));
  EXPECT_EQ(chosen.second, "of its 2 animations number 1, \"jump\", plays");
  EXPECT_EQ(at("time: 1 s, animation: 1").first, (std::pair{still, second_goes}));
  const auto all = at("time: 1 s, animation: all");
  EXPECT_EQ(all.first, (std::pair{first_goes, second_goes}));
  EXPECT_EQ(all.second, "all of its 2 animations play");
  // A film of all goes on to the last keyframe of any, 2 s, and begins again.
  std::vector<V> vertices, normals;
  mesh("file: moves.glb, play: loop, animation: all").motion->at(3, vertices, normals);
  EXPECT_EQ(vertices.at(0), first_goes);
  EXPECT_EQ(vertices.at(3), second_goes);
  EXPECT_EQ(at("play: still").second, "its 2 animations stand still: play: loop plays one of them, time: 0 s is one moment of it");
}

TEST_F(gltf_in_scene, names_the_animations_that_there_are) {
  file("in/moves.glb", with_two_animations().glb());
  EXPECT_TRUE(has(refusal("file: moves.glb, time: 1 s, animation: run"),
                  "there is no animation \"run\"\n  expected a name, a number from 0 to 1, or all; the file has \"\" and \"jump\""))
      << refusal("file: moves.glb, time: 1 s, animation: run");
  EXPECT_TRUE(has(refusal("file: moves.glb, time: 1 s, animation: 2"), "there is no animation \"2\""));
  EXPECT_TRUE(has(refusal("file: moves.glb, animation: jump"),
                  "animation says which one plays, and nothing plays\n  add play: loop, or time: 0 s"));
}

// From the file's (x, y, z) to the world's 2·(x, −y, −z); two seconds long.
TEST_F(gltf_in_scene, plays_its_first_animation) {
  file("in/moves.glb", gltf_test::animated_file().glb());
  const auto at = [&](const std::string& keys, double time_s) {
    const Mesh one = mesh("file: moves.glb, scale: 2, " + keys);
    std::vector<V> vertices, normals;
    one.motion->at(time_s, vertices, normals);
    EXPECT_EQ(vertices.size(), one.triangles->vertices.size());
    EXPECT_EQ(normals.size(), one.triangles->normals.size());
    return vertices.at(0);
  };
  EXPECT_EQ(mesh("file: moves.glb").motion, nullptr);
  EXPECT_EQ(mesh("file: moves.glb, time: 1 s, play: still").motion, nullptr);
  EXPECT_EQ(first("file: moves.glb, scale: 2, play: once, time: 500 ms"), (V{1.5F, 0, 0}));
  EXPECT_EQ(at("play: once", 0), (V{0, 0, 0}));
  EXPECT_EQ(at("play: once", 1), (V{3, 0, 0}));
  EXPECT_EQ(at("play: once", -1), (V{0, 0, 0}));
  EXPECT_EQ(at("play: once", 2), (V{6, 0, 0}));
  EXPECT_EQ(at("play: once", 7), (V{6, 0, 0}));
  EXPECT_EQ(at("play: once, time: 500 ms", 0.5), (V{3, 0, 0}));
  EXPECT_EQ(at("play: loop", 1), (V{3, 0, 0}));
  EXPECT_EQ(at("play: loop", 2), (V{0, 0, 0}));
  EXPECT_EQ(at("play: loop", 7), (V{3, 0, 0}));
  EXPECT_EQ(at("play: loop", -1.5), (V{1.5F, 0, 0}));
  EXPECT_EQ(at("play: loop, time: 1500 ms", 1), (V{1.5F, 0, 0}));
}

TEST_F(gltf_in_scene, plays_all_its_materials_at_one_time) {
  File two = two_materials();
  const int clock = two.floats({0, 1}, "SCALAR"), to = two.floats({0, 0, 0, 0, 0, 4}, "VEC3");
  two.add("animations", {{"samplers", {{{"input", clock}, {"output", to}}}},
                         {"channels", {{{"sampler", 0}, {"target", {{"node", 1}, {"path", "translation"}}}}}}});
  file("in/moves.glb", two.glb());
  const Scene got = scene("file: moves.glb, play: once");
  ASSERT_EQ(got.objects.size(), 2U);
  std::vector<V> vertices, normals;
  for (const double time_s : {1.0, 0.25, 1.0}) {
    std::get<Mesh>(got.objects[1].shape).motion->at(time_s, vertices, normals);
    EXPECT_EQ(vertices.at(0)[2], static_cast<float>(-4 * time_s));
    std::get<Mesh>(got.objects[0].shape).motion->at(time_s, vertices, normals);
    EXPECT_EQ(vertices.at(0)[2], 0.0F);
  }
  const Scene whole = scene("file: moves.glb, play: once, reflectivity: 0.5");
  std::get<Mesh>(whole.objects.at(0).shape).motion->at(0.5, vertices, normals);
  EXPECT_EQ(vertices.at(0)[2], 0.0F);
  EXPECT_EQ(vertices.at(3)[2], -2.0F);
}

TEST_F(gltf_in_scene, refuses_to_play_what_does_not_move) {
  EXPECT_TRUE(has(refusal("file: two.glb, play: loop"), "scene.yaml:2:33: error: ")) << refusal("file: two.glb, play: loop");
  EXPECT_TRUE(has(refusal("file: two.glb, play: loop"), "two.glb\" has no animation\n  there is nothing to play"));
  EXPECT_TRUE(has(refusal("file: corner.obj, reflectivity: 0.5, play: once"), "play is for glTF files"));
  EXPECT_TRUE(has(refusal("file: two.glb, play: twice"), "still, once or loop"));
}

TEST_F(gltf_in_scene, refuses_a_time_of_what_does_not_move) {
  EXPECT_TRUE(has(refusal("file: two.glb, time: 1 s"), "scene.yaml:2:33: error: ")) << refusal("file: two.glb, time: 1 s");
  EXPECT_TRUE(has(refusal("file: two.glb, time: 1 s"), "two.glb\" has no animation"));
  EXPECT_TRUE(has(refusal("file: corner.obj, reflectivity: 0.5, time: 1 s"), "time is for glTF files"));
  EXPECT_TRUE(has(refusal("file: two.glb, time: -1 s"), "time is out of range"));
}

TEST_F(gltf_in_scene, alone_may_lack_a_material) {
  EXPECT_TRUE(has(refusal("file: corner.obj"), "scene.yaml:2:11: error: mesh lacks a key")) << refusal("file: corner.obj");
  EXPECT_TRUE(has(refusal("file: two.glb, reflectivity: 0.5, material: paper"), "has \"reflectivity\" and \"material\""));
}

TEST_F(gltf_in_scene, may_name_files_beside_it_or_below) {
  const File inside = triangle_file();
  file("in/side/corner.gltf", inside.text_beside("corner.bin")), file("in/side/corner.bin", inside.binary);
  EXPECT_EQ(mesh("file: side/corner.gltf").triangles->triangles.size(), 1U);
  file("out.bin", inside.binary), file("in/out.gltf", inside.text_beside("../out.bin"));
  EXPECT_TRUE(has(refusal("file: out.gltf"), "leads out of its folder")) << refusal("file: out.gltf");
  fs::create_symlink(folder_.path() / "out.bin", folder_.path() / "in/link.bin");
  file("in/link.gltf", inside.text_beside("link.bin"));
  EXPECT_TRUE(has(refusal("file: link.gltf"), "link.gltf: error: \"link.bin\" leads out of the folder")) << refusal("file: link.gltf");
  file("in/none.gltf", inside.text_beside("none.bin"));
  EXPECT_TRUE(has(refusal("file: none.gltf", ErrorKind::io), "cannot open")) << refusal("file: none.gltf", ErrorKind::io);
}

TEST_F(gltf_in_scene, is_known_by_the_sha256_of_all_its_files) {
  const File inside = triangle_file();
  file("in/corner.gltf", inside.text_beside("corner.bin")), file("in/corner.bin", inside.binary);
  const std::string known = mesh("file: corner.gltf").sha256;
  EXPECT_EQ(known, files::sha256_hex(inside.text_beside("corner.bin") + inside.binary));
  EXPECT_EQ(mesh("file: two.glb").sha256, files::sha256_hex(two_materials().glb()));
  const assets::MeshFiles same{{}, {{{"corner.gltf", known}}}};
  EXPECT_EQ(mesh("file: corner.gltf", same).triangles->triangles.size(), 1U);
  std::string changed = inside.binary;
  changed[3] = '\x40';  // the sign and exponent of the first coordinate: 2 in place of 0
  file("in/corner.bin", changed);
  EXPECT_NE(mesh("file: corner.gltf").sha256, known);
  EXPECT_TRUE(has(refusal("file: corner.gltf", ErrorKind::bad_input, same), "is not the mesh that it was"));
}

TEST_F(gltf_in_scene, is_told_with_its_place_where_it_is_wrong) {
  const std::string whole = two_materials().glb();
  for (std::size_t size = 0; size < whole.size(); size += 97) {
    file("in/cut.glb", whole.substr(0, size));
    const std::string message = refusal("file: cut.glb");
    EXPECT_TRUE(has(message, "cut.glb:")) << message;
  }
  File empty;
  empty.node({{"name", "alone"}});
  file("in/empty.glb", empty.glb());
  EXPECT_TRUE(has(refusal("file: empty.glb"), "the file's scene shows none")) << refusal("file: empty.glb");
  EXPECT_TRUE(has(refusal("file: two.glb, scale: 1e9"), "no triangle of")) << refusal("file: two.glb, scale: 1e9");
}

TEST_F(gltf_in_scene, may_not_make_more_objects_than_a_scene_has) {
  File many = triangle_file();
  many.json["meshes"] = gltf_test::Document::array();
  many.json["nodes"] = gltf_test::Document::array();
  for (int i = 0; i < 9000; ++i) {
    many.add("materials", gltf_test::Document::object());
    many.primitive(many.mesh({{"POSITION", 0}}))["material"] = i;
    many.node({{"mesh", i}});
  }
  file("in/many.glb", many.glb());
  const std::string one = "  - mesh: {file: many.glb}\n";
  EXPECT_EQ(load::scene_from_text("objects:\n" + one + one, source()).objects.size(), 18000U);
  const auto refused = [&](const std::string& objects, const std::string& place) {
    const Error error = out_test::error_of([&] { (void)load::scene_from_text("objects:\n" + objects, source()); });
    EXPECT_EQ(error.kind(), ErrorKind::limit);
    EXPECT_TRUE(has(error.what(), place + ": error: the scene has too many objects")) << error.what();
  };
  refused(one + one + one, "scene.yaml:4:18");
  std::string spheres;
  for (int i = 0; i < 2001; ++i) spheres += "  - sphere: {center: [0, 0, 1], radius: 0.1 m, reflectivity: 0.2}\n";
  refused(one + one + spheres, "scene.yaml:3:18");
}

TEST_F(gltf_in_scene, says_where_its_first_perspective_camera_stands) {
  File seen = triangle_file();
  seen.add("cameras", {{"type", "orthographic"}, {"orthographic", {{"xmag", 1}, {"ymag", 1}, {"znear", 0.1}, {"zfar", 9}}}});
  seen.add("cameras", {{"type", "perspective"}, {"perspective", {{"yfov", 1}, {"znear", 0.1}}}});
  seen.node({{"camera", 0}});
  // Turned to the left about y by 90 degrees it looks along −x.
  seen.node({{"camera", 1}, {"translation", {1, 2, 3}}, {"rotation", {0, gltf_test::half_root, 0, gltf_test::half_root}}});
  file("in/seen.glb", seen.glb());
  const auto pose = assets::camera_in(mesh("file: seen.glb, scale: 2"), source(), {});
  ASSERT_TRUE(pose);
  // The world is (x, −y, −z) of the file; rounding of a quaternion and its product
  const Vec3 expected[] = {{2, -4, -6}, {0, -4, -6}, {0, -1, 0}}, got[] = {pose->position, pose->look_at, pose->up};
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t k = 0; k < 3; ++k) EXPECT_NEAR(got[i][k], expected[i][k], 1e-12);
  EXPECT_FALSE(assets::camera_in(mesh("file: two.glb"), source(), {}));
  EXPECT_FALSE(assets::camera_in(mesh("file: corner.obj, reflectivity: 0.5"), source(), {}));
}
