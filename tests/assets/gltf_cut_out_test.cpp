// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
// What a glTF file's alphas cut out, as scenes have it, and what is told of it.
#include <gtest/gtest.h>

#include "gltf/gltf_files.h"
#include "image/image_files.h"
#include "load/load.h"
#include "support/pixels.h"
#include "support/samples.h"
#include "support/text.h"
#include "tofray/tofray.h"

using namespace tofray;
using gltf_test::File;
using test::has;

namespace {

using Doc = gltf_test::Document;
using Sentences = std::vector<std::string>;

class gltf_cut_out : public testing::Test {
 protected:
  void SetUp() override { std::filesystem::create_directories(folder_.path() / "in"); }
  void save(const File& file) const { out_test::write_file(folder_.path() / "in/a.glb", file.glb()); }
  [[nodiscard]] Scene scene(const std::string& keys = "", const std::string& before = "") const {
    return load::scene_from_text(before + "objects:\n  - mesh: {file: a.glb" + keys + "}\n", (folder_.path() / "in/s.yaml").string());
  }
  [[nodiscard]] Sentences notices(const std::string& keys = "") const { return std::get<Mesh>(scene(keys).objects.at(0).shape).notices; }

  /// One triangle, with coordinates in a picture of 4 × 1: red of alpha 255, white of alpha 127, green of 128, white of 0.
  [[nodiscard]] static File leaf(const std::string& mode, const Doc& more = Doc::object(), double factor = 1, bool has_texcoords = true) {
    File file;
    Doc attributes = {{"POSITION", file.floats(gltf_test::corner_positions, "VEC3")}};
    if (has_texcoords) attributes["TEXCOORD_0"] = file.floats({0, 0, 1, 0, 0, 1}, "VEC2");
    const int mesh = file.mesh(attributes);
    file.primitive(mesh)["material"] = 0;
    file.node({{"mesh", mesh}});
    Doc material = {
        {"name", "leaf"},
        {"alphaMode", mode},
        {"pbrMetallicRoughness", {{"baseColorFactor", {1, 1, 1, factor}}, {"baseColorTexture", {{"index", 0}}}, {"metallicFactor", 0}}}};
    material.update(more);
    file.add("materials", material);
    const std::string row("\0\xFF\0\0\xFF\xFF\xFF\xFF\x7F\0\xFF\0\x80\xFF\xFF\xFF\0", 17);
    file.add("images", {{"bufferView", file.view(image_test::hand_png(4, 1, 8, image_test::rgba, row))}, {"mimeType", "image/png"}});
    file.add("textures", {{"source", 0}, {"sampler", 0}});
    file.add("samplers", {{"wrapS", 33071}, {"wrapT", 33648}});
    return file;
  }
  /// Expects of the scene's material that it is a surface at these texels.
  void expect_there(const Scene& scene, const std::array<bool, 4>& expected) const {
    const Material& material = scene.materials.at(static_cast<std::size_t>(scene.objects.at(0).material));
    ASSERT_NE(material.opacity, nullptr);
    ASSERT_EQ(material.opacity->values.size(), 4U);
    for (std::size_t i = 0; i < 4; ++i) EXPECT_EQ(material.opacity->values[i] >= 0.5F, expected[i]) << i;
  }

  out_test::TemporaryFolder folder_;
};

}  // namespace

TEST_F(gltf_cut_out, is_a_surface_where_alpha_comes_up_to_the_cutoff) {
  save(leaf("MASK"));
  const Scene got = scene();
  expect_there(got, {true, false, true, false});
  const ReflectivityMap& opacity = *got.materials[0].opacity;
  EXPECT_EQ(opacity.wrap_u, ReflectivityMap::Wrap::clamp);
  EXPECT_EQ(opacity.wrap_v, ReflectivityMap::Wrap::mirror);
  EXPECT_EQ(opacity.width, 4);
  EXPECT_EQ(notices(), Sentences{}) << "what is simulated needs no notice";
  // Texels that are cut out are white, the others red and green: the brightest is green, and the mean is that of the two.
  EXPECT_NEAR(got.materials[0].diffuse, 0.7152, 1e-6);
}

// An alpha of 128 of 255 is the cut-off where that is 128/255, and not a hair above; a factor of the alpha counts.
TEST_F(gltf_cut_out, decides_at_the_cutoff_to_the_last_bit) {
  save(leaf("MASK", {{"alphaCutoff", 128.0 / 255}}));
  expect_there(scene(), {true, false, true, false});
  save(leaf("MASK", {{"alphaCutoff", std::nextafter(128.0 / 255, 1.0)}}));
  expect_there(scene(), {true, false, false, false});
  save(leaf("MASK", {{"alphaCutoff", 127.0 / 255}}));
  expect_there(scene(), {true, true, true, false});
  save(leaf("MASK", {{"alphaCutoff", 0.25}}, 0.5));
  expect_there(scene(), {true, false, true, false});
}

TEST_F(gltf_cut_out, that_lets_light_through_in_part_is_cut_at_half_and_told) {
  save(leaf("BLEND", {{"alphaCutoff", 0.9}}));
  expect_there(scene(), {true, false, true, false});
  ASSERT_EQ(notices().size(), 1U);
  EXPECT_TRUE(has(notices()[0], "material \"leaf\" lets light through in part (alphaMode BLEND): it is a surface where its alpha is 0.5"));
  // Half of it everywhere is glass, to nine tenths it is there.
  File pane = leaf("BLEND", Doc::object(), 0.9);
  pane.json["materials"][0]["pbrMetallicRoughness"].erase("baseColorTexture");
  save(pane);
  EXPECT_EQ(scene().materials.at(0).opacity, nullptr);
  EXPECT_EQ(notices().size(), 1U);
  pane.json["materials"][0]["pbrMetallicRoughness"]["baseColorFactor"][3] = 1;
  save(pane);
  EXPECT_EQ(notices(), Sentences{});
}

TEST_F(gltf_cut_out, is_whole_where_nothing_is_below_the_cutoff) {
  save(leaf("OPAQUE"));
  EXPECT_EQ(scene().materials.at(0).opacity, nullptr);
  EXPECT_NEAR(scene().materials.at(0).diffuse, 1, 1e-6);
  save(leaf("MASK", {{"alphaCutoff", 0}}));
  EXPECT_EQ(scene().materials.at(0).opacity, nullptr);
  EXPECT_EQ(notices(), Sentences{});
}

TEST_F(gltf_cut_out, everywhere_is_left_out_and_told) {
  File file = leaf("MASK", Doc::object(), 0.4);
  save(file);
  const Error error = out_test::error_of([&] { (void)scene(); });
  EXPECT_TRUE(has(error.what(), "all of \"" + (folder_.path() / "in/a.glb").string() + "\" is cut out by alpha")) << error.what();
  // Beside something else.
  const int corners = file.floats(gltf_test::corner_positions, "VEC3");
  file.node({{"mesh", file.mesh({{"POSITION", corners}})}});
  save(file);
  EXPECT_EQ(scene().objects.size(), 1U);
  EXPECT_EQ(notices(), (Sentences{"triangles without a material get a reflectivity of 0.5",
                                  "material \"leaf\" is cut out everywhere by its alpha: its triangles are left out"}));
}

TEST_F(gltf_cut_out, by_what_cannot_be_placed_is_told) {
  save(leaf("MASK", Doc::object(), 1, false));
  EXPECT_EQ(scene().materials.at(0).opacity, nullptr);
  ASSERT_EQ(notices().size(), 1U);
  EXPECT_TRUE(has(notices()[0], "is cut out by alphas of vertices, or by a picture without texture coordinates: they are left out"));
  File file = leaf("MASK");
  file.primitive(0)["attributes"]["COLOR_0"] = file.floats({1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 0}, "VEC4");
  save(file);
  ASSERT_EQ(notices().size(), 1U);
  EXPECT_TRUE(has(notices()[0], "by alphas of vertices"));
  expect_there(scene(), {true, false, true, false});
}

// The shape of a leaf is its own, whatever the scene says that it is made of; but one reflectivity for all of the file is one surface.
TEST_F(gltf_cut_out, stays_where_the_scene_says_what_a_material_is) {
  save(leaf("MASK"));
  expect_there(scene(", materials: {leaf: oak}", "materials: {oak: {reflectivity: 0.7}}\n"), {true, false, true, false});
  EXPECT_EQ(scene(", materials: {leaf: oak}", "materials: {oak: {reflectivity: 0.7}}\n").materials.at(0).diffuse, 0.7);
  EXPECT_EQ(scene(", reflectivity: 0.3").materials.at(0).opacity, nullptr);
  EXPECT_EQ(notices(", reflectivity: 0.3"),
            Sentences{"what its materials cut out by alpha is opaque, since the object's own material stands for all of them"});
  File file = leaf("MASK", {{"extras", {{"nir_reflectivity", 0.9}}}});
  save(file);
  expect_there(scene(), {true, false, true, false});
}

// Out of the file into the picture: the middles of the four texels of a square metre, seen at 1 m before a wall.
TEST_F(gltf_cut_out, is_seen_through) {
  File file = leaf("MASK");
  file.json["nodes"].clear();
  const int corners = file.floats({-0.5, -0.5, -1, 0.5, -0.5, -1, 0.5, 0.5, -1, -0.5, 0.5, -1}, "VEC3");
  const int square = file.mesh({{"POSITION", corners}, {"TEXCOORD_0", file.floats({0, 1, 1, 1, 1, 0, 0, 0}, "VEC2")}},
                               file.accessor<std::uint16_t>({0, 1, 2, 0, 2, 3}, "SCALAR"));
  file.primitive(square)["material"] = 0;
  file.node({{"mesh", square}});
  save(file);
  const Scene got =
      load::scene_from_text("objects:\n  - plane: {point: [0, 0, 2], normal: [0, 0, -1], reflectivity: 0.5}\n  - mesh: {file: a.glb}\n",
                            (folder_.path() / "in/s.yaml").string());
  const Frame frame = Simulator(got, test::lit_camera(65, 3, 64), {.noise = Noise::off, .truth = true}).frame(0);
  const std::int32_t expected[] = {1, 0, 1, 0};
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_EQ(frame.truth.object_id[65 + 8 + 16 * i], expected[i]) << i;
    EXPECT_NEAR(frame.truth.z_m[65 + 8 + 16 * i], expected[i] == 1 ? 1.0F : 2.0F, 1e-5F) << i;
  }
}
