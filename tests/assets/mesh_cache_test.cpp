// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
// Meshes that an earlier scene has read: the same memory while nothing changed that they depend on, and other memory as soon as it did.
#include <gtest/gtest.h>

#include <algorithm>
#include <memory>
#include <thread>

#include "base/shared.h"
#include "gltf/gltf_files.h"
#include "image/image_files.h"
#include "load/load.h"
#include "support/samples.h"
#include "support/text.h"

using namespace tofray;
using out_test::write_file;
using test::has;

namespace {

namespace fs = std::filesystem;

const std::string grey_pixel = image_test::hand_png(1, 1, 8, image_test::rgb, std::string("\0\xBC\xBC\xBC", 4));
const std::string white_pixel = image_test::hand_png(1, 1, 8, image_test::rgb, std::string("\0\xFF\xFF\xFF", 4));
const std::string painted_card =
    "mtllib card.mtl\nusemtl paint\nv -1 -1 -2\nv 1 -1 -2\nv 1 1 -2\nv -1 1 -2\nvt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\nf 1/1 2/2 3/3 4/4\n";

class cached_mesh : public testing::Test {
 protected:
  void SetUp() override {
    base::forget_kept();
    fs::create_directories(folder_.path() / "other");
    for (const char* where : {"", "other/"}) {
      file(std::string(where) + "card.obj", painted_card);
      file(std::string(where) + "card.mtl", "newmtl paint\nmap_Kd card.png\n");
      file(std::string(where) + "card.png", grey_pixel);
    }
  }
  void TearDown() override { base::forget_kept(); }
  void file(const std::string& name, const std::string& bytes) const { write_file(folder_.path() / name, bytes); }
  [[nodiscard]] Scene scene(const std::string& keys, const std::string& folder = "", const assets::MeshFiles& files = {}) const {
    return load::scene_from_text("objects:\n  - mesh: {" + keys + "}\n", (folder_.path() / folder / "scene.yaml").string(), {}, files);
  }
  static const TriangleMesh* triangles(const Scene& of) { return std::get<Mesh>(of.objects.at(0).shape).triangles.get(); }
  static double diffuse(const Scene& of) { return of.materials.at(static_cast<std::size_t>(of.objects.at(0).material)).diffuse; }

  out_test::TemporaryFolder folder_;
};

}  // namespace

TEST_F(cached_mesh, is_that_of_the_scene_before) {
  const Scene one = scene("file: card.obj");
  const Scene two = scene("file: card.obj");
  EXPECT_EQ(triangles(one), triangles(two));
  const Material &a = one.materials.at(0), &b = two.materials.at(0);
  EXPECT_EQ(a.map, b.map);
  EXPECT_EQ(std::get<Mesh>(one.objects[0].shape).sha256, std::get<Mesh>(two.objects[0].shape).sha256);
  EXPECT_EQ(std::get<Mesh>(one.objects[0].shape).notices, std::get<Mesh>(two.objects[0].shape).notices);
}

TEST_F(cached_mesh, is_another_one_where_it_is_read_otherwise) {
  const Scene one = scene("file: card.obj");
  for (const char* other : {"file: card.obj, scale: 2", "file: card.obj, up: z", "file: card.obj, reflectivity: 0.5"})
    EXPECT_NE(triangles(one), triangles(scene(other))) << other;
  EXPECT_NE(triangles(one), triangles(scene("file: card.obj", "other"))) << "messages and pictures are of the file's own folder";
  const std::string up_z = "world_up: z\nobjects:\n  - mesh: {file: card.obj}\n";
  EXPECT_NE(triangles(one), triangles(load::scene_from_text(up_z, (folder_.path() / "scene.yaml").string())));
}

TEST_F(cached_mesh, is_made_anew_where_a_file_of_it_changed) {
  const Scene before = scene("file: card.obj");
  const std::pair<const char*, std::string> changes[] = {
      {"card.obj", painted_card + "# of the same shape\n"},
      {"card.mtl", "newmtl paint\nmap_Kd card.png\nKd 0.5 0.5 0.5\n"},
      {"card.png", white_pixel},
  };
  const Scene* last = &before;
  std::vector<std::unique_ptr<Scene>> all;
  for (const auto& [name, bytes] : changes) {
    file(name, bytes);
    all.push_back(std::make_unique<Scene>(scene("file: card.obj")));
    EXPECT_NE(triangles(*last), triangles(*all.back())) << name;
    EXPECT_EQ(triangles(*all.back()), triangles(scene("file: card.obj"))) << name;
    last = all.back().get();
  }
  EXPECT_GT(diffuse(*all[2]), 1.5 * diffuse(*all[1])) << "the new picture is white";
  file("card.obj", painted_card), file("card.mtl", "newmtl paint\nmap_Kd card.png\n"), file("card.png", grey_pixel);
  EXPECT_EQ(triangles(before), triangles(scene("file: card.obj"))) << "all as it was at first";
}

TEST_F(cached_mesh, is_made_anew_where_a_file_goes_or_comes) {
  const Scene before = scene("file: card.obj");
  fs::remove(folder_.path() / "card.png");
  const Scene without = scene("file: card.obj");
  EXPECT_NE(triangles(before), triangles(without));
  EXPECT_TRUE(has(std::get<Mesh>(without.objects[0].shape).notices.at(0), "card.png"));
  EXPECT_EQ(triangles(without), triangles(scene("file: card.obj")));
  file("CARD.PNG", white_pixel);  // read where nothing is called as it should be
  const Scene found = scene("file: card.obj");
  EXPECT_NE(triangles(without), triangles(found));
  EXPECT_GT(diffuse(found), 0.9);
}

TEST_F(cached_mesh, of_a_gltf_file_depends_on_its_buffer) {
  const gltf_test::File triangle = gltf_test::triangle_file();
  file("box.gltf", triangle.text_beside("box.bin"));
  file("box.bin", triangle.binary);
  const Scene one = scene("file: box.gltf, reflectivity: 0.5");
  EXPECT_EQ(triangles(one), triangles(scene("file: box.gltf, reflectivity: 0.5")));
  std::string other = triangle.binary;
  std::swap_ranges(other.begin() + 12, other.begin() + 16, other.begin() + 20);  // the second corner's x and z
  file("box.bin", other);
  EXPECT_NE(triangles(one), triangles(scene("file: box.gltf, reflectivity: 0.5")));
  fs::remove(folder_.path() / "box.bin");
  EXPECT_EQ(out_test::error_of([&] { (void)scene("file: box.gltf, reflectivity: 0.5"); }).kind(), ErrorKind::io);
}

TEST_F(cached_mesh, is_held_to_what_a_manifest_expects) {
  const Scene one = scene("file: card.obj");
  const assets::MeshFiles none{{}, std::map<std::string, std::string>{{"card.obj", std::string(64, '0')}}};
  EXPECT_TRUE(has(out_test::error_of([&] { (void)scene("file: card.obj", "", none); }).what(), "is not the mesh that it was"));
}

TEST_F(cached_mesh, lives_as_long_as_its_triangles_and_no_longer) {
  std::weak_ptr<const TriangleMesh> last;
  {
    const std::shared_ptr<const TriangleMesh> kept = std::get<Mesh>(scene("file: card.obj").objects.at(0).shape).triangles;
    base::forget_kept();
    EXPECT_EQ(kept.get(), triangles(scene("file: card.obj"))) << "who holds the triangles alone holds all of it";
    last = kept;
  }
  EXPECT_FALSE(last.expired()) << "the one used last is kept for who comes next";
  base::forget_kept();
  EXPECT_TRUE(last.expired());
}

TEST_F(cached_mesh, is_one_for_many_threads) {
  std::vector<Scene> scenes(8);
  {
    std::vector<std::jthread> threads;
    for (Scene& one : scenes) threads.emplace_back([&] { one = scene("file: card.obj"); });
  }
  for (const Scene& one : scenes) EXPECT_EQ(triangles(one)->vertices, triangles(scenes[0])->vertices);
}

TEST_F(cached_mesh, of_tofray_itself_is_made_once) {
  EXPECT_EQ(triangles(scene("file: 'tofray:wavy-floor', reflectivity: 0.5")),
            triangles(scene("file: 'tofray:wavy-floor', reflectivity: 0.2")));
}
