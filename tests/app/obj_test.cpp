// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
// OBJ files with materials of their own on the command line: alone, made again from a manifest, and without their files.
#include <gtest/gtest.h>

#include "support/tool.h"

namespace tofray::test {
namespace {

const fs::path crate = fs::path(TOFRAY_SOURCE_DIR) / "examples/crate";

class obj_tool : public testing::Test {
 protected:
  void SetUp() override {
    for (const char* const name : {"crate.obj", "crate.mtl", "crate.png"}) fs::copy_file(crate / name, folder_ / name);
  }
  void write(const std::string& name, const std::string& bytes) const { std::ofstream(folder_ / name, std::ios::binary) << bytes; }
  [[nodiscard]] Result tool(const Arguments& arguments) const { return run(with_small_sensor(arguments), in_folder(folder_.path())); }
  [[nodiscard]] Result as_typed(const Arguments& arguments) const { return run(arguments, in_folder(folder_.path())); }

  Folder folder_;
};

}  // namespace

TEST_F(obj_tool, renders_a_file_alone_with_its_own_materials) {
  const Result made = tool({"render", "crate.obj", "-o", "out", "--noise", "off"});
  ASSERT_EQ(made.code, 0) << made.err;
  EXPECT_TRUE(has(made.err,
                  "warning: 1 material of \"crate.obj\" reflects as much infrared as visible light: a guess from the base colour\n"
                  "  a line #!nir_reflectivity 0.6 below newmtl says it, or materials or reflectivity at the object\n"))
      << made.err;
  EXPECT_TRUE(has(made.err, "warning: \"crate.obj\": of its materials is left out: Ks, Ns\n")) << made.err;
  const Result checked = as_typed({"check", "crate.obj"});
  EXPECT_TRUE(has(checked.out, "good: scene with 3 objects (236 triangles in meshes)")) << checked.out << checked.err;  // and the floor
  const Result own = as_typed({"check", "crate.obj", "--set", "objects.0.mesh.reflectivity=0.4"});
  EXPECT_TRUE(has(own.out, "good: scene with 2 objects (236 triangles in meshes)")) << own.out << own.err;
  EXPECT_FALSE(has(own.err, "warning:")) << own.err;
}

TEST_F(obj_tool, renders_a_file_alone_without_them_where_they_are_not_there) {
  fs::remove(folder_ / "crate.mtl");
  const Result made = tool({"render", "crate.obj", "-o", "out", "--noise", "off"});
  ASSERT_EQ(made.code, 0) << made.err;
  EXPECT_FALSE(has(made.err, "guess")) << made.err;
  EXPECT_TRUE(has(content(folder_ / "out/manifest.json"), "mesh: {file: \\\"crate.obj\\\", reflectivity: 0.5}"));
}

TEST_F(obj_tool, is_made_again_from_a_manifest_only_if_all_its_files_are_the_same) {
  ASSERT_EQ(tool({"render", "crate.obj", "-o", "one"}).code, 0);
  const Result again = as_typed({"render", "--from", "one/manifest.json", "-o", "two"});
  ASSERT_EQ(again.code, 0) << again.err;
  EXPECT_EQ(content(folder_ / "one/frame.npz"), content(folder_ / "two/frame.npz"));
  for (const char* const name : {"crate.mtl", "crate.png"}) {
    const std::string before = content(folder_ / name);
    write(name, before + "\n");
    const Result other = as_typed({"render", "--from", "one/manifest.json", "-o", "three"});
    EXPECT_EQ(other.code, 2);
    EXPECT_TRUE(has(other.err, "is not the mesh that it was")) << name << other.err;
    EXPECT_FALSE(fs::exists(folder_ / "three"));
    write(name, before);
  }
}

TEST_F(obj_tool, says_which_pictures_are_missing_alone_as_in_a_scene) {
  fs::remove(folder_ / "crate.png");
  write("scene.yaml", "objects:\n  - mesh: {file: crate.obj}\n");
  for (const char* const name : {"scene.yaml", "crate.obj"}) {
    const Result missing = as_typed({"check", name});
    EXPECT_EQ(missing.code, 0) << missing.err;
    EXPECT_TRUE(has(missing.err, "warning: \"crate.obj\": cannot be read and is left out: \"crate.png\"; files lie beside")) << missing.err;
  }
  EXPECT_FALSE(has(as_typed({"check", "scene.yaml", "--set", "objects.0.mesh.reflectivity=0.4"}).err, "crate.png"));
}

TEST_F(obj_tool, has_an_example_that_its_program_writes) {
  if (std::system("python3 -c ''") != 0) GTEST_SKIP() << "no python3";  // NOLINT(concurrency-mt-unsafe)
  const std::string command = "cd '" + (folder_ / "").string() + "' && python3 '" + (crate / "make_crate.py").string() + "'";
  ASSERT_EQ(std::system(command.c_str()), 0);  // NOLINT(concurrency-mt-unsafe)
  for (const char* const name : {"crate.obj", "crate.mtl"}) EXPECT_EQ(content(folder_ / name), content(crate / name)) << name;
}

}  // namespace tofray::test
