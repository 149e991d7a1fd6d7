// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
// Normals, texture coordinates and the names of materials that OBJ and PLY files have.
#include <chrono>

#include "mesh_files.h"

using namespace tofray;
using namespace tofray::mesh_test;

namespace {

using Texcoords = std::vector<std::array<float, 2>>;
using Places = std::vector<std::int32_t>;

ReadMesh read_obj(const std::string& text) { return mesh::parse(Format::obj, text, "m.obj"); }

const std::string three = "v 0 0 0\nv 1 0 0\nv 0 2 0\n";  // lines 1 to 3
const Vertices three_vertices = {{0, 0, 0}, {1, 0, 0}, {0, 2, 0}};

std::vector<std::string> files_of(const std::vector<mesh::Reference>& all) {
  std::vector<std::string> out;
  for (const mesh::Reference& one : all) out.push_back(base::to_string(one.place) + " " + one.file);
  return out;
}

}  // namespace

TEST(obj_details, are_the_vertices_own) {
  const ReadMesh read = read_obj(three + "vt 0.25 1\nvt 0.5 0.75\nvt 1 0\nvn 0 0 1\nvn 0 3 4\nvn -0.5 0 0\nf 1/1/1 2/2/2 3/3/3\n");
  expect_mesh(read, three_vertices, {{0, 1, 2}});
  EXPECT_EQ(read.mesh.normals, (Vertices{{0, 0, 1}, {0, 0.6F, 0.8F}, {-1, 0, 0}}));
  EXPECT_EQ(read.mesh.texcoords, (Texcoords{{0.25F, 0}, {0.5F, 0.25F}, {1, 1}}));  // v of OBJ is 0 at the bottom
}

TEST(obj_details, may_be_of_either_kind_alone) {
  const ReadMesh normals = read_obj(three + "vn 0 0 1\nf 1//1 2//1 3//1\n"), texcoords = read_obj(three + "vt 0.5\nf 1/1 2/1/ 3/1\n");
  EXPECT_EQ(normals.mesh.normals, (Vertices{{0, 0, 1}, {0, 0, 1}, {0, 0, 1}}));
  EXPECT_TRUE(normals.mesh.texcoords.empty());
  EXPECT_TRUE(texcoords.mesh.normals.empty());
  EXPECT_EQ(texcoords.mesh.texcoords, (Texcoords{{0.5F, 1}, {0.5F, 1}, {0.5F, 1}}));
}

TEST(obj_details, count_indices_as_vertices_do) {
  const std::string rows = "vt 0 0\nvt 1 0\nvn 1 0 0\nvn 0 1 0\n";
  const ReadMesh forward = read_obj(three + rows + "f 1/2/1 2/1/2 3/1/1\n"),
                 back = read_obj(three + rows + "f -3/-1/-2 -2/-2/-1 -1/-2/-2\n"),
                 before = read_obj("f 1/2/1 2/1/2 3/1/1\n" + three + rows);
  for (const ReadMesh* const read : {&forward, &back, &before}) {
    EXPECT_EQ(read->mesh.normals, (Vertices{{1, 0, 0}, {0, 1, 0}, {1, 0, 0}}));
    EXPECT_EQ(read->mesh.texcoords, (Texcoords{{1, 1}, {0, 1}, {0, 1}}));
  }
  // From the last one so far, not of all.
  EXPECT_EQ(read_obj(three + "vn 1 0 0\nf 1//-1 2//-1 3//-1\nvn 0 1 0\n").mesh.normals, Vertices(3, {1, 0, 0}));
}

// Two squares that share an edge at a right angle: each corner of the edge has two normals.
TEST(obj_details, of_one_vertex_that_differ_make_it_several) {
  const ReadMesh read = read_obj(
      "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 1 0 1\nv 1 1 1\nv 9 9 9\nvn 0 0 1\nvn 1 0 0\n"
      "f 1//1 2//1 3//1 4//1\nf 2//2 5//2 6//2 3//2\n");
  expect_mesh(read, {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {1, 0, 1}, {1, 1, 1}, {9, 9, 9}, {1, 0, 0}, {1, 1, 0}},
              {{0, 1, 2}, {0, 2, 3}, {7, 4, 5}, {7, 5, 8}});
  const std::array<float, 3> z{0, 0, 1}, x{1, 0, 0}, no{0, 0, 0};
  EXPECT_EQ(read.mesh.normals, (Vertices{z, z, z, z, x, x, no, x, x}));
}

// Any one of the five numbers that differs makes a vertex of its own.
TEST(obj_details, that_differ_in_one_number_are_told_apart) {
  std::string text = three + "vt 0 0\nvt 0.5 0\nvt 0 0.5\nvn 0.6 0.8 0\nvn 0.6 -0.8 0\nvn -0.6 0.8 0\nvn 0.6 0 0.8\n";
  for (const char* const corner : {"1/1/1", "1/1/1", "1/2/1", "1/3/1", "1/1/2", "1/1/3", "1/1/4", "1/3/1"})
    text += std::string("f ") + corner + " 2 3\n";
  const ReadMesh read = read_obj(text);
  std::vector<std::int32_t> first;
  for (const auto& triangle : read.mesh.triangles) first.push_back(triangle[0]);
  EXPECT_EQ(first, (Places{0, 0, 3, 4, 5, 6, 7, 4}));
  EXPECT_EQ(read.mesh.texcoords[4], (std::array<float, 2>{0, 0.5F}));
}

TEST(obj_details, that_say_the_same_make_no_vertex) {
  // Equal numbers at other indices, and -0 for 0.
  const ReadMesh read = read_obj(three + "v 1 1 1\nvn 0 0 2\nvn -0 0 1\nvt 0 1\nvt -0 1\nf 1/1/1 2/1/1 3/1/1\nf 1/2/2 4/2/2 3/2/2\n");
  expect_mesh(read, {{0, 0, 0}, {1, 0, 0}, {0, 2, 0}, {1, 1, 1}}, {{0, 1, 2}, {0, 3, 2}});
}

TEST(obj_details, that_a_corner_lacks_are_zero) {
  const ReadMesh read = read_obj(three + "vn 0 0 1\nvt 0.5 0.5\nf 1//1 2/1/1 3\nf 1 2 3\n");
  expect_mesh(read, {{0, 0, 0}, {1, 0, 0}, {0, 2, 0}, {0, 0, 0}, {1, 0, 0}}, {{0, 1, 2}, {3, 4, 2}});
  EXPECT_EQ(read.mesh.normals, (Vertices{{0, 0, 1}, {0, 0, 1}, {0, 0, 0}, {0, 0, 0}, {0, 0, 0}}));
  EXPECT_EQ(read.mesh.texcoords, (Texcoords{{0, 0}, {0.5F, 0.5F}, {0, 0}, {0, 0}, {0, 0}}));
}

TEST(obj_details, that_no_face_names_are_none) {
  const ReadMesh unused = read_obj(three + "vn 0 0 1\nvt 0 0\nf 1 2 3\n"),
                 zero = read_obj(three + "vn 0 0 0\nvn -0 0 0\nf 1//1 2//2 3//1\n");
  for (const ReadMesh* const read : {&unused, &zero}) {
    expect_mesh(*read, three_vertices, {{0, 1, 2}});
    EXPECT_TRUE(read->mesh.normals.empty());
    EXPECT_TRUE(read->mesh.texcoords.empty());
    EXPECT_TRUE(read->notices.empty());
  }
}

TEST(obj_details, that_are_no_numbers_are_zero_and_told) {
  const ReadMesh read =
      read_obj(three + "vn 0 0 1\nvn nan 0 1\nvn 1e39 0 0\nvn 0 x 1\nvn 0 1\nvt 2e6 0\nvt 0 -2e6\nvt inf 0\nvt\nvt a\nvt 0 b\nvt 5 5\n" +
               "f 1/1/1 2/2/2 3/3/3\nf 1/4/4 2/5/5 3/6/4\nf 1/7/1 1/7/1 1/7/1\n");
  for (std::size_t i = 1; i < read.mesh.normals.size(); ++i)
    if (read.mesh.normals[i] != std::array<float, 3>{0, 0, 0}) {
      EXPECT_EQ(read.mesh.texcoords[i], (std::array<float, 2>{5, -4}));
    }
  EXPECT_EQ(read.notices, (std::vector<std::string>{"normals that are not finite (4) become 0: flat",
                                                    "texture coordinates that are not finite, or beyond 1e6 (6), become 0"}));
  EXPECT_TRUE(is_sound(read));
}

TEST(obj_details, go_with_their_vertices_where_others_are_dropped) {
  const ReadMesh read = read_obj("v nan 0 0\n" + three + "vn 1 0 0\nvn 0 1 0\nvt 0 1\nvt 0.5 1\nusemtl a\nf 1/1/1 2/1/1 3/1/1\nusemtl b\n" +
                                 "f 2/2/2 3/2/2 4/2/2\nf 2/1/1 3/1/1 4/2/2\n");
  expect_mesh(read, {{0, 0, 0}, {1, 0, 0}, {0, 2, 0}, {0, 0, 0}, {1, 0, 0}}, {{3, 4, 2}, {0, 1, 2}}, 1);
  EXPECT_EQ(read.mesh.normals, (Vertices{{1, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 1, 0}, {0, 1, 0}}));
  EXPECT_EQ(read.mesh.texcoords, (Texcoords{{0, 0}, {0, 0}, {0.5F, 0}, {0.5F, 0}, {0.5F, 0}}));
  EXPECT_EQ(read.material_of, (Places{1, 1}));
}

TEST(obj_details, of_a_normal_of_any_length_are_of_unit_length) {
  const ReadMesh read = read_obj(three + "vn 3e38 -3e38 3e38\nvn 1e-30 0 1e-30\nvn 1e-60 0 0\nf 1//1 2//2 3//3\n");
  const float third = static_cast<float>(1 / std::sqrt(3.0)), half = static_cast<float>(std::sqrt(0.5));
  const Vertices expected = {{third, -third, third}, {half, 0, half}, {0, 0, 0}};
  ASSERT_EQ(read.mesh.normals.size(), 3U);
  for (std::size_t i = 0; i < 3; ++i)  // half a step of a float below 1
    for (std::size_t k = 0; k < 3; ++k) EXPECT_NEAR(read.mesh.normals[i][k], expected[i][k], 6e-8F);
}

// Of one place 600,000 normals: a list of those of each vertex would take minutes.
TEST(obj_details, of_a_vertex_that_has_a_million_are_found_in_linear_time) {
  std::string text = three + "vt 0 0\n";
  constexpr int count = 600'000;
  for (int i = 0; i < count; ++i) text += "vn 1 " + std::to_string(i) + " 0\n";
  for (int i = 1; i + 2 <= count; i += 3)
    text += "f 1/1/" + std::to_string(i) + " 1/1/" + std::to_string(i + 1) + " 1/1/" + std::to_string(i + 2) + "\n";
  const auto start = std::chrono::steady_clock::now();
  const ReadMesh read = read_obj(text);
  EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::seconds(60));
  // Two neighbours of large slope may be the same float, but not many are.
  EXPECT_GT(read.mesh.vertices.size(), 3U + 100'000U);
  EXPECT_TRUE(is_sound(read));
}

TEST(obj_details, may_be_named_where_the_file_has_none) {
  expect_mesh(read_obj(three + "f 1/7/0 2/-3/9 3/0/-1\n"), three_vertices, {{0, 1, 2}});
  expect_mesh(read_obj(three + "vn 0 0 1\nf 1/7/1 2/0/1 3/-1/1\n"), three_vertices, {{0, 1, 2}});
}

TEST(obj_details, with_faults_say_where_and_what) {
  const std::string both = three + "vt 0 0\nvn 0 0 1\n";
  expect_faults(Format::obj,
                {{both + "f 1/2 2/1 3/1", "m:6:3: error: a face has a texture coordinate beyond the last one\n  got 2, the file has 1"},
                 {both + "f 1//1 2//1 3//2", "m:6:13: error: a face has a normal beyond the last one\n  got 2, the file has 1"},
                 {"f 1//1 2//3 3//2\n" + both, "m:1:8: error: a face has a normal beyond the last one\n  got 3, the file has 1"},
                 {both + "f 1//1 2//1 3//20000001", "m:6:13: error: a face has a normal beyond the last one\n  got 20000001"},
                 {both + "f 1//1 2//1 3//99999999999999999999999", "error: a face has a normal beyond the last one"},
                 {both + "f 1/4294967297 2 3", "error: a face has a texture coordinate beyond the last one\n  got 4294967297"},
                 {both + "f 1/0/1 2 3", "m:6:3: error: a face has a texture coordinate of index 0\n  expected 1 for the first one"},
                 {both + "f 1/1/0 2 3",
                  "m:6:3: error: a face has a normal of index 0\n  expected 1 for the first one, or -1 for the last one so far"},
                 {both + "f 1/-2 2 3", "m:6:3: error: a face has a texture coordinate before the first one\n  got -2 after 1"},
                 {"f 1//-1 2 3\n" + both, "m:1:3: error: a face has a normal before the first one\n  got -1 after 0"},
                 {both + "f 1 2 3//-99999999999999999999999", "m:6:7: error: a face has a normal before the first one"},
                 {both + "f 1//0 2//-7 3//9", "m:6:3: error: a face has a normal of index 0"},  // the first
                 {both + "f 1/x 2 3", "m:6:3: error: the corner of a face is no index\n  got \"1/x\""},
                 {both + "f 1//1.0 2 3", "got \"1//1.0\""}});
}

TEST(obj_materials, are_the_triangles) {
  const ReadMesh read = read_obj("mtllib a.mtl\n" + three +
                                 "f 1 2 3\nusemtl red\nf 1 2 3 1\nusemtl  dark   blue # not green\nf 1 2 3\nusemtl red\nf 1 2 3\n" +
                                 "usemtl\nf 1 2 3\nusemtl unused\n");
  EXPECT_EQ(read.materials, (std::vector<std::string>{"red", "dark blue", "unused"}));
  EXPECT_EQ(read.material_of, (Places{-1, 0, 0, 1, 0, -1}));
  EXPECT_TRUE(read_obj(three + "f 1 2 3\nusemtl a\n").material_of.empty());
}

TEST(obj_materials, lie_in_files_with_blanks_in_their_names_or_several_in_a_line) {
  const std::string text =
      "mtllib a.mtl side/b.MTL my own.mtl\n" + three + "f 1 2 3\n mtllib a.mtl \\\n  c.txt d\nmtllib\nmtllib e.mtl # f.mtl\n";
  const std::vector<std::string> expected = {"m.obj:1:8 a.mtl", "m.obj:1:14 side/b.MTL", "m.obj:1:25 my own.mtl", "m.obj:7:3 c.txt d",
                                             "m.obj:9:8 e.mtl"};
  EXPECT_EQ(files_of(read_obj(text).libraries), expected);
  EXPECT_EQ(files_of(mesh::libraries_of_obj(text, "m.obj")), expected);
  EXPECT_TRUE(mesh::libraries_of_obj(three, "m.obj").empty());
}

// A name of a million words: looking at all of it again behind each word would take hours.
TEST(obj_materials, have_names_of_any_length_in_linear_time) {
  std::string words;
  for (int i = 0; i < 1'000'000; ++i) words += " a";
  const ReadMesh read = read_obj("mtllib" + words + "\n" + three + "usemtl" + words + "\nf 1 2 3\n");
  EXPECT_EQ(read.libraries.at(0).file.size(), 1'999'999U);
  EXPECT_EQ(read.materials.at(0).size(), 1'999'999U);
}

TEST(obj_materials, beyond_the_limits_are_refused) {
  std::string files = three, names = three;
  for (int i = 0; i < 101; ++i) files += "mtllib " + std::to_string(i) + ".mtl\n";
  for (int i = 0; i < 100'001; ++i) names += "usemtl " + std::to_string(i) + "\n";
  const auto refused = [](const std::string& text, const std::string& message) {
    const Error error = out_test::error_of([&] { (void)read_obj(text); });
    EXPECT_EQ(error.kind(), ErrorKind::limit);
    EXPECT_TRUE(test::has(error.what(), message)) << error.what();
  };
  refused(files + "f 1 2 3\n", "m.obj:104:8: error: the file names more than 100 files of materials");
  refused(names + "f 1 2 3\n", "m.obj:100004:1: error: the file uses more than 100000 materials");
}

namespace {

std::string triangle_ply(PlyWriter::Encoding encoding, const std::string& more, const std::vector<std::vector<double>>& rows) {
  PlyWriter file(encoding, "element vertex 3\nproperty float x\n" + more +
                               "property float y\nproperty float z\nelement face 1\nproperty list uchar int vertex_indices\n");
  for (std::size_t i = 0; i < 3; ++i) {
    file.put<float>(static_cast<double>(three_vertices[i][0]));
    for (const double number : rows[i]) file.put<float>(number);
    file.put<float>(static_cast<double>(three_vertices[i][1])).put<float>(static_cast<double>(three_vertices[i][2])).end_row();
  }
  file.put<std::uint8_t>(3).put<std::int32_t>(0).put<std::int32_t>(1).put<std::int32_t>(2).end_row();
  return file.bytes;
}

std::string floats(std::initializer_list<const char*> names) {
  std::string out;
  for (const char* const name : names) out += std::string("property float ") + name + "\n";
  return out;
}

}  // namespace

TEST(ply_details, are_read_in_any_encoding_and_order) {
  for (const auto encoding : every_encoding) {
    const ReadMesh read = mesh::parse(Format::ply,
                                      triangle_ply(encoding, floats({"t", "nz", "red", "nx", "s", "ny"}),
                                                   {{1, 1, 9, 0, 0.25, 0}, {0.75, 4, 9, 0, 0.5, 3}, {0, 0, 9, -2, 1, 0}}),
                                      "m.ply");
    expect_mesh(read, three_vertices, {{0, 1, 2}});
    EXPECT_EQ(read.mesh.normals, (Vertices{{0, 0, 1}, {0, 0.6F, 0.8F}, {-1, 0, 0}}));
    EXPECT_EQ(read.mesh.texcoords, (Texcoords{{0.25F, 0}, {0.5F, 0.25F}, {1, 1}}));
  }
}

TEST(ply_details, have_texture_coordinates_of_any_of_three_names) {
  const std::vector<std::vector<double>> rows(3, {0.5, 1, 7, 7});
  for (const auto& names : {floats({"s", "t", "a", "b"}), floats({"u", "v", "a", "b"}), floats({"texture_u", "texture_v", "a", "b"}),
                            floats({"s", "t", "u", "v"}), floats({"u", "v", "texture_u", "texture_v"})})
    EXPECT_EQ(mesh::parse(Format::ply, triangle_ply(PlyWriter::Encoding::text, names, rows), "m").mesh.texcoords, Texcoords(3, {0.5F, 0}));
}

TEST(ply_details, that_are_not_whole_are_read_past) {
  const std::vector<std::vector<double>> rows(3, {1, 1});
  for (const auto& names : {floats({"nx", "ny"}), floats({"nx", "nz"}), floats({"s", "v"}), floats({"texture_u", "t"}), floats({"u", "nx"}),
                            floats({"texture_u", "a"}), floats({"red", "green"})}) {
    const ReadMesh read = mesh::parse(Format::ply, triangle_ply(PlyWriter::Encoding::little, names, rows), "m");
    expect_mesh(read, three_vertices, {{0, 1, 2}});
    EXPECT_TRUE(read.mesh.normals.empty());
    EXPECT_TRUE(read.mesh.texcoords.empty());
  }
  // A list of that name is none.
  const std::string list = replaced(plain_ply(PlyWriter::Encoding::text), "property float z\n",
                                    "property float z\nproperty list uchar float s\nproperty float t\n");
  EXPECT_TRUE(mesh::parse(Format::ply,
                          replaced(replaced(replaced(replaced(list, "0 0 0\n", "0 0 0 1 5 6\n"), "1 0 0\n", "1 0 0 0 6\n"), "0 2 0\n",
                                            "0 2 0 0 6\n"),
                                   "0 0 0.5\n", "0 0 0.5 0 6\n"),
                          "m")
                  .mesh.texcoords.empty());
}

TEST(ply_details, that_are_not_finite_are_zero_and_told) {
  std::string text = triangle_ply(PlyWriter::Encoding::text, floats({"nx", "ny", "nz", "u", "v"}),
                                  {{0, 0, 1, 0.5, 0.5}, {0, 777, 0, 888, 0}, {0, 0, 0, 0, 1e7}});
  const ReadMesh read = mesh::parse(Format::ply, replaced(replaced(text, "777", "nan"), "888", "-inf"), "m");
  EXPECT_EQ(read.mesh.normals, (Vertices{{0, 0, 1}, {0, 0, 0}, {0, 0, 0}}));
  EXPECT_EQ(read.mesh.texcoords, (Texcoords{{0.5F, 0.5F}, {0, 0}, {0, 0}}));
  EXPECT_EQ(read.notices, (std::vector<std::string>{"normals that are not finite (1) become 0: flat",
                                                    "texture coordinates that are not finite, or beyond 1e6 (2), become 0"}));
}
