// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "load/builtin.h"
#include "support/tool.h"

namespace tofray::test {
namespace {

/// A folder with what a run leaves, a profile and a folder of numbered frames.
const Folder& files() {
  static const Folder folder;
  static const bool made = [] {
    std::ofstream(folder / "mycam.yaml") << load::find_builtin(load::builtin_profiles(), "pico-flexx")->text;
    fs::create_directory(folder / "empty");
    const Prepare here = in_folder(folder.path());
    return run(with_small_sensor({"render", "card", "-o", "out"}), here).code == 0 &&
           run(with_small_sensor({"render", "card", "-o", "many", "--frames", "3"}), here).code == 0;
  }();
  EXPECT_TRUE(made);
  return folder;
}

struct Other {
  Arguments arguments;
  int code;
  std::vector<std::string> says;
};

class other_file : public testing::TestWithParam<Other> {};

TEST_P(other_file, is_called_what_it_is_and_the_fitting_command_is_named) {
  const Result result = run(GetParam().arguments, in_folder(files().path()));
  EXPECT_EQ(result.code, GetParam().code) << result.err;
  EXPECT_EQ(result.out, "");
  for (const std::string& part : GetParam().says) EXPECT_TRUE(has(result.err, part)) << part << " in " << result.err;
}

INSTANTIATE_TEST_SUITE_P(
    all, other_file,
    testing::Values(
        Other{{"render", "mycam.yaml"}, 2, {"this is a camera profile", "camera: {profile: mycam.yaml}", "tofray check mycam.yaml"}},
        Other{{"inspect", "mycam.yaml"}, 2, {"this is a camera profile"}},
        Other{{"render", "out/frame.npz"}, 2, {"archive of arrays", "tofray inspect out/frame.npz", "tofray process out/frame.npz"}},
        Other{{"check", "out/frame.npz"}, 2, {"archive of arrays"}}, Other{{"bench", "out/frame.npz"}, 2, {"archive of arrays"}},
        Other{{"render", "out/preview.png"}, 2, {"a picture"}},
        Other{{"inspect", "out/cloud.ply"}, 2, {"no faces", "a cloud of points has no surface"}},
        Other{{"render", "out/manifest.json"}, 2, {"a manifest", "tofray render --from out/manifest.json"}},
        Other{{"render", "out"}, 3, {"this is a folder", "no .yaml file"}},
        Other{{"check", "."}, 3, {"this is a folder", "it holds mycam.yaml"}},
        Other{{"inspect", "many"},
              2,
              {"folder without frame.npz", "frame_0000.npz … frame_0002.npz (3 files)", "tofray inspect many/frame_0000.npz"}},
        Other{{"inspect", "empty"}, 2, {"no .npz"}}));

TEST(other_mesh, is_called_what_it_is_with_what_is_read_and_the_way_there) {
  using namespace std::string_literals;
  constexpr const char* collada = "<?xml version=\"1.0\"?>\n<COLLADA xmlns=\"x\">\n</COLLADA>\n";
  const std::string utf16 = "\xFF\xFEo\0b\0j\0e\0c\0t\0s\0:\0 \0[\0]\0"s, without_mark = "\0v\0 \0\x30\0 \0\x30\0 \0\x30\0\n\0#"s;
  struct Case {
    const char* name;
    std::string bytes;
    const char* what;
    const char* way;
  };
  const Case cases[] = {{"a.dae", collada, "a Collada file", "Blender"},
                        {"A.FBX", "Kaydara FBX Binary  \0"s, "an FBX file", "Blender"},
                        {"a.off", "OFF\n3 1 0\n", "an OFF file", "MeshLab"},
                        {"a.3ds", "MM\x06\0\0\0"s, "a 3DS file", "MeshLab"},
                        {"a.blend", "BLENDER-v300", "a file of Blender's", "glTF"},
                        {"a.usdz", "PK\x03\x04", "a USD file", "Blender"},
                        {"a.stp", "ISO-10303-21;\n", "a STEP file", "FreeCAD"},
                        {"a.iges", "S      1\n", "an IGES file", "FreeCAD"},
                        {"a.3dm", "3D Geometry File Format", "a file of Rhino's", "OBJ"},
                        {"a.pcd", "# .PCD v0.7", "a cloud of points", "no surface"},
                        {"a.obj.gz", "\x1F\x8B\x08", "a compressed file", "unpack"},
                        {"a.yaml", collada, "a Collada file", "Blender"},
                        {"b.yaml", "\xFF\xD8\xFF\xE0", "a picture (JPEG)", "map_Kd"},
                        {"c.yaml", utf16, "text in UTF-16", "iconv -f UTF-16 -t UTF-8"},
                        {"d.txt", "# made by hand\nv 0 0 0\n", "an OBJ file", ".obj"},
                        {"e.txt", "solid part\n", "an STL file", ".stl"},
                        {"a.obj", "MM\x06\0\0\0"s, "a 3DS file", "MeshLab"},
                        {"b.obj", without_mark, "text in UTF-16", "iconv"},
                        {"c.ply", "OFF\r\n", "an OFF file", "MeshLab"},
                        {"d.stl", "\x1F\x8B\x08", "a compressed file", "unpack"}};
  const Folder folder;
  for (const Case& one : cases) {
    SCOPED_TRACE(one.name);
    write(folder / one.name, one.bytes);
    for (const char* command : {"render", "check"}) {
      const Result result = run({command, one.name}, in_folder(folder.path()));
      EXPECT_EQ(result.code, 2) << result.err;
      EXPECT_EQ(result.err.rfind(std::string(one.name) + ": error: this is ", 0), 0U) << result.err;
      const std::string line = result.err.substr(0, result.err.find('\n'));
      EXPECT_TRUE(has(line, one.what)) << result.err;
      EXPECT_TRUE(has(result.err.substr(line.size()), one.way)) << result.err;
    }
  }
  write(folder / "scene.yaml", "objects:\n  - mesh: {file: a.dae, reflectivity: 0.5}\n");
  EXPECT_EQ(
      run({"check", "scene.yaml"}, in_folder(folder.path())).err,
      "scene.yaml:2:18: error: \"a.dae\" is no mesh that can be read\n  got a Collada file (.dae), expected .obj, .ply, .stl, .glb or "
      ".gltf; Blender imports it and exports glTF (.glb)\n");
  EXPECT_TRUE(has(run({"check", "none.dae"}, in_folder(folder.path())).err, "cannot open"));
}

TEST(mesh_in_place_of_a_scene, is_what_its_faults_cite) {
  const Folder folder;
  const auto fault_of = [&](const Arguments& words) {
    const Result result = run(words, in_folder(folder.path()));
    EXPECT_NE(result.code, 0);
    EXPECT_FALSE(has(result.err, ".yaml")) << result.err;
    return result.err.substr(0, result.err.find('\n'));
  };
  write(folder / "far.ply",
        "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\nelement face 1\n"
        "property list uchar int vertex_indices\nend_header\n0 0 1e6 1 0 1e6 0 1 1e6 3 0 1 2\n");
  EXPECT_EQ(fault_of({"render", "far.ply"}), "far.ply: error: no triangle of \"far.ply\" is in the world");
  EXPECT_EQ(fault_of({"check", "far.ply", "--set", "objects.0.mesh.time=1 s", "--set", "objects.0.mesh.scale=1e-6"}).substr(0, 7),
            "--set o");
  EXPECT_EQ(fault_of({"render", "none.obj"}), "none.obj: error: cannot open \"none.obj\": No such file or directory");
  write(folder / "bad.obj", "v 0 0\n");
  EXPECT_EQ(fault_of({"render", "bad.obj"}), "bad.obj:1:1: error: a vertex does not have three coordinates");
}

TEST(guess_of_infrared, is_mended_where_the_files_format_can_say_it) {
  const Folder folder;
  const auto advice_of = [&](const std::string& name, const std::string& bytes) {
    write(folder / name, bytes);
    const std::string told = run({"check", name}, in_folder(folder.path())).err;
    EXPECT_TRUE(has(told, "a guess from the base colour\n")) << told;
    return told;
  };
  const std::string colored = "v 0 0 0 1 0 0\nv 1 0 0 0 1 0\nv 0 1 0 0 0 1\nf 1 2 3\n";
  for (const std::string& told :
       {advice_of("c.obj", colored),
        advice_of("c.ply",
                  "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n"
                  "property uchar red\nproperty uchar green\nproperty uchar blue\nelement face 1\nproperty list uchar int "
                  "vertex_indices\nend_header\n0 0 0 9 0 0 1 0 0 9 9 9 0 1 0 9 9 9 3 0 1 2\n")}) {
    EXPECT_TRUE(has(told, "\n  reflectivity or material at the object says it\n")) << told;
    EXPECT_FALSE(has(told, "newmtl") || has(told, "extras")) << told;
  }
  write(folder / "m.mtl", "newmtl a\nKd 0.5 0.5 0.5\n");
  EXPECT_TRUE(has(advice_of("m.obj", "mtllib m.mtl\nusemtl a\n" + colored), "#!nir_reflectivity 0.6 below newmtl"));
}

TEST(inspect, of_a_folder_is_that_of_its_frame) {
  const Prepare here = in_folder(files().path());
  const Result result = run({"inspect", "out"}, here);
  EXPECT_EQ(result.code, 0) << result.err;
  EXPECT_EQ(result.out, run({"inspect", "out/frame.npz"}, here).out);
}

TEST(warning, of_an_integration_time_above_the_modes_names_both) {
  const Folder folder;
  const Prepare here = in_folder(folder.path());
  std::ofstream(folder / "long.yaml") << "camera: {integration_time: 2.5 ms}\nobjects: []\n";
  for (const Arguments& arguments :
       {Arguments{"check", "card", "--set", "camera.integration_time=2500 us"}, Arguments{"check", "long.yaml"}}) {
    const Result result = run(arguments, here);
    EXPECT_EQ(result.code, 0) << result.err;
    EXPECT_TRUE(has(result.err, "warning: camera.integration_time is 2500 us, longer than the 2000 us of the mode MODE_9_5FPS_2000"))
        << result.err;
  }
  EXPECT_EQ(run({"check", "card", "--set", "camera.integration_time=2000 us"}, here).err, "");
  EXPECT_EQ(run({"check", "card", "--set", "camera.integration_time=450 us"}, here).err, "");
  // A manifest brings the scene's texts, not the files; the warning is the same.
  ASSERT_EQ(run(with_small_sensor({"render", "long.yaml", "-o", "out", "--emit", "npz"}), here).code, 0);
  EXPECT_TRUE(has(run({"render", "--from", "out/manifest.json", "-o", "again"}, here).err, "2500 us, longer than the 2000 us"));
}

TEST(warning, names_the_key_and_its_value) {
  const Folder folder;
  std::ofstream(folder / "empty.yaml") << "objects: []\n";
  std::string profile(load::find_builtin(load::builtin_profiles(), "pico-flexx")->text);
  std::ofstream(folder / "mycam.yaml") << profile << "\nrefractive_index: 1.0003\n";
  const std::vector<std::pair<Arguments, std::string>> cases = {
      {{"check", "empty.yaml"}, "objects is []"},
      {{"check", "mycam.yaml"}, "warning: refractive_index is 1.0003, and does not say where that comes from"},
      {{"check", "card", "--set", "camera.illumination=[]"}, "camera.illumination is []"},
      {{"check", "card", "--set", "camera.illumination.0.power=0 W"}, "camera.illumination.0.power is 0 W"},
      {{"check", "pico-flexx", "--set", "illumination.0.power=0 W"}, ": illumination.0.power is 0 W"},
      {{"check", "card", "--mode", "GREY", "--set",
        "camera.modes.GREY={frame_rate: 5 Hz, sequence: [{lit: false, integration_time: 1 ms}]}"},
       "camera.modes.GREY.sequence says lit: false throughout"}};
  for (const auto& [arguments, says] : cases) {
    const Result result = run(arguments, in_folder(folder.path()));
    EXPECT_EQ(result.code, 0) << result.err;
    EXPECT_TRUE(has(result.err, says)) << says << " in " << result.err;
  }
}

}  // namespace
}  // namespace tofray::test
