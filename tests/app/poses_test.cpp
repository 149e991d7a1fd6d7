// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
// Files of poses on the command line: in the manifest, made again from it, elsewhere than the scene; meshes alone in another world.
#include <gtest/gtest.h>

#include "support/tool.h"

namespace tofray::test {
namespace {

constexpr const char* way = "t,x,y,z,qx,qy,qz,qw\n0,0,0,-0.5,0,0,0,1\n1,0.1,0,-0.5,0,0.0871557,0,0.9961947\n";

class pose_file : public testing::Test {
 protected:
  void SetUp() override {
    write("way.csv", way);
    write("scene.yaml",
          "camera: {keyframes: {file: way.csv}}\nobjects:\n  - plane: {point: [0, 0, 1], normal: [0, 0, -1], reflectivity: 0.8}\n");
  }
  void write(const std::string& name, const std::string& text) const { std::ofstream(folder_ / name) << text; }
  [[nodiscard]] Result tool(const Arguments& arguments) const { return run(with_small_sensor(arguments), in_folder(folder_.path())); }
  [[nodiscard]] Result as_typed(const Arguments& arguments) const { return run(arguments, in_folder(folder_.path())); }

  Folder folder_;
};

/// All of a file whose texts are of four bytes a letter, without the zeros.
std::string meta_in(const fs::path& path) {
  std::string text = content(path);
  std::erase(text, '\0');
  return text;
}

}  // namespace

TEST_F(pose_file, is_made_again_from_a_manifest_only_if_it_is_the_same) {
  ASSERT_EQ(tool({"render", "scene.yaml", "-o", "one", "--frames", "2"}).code, 0);
  EXPECT_TRUE(has(content(folder_ / "one/manifest.json"), "\"role\": \"keyframes\",\n      \"name\": \"way.csv\""));
  const Result again = as_typed({"render", "--from", "one/manifest.json", "-o", "two"});
  EXPECT_EQ(again.code, 0) << again.err;
  EXPECT_EQ(content(folder_ / "one/frame_0001.npz"), content(folder_ / "two/frame_0001.npz"));
  write("way.csv", std::string(way) + "\n");
  const Result other = as_typed({"render", "--from", "one/manifest.json", "-o", "three"});
  EXPECT_EQ(other.code, 2);
  EXPECT_TRUE(has(other.err, "does not hold the keyframes that it did")) << other.err;
  EXPECT_FALSE(fs::exists(folder_ / "three"));
}

TEST_F(pose_file, is_written_out_in_meta_which_makes_the_frame_without_it) {
  ASSERT_EQ(tool({"render", "scene.yaml", "-o", "one"}).code, 0);
  const std::string npz = meta_in(folder_ / "one/frame.npz");
  EXPECT_TRUE(has(npz, R"("camera_keyframes":[{"time_s":0.0,"pose":{"position":[0.0,0.0,-0.5],"quaternion":[0.0,0.0,0.0,1.0]}},)"));
  EXPECT_FALSE(has(npz, "world_up")) << "what is as ever is not said";
  ASSERT_EQ(tool({"render", "scene.yaml", "-o", "two", "--set", "world_up=z"}).code, 0);
  EXPECT_TRUE(has(meta_in(folder_ / "two/frame.npz"), R"("world_up":"z")"));
}

TEST_F(pose_file, may_lie_below_a_root) {
  fs::create_directory(folder_ / "in");
  fs::rename(folder_ / "scene.yaml", folder_ / "in/scene.yaml");
  const Arguments render = {"render", "in/scene.yaml", "-o", "one", "--set", "camera.keyframes.file=../way.csv"};
  const Result refused = tool(render);
  EXPECT_EQ(refused.code, 2);
  EXPECT_TRUE(has(refused.err, "leads out of the folder")) << refused.err;
  Arguments rooted = render;
  rooted.insert(rooted.end(), {"--root", "."});
  EXPECT_EQ(tool(rooted).code, 0);
  EXPECT_EQ(as_typed({"render", "--from", "one/manifest.json", "-o", "two", "--root", "."}).code, 0);
}

TEST_F(pose_file, that_is_wrong_ends_check_with_its_line) {
  write("way.csv", std::string(way) + "1,0,0,0,0,0,0,1\n");
  const Result checked = as_typed({"check", "scene.yaml"});
  EXPECT_EQ(checked.code, 2);
  EXPECT_TRUE(has(checked.err + checked.out, "way.csv:4:1: error: the time is not later than that of the line before")) << checked.err;
}

// A mesh alone is seen alike, whatever the world's axes: on its floor, from above.
TEST_F(pose_file, is_not_needed_for_a_mesh_alone_in_a_world_whose_z_is_up) {
  write("tent.obj",
        "v -0.5 0 0.4\nv 0.5 0 0.4\nv 0.5 0 -0.4\nv -0.5 0 -0.4\nv -0.5 0.6 0\nv 0.5 0.6 0\nf 1 2 6 5\nf 3 4 5 6\nf 2 3 6\nf 4 1 5\n");
  ASSERT_EQ(tool({"render", "tent.obj", "-o", "ours", "--noise", "off"}).code, 0);
  for (const char* up : {"z", "y"}) {
    const Result made = tool({"render", "tent.obj", "-o", up, "--noise", "off", "--set", std::string("world_up=") + up});
    ASSERT_EQ(made.code, 0) << made.err;
    const std::string told = as_typed({"diff", "ours", up}).out;
    EXPECT_TRUE(has(told, "  raw                      same")) << told;
    EXPECT_FALSE(has(told, "camera_pose              same")) << told;
  }
}

}  // namespace tofray::test
