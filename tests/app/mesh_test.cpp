// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
// Meshes on the command line: alone, in a scene, made again from a manifest.
#include <gtest/gtest.h>

#include "support/tool.h"

namespace tofray::test {
namespace {

constexpr const char* tent =
    "v -0.5 0 0.4\nv 0.5 0 0.4\nv 0.5 0 -0.4\nv -0.5 0 -0.4\nv -0.5 0.6 0\nv 0.5 0.6 0\nf 1 2 6 5\nf 3 4 5 6\nf 2 3 6\nf 4 1 5\nf 4 3 2 "
    "1\n";

class mesh_file : public testing::Test {
 protected:
  void SetUp() override { write("tent.obj", tent); }
  void write(const std::string& name, const std::string& text) const { std::ofstream(folder_ / name) << text; }
  [[nodiscard]] Result tool(const Arguments& arguments) const { return run(with_small_sensor(arguments), in_folder(folder_.path())); }
  [[nodiscard]] Result as_typed(const Arguments& arguments) const { return run(arguments, in_folder(folder_.path())); }

  Folder folder_;
};

}  // namespace

TEST_F(mesh_file, alone_stands_on_a_floor_and_is_seen_whole) {
  for (const std::string& scale : {std::string("1"), std::string("0.01"), std::string("30")}) {
    const Result made = tool({"render", "tent.obj", "-o", "out" + scale, "--noise", "off", "--set", "objects.0.mesh.scale=" + scale});
    ASSERT_EQ(made.code, 0) << made.err;
    const Result seen = as_typed({"inspect", "out" + scale + "/frame.npz", "--json"});
    ASSERT_EQ(seen.code, 0) << seen.err;
  }
  EXPECT_TRUE(fs::exists(folder_ / "out1/preview.png"));
  ASSERT_EQ(tool({"render", "tent.obj"}).code, 0);
  EXPECT_TRUE(fs::exists(folder_ / "tent/frame.npz"));
}

TEST_F(mesh_file, is_made_again_from_a_manifest_only_if_it_is_the_same) {
  ASSERT_EQ(tool({"render", "tent.obj", "-o", "one"}).code, 0);
  const Result again = as_typed({"render", "--from", "one/manifest.json", "-o", "two"});
  EXPECT_EQ(again.code, 0) << again.err;
  write("tent.obj", std::string(tent) + "# another byte\n");
  const Result other = as_typed({"render", "--from", "one/manifest.json", "-o", "three"});
  EXPECT_EQ(other.code, 2);
  EXPECT_TRUE(has(other.err, "is not the mesh that it was")) << other.err;
  EXPECT_FALSE(fs::exists(folder_ / "three"));
}

TEST_F(mesh_file, of_a_manifest_is_not_any_file) {
  ASSERT_EQ(tool({"render", "tent.obj", "-o", "one"}).code, 0);
  std::string text = content(folder_ / "one/manifest.json");
  const std::size_t at = text.find("\"role\": \"mesh\"");
  ASSERT_NE(at, std::string::npos);
  text.replace(at, 14, "\"role\": \"none\"");
  write("strange.json", text);
  const Result made = as_typed({"render", "--from", "strange.json", "-o", "two"});
  EXPECT_EQ(made.code, 2) << made.err;
  EXPECT_TRUE(has(made.err, "is not the mesh that it was")) << made.err;
}

TEST_F(mesh_file, is_checked_like_a_scene) {
  write("two.yaml", "objects:\n  - mesh: {file: tent.obj, reflectivity: 0.5}\n  - mesh: {file: tent.obj, reflectivity: 0.2}\n");
  for (const std::string& name : {std::string("tent.obj"), std::string("two.yaml")}) {
    const Result checked = as_typed({"check", name});
    EXPECT_EQ(checked.code, 0) << checked.err;
    EXPECT_TRUE(has(checked.out, "good: scene with 2 objects (8 triangles in meshes)")) << checked.out;
    EXPECT_TRUE(has(as_typed({"check", name, "--json"}).out, "\"mesh_triangles\": 8"));
  }
  fs::rename(folder_ / "tent.obj", folder_ / "tent");
  EXPECT_EQ(as_typed({"check", "tent"}).code, 2);
}

TEST_F(mesh_file, that_lost_triangles_says_so) {
  write("holes.obj", std::string(tent) + "v nan 0 0\nf 1 2 7\nf 2 3 7\n");
  const Result made = tool({"render", "holes.obj"});
  EXPECT_EQ(made.code, 0) << made.err;
  EXPECT_TRUE(has(made.err, "warning: 2 of the 10 triangles of \"holes.obj\" are left out")) << made.err;
}

TEST_F(mesh_file, that_cannot_be_read_is_told_at_once) {
  EXPECT_TRUE(has(tool({"render", "chair.glb"}).err, "cannot open"));
  EXPECT_TRUE(has(tool({"render", "none.obj"}).err, "cannot open"));
  write("bad.stl", "solid x\nfacet normal 0 0\n");
  const Result bad = tool({"render", "bad.stl"});
  EXPECT_EQ(bad.code, 2);
  EXPECT_TRUE(has(bad.err, "bad.stl:3")) << bad.err;
  EXPECT_FALSE(fs::exists(folder_ / "bad"));
}

}  // namespace tofray::test
