// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
// OBJ files that a scene names: their materials and pictures, and the files that those lie in.
#include <gtest/gtest.h>

#include "assets/mesh_load.h"
#include "assets/obj_load.h"
#include "files/sha256.h"
#include "gltf/gltf_files.h"
#include "image/image_files.h"
#include "load/load.h"
#include "support/pixels.h"
#include "support/samples.h"
#include "support/text.h"

using namespace tofray;
using out_test::write_file;
using test::has;

namespace {

namespace fs = std::filesystem;
using V = std::array<float, 3>;
using Texcoords = std::vector<std::array<float, 2>>;
using Notices = std::vector<std::string>;

/// 2 × 2: white, grey of a half (0.50289 linear), red, black.
const std::string four_colours = image_test::hand_png(2, 2, 8, image_test::rgb,
                                                      std::string("\0\xFF\xFF\xFF\xBC\xBC\xBC"
                                                                  "\0\xFF\0\0\0\0\0",
                                                                  14));
constexpr double grey = 0.50289, red = 0.2126;

/// 2 m × 2 m, 2 m before a camera at zero that looks along the world's +z; OBJ's v is 0 at the bottom.
const std::string square =
    "v -1 -1 -2\nv 1 -1 -2\nv 1 1 -2\nv -1 1 -2\nvt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\n"
    "f 1/1 2/2 3/3 4/4\n";

const std::string two =
    "mtllib two.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 2 3\nusemtl paint\nf 1 2 4\nusemtl cloth\nf 1 3 4\nf 2 3 4\nusemtl paint\nf 4 "
    "3 2\n";

class obj_in_scene : public testing::Test {
 protected:
  void SetUp() override {
    fs::create_directories(folder_.path() / "in/side");
    file("in/two.obj", two);
    file("in/two.mtl", "newmtl cloth\n#!nir_reflectivity 0.9\nKd 0.1 0.1 0.1\nnewmtl paint\nKd 0.5 0.25 0.125\nNs 10\nKs 1 1 1\n");
    file("in/card.obj", "mtllib card.mtl\nusemtl card\n" + square);
    file("in/card.mtl", "newmtl card\nmap_Kd card.png\n"), file("in/card.png", four_colours);
    file("in/corner.obj", "v 1 2 3\nv 4 2 3\nv 1 7 3\nf 1 2 3\n");
  }
  void file(const std::string& name, const std::string& bytes) const { write_file(folder_.path() / name, bytes); }
  void card(const std::string& mtl) const { file("in/card.mtl", "newmtl card\n" + mtl); }
  [[nodiscard]] std::string source() const { return (folder_.path() / "in/scene.yaml").string(); }
  [[nodiscard]] Scene scene(const std::string& keys, const assets::MeshFiles& files = {}) const {
    return load::scene_from_text("objects:\n  - mesh: {" + keys + "}\n", source(), {}, files);
  }
  [[nodiscard]] Mesh mesh(const std::string& keys, const assets::MeshFiles& files = {}) const {
    return std::get<Mesh>(scene(keys, files).objects.at(0).shape);
  }
  [[nodiscard]] std::string refusal(const std::string& keys, ErrorKind kind = ErrorKind::bad_input,
                                    const assets::MeshFiles& files = {}) const {
    const Error error = out_test::error_of([&] { (void)scene(keys, files); });
    EXPECT_EQ(error.kind(), kind) << error.what();
    return error.what();
  }
  /// What the message tells of a card whose file of materials is this one.
  [[nodiscard]] std::string card_refusal(const std::string& mtl, ErrorKind kind = ErrorKind::bad_input) const {
    card(mtl);
    return refusal("file: card.obj", kind);
  }

  out_test::TemporaryFolder folder_;
};

const Material& material(const Scene& scene, std::size_t object) {
  return scene.materials.at(static_cast<std::size_t>(scene.objects.at(object).material));
}

Notices notices(const Scene& scene) { return std::get<Mesh>(scene.objects.at(0).shape).notices; }

/// Of the pixels that see the middles of a picture's texels: upper left, upper right, lower left, lower right.
std::array<double, 4> seen(const Scene& scene) {
  const Frame frame = Simulator(scene, test::lit_camera(65, 65, 32), {.noise = Noise::off, .truth = true}).frame(0);
  const auto at = [&](std::size_t x, std::size_t y) { return static_cast<double>(frame.truth.reflectivity[65 * y + x]); };
  return {at(24, 24), at(40, 24), at(24, 40), at(40, 40)};
}

void expect_seen(const Scene& scene, const std::array<double, 4>& expected) {
  const std::array<double, 4> got = seen(scene);
  for (std::size_t i = 0; i < 4; ++i) EXPECT_NEAR(got[i], expected[i], 2e-5) << i;  // roundings of a place of some pixels
}

constexpr const char* way_out = "\n  or give the object a reflectivity or a material: what its file says of materials is not read then";

}  // namespace

TEST_F(obj_in_scene, is_an_object_for_each_material) {
  const Scene got = load::scene_from_text(
      "objects:\n  - sphere: {center: [0, 0, 1], radius: 0.1 m, reflectivity: 0.7}\n"
      "  - mesh: {file: two.obj, name: toy, position: [1, 2, 3]}\n  - mesh: {file: two.obj}\n",
      source());
  std::vector<std::string> names;
  for (const Object& one : got.objects) names.push_back(one.name);
  EXPECT_EQ(names,
            (std::vector<std::string>{"", "toy/no material", "toy/paint", "toy/cloth", "two/no material", "two/paint", "two/cloth"}));
  const auto triangles = [&](std::size_t i) { return *std::get<Mesh>(got.objects.at(i).shape).triangles; };
  EXPECT_EQ(triangles(1).triangles.size(), 1U);
  EXPECT_EQ(triangles(2).triangles, (std::vector<std::array<std::int32_t, 3>>{{0, 1, 2}, {2, 3, 1}}));
  EXPECT_EQ(triangles(2).vertices, (std::vector<V>{{0, 0, 0}, {1, 0, 0}, {0, 0, -1}, {0, -1, 0}}));
  EXPECT_EQ(triangles(3).triangles.size(), 2U);
  EXPECT_EQ(material(got, 0).diffuse, 0.7);
  EXPECT_EQ(material(got, 1).diffuse, 0.5);
  // 0.2126 · 0.5 + 0.7152 · 0.25 + 0.0722 · 0.125; rounding of three terms
  EXPECT_NEAR(material(got, 2).diffuse, 0.294125, 1e-12);
  EXPECT_EQ(material(got, 3).diffuse, 0.9);
  EXPECT_EQ(got.objects[3].position, (Vec3{1, 2, 3}));
  EXPECT_EQ(std::get<Mesh>(got.objects[1].shape).guessed, 1);
  EXPECT_EQ(std::get<Mesh>(got.objects[2].shape).guessed, 0);
  EXPECT_EQ(std::get<Mesh>(got.objects[1].shape).notices,
            (Notices{"triangles without a material get a reflectivity of 0.5", "of its materials is left out: Ns, Ks"}));
}

TEST_F(obj_in_scene, is_one_object_where_that_has_a_material) {
  file("in/lost.obj", "mtllib nowhere.mtl\n" + two);
  for (const char* const name : {"two.obj", "lost.obj"}) {
    const Scene got = scene(std::string("reflectivity: 0.3, name: toy, file: ") + name);
    ASSERT_EQ(got.objects.size(), 1U);
    EXPECT_EQ(got.objects[0].name, "toy");
    EXPECT_EQ(material(got, 0).diffuse, 0.3);
    const Mesh& mesh = std::get<Mesh>(got.objects[0].shape);
    EXPECT_EQ(mesh.triangles->triangles.size(), 5U);
    EXPECT_TRUE(mesh.notices.empty());
    EXPECT_EQ(mesh.sha256, files::sha256_hex(out_test::read_file(folder_.path() / "in" / name)));
  }
}

TEST_F(obj_in_scene, without_material_needs_an_mtllib) {
  EXPECT_TRUE(has(refusal("file: corner.obj"),
                  "scene.yaml:2:11: error: mesh lacks a key\n  expected one of \"reflectivity\" or "
                  "\"material\"; glTF files, OBJ files that name an mtllib, PLY files that wear a picture, and vertices with "
                  "colours have their own; "));
  EXPECT_TRUE(has(refusal("file: corner.obj"), "corner.obj\" names no mtllib"));
  file("in/one.mtl", ""), file("in/one.obj", "mtllib one.mtl\n" + out_test::read_file(folder_.path() / "in/corner.obj"));
  const Scene got = scene("file: one.obj");
  EXPECT_EQ(got.objects.at(0).name, "one/no material");
  EXPECT_EQ(material(got, 0).diffuse, 0.5);
}

TEST_F(obj_in_scene, tells_of_materials_without_colour_and_of_names_that_come_twice) {
  file("in/two.mtl", "newmtl cloth\nillum 1\nnewmtl other\nnewmtl cloth\nKd 1 1 1\n");
  const Scene got = scene("file: two.obj");
  EXPECT_EQ(material(got, 1).diffuse, 0.5);
  EXPECT_EQ(material(got, 2).diffuse, 0.5);
  EXPECT_EQ(std::get<Mesh>(got.objects.at(0).shape).guessed, 0);
  EXPECT_EQ(notices(got),
            (Notices{"triangles without a material get a reflectivity of 0.5",
                     "no MTL file says a colour of material \"paint\" and 1 more: a reflectivity of 0.5",
                     "materials that come twice in its MTL files (1): the first of each counts", "of its materials is left out: illum"}));
}

TEST_F(obj_in_scene, wears_pictures_the_right_way_up) {
  expect_seen(scene("file: card.obj"), {1, grey, red, 0});
  card("Kd 0.8 0.5 1\nmap_Kd card.png\n");
  const double white = 0.2126 * 0.8 + 0.7152 * 0.5 + 0.0722;
  const Scene got = scene("file: card.obj");
  expect_seen(got, {white, grey * white, red * 0.8, 0});
  EXPECT_NEAR(material(got, 0).diffuse, white, 1e-6);
  EXPECT_EQ(material(got, 0).map->wrap_u, ReflectivityMap::Wrap::repeat);
  EXPECT_EQ(std::get<Mesh>(got.objects[0].shape).guessed, 1);
}

TEST_F(obj_in_scene, wears_the_same_as_a_gltf_file) {
  gltf_test::File same;
  const int corners = same.floats({-1, -1, -2, 1, -1, -2, 1, 1, -2, -1, 1, -2}, "VEC3"), uv = same.floats({0, 1, 1, 1, 1, 0, 0, 0}, "VEC2");
  same.primitive(
      same.mesh({{"POSITION", corners}, {"TEXCOORD_0", uv}}, same.accessor<std::uint16_t>({0, 1, 2, 0, 2, 3}, "SCALAR")))["material"] = 0;
  same.node({{"mesh", 0}});
  same.add("materials", {{"pbrMetallicRoughness", {{"baseColorTexture", {{"index", 0}}}}},
                         {"extensions", {{"KHR_materials_unlit", gltf_test::Document::object()}}}});
  same.add("textures", {{"source", 0}});
  same.add("images", {{"bufferView", same.view(four_colours)}, {"mimeType", "image/png"}});
  file("in/same.glb", same.glb());
  expect_seen(scene("file: same.glb"), {1, grey, red, 0});
  EXPECT_EQ(seen(scene("file: same.glb")), seen(scene("file: card.obj")));
}

// (u, v) of the file times the scale plus the offset, v upward.
TEST_F(obj_in_scene, shifts_scales_and_clamps_pictures) {
  card("map_Kd -o 0.5 card.png\n");
  expect_seen(scene("file: card.obj"), {grey, 1, 0, red});
  card("map_Kd -o 0 0.5 0 card.png\n");
  expect_seen(scene("file: card.obj"), {red, 0, 1, grey});
  card("map_Kd -s -1 card.png\n");
  expect_seen(scene("file: card.obj"), {grey, 1, 0, red});
  card("map_Kd -clamp on -o 0.5 0.25 card.png\n");
  const Scene got = scene("file: card.obj");
  EXPECT_EQ(material(got, 0).map->wrap_u, ReflectivityMap::Wrap::clamp);
  EXPECT_EQ(material(got, 0).map->wrap_v, ReflectivityMap::Wrap::clamp);
  expect_seen(got, {grey, grey, grey / 2, grey / 2});  // v = 0.5 lies between the two rows
  card("map_Kd -s 2 3 -o 0.5 0.25 card.png\n");
  EXPECT_EQ(mesh("file: card.obj").triangles->texcoords, (Texcoords{{0.5F, 0.75F}, {2.5F, 0.75F}, {2.5F, -2.25F}, {0.5F, -2.25F}}));
  file("in/far.obj", "mtllib card.mtl\nusemtl card\nv 0 0 0\nv 1 0 0\nv 0 1 0\nvt 1e6 0\nvt 1 1\nf 1/1 2/2 3/2\n");
  EXPECT_EQ(mesh("file: far.obj").triangles->texcoords, (Texcoords{{0, 0}, {2.5F, -2.25F}, {2.5F, -2.25F}}));
}

TEST_F(obj_in_scene, wears_no_picture_where_its_reflectivity_is_known) {
  card("#!nir_reflectivity 0.6\nmap_Kd nowhere.png\n");
  EXPECT_EQ(material(scene("file: card.obj"), 0).map, nullptr);
  EXPECT_EQ(material(scene("file: card.obj"), 0).diffuse, 0.6);
  card("map_Kd nowhere.png\n");
  EXPECT_EQ(material(scene("file: card.obj, reflectivity: 0.4"), 0).map, nullptr);
}

TEST_F(obj_in_scene, without_texture_coordinates_has_half_its_colours_luminance) {
  file("in/two.mtl", "newmtl paint\nKd 0.5 0.5 0.5\nmap_Kd nowhere.png\nnewmtl cloth\nmap_Kd nowhere.png\n");
  EXPECT_NEAR(material(scene("file: two.obj"), 1).diffuse, 0.25, 1e-12);
  EXPECT_NEAR(material(scene("file: two.obj"), 2).diffuse, 0.5, 1e-12);
}

TEST_F(obj_in_scene, has_its_normals_turned_with_it) {
  file("in/smooth.obj", "v 1 2 3\nv 4 2 3\nv 1 7 3\nvn 0 1 0\nvn 0 0 5\nf 1//1 2//2 3//2\n");
  EXPECT_EQ(mesh("file: smooth.obj, scale: 3, reflectivity: 0.5").triangles->normals, (std::vector<V>{{0, -1, 0}, {0, 0, -1}, {0, 0, -1}}));
  EXPECT_EQ(mesh("file: smooth.obj, up: z, reflectivity: 0.5").triangles->normals, (std::vector<V>{{0, 0, 1}, {0, -1, 0}, {0, -1, 0}}));
}

TEST_F(obj_in_scene, may_name_files_beside_it_or_below) {
  file("in/side/card.mtl", "newmtl card\nmap_Kd pictures\\card.png\n"), fs::create_directories(folder_.path() / "in/side/pictures");
  file("in/side/pictures/card.png", four_colours), file("in/below.obj", "mtllib side/card.mtl\nusemtl card\n" + square);
  expect_seen(scene("file: below.obj"), {1, grey, red, 0});
  file("out.mtl", ""), file("in/out.obj", "mtllib ../out.mtl\n" + square), file("out.png", four_colours);
  const auto expect_left_out = [&](const std::string& name, const std::string& what) {
    const Scene left = scene("file: " + name);
    EXPECT_TRUE(has(notices(left).back(), "cannot be read and is left out: \"" + what + "\"")) << notices(left).back();
    EXPECT_TRUE(has(notices(left).back(), "--root DIR"));
  };
  expect_left_out("out.obj", "../out.mtl");
  EXPECT_EQ(scene("file: out.obj", {folder_.path().string(), {}}).objects.size(), 1U);
  fs::create_symlink(folder_.path() / "out.mtl", folder_.path() / "in/link.mtl");
  file("in/link.obj", "mtllib link.mtl\n" + square);
  expect_left_out("link.obj", "link.mtl");
  for (const char* picture : {"../out.png", "/etc/passwd"}) {
    card("map_Kd " + std::string(picture));
    expect_left_out("card.obj", picture);
  }
}

TEST_F(obj_in_scene, finds_files_that_were_called_otherwise_on_the_machine_that_wrote_it) {
  const auto expect_found = [&](const std::string& mtl, const std::string& notice) {
    card(mtl);
    SCOPED_TRACE(mtl);
    const Scene found = scene("file: card.obj");
    expect_seen(found, {1, grey, red, 0});
    EXPECT_EQ(notices(found).back(), notice);
  };
  expect_found("map_Kd C:\\Users\\me\\textures\\card.png", "there is no \"C:/Users/me/textures/card.png\": \"card.png\" is read");
  expect_found("map_Kd /home/me/card.png", "there is no \"/home/me/card.png\": \"card.png\" is read");
  expect_found("map_Kd CARD.PNG", "there is no \"CARD.PNG\": \"card.png\" is read");
  expect_found("map_kd \"D:\\Card.Png\"", "there is no \"D:/Card.Png\": \"card.png\" is read");
  expect_found("map_Kd textures/card.png", "there is no \"textures/card.png\": \"card.png\" is read");
  file("in/Side/none.txt", ""), file("in/side/Deep.png", four_colours);
  expect_found("map_Kd SIDE/deep.png", "there is no \"SIDE/deep.png\": \"side/Deep.png\" is read");
  card("map_Kd card.png\n"), file("in/other.obj", "mtllib \"C:\\models\\Card.MTL\"\nusemtl card\n" + square);
  expect_seen(scene("file: other.obj"), {1, grey, red, 0});
}

TEST_F(obj_in_scene, without_a_picture_or_a_file_of_materials_says_so_and_goes_on) {
  card("Kd 0.8 0.8 0.8\nmap_Kd none.png\n");
  const Scene half = scene("file: card.obj");
  EXPECT_NEAR(half.materials.at(0).diffuse, 0.4, 1e-9) << "the colour alone, as where there are no texture coordinates";
  EXPECT_EQ(half.materials[0].map, nullptr);
  EXPECT_TRUE(has(notices(half).back(), "cannot be read and is left out: \"none.png\""));
  file("in/none.obj", "mtllib none.mtl\nusemtl card\n" + square);
  const Scene none = scene("file: none.obj");
  EXPECT_EQ(none.materials.at(0).diffuse, 0.5);
  EXPECT_TRUE(has(notices(none).back(), "cannot be read and is left out: \"none.mtl\""));
  file("in/half.obj", "mtllib none.mtl card.mtl\nusemtl card\n" + square);
  card("Kd 0.8 0.8 0.8\n");
  EXPECT_NEAR(scene("file: half.obj").materials.at(0).diffuse, 0.8, 1e-9);
}

TEST_F(obj_in_scene, of_materials_without_a_name_has_the_one_without_a_name) {
  file("in/nameless.mtl", "newmtl\nKd 0.25 0.25 0.25\nnewmtl a\nKd 1 1 1\n"),
      file("in/nameless.obj", "mtllib nameless.mtl\nusemtl\n" + square);
  EXPECT_NEAR(scene("file: nameless.obj").materials.at(0).diffuse, 0.25, 1e-9);
}

TEST_F(obj_in_scene, says_the_way_out_where_a_file_is_broken) {
  const auto expect_told = [&](const std::string& message, const std::string& what) {
    EXPECT_TRUE(has(message, what) && has(message, way_out)) << message;
  };
  expect_told(card_refusal("Kd 2 0 0"), "card.mtl:2:4: error: a number is out of range");
  expect_told(card_refusal("map_Kd card.mtl"), "card.mtl: error: this is no image that can be read");
  file("in/cut.png", four_colours.substr(0, 50)), file("in/empty.png", ""), file("in/x.bmp", std::string("BM\0\0\0\0", 6));
  expect_told(card_refusal("map_Kd cut.png"), "cut.png: error: ");
  expect_told(card_refusal("map_Kd empty.png"), "empty.png: error: the image file is empty");
  expect_told(card_refusal("map_Kd x.bmp"), "x.bmp: error: ");
  file("in/binary.obj", "mtllib card.png\n" + square);
  expect_told(refusal("file: binary.obj"), "card.png:1:1: error: a statement stands before the first newmtl");
}

TEST_F(obj_in_scene, is_known_by_the_sha256_of_all_its_files) {
  const auto bytes = [&](const std::string& name) { return out_test::read_file(folder_.path() / "in" / name); };
  file("in/three.obj",
       "mtllib card.mtl two.mtl card.mtl\nusemtl paint\n" + square + "usemtl card\nf 1/1 2/2 3/3\nusemtl same\nf 1/1 2/2 3/3\n");
  file("in/card.mtl", "newmtl card\nmap_Kd card.png\nnewmtl same\nmap_Kd card.png\nnewmtl unused\nmap_Kd nowhere.png\n");
  file("in/two.mtl", "newmtl paint\nmap_Kd other.png\n"), file("in/other.png", four_colours + "!");
  const std::string all = bytes("three.obj") + bytes("card.mtl") + bytes("two.mtl") + bytes("other.png") + bytes("card.png");
  const std::string known = mesh("file: three.obj").sha256;
  EXPECT_EQ(known, files::sha256_hex(all));
  const assets::MeshFiles same{{}, {{{"three.obj", known}}}};
  EXPECT_EQ(scene("file: three.obj", same).objects.size(), 3U);
  for (const char* const changed : {"in/card.mtl", "in/two.mtl", "in/card.png", "in/three.obj"}) {
    const std::string before = out_test::read_file(folder_.path() / changed);
    file(changed, before + "\n# changed");
    EXPECT_TRUE(has(refusal("file: three.obj", ErrorKind::bad_input, same), "is not the mesh that it was")) << changed;
    file(changed, before);
  }
  // One name has one SHA-256: that of all its files where any object wants its materials.
  const Scene both =
      load::scene_from_text("objects:\n  - mesh: {file: three.obj, reflectivity: 0.5}\n  - mesh: {file: three.obj}\n", source(), {}, same);
  ASSERT_EQ(both.objects.size(), 4U);
  for (const Object& one : both.objects) EXPECT_EQ(std::get<Mesh>(one.shape).sha256, known);
}

TEST_F(obj_in_scene, takes_no_more_than_the_limits) {
  file("in/long.mtl", std::string(9 << 20, '\n')), file("in/long2.mtl", std::string(9 << 20, ' '));
  file("in/long.obj", "mtllib long.mtl\nmtllib long2.mtl\n" + square);
  EXPECT_TRUE(has(refusal("file: long.obj", ErrorKind::limit), "mtl_bytes") || has(refusal("file: long.obj", ErrorKind::limit), "bytes"));
  file("in/long.obj", "mtllib long.mtl\n" + square);
  EXPECT_EQ(scene("file: long.obj").objects.size(), 1U);
  std::string many;
  for (int i = 0; i < 60'000; ++i) many += "newmtl " + std::to_string(i) + "\n";
  file("in/many.mtl", many), file("in/many2.mtl", many), file("in/many.obj", "mtllib many.mtl many2.mtl\n" + square);
  EXPECT_TRUE(has(refusal("file: many.obj", ErrorKind::limit), "many2.mtl:40001:1: error: there are more than 40000 materials"))
      << refusal("file: many.obj", ErrorKind::limit);
}

TEST_F(obj_in_scene, wears_no_more_texels_than_the_limit) {
  // 4096 × 4096 of grey, one bit each: four of them are as many as a scene may have.
  constexpr int side = 4096;
  file("in/card.png",
       image_test::hand_png(side, side, 1, image_test::grey, std::string(static_cast<std::size_t>(side) * (side / 8 + 1), '\0')));
  std::string mtl, obj = "mtllib card.mtl\n" + square;
  for (int i = 0; i < 5; ++i) {
    mtl += "newmtl " + std::to_string(i) + "\nmap_Kd card.png\n";
    obj += "usemtl " + std::to_string(i) + "\nf 1/1 2/2 3/3\n";
  }
  file("in/card.mtl", mtl), file("in/card.obj", obj);
  EXPECT_TRUE(has(refusal("file: card.obj", ErrorKind::limit), "the scene's meshes wear too many pixels of pictures"));
}

TEST_F(obj_in_scene, takes_materials_in_place_of_its_own_by_their_usemtl_names) {
  const Scene got = scene("file: two.obj, materials: {paint: cotton-white, cloth: {brdf: ggx, specular: 0.9, alpha: 0.25}}");
  ASSERT_EQ(got.objects.size(), 3U);
  EXPECT_EQ(material(got, 0).diffuse, 0.5);
  EXPECT_EQ(material(got, 1).name, "cotton-white");
  EXPECT_EQ(material(got, 2).brdf, Material::Brdf::ggx);
  EXPECT_EQ(material(got, 2).alpha, 0.25);
  EXPECT_EQ(std::get<Mesh>(got.objects[0].shape).guessed, 0);
  const Notices all = {"of its materials is left out: Ns, Ks"};
  EXPECT_EQ(notices(scene("file: two.obj, materials: {no material: wood, paint: wood, cloth: wood}")), all);
  EXPECT_TRUE(has(refusal("file: two.obj, materials: {pain: wood}"),
                  "two.obj\" has no material \"pain\"; did you mean \"paint\"?\n  its materials: cloth, no material and paint"))
      << refusal("file: two.obj, materials: {pain: wood}");
}

// Its triangles name materials; where the scene says them, nobody needs an MTL file.
TEST_F(obj_in_scene, needs_no_mtllib_where_the_scene_says_its_materials) {
  file("in/bare.obj", "usemtl paint\n" + square + "usemtl cloth\nf 1/1 2/2 3/3\n");
  const Scene got = scene("file: bare.obj, materials: {paint: {reflectivity: 0.3}}");
  ASSERT_EQ(got.objects.size(), 2U);
  EXPECT_EQ(material(got, 0).diffuse, 0.3);
  EXPECT_EQ(notices(got), Notices{"no MTL file says a colour of material \"cloth\": a reflectivity of 0.5"});
  EXPECT_TRUE(has(refusal("file: bare.obj"), "names no mtllib"));
}

TEST_F(obj_in_scene, has_names_that_may_be_shown) {
  file("in/two.obj", "mtllib two.mtl\nusemtl \x1b[31m" + std::string(300, 'n') + "\n" + square);
  const std::string name = scene("file: two.obj").objects.at(0).name;
  EXPECT_TRUE(name.starts_with("two/\\x1b[31mnnn")) << name;
  EXPECT_LT(name.size(), 220U);
  EXPECT_TRUE(has(notices(scene("file: two.obj")).at(0), "no MTL file says a colour of material \""));
}

TEST_F(obj_in_scene, has_materials_of_its_own_if_one_of_its_files_can_be_read) {
  const auto own = [&](const std::string& name) { return assets::has_own_materials(name, source(), {}); };
  EXPECT_TRUE(own("card.obj"));
  EXPECT_TRUE(own("any.glb"));
  EXPECT_FALSE(own("corner.obj"));
  EXPECT_FALSE(own("nowhere.obj"));
  EXPECT_FALSE(own("a.ply"));
  file("in/half.obj", "mtllib card.mtl none.mtl\n" + square), file("out.mtl", ""), file("in/out.obj", "mtllib ../out.mtl\n" + square);
  EXPECT_TRUE(own("half.obj"));
  EXPECT_FALSE(own("out.obj"));
  file("in/OTHER.OBJ", "mtllib card.mtl\n" + square);
  EXPECT_TRUE(own("OTHER.OBJ"));
}

// The card of OBJ files as a PLY file has it: of vertices, and of corners as MeshLab writes them.
TEST_F(obj_in_scene, wears_the_same_as_a_ply_file) {
  const std::string body = "-1 -1 -2 0 0\n1 -1 -2 1 0\n1 1 -2 1 1\n-1 1 -2 0 1\n4 0 1 2 3";
  const std::string header =
      "ply\nformat ascii 1.0\ncomment TextureFile C:\\scans\\card.png\nelement vertex 4\nproperty float x\nproperty float "
      "y\nproperty float z\nproperty float s\nproperty float t\nelement face 1\nproperty list uchar int vertex_indices\n";
  file("in/vertices.ply", header + "end_header\n" + body + "\n");
  file("in/corners.ply", header + "property list uchar float texcoord\nend_header\n" +
                             "-1 -1 -2 5 5\n1 -1 -2 5 5\n1 1 -2 5 5\n-1 1 -2 5 5\n4 0 1 2 3 8 0 0 1 0 1 1 0 1\n");
  for (const char* const name : {"vertices.ply", "corners.ply"}) {
    const Scene got = scene(std::string("up: y, file: ") + name);
    expect_seen(got, {1, grey, red, 0});
    ASSERT_EQ(got.objects.size(), 1U);
    EXPECT_TRUE(has(got.objects[0].name, "card.png")) << got.objects[0].name;
    EXPECT_EQ(std::get<Mesh>(got.objects[0].shape).guessed, 1);
    EXPECT_EQ(notices(got), Notices{"there is no \"C:/scans/card.png\": \"card.png\" is read"});
    EXPECT_EQ(std::get<Mesh>(got.objects[0].shape).sha256,
              files::sha256_hex(out_test::read_file(folder_.path() / "in" / name) + out_test::read_file(folder_.path() / "in/card.png")));
    EXPECT_EQ(material(scene(std::string("reflectivity: 0.4, file: ") + name), 0).map, nullptr);
  }
}

TEST_F(obj_in_scene, whose_ply_file_lacks_its_picture_has_the_colours_of_its_vertices) {
  const auto save = [&](const std::string& color, const std::string& value) {
    file("in/lost.ply",
         "ply\nformat ascii 1.0\ncomment TextureFile lost.png\nelement vertex 3\nproperty float x\nproperty float y\nproperty "
         "float z\nproperty float s\nproperty float t\n" +
             color + "element face 1\nproperty list uchar int vertex_indices\nend_header\n0 0 0 0 0" + value + "1 0 0 1 0" + value +
             "0 1 0 0 1" + value + "3 0 1 2\n");
  };
  save("property uchar red\nproperty uchar green\nproperty uchar blue\n", " 255 255 255\n");
  const Scene got = scene("file: lost.ply");
  EXPECT_EQ(material(got, 0).diffuse, 1);
  ASSERT_EQ(notices(got).size(), 1U);
  EXPECT_TRUE(has(notices(got)[0], "cannot be read and is left out: \"lost.png\""));
  save("", "\n");
  EXPECT_TRUE(has(refusal("file: lost.ply"), "\"lost.ply\" has neither colours of vertices nor a picture that can be read"));
}
