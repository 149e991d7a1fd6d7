// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
// Mistakes in scenes that newcomers make: `check` names each, and so does `render`, in words that they would look for.
#include <gtest/gtest.h>

#include "files/json.h"
#include "rows.h"
#include "support/tool.h"

namespace tofray::test {
namespace {

constexpr const char* wall = "  - plane: {name: wall, point: [0, 0, 2], normal: [0, 0, -1], reflectivity: 0.8}\n";
constexpr const char* ball = "  - sphere: {name: ball, center: [0.1, 0, 1.3], radius: 25 cm, reflectivity: 0.5}\n";

/// An OBJ file of a cube about zero, its faces outward.
std::string cube(double size) {
  std::string text;
  for (const double x : {-0.5, 0.5})
    for (const double y : {-0.5, 0.5})
      for (const double z : {-0.5, 0.5})
        text += "v " + std::to_string(size * x) + " " + std::to_string(size * y) + " " + std::to_string(size * z) + "\n";
  return text + "f 1 2 4 3\nf 5 7 8 6\nf 1 5 6 2\nf 3 4 8 7\nf 1 3 7 5\nf 2 6 8 4\n";
}

class newcomer : public testing::Test {
 protected:
  [[nodiscard]] Result tool(const Arguments& arguments) const { return run(arguments, in_folder(folder_.path())); }
  void save(const std::string& name, const std::string& text) const { write(folder_ / name, text); }
  /// What both commands say of a file, or of a scene of these objects.
  void expect_told(const std::string& file, const std::string& words, const std::string& more) const {
    for (const Arguments& command : {Arguments{"check", file}, Arguments{"render", file, "-o", "out", "--emit", "npz"}}) {
      const Result result = tool(command);
      EXPECT_EQ(result.code, 0) << result.err;
      EXPECT_TRUE(has(result.err, "warning: ")) << command[0] << result.err;
      EXPECT_TRUE(has(result.err, words)) << command[0] << ": " << result.err;
      EXPECT_TRUE(has(result.err, more)) << command[0] << ": " << result.err;
    }
  }
  void expect_told_of_scene(const std::string& text, const std::string& words, const std::string& more) const {
    save("scene.yaml", text);
    expect_told("scene.yaml", words, more);
  }
  void expect_silence(const std::string& text) const {
    save("scene.yaml", text);
    for (const Arguments& command : {Arguments{"check", "scene.yaml"}, Arguments{"render", "scene.yaml", "-o", "out", "--emit", "npz"}}) {
      const Result result = tool(command);
      EXPECT_EQ(result.code, 0) << result.err;
      EXPECT_FALSE(has(result.err, "warning")) << result.err;
    }
  }

  Folder folder_;
};

}  // namespace

TEST_F(newcomer, writes_a_scene_in_millimetres) {
  expect_told_of_scene("objects:\n  - box: {min: [-200, -200, 1000], max: [200, 200, 1400], reflectivity: 0.5}\n",
                       "scene.yaml:2:5: warning: the nearest object is 1000 m away", "are these millimetres? Then this would be 1.00 m");
  // The ball itself has a unit, and no ray meets it.
  expect_told_of_scene("objects:\n  - sphere: {center: [500, 0, 1300], radius: 250 mm, reflectivity: 0.5}\n", "is 1393 m away",
                       "are these millimetres?");
}

TEST_F(newcomer, has_a_mesh_in_millimetres) {
  save("cube.obj", cube(400));
  expect_told_of_scene("objects:\n  - mesh: {file: cube.obj, position: [0, 0, 1.5], reflectivity: 0.5}\n",
                       "scene.yaml:2:5: warning: objects.0 (cube.obj) measures 400 x 400 x 400 m",
                       "is its file in millimetres? Then say scale: 0.001");
  expect_told("cube.obj", "cube.obj: warning: it measures 400 x 400 x 400 m", "--set objects.0.mesh.scale=0.001");
}

TEST_F(newcomer, scales_a_mesh_twice) {
  save("cube.obj", cube(0.4));
  expect_told_of_scene(
      "objects:\n" + std::string(wall) + "  - mesh: {file: cube.obj, scale: 0.001, position: [0, 0, 1], reflectivity: 0.5}\n",
      "objects.1 (cube.obj) measures 0.40 x 0.40 x 0.40 mm", "Then take scale: 0.001 out of its mesh");
}

TEST_F(newcomer, writes_lengths_without_a_unit) {
  for (const char* shape :
       {"sphere: {center: [0, 0, 1], radius: 25", "disk: {center: [0, 0, 1], normal: [0, 0, 1], radius: 25",
        "capsule: {start: [0, 0, 1], end: [0, 0, 2], radius: 25", "cone: {base: [0, 0, 1], axis: [0, 1, 0], height: 1 m, radius: 25",
        "cylinder: {center: [0, 0, 1], axis: [0, 1, 0], height: 1 m, radius: 25"}) {
    save("scene.yaml", "objects:\n  - " + std::string(shape) + ", reflectivity: 0.5}\n");
    const Result result = tool({"check", "scene.yaml"});
    EXPECT_EQ(result.code, 2);
    EXPECT_TRUE(has(result.err, "error: radius has no unit\n  got \"25\", expected a length such as ")) << result.err;
  }
  for (const char* shape : {"cone: {base: [0, 0, 1], axis: [0, 1, 0], radius: 1 m, height: 30",
                            "cylinder: {center: [0, 0, 1], axis: [0, 1, 0], radius: 1 m, height: 30"}) {
    save("scene.yaml", "objects:\n  - " + std::string(shape) + ", reflectivity: 0.5}\n");
    EXPECT_TRUE(has(tool({"check", "scene.yaml"}).err, "error: height has no unit\n  got \"30\"")) << shape;
  }
  // Coordinates and extents in lists are metres.
  expect_silence("objects:\n  - rectangle: {center: [0, 0, 1.5], size: [0.4, 0.4], reflectivity: 0.5}\n");
}

TEST_F(newcomer, has_all_behind_the_camera) {
  expect_told_of_scene("objects:\n  - sphere: {name: ball, center: [0, 0, -2], radius: 25 cm, reflectivity: 0.5}\n",
                       "scene.yaml:2:5: warning: objects.0 (ball) is behind the camera", "camera.pose.look_at: [0, 0, -2] looks at it");
}

TEST_F(newcomer, turns_the_camera_away) {
  expect_told_of_scene("camera: {pose: {position: [0, 0, 0], look_at: [0, 0, -1]}}\nobjects:\n" + std::string(wall) + ball,
                       "objects.1 (ball) is behind the camera, whose rays hit nothing",
                       "the camera stands at [0, 0, 0] and looks along [0, 0, -1]");
  expect_told_of_scene("camera: {pose: {position: [0, 0, 0], look_at: [1, 0, 0]}}\nobjects:\n" + std::string(ball),
                       "no ray of the camera hits an object: it looks past objects.0 (ball)", "86 deg off its axis");
  expect_told_of_scene(
      "camera: {pose: {position: [0, 0, 0], look_at: [1, 0.2, 0]}}\nobjects:\n"
      "  - plane: {name: floor, point: [0, 1, 0], normal: [0, -1, 0], reflectivity: 0.8}\n" +
          std::string(ball),
      "the camera sees planes alone: objects.1 (ball) is out of view", "looks at it");
}

TEST_F(newcomer, puts_the_camera_into_a_mesh) {
  save("cube.obj", cube(0.4));
  expect_told_of_scene("objects:\n  - mesh: {file: cube.obj, reflectivity: 0.5}\n" + std::string(wall),
                       "the camera stands inside objects.0 (cube.obj)", "it sees the inner side, and nothing beyond");
}

TEST_F(newcomer, puts_the_camera_into_a_ball_that_hides_the_rest) {
  expect_told_of_scene(
      "objects:\n  - sphere: {center: [0, 0, 0.1], radius: 2 m, reflectivity: 0.5}\n"
      "  - sphere: {center: [0, 0, 4], radius: 25 cm, reflectivity: 0.5}\n",
      "the camera stands inside objects.0 (sphere)", "none of the other objects is in view");
  // A room has walls, too.
  expect_silence("objects:\n  - box: {name: room, min: [-2, -1.5, -1], max: [2, 1, 3], reflectivity: 0.5}\n" + std::string(ball));
}

TEST_F(newcomer, takes_y_for_up) {
  expect_told_of_scene("objects:\n  - plane: {point: [0, -0.5, 0], normal: [0, 1, 0], reflectivity: 0.5}\n" + std::string(ball),
                       "scene.yaml:2:5: warning: objects.0 (plane) is level and 0.50 m above the camera: a ceiling, not a floor",
                       "y points down");
  expect_told_of_scene("objects:\n" + std::string(wall) +
                           "  - rectangle: {name: the floor, center: [0, -1, 1], size: [2, 2], rotation: {axis: [1, 0, 0], "
                           "angle: 90 deg}, reflectivity: 0.5}\n",
                       "objects.1 (the floor) is level and 1.00 m above the camera", "y points down");
  expect_silence("objects:\n  - plane: {name: ceiling, point: [0, -0.5, 0], normal: [0, 1, 0], reflectivity: 0.5}\n" + std::string(ball));
  expect_silence("objects:\n  - plane: {point: [0, 0.5, 0], normal: [0, 1, 0], reflectivity: 0.5}\n" + std::string(ball));
  expect_silence(
      "camera: {pose: {position: [0, 0, 0], look_at: [0, 0, 1], up: [0, 1, 0]}}\nobjects:\n"
      "  - plane: {point: [0, -0.5, 0], normal: [0, 1, 0], reflectivity: 0.5}\n" +
      std::string(ball));
}

TEST_F(newcomer, puts_two_bodies_into_one_place) {
  expect_told_of_scene("objects:\n" + std::string(wall) + ball + ball,
                       "scene.yaml:4:5: warning: objects.2 (ball) is in the same place as objects.1 (ball)", "only one of the two is seen");
  expect_told_of_scene(
      "objects:\n" + std::string(wall) + ball + "  - sphere: {name: core, center: [0.1, 0, 1.3], radius: 20 cm, reflectivity: 0.5}\n",
      "objects.2 (core) is hidden inside objects.1 (ball)", "no light reaches it");
  // Bars of a cross have one box.
  const std::string bar = "  - rectangle: {center: [0, 0, 1], size: [0.5, 0.1], reflectivity: 0.5, rotation: {axis: [0, 0, 1], angle: ";
  expect_silence("objects:\n" + bar + "45 deg}}\n" + bar + "-45 deg}}\n");
}

TEST_F(newcomer, puts_a_wall_beyond_the_ambiguity_range) {
  expect_told_of_scene("objects:\n  - plane: {name: wall, point: [0, 0, 9], normal: [0, 0, -1], reflectivity: 0.8}\n",
                       "objects.0 (wall) is beyond the ambiguity range of 7.465 m: the nearest of it is 9.00 m away",
                       "too small by 7.465 m");
  const Result render = tool({"render", "scene.yaml", "-o", "out", "--emit", "npz"});
  EXPECT_TRUE(has(render.err, "% beyond reach: surfaces farther than the ambiguity range of 7.465 m")) << render.err;
  // The far end of a floor is no mistake.
  expect_silence("objects:\n  - plane: {name: floor, point: [0, 1, 0], normal: [0, -1, 0], reflectivity: 0.8}\n" + std::string(ball));
}

TEST_F(newcomer, loses_the_materials_of_a_mesh) {
  save("lost.obj", "mtllib lost.mtl\nusemtl a\n" + cube(0.4));
  expect_told("lost.obj", "lost.obj: warning: its file of materials (mtllib) cannot be read: \"lost.mtl\"",
              "--set objects.0.mesh.reflectivity=0.3");
  save("lost.mtl", "newmtl a\nKd 0.5 0.5 0.5\n");
  EXPECT_FALSE(has(tool({"check", "lost.obj"}).err, "mtllib"));
}

TEST_F(newcomer, switches_the_light_off) {
  expect_told_of_scene("camera: {illumination.0.power: 0 W}\nobjects:\n" + std::string(wall), "the camera's light sources have no power",
                       "no light comes back: what depth there is, is noise");
  const Result render = tool({"render", "scene.yaml", "-o", "out", "--emit", "npz"});
  EXPECT_FALSE(has(render.err, "every depth")) << render.err;
  EXPECT_TRUE(has(render.err, "% dark: the camera has no light")) << render.err;
  EXPECT_FALSE(has(render.err, "more light")) << render.err;
  EXPECT_FALSE(has(render.err, "whole cycles off")) << "of what is noise alone";
}

TEST_F(newcomer, renders_an_empty_scene) {
  expect_told_of_scene("objects: []\n", "the scene has no objects", "what depth there is, is noise");
  const Result render = tool({"render", "scene.yaml", "-o", "out", "--emit", "npz"});
  EXPECT_TRUE(has(render.err, "100 % no surface: the rays of these pixels hit nothing: more light does not help")) << render.err;
  EXPECT_FALSE(has(render.err, "longer integration time")) << render.err;
}

// 80 and 61.7 MHz: their cycles come close again and again.
TEST_F(newcomer, takes_modulation_frequencies_whose_cycles_are_taken_for_each_other) {
  save("own.yaml", content(fs::path(TOFRAY_SOURCE_DIR) / "profiles/custom.yaml"));
  save("scene.yaml",
       "camera: {profile: own.yaml, mode: TWO_FREQUENCIES}\nobjects:\n  - plane: {point: [0, 0, 1], normal: [0, 0, -1], reflectivity: "
       "0.8}\n");
  const std::string key = "camera.modes.TWO_FREQUENCIES.sequence.1.modulation_frequency=";
  const Result wrong = tool({"render", "scene.yaml", "-o", "out", "--emit", "npz", "--set", key + "61.7 MHz"});
  EXPECT_EQ(wrong.code, 0) << wrong.err;
  EXPECT_TRUE(has(wrong.err, " % wrong cycle: noise moves these by whole cycles, of 2.429 m and 1.874 m")) << wrong.err;
  EXPECT_FALSE(has(wrong.err, "glancing")) << wrong.err;
  EXPECT_FALSE(has(tool({"render", "scene.yaml", "-o", "out", "--emit", "npz", "--set", key + "60 MHz"}).err, "wrong cycle"));
}

// A wall that is seen at a glancing angle is off by no cycle.
TEST_F(newcomer, sees_a_wall_at_a_glancing_angle) {
  save("scene.yaml", "objects:\n  - plane: {point: [0, 0.01, 0], normal: [0, -1, 0.01], reflectivity: 0.8}\n");
  const Result render =
      tool({"render", "scene.yaml", "-o", "out", "--emit", "npz", "--noise", "off", "--set", "camera.decoding.noise_threshold=100 m"});
  EXPECT_FALSE(has(render.err, "wrong cycle")) << render.err;
}

TEST_F(newcomer, reads_all_of_it_in_json) {
  save("scene.yaml", "objects:\n" + std::string(wall) + ball + ball + "  - box: {min: [-3, -3, -3], max: [3, 3, 3], reflectivity: 0.5}\n");
  for (const Arguments& command :
       {Arguments{"check", "scene.yaml", "--json"}, Arguments{"render", "scene.yaml", "-o", "out", "--emit", "npz", "--json"}}) {
    const Result result = tool(command);
    const files::Json json = files::parse_json(result.out, "stdout");
    ASSERT_EQ(json.find("warnings")->items()->size(), 1U) << result.out;
    const std::string& warning = *json.find("warnings")->items()->at(0).string();
    EXPECT_TRUE(has(warning, "scene.yaml:4:5: objects.2 (ball) is in the same place as objects.1 (ball), and the same\nonly one of"))
        << warning;
    ASSERT_NE(json.find("notes"), nullptr);
  }
  const files::Json checked = files::parse_json(tool({"check", "scene.yaml", "--json"}).out, "stdout");
  ASSERT_EQ(checked.find("notes")->items()->size(), 1U);
  EXPECT_TRUE(has(*checked.find("notes")->items()->at(0).string(), "the camera stands inside objects.3 (box)"));
  const files::Json& report = *checked.find("scene_report");
  EXPECT_EQ(number(report, "share_without_surface"), 0);
  const files::Json::Array& objects = *report.find("objects")->items();
  ASSERT_EQ(objects.size(), 4U);
  EXPECT_EQ(*objects[1].find("name")->string(), "objects.1 (ball)");
  EXPECT_EQ(number(objects[2], "share_of_pixels"), 0);
  EXPECT_TRUE(objects[2].find("nearest_m")->is_null());
  save("scene.yaml", "objects: []\n");
  const files::Json empty = files::parse_json(tool({"render", "scene.yaml", "-o", "out", "--emit", "npz", "--json"}).out, "stdout");
  const files::Json& invalid = *empty.find("invalid_pixels");
  EXPECT_EQ(number(invalid, "no_surface"), number(empty, "pixels") - number(empty, "valid_pixels"));
  EXPECT_EQ(number(invalid, "dark"), 0);
}

TEST_F(newcomer, reads_what_the_camera_sees_of_each_object) {
  save("scene.yaml", "objects:\n" + std::string(wall) + ball);
  const Result result = tool({"check", "scene.yaml"});
  EXPECT_TRUE(has(result.out, "nothing hit by          none of the rays\n")) << result.out;
  EXPECT_TRUE(has(result.out, "  surfaces                from 1.0")) << result.out;
  EXPECT_TRUE(has(result.out, "objects.0 (wall)")) << result.out;
  EXPECT_TRUE(has(result.out, "endless\n")) << result.out;
  EXPECT_TRUE(has(result.out, "0.50 x 0.50 x 0.50 m\n")) << result.out;
}

TEST_F(newcomer, gets_no_warning_for_a_built_in_scene) {
  for (const fs::directory_entry& file : fs::directory_iterator(fs::path(TOFRAY_SOURCE_DIR) / "scenes")) {
    const Result result = tool({"check", file.path().stem().string()});
    EXPECT_EQ(result.code, 0) << result.err;
    EXPECT_FALSE(has(result.err, "warning")) << file.path() << result.err;
  }
}

TEST_F(newcomer, is_told_of_frames_that_an_earlier_run_left) {
  const Arguments five = {"render", "card", "-o", "out", "--frames", "5", "-q", "--arrays", "z_m"};
  const auto frames = [&](const char* count, const char* first, const Arguments& more = {}) {
    Arguments all = {"render", "card", "-o", "out", "--frames", count, "--first-frame", first, "-q", "--arrays", "z_m"};
    all.insert(all.end(), more.begin(), more.end());
    return tool(all);
  };
  EXPECT_EQ(tool(five).err, "");
  EXPECT_EQ(tool(five).err, "") << "the same files again";
  const std::string words = "warning: 3 files of an earlier run lie in out: frame_0002.npz, frame_0003.npz and frame_0004.npz";
  EXPECT_TRUE(has(frames("2", "0").err, words));
  // The manifest of that run remembers them.
  EXPECT_TRUE(has(frames("2", "0").err, words));
  write(folder_ / "out/mine.npz", "mine");
  write(folder_ / "out/frame_0003.npz", "changed");
  const Result cleaned = frames("2", "0", {"--clean"});
  EXPECT_TRUE(has(cleaned.err, "note: 2 files of an earlier run removed from out: frame_0002.npz and frame_0004.npz")) << cleaned.err;
  EXPECT_TRUE(has(cleaned.err, "warning: 1 file of an earlier run stays in out: frame_0003.npz")) << cleaned.err;
  EXPECT_FALSE(fs::exists(folder_ / "out/frame_0002.npz"));
  EXPECT_TRUE(fs::exists(folder_ / "out/frame_0001.npz"));
  EXPECT_EQ(content(folder_ / "out/mine.npz"), "mine");
  EXPECT_EQ(content(folder_ / "out/frame_0003.npz"), "changed");
}

// Parts of one run are no leftovers, of another seed they are.
TEST_F(newcomer, renders_a_run_in_parts) {
  const auto part = [&](const char* first, const char* seed) {
    return tool({"render", "card", "-o", "out", "--frames", "2", "--first-frame", first, "--seed", seed, "-q", "--arrays", "z_m"}).err;
  };
  EXPECT_EQ(part("0", "1"), "");
  EXPECT_EQ(part("2", "1"), "");
  EXPECT_EQ(part("4", "1"), "");
  EXPECT_TRUE(has(part("6", "2"), "6 files of an earlier run lie in out"));
}

// A manifest may come from anybody: no file outside the folder goes, and no folder.
TEST_F(newcomer, cleans_no_more_than_plain_files_of_the_folder) {
  ASSERT_EQ(tool({"render", "card", "-o", "out", "-q", "--emit", "npz", "--arrays", "z_m"}).code, 0);
  std::string manifest = content(folder_ / "out/manifest.json");
  write(folder_ / "precious", "12345");
  fs::create_directory(folder_ / "out/folder");
  fs::create_symlink(folder_ / "precious", folder_ / "out/link");
  const std::string sha = ", \"bytes\": 5, \"sha256\": \"00\"}, ";
  const std::size_t files = manifest.find("\"files\": [");
  ASSERT_NE(files, std::string::npos);
  manifest.insert(files + 10, "{\"name\": \"../precious\"" + sha + "{\"name\": \"" + (folder_ / "precious").string() + "\"" + sha +
                                  "{\"name\": \"folder\"" + sha + "{\"name\": \"link\"" + sha + "{\"name\": \"manifest.json\"" + sha +
                                  "{\"name\": \"..\"" + sha);
  write(folder_ / "out/manifest.json", manifest);
  const Result result = tool({"render", "card", "-o", "out", "-q", "--emit", "npz", "--arrays", "z_m", "--clean"});
  EXPECT_EQ(result.code, 0) << result.err;
  EXPECT_EQ(result.err, "");
  EXPECT_EQ(content(folder_ / "precious"), "12345");
  EXPECT_TRUE(fs::exists(folder_ / "out/folder"));
  EXPECT_TRUE(fs::is_symlink(folder_ / "out/link"));
}

}  // namespace tofray::test
