// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
// glTF files on the command line: alone, in a scene, made again from a manifest, and broken.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "gltf/gltf_files.h"
#include "support/tool.h"

namespace tofray::test {
namespace {

using gltf_test::File;

/// Two square metres upright beside each other, of two materials.
File screens() {
  File file;
  const int corners = file.floats({0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0}, "VEC3");
  const int indices = file.accessor<std::uint16_t>({0, 1, 2, 0, 2, 3}, "SCALAR");
  file.add("materials", {{"name", "paint"},
                         {"pbrMetallicRoughness", {{"baseColorFactor", {0.5, 0.5, 0.5, 1}}}},
                         {"extensions", {{"KHR_materials_unlit", gltf_test::Document::object()}}}});
  file.add("materials", {{"name", "cloth"}, {"extras", {{"nir_reflectivity", 0.25}}}});
  for (int i = 0; i < 2; ++i) {
    file.primitive(file.mesh({{"POSITION", corners}}, indices))["material"] = i;
    file.node({{"mesh", i}, {"translation", {i, 0, 0}}});
  }
  return file;
}

class gltf_tool : public testing::Test {
 protected:
  void SetUp() override { write("screens.glb", screens().glb()); }
  void write(const std::string& name, const std::string& bytes) const { std::ofstream(folder_ / name, std::ios::binary) << bytes; }
  [[nodiscard]] Result tool(const Arguments& arguments) const { return run(with_small_sensor(arguments), in_folder(folder_.path())); }
  [[nodiscard]] Result as_typed(const Arguments& arguments) const { return run(arguments, in_folder(folder_.path())); }

  Folder folder_;
};

std::size_t count(const std::string& text, const std::string& part) {
  std::size_t times = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++times;
  return times;
}

}  // namespace

TEST_F(gltf_tool, renders_a_file_alone) {
  const Result made = tool({"render", "screens.glb", "-o", "out", "--noise", "off"});
  ASSERT_EQ(made.code, 0) << made.err;
  EXPECT_TRUE(has(made.err, "warning: 1 material of \"screens.glb\" reflects as much infrared as visible light")) << made.err;
  EXPECT_EQ(count(made.err, "warning:"), 1U) << made.err;
  const Result checked = as_typed({"check", "screens.glb"});
  EXPECT_EQ(checked.code, 0) << checked.err;
  EXPECT_TRUE(has(checked.out, "good: scene with 3 objects (4 triangles in meshes)")) << checked.out;  // and the floor
  const Result own = as_typed({"check", "screens.glb", "--set", "objects.0.mesh.reflectivity=0.4"});
  EXPECT_TRUE(has(own.out, "good: scene with 2 objects (4 triangles in meshes)")) << own.out << own.err;
  EXPECT_EQ(count(own.err, "warning:"), 0U) << own.err;
}

TEST_F(gltf_tool, names_the_material_that_a_pixel_sees) {
  write("scene.yaml", "objects:\n  - mesh: {file: screens.glb, name: wall, position: [-1, 0.5, 2], scale: 2}\n");
  ASSERT_EQ(tool({"render", "scene.yaml", "-o", "out", "--noise", "off"}).code, 0);
  const Result left = as_typed({"inspect", "out/frame.npz", "--pixel", "8,8"});
  EXPECT_TRUE(has(left.out, "(wall/paint), reflectivity 0.5")) << left.out << left.err;
}

TEST_F(gltf_tool, takes_a_scene_s_material_by_its_name_without_a_warning) {
  write("scene.yaml", "objects:\n  - mesh: {file: screens.glb, name: wall, position: [-1, 0.5, 2], scale: 2, materials: {paint: wood}}\n");
  const Result made = tool({"render", "scene.yaml", "-o", "out", "--noise", "off"});
  ASSERT_EQ(made.code, 0) << made.err;
  EXPECT_EQ(count(made.err, "warning:"), 0U) << made.err;
  const Result seen = as_typed({"inspect", "out/frame.npz", "--pixel", "8,8"});
  EXPECT_TRUE(has(seen.out, "(wall/paint), reflectivity 0.634")) << seen.out << seen.err;
  const Result again = as_typed({"render", "--from", "out/manifest.json", "-o", "two"});
  ASSERT_EQ(again.code, 0) << again.err;
  EXPECT_EQ(content(folder_ / "out/frame.npz"), content(folder_ / "two/frame.npz"));
  const Result set = as_typed({"check", "screens.glb", "--set", "objects.0.mesh.materials.paint=skin"});
  EXPECT_EQ(count(set.err, "warning:"), 0U) << set.err;
  EXPECT_TRUE(has(set.out, "good: scene with 3 objects")) << set.out << set.err;
}

// The camera stands 15 km from a square of 100 m and looks at it: six digits of place and look_at would look 0.95 degrees past it.
TEST_F(gltf_tool, looks_from_far_away_where_the_file_looks) {
  File seen;
  seen.mesh({{"POSITION", seen.floats({-50, -50, 0, 50, -50, 0, 50, 50, 0}, "VEC3")}});
  seen.node({{"mesh", 0}, {"translation", {10000.123, 0.25, 0}}});
  seen.add("cameras", {{"type", "perspective"}, {"perspective", {{"yfov", 1}, {"znear", 0.1}}}});
  // A turn about y by a, so that −z looks along (−sin a, 0, −cos a): from (15000.123 + …) back to the middle.
  const double dx = 15000, dz = 0.5, turn = std::atan2(dx, dz);
  seen.node({{"camera", 0}, {"translation", {10000.123 + dx, 0.25, dz}}, {"rotation", {0, std::sin(turn / 2), 0, std::cos(turn / 2)}}});
  write("far.glb", seen.glb());
  const Result made = tool({"render", "far.glb", "-o", "out", "--noise", "off", "--emit", "npz"});
  ASSERT_EQ(made.code, 0) << made.err;
  const std::vector<double> pose = numbers_of(folder_ / "out" / "frame.npz", "camera_pose");  // columns: right, down, forward, place
  const double size = std::hypot(dx, dz);
  EXPECT_NEAR(pose[2], -dx / size, 1e-9);
  EXPECT_NEAR(pose[6], 0, 1e-9);
  EXPECT_NEAR(pose[10], dz / size, 1e-9);  // the file's z is the world's −z
  EXPECT_NEAR(pose[3], 25000.123, 1e-6);
}

TEST_F(gltf_tool, looks_from_the_files_own_camera) {
  File seen = screens();
  seen.add("cameras", {{"type", "perspective"}, {"perspective", {{"yfov", 1}, {"znear", 0.1}}}});
  seen.node({{"camera", 0}, {"translation", {1, 0.5, 2}}});
  write("seen.glb", seen.glb());
  ASSERT_EQ(tool({"render", "seen.glb", "-o", "out", "--noise", "off"}).code, 0);
  const std::string manifest = content(folder_ / "out/manifest.json");
  EXPECT_TRUE(has(manifest, "position: [1, -0.5, -2], look_at: [1, -0.5, -1], up: [0, -1, 0]")) << manifest;
  EXPECT_FALSE(has(manifest, "plane")) << manifest;  // its own floor, if it has one, is the only one
}

TEST_F(gltf_tool, is_made_again_from_a_manifest_only_if_all_its_files_are_the_same) {
  const File file = screens();
  write("screens.gltf", file.text_beside("screens.bin")), write("screens.bin", file.binary);
  ASSERT_EQ(tool({"render", "screens.gltf", "-o", "one"}).code, 0);
  const Result again = as_typed({"render", "--from", "one/manifest.json", "-o", "two"});
  ASSERT_EQ(again.code, 0) << again.err;
  EXPECT_EQ(content(folder_ / "one/frame.npz"), content(folder_ / "two/frame.npz"));
  std::string changed = file.binary;
  changed[12] = '\x01';
  write("screens.bin", changed);
  const Result other = as_typed({"render", "--from", "one/manifest.json", "-o", "three"});
  EXPECT_EQ(other.code, 2);
  EXPECT_TRUE(has(other.err, "is not the mesh that it was")) << other.err;
  EXPECT_FALSE(fs::exists(folder_ / "three"));
}

TEST_F(gltf_tool, says_what_is_left_out_in_at_most_six_lines) {
  File file = screens();
  for (int i = 0; i < 9; ++i) file.json["extensionsUsed"].push_back("X_other_" + std::to_string(i));
  write("many.glb", file.glb());
  write("scene.yaml", "objects:\n  - mesh: {file: many.glb, reflectivity: 0.5}\n  - mesh: {file: many.glb, reflectivity: 0.2}\n");
  const Result made = tool({"render", "scene.yaml"});
  ASSERT_EQ(made.code, 0) << made.err;
  EXPECT_EQ(count(made.err, "warning: \"many.glb\": "), 6U) << made.err;
  EXPECT_EQ(count(made.err, "warning: \"many.glb\": and 4 more\n"), 1U) << made.err;
}

TEST_F(gltf_tool, counts_triangles_that_are_left_out_over_all_materials) {
  File file = screens();
  const float nan = std::numeric_limits<float>::quiet_NaN();
  const int corners = file.floats({nan, 0, 0, 1, 0, 0, 1, 1, 0, 0, 0, 0, 1, 0, 0, 0, 1, 0}, "VEC3");
  file.primitive(1)["attributes"]["POSITION"] = corners;
  file.primitive(1).erase("indices");
  write("holes.glb", file.glb());
  const Result made = tool({"render", "holes.glb"});
  EXPECT_EQ(made.code, 0) << made.err;
  EXPECT_TRUE(has(made.err, "warning: 1 of the 4 triangles of \"holes.glb\" are left out")) << made.err;
}

TEST_F(gltf_tool, tells_what_is_wrong_with_a_file) {
  write("cut.glb", screens().glb().substr(0, 300));
  const Result cut = tool({"render", "cut.glb"});
  EXPECT_EQ(cut.code, 2);
  EXPECT_TRUE(has(cut.err, "cut.glb: error: ")) << cut.err;
  EXPECT_FALSE(fs::exists(folder_ / "cut"));
  fs::rename(folder_ / "screens.glb", folder_ / "screens");
  const Result other = as_typed({"check", "screens"});
  EXPECT_EQ(other.code, 2);
  EXPECT_TRUE(has(other.err, "a binary glTF file, not a scene")) << other.err;
}

}  // namespace tofray::test
