// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
// Meshes that a scene names: where they may lie, which way is up, how large they are, what is left out.
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "gltf/gltf_files.h"
#include "load/load.h"
#include "support/samples.h"

using namespace tofray;
using out_test::write_file;

namespace {

namespace fs = std::filesystem;

constexpr const char* corner = "v 1 2 3\nv 4 2 3\nv 1 7 3\nf 1 2 3\n";
constexpr const char* corner_ply =
    "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\nelement face 1\n"
    "property list uchar int vertex_indices\nend_header\n1 2 3\n4 2 3\n1 7 3\n3 0 1 2\n";

bool tells(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

class mesh_files : public testing::Test {
 protected:
  void SetUp() override {
    fs::create_directories(folder_.path() / "in/side");
    file("in/corner.obj", corner), file("in/side/corner.ply", corner_ply), file("out.obj", corner);
  }
  void file(const std::string& name, const std::string& bytes) const { write_file(folder_.path() / name, bytes); }
  [[nodiscard]] Scene scene(const std::string& keys, const assets::MeshFiles& files = {}) const {
    const std::string text = "objects:\n  - mesh: {" + keys + ", reflectivity: 0.5}\n";
    return load::scene_from_text(text, (folder_.path() / "in/scene.yaml").string(), {}, files);
  }
  [[nodiscard]] Mesh mesh(const std::string& keys, const assets::MeshFiles& files = {}) const {
    return std::get<Mesh>(scene(keys, files).objects.at(0).shape);
  }
  [[nodiscard]] std::array<float, 3> first(const std::string& keys) const { return mesh(keys).triangles->vertices.at(0); }
  [[nodiscard]] std::string refusal(const std::string& keys, ErrorKind kind = ErrorKind::bad_input,
                                    const assets::MeshFiles& files = {}) const {
    try {
      (void)scene(keys, files);
    } catch (const Error& error) {
      EXPECT_EQ(error.kind(), kind) << error.what();
      return error.what();
    }
    return "";
  }

  out_test::TemporaryFolder folder_;
};

using V = std::array<float, 3>;

}  // namespace

TEST_F(mesh_files, are_turned_so_that_up_is_up) {
  EXPECT_EQ(first("file: corner.obj"), (V{1, -2, -3}));
  EXPECT_EQ(first("file: corner.obj, up: y"), (V{1, -2, -3}));
  EXPECT_EQ(first("file: corner.obj, up: z"), (V{1, -3, 2}));
  EXPECT_EQ(first("file: corner.obj, up: -y"), (V{1, 2, 3}));
  EXPECT_EQ(first("file: side/corner.ply"), (V{1, -3, 2}));
  EXPECT_EQ(first("file: side/corner.ply, up: y"), (V{1, -2, -3}));
}

// As Blender turns a file with y up when it takes it into its own world: (x, -z, y).
TEST_F(mesh_files, are_turned_to_the_worlds_up_or_not_at_all) {
  const auto in = [&](const char* world, const std::string& keys) {
    const std::string text = std::string("world_up: ") + world + "\nobjects:\n  - mesh: {" + keys + ", reflectivity: 0.5}\n";
    const Scene one = load::scene_from_text(text, (folder_.path() / "in/scene.yaml").string());
    return std::get<Mesh>(one.objects.at(0).shape).triangles->vertices.at(0);
  };
  EXPECT_EQ(in("z", "file: corner.obj"), (V{1, -3, 2}));
  EXPECT_EQ(in("z", "file: side/corner.ply"), (V{1, 2, 3}));
  EXPECT_EQ(in("z", "file: corner.obj, up: -y"), (V{1, 3, -2}));
  EXPECT_EQ(in("y", "file: corner.obj"), (V{1, 2, 3}));
  EXPECT_EQ(in("y", "file: side/corner.ply"), (V{1, 3, -2}));
  EXPECT_EQ(in("y", "file: corner.obj, up: -y"), (V{1, -2, -3}));
  EXPECT_EQ(in("-y", "file: corner.obj"), (V{1, -2, -3}));
  for (const char* world : {"-y", "y", "z"})
    for (const char* name : {"corner.obj", "side/corner.ply"})
      EXPECT_EQ(in(world, std::string("up: none, file: ") + name), (V{1, 2, 3})) << world;
}

TEST_F(mesh_files, are_scaled_to_metres) {
  EXPECT_EQ(first("file: corner.obj, scale: 0.001"), (V{0.001f, -0.002f, -0.003f}));
  EXPECT_TRUE(tells(refusal("file: corner.obj, scale: 0"), "scale is out of range"));
  EXPECT_TRUE(tells(refusal("file: corner.obj, scale: -1"), "scale is out of range"));
}

TEST_F(mesh_files, are_read_once_for_all_objects_that_want_them_alike) {
  const std::string text =
      "objects:\n  - mesh: {file: corner.obj, reflectivity: 0.5}\n  - mesh: {file: corner.obj, reflectivity: 0.2}\n"
      "  - mesh: {file: corner.obj, scale: 2, reflectivity: 0.2}\n";
  const Scene scene = load::scene_from_text(text, (folder_.path() / "in/scene.yaml").string());
  const auto at = [&](std::size_t i) { return std::get<Mesh>(scene.objects[i].shape).triangles; };
  EXPECT_EQ(at(0), at(1));
  EXPECT_NE(at(0), at(2));
}

TEST_F(mesh_files, are_known_by_their_sha256) {
  EXPECT_EQ(mesh("file: corner.obj").sha256.size(), 64U);
  const assets::MeshFiles same{{}, {{{"corner.obj", mesh("file: corner.obj").sha256}}}}, none{{}, std::map<std::string, std::string>{}};
  EXPECT_EQ(mesh("file: corner.obj", same).triangles->triangles.size(), 1U);
  EXPECT_TRUE(tells(refusal("file: corner.obj", ErrorKind::bad_input, none), "is not the mesh that it was"));
  file("in/corner.obj", std::string(corner) + "# changed\n");
  EXPECT_TRUE(tells(refusal("file: corner.obj", ErrorKind::bad_input, same), "is not the mesh that it was"));
}

TEST_F(mesh_files, lie_beside_the_scene_or_below) {
  for (const char* const outside : {"../out.obj", "side/../../out.obj"})
    EXPECT_TRUE(tells(refusal("file: " + std::string(outside)), "leads out of the folder")) << outside;
  EXPECT_TRUE(tells(refusal("file: " + folder_.file("out.obj")), "leads out of the folder"));
  EXPECT_EQ(mesh("file: ../out.obj", {folder_.path().string(), {}}).triangles->triangles.size(), 1U);
  fs::create_symlink(folder_.path() / "out.obj", folder_.path() / "in/link.obj");
  EXPECT_NE(refusal("file: link.obj"), "");
  ASSERT_EQ(::mkfifo(folder_.file("in/pipe.obj").c_str(), 0600), 0);
  EXPECT_TRUE(tells(refusal("file: pipe.obj", ErrorKind::io), "is not a plain file"));
  fs::create_directory(folder_.path() / "in/folder.obj");
  EXPECT_TRUE(tells(refusal("file: folder.obj", ErrorKind::io), "is not a plain file"));
  EXPECT_TRUE(tells(refusal("file: none.obj", ErrorKind::io), "cannot open"));
}

TEST_F(mesh_files, that_are_wrong_are_named_with_their_place) {
  EXPECT_TRUE(tells(refusal("file: chair.glb", ErrorKind::io), "scene.yaml:2:18: error: cannot open"))
      << refusal("file: chair.glb", ErrorKind::io);
  EXPECT_TRUE(tells(refusal("file: chair.fbx"), "scene.yaml:2:18: error: \"chair.fbx\" is no mesh that can be read"))
      << refusal("file: chair.fbx");
  file("in/bad.obj", "v 1 2 3\nf 1 2 3\n");
  EXPECT_TRUE(tells(refusal("file: bad.obj"), "bad.obj:2:")) << refusal("file: bad.obj");
  // What else is wrong with the scene is told first: the file is not read then.
  EXPECT_TRUE(tells(refusal("file: bad.obj, velocity: 3"), "velocity"));
  EXPECT_FALSE(tells(refusal("file: bad.obj, velocity: 3"), "bad.obj:2:"));
  EXPECT_TRUE(tells(refusal("scale: 2"), "lacks the key \"file\""));
}

TEST_F(mesh_files, lose_triangles_that_are_nowhere) {
  const std::string two = "v nan 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nv 1e30 0 0\nf 1 2 3\nf 2 3 4\nf 2 3 5\n";
  file("in/holes.obj", two);
  const Mesh one = mesh("file: holes.obj");
  EXPECT_EQ(one.left_out, 2);
  ASSERT_EQ(one.triangles->triangles.size(), 1U);
  for (const auto& v : one.triangles->vertices)
    for (const float x : v) EXPECT_TRUE(std::isfinite(x) && std::abs(x) <= 1e5f);
  EXPECT_TRUE(tells(refusal("file: corner.obj, scale: 1e9"), "no triangle of")) << refusal("file: corner.obj, scale: 1e9");
  file("in/far.obj", "v 100000 0 0\nv 0 -100000 0\nv 0 0 100000\nv 100001 0 0\nf 1 2 3\nf 4 2 3\n");  // the world's end, and a metre beyond
  EXPECT_EQ(mesh("file: far.obj").left_out, 1);
}

TEST_F(mesh_files, of_which_nothing_is_in_the_world_are_blamed_on_what_it_is) {
  const auto says = [&](const std::string& keys, const std::string& what) {
    const std::string said = refusal(keys);
    EXPECT_TRUE(tells(said, "scene.yaml:2:18: error: no triangle of ") && tells(said, what)) << said;
  };
  says("file: corner.obj, scale: 1e6",
       "beyond 100000 m, up to 7000000 m; is another scale meant? Such as scale: 1 (--set objects.0.mesh.scale=1)");
  file("in/huge.obj", "v 1e38 0 0\nv 3e38 0 0\nv 0 3e38 2e38\nf 1 2 3\n");
  says("file: huge.obj", "no scale makes a thing of these");
  says("file: huge.obj, scale: 1e9", "no scale makes a thing of these");
  const float infinity = std::numeric_limits<float>::infinity();
  gltf_test::File file_of_gltf;
  file_of_gltf.mesh({{"POSITION", file_of_gltf.floats({0, 0, 0, 1, 0, 0, 0, infinity, 0}, "VEC3")}});
  file_of_gltf.node({{"mesh", 0}});
  file("in/infinite.glb", file_of_gltf.glb());
  says("file: infinite.glb", "each has a corner that is not a finite number");
}

// Closed: each edge is that of two triangles, once each way. Radii as their header says.
TEST_F(mesh_files, need_not_be_where_tofray_has_the_mesh_itself) {
  const Mesh ball = mesh("file: \"tofray:bumpy-ball\""), floor = mesh("file: \"tofray:wavy-floor\", scale: 0.5");
  EXPECT_EQ(ball.triangles->triangles.size(), 81920U);
  EXPECT_EQ(floor.triangles->triangles.size(), 20000U);
  EXPECT_TRUE(ball.sha256.empty());
  float least = 1, most = 0;
  for (const V& v : ball.triangles->vertices) {
    const float r = std::hypot(v[0], v[1], v[2]);
    least = std::min(least, r), most = std::max(most, r);
  }
  EXPECT_TRUE(least >= 0.46f && least < 0.475f) << least;
  EXPECT_TRUE(most > 0.525f && most <= 0.54f) << most;
  std::map<std::pair<int, int>, int> edges;
  for (const auto& t : ball.triangles->triangles)
    for (std::size_t i = 0; i < 3; ++i) ++edges[{t[i], t[(i + 1) % 3]}];
  for (const auto& [edge, times] : edges) {
    ASSERT_EQ(times, 1);
    ASSERT_EQ(edges.count({edge.second, edge.first}), 1U);
  }
  for (const V& v : floor.triangles->vertices) {
    ASSERT_TRUE(std::abs(v[0]) <= 1.0f && std::abs(v[1]) <= 0.01f && std::abs(v[2]) <= 1.0f);
  }
  EXPECT_TRUE(
      tells(refusal("file: \"tofray:bunny\""),
            "there is no mesh \"tofray:bunny\" in tofray itself\n  expected a file, or one of tofray:bumpy-ball, tofray:wavy-floor"))
      << refusal("file: \"tofray:bunny\"");
}
