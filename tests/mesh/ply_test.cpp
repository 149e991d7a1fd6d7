// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include <sstream>

#include "mesh_files.h"

using namespace tofray;
using namespace tofray::mesh_test;

namespace {

using Encoding = PlyWriter::Encoding;

ReadMesh ply(const std::string& bytes) { return mesh::parse(Format::ply, bytes, "m.ply"); }

const std::string vertex_4 = "element vertex 4\nproperty float x\nproperty float y\nproperty float z\n";
const std::string face_list = "property list uchar int vertex_indices\n";

/// The corner's vertices, and what stands behind them.
PlyWriter with_vertices(Encoding encoding, const std::string& header) {
  PlyWriter file(encoding, vertex_4 + header);
  for (const auto& vertex : corner_vertices)
    for (const float number : vertex) file.put<float>(static_cast<double>(number));
  return file;
}

/// One list of vertices.
std::string one_list(Encoding encoding, const std::string& element, const std::vector<int>& indices) {
  PlyWriter file = with_vertices(encoding, "element " + element + " 1\nproperty list int int vertex_index\n");
  file.put<std::int32_t>(static_cast<double>(indices.size()));
  for (const int index : indices) file.put<std::int32_t>(index);
  return file.bytes;
}

}  // namespace

TEST(ply, in_every_encoding_is_the_mesh) {
  for (const Encoding encoding : every_encoding) expect_corner(ply(plain_ply(encoding)));
}

TEST(ply, of_every_type_of_number_is_the_mesh) {
  for (const Encoding encoding : every_encoding) {
    SCOPED_TRACE(static_cast<int>(encoding));
    expect_corner(ply(corner_ply<double, std::uint8_t, std::uint8_t>(encoding, "double", "uint8", "uchar", "vertex_index")));
    expect_corner(ply(corner_ply<double, std::int32_t, std::uint32_t>(encoding, "float64", "int", "uint")));
    expect_corner(ply(corner_ply<float, std::int8_t, std::int8_t>(encoding, "float32", "char", "int8")));
    expect_corner(ply(corner_ply<float, std::uint16_t, std::int16_t>(encoding, "float", "ushort", "int16", "vertex_index")));
    expect_corner(ply(corner_ply<float, std::int16_t, std::uint16_t>(encoding, "float", "short", "uint16")));
    expect_corner(ply(corner_ply<float, std::uint32_t, std::int32_t>(encoding, "float", "uint32", "int32")));
    const auto expect_scaled = [&](float scale, const std::string& bytes) {
      Vertices vertices = corner_vertices;
      for (auto& vertex : vertices)
        for (float& number : vertex) number *= scale;
      expect_mesh(ply(bytes), vertices, corner_triangles);
    };
    expect_scaled(-2, corner_ply<std::int8_t, std::uint8_t, std::int32_t>(encoding, "char", "uchar", "int", "vertex_indices", -2));
    expect_scaled(-600, corner_ply<std::int16_t, std::uint8_t, std::int32_t>(encoding, "int16", "uchar", "int", "vertex_indices", -600));
    expect_scaled(-1e6F, corner_ply<std::int32_t, std::uint8_t, std::int32_t>(encoding, "int", "uchar", "int", "vertex_indices", -1e6));
    expect_scaled(100, corner_ply<std::uint8_t, std::uint8_t, std::int32_t>(encoding, "uchar", "uchar", "int", "vertex_indices", 100));
    expect_scaled(3e4F, corner_ply<std::uint16_t, std::uint8_t, std::int32_t>(encoding, "uint16", "uchar", "int", "vertex_indices", 3e4));
    expect_scaled(2e9F, corner_ply<std::uint32_t, std::uint8_t, std::int32_t>(encoding, "uint", "uchar", "int", "vertex_indices", 2e9));
  }
}

TEST(ply, is_read_past_other_elements_and_properties) {
  for (const Encoding encoding : every_encoding) {
    SCOPED_TRACE(static_cast<int>(encoding));
    PlyWriter file(
        encoding,
        "obj_info from a test\nelement camera 2\nproperty double view\nproperty list ushort double weights\nelement nothing 4000000000\n"
        "element vertex 4\nproperty uchar red\nproperty float y\nproperty list uchar short tags\nproperty float x\nproperty double z\n"
        "comment\n\nelement face 4\nproperty list uchar float uv\nproperty list uchar int vertex_indices\nproperty short group\n"
        "element edge 1\nproperty int vertex1\nproperty int vertex2\n");
    file.put<double>(7).put<std::uint16_t>(0);
    file.put<double>(7).put<std::uint16_t>(2).put<double>(1).put<double>(2);
    for (const auto& [x, y, z] : corner_vertices) {
      file.put<std::uint8_t>(255).put<float>(static_cast<double>(y)).put<std::uint8_t>(2).put<std::int16_t>(-1).put<std::int16_t>(9);
      file.put<float>(static_cast<double>(x)).put<double>(static_cast<double>(z));
    }
    for (const auto& [a, b, c] : corner_triangles)
      file.put<std::uint8_t>(0).put<std::uint8_t>(3).put<std::int32_t>(a).put<std::int32_t>(b).put<std::int32_t>(c).put<std::int16_t>(5);
    file.put<std::int32_t>(0).put<std::int32_t>(77);
    expect_corner(ply(file.bytes));
  }
}

TEST(ply, may_say_twice_what_is_not_read) {
  const std::string text = "ply\nformat ascii 1.0\n" + vertex_4 + "property uchar flags\nproperty uchar flags\nelement face 1\n" +
                           face_list +
                           "property int group\nproperty int group\nend_header\n0 0 0 7 7 1 0 0 7 7 0 2 0 7 7 0 0 0.5 7 7 3 0 1 2 5 5";
  expect_mesh(ply(text), corner_vertices, {{0, 1, 2}});
}

namespace {

/// Luminance of grey as programs show it: IEC 61966-2-1.
double linear_of(double grey) { return grey <= 0.04045 ? grey / 12.92 : std::pow((grey + 0.055) / 1.055, 2.4); }

}  // namespace

TEST(ply, has_colours_by_each_name_that_programs_give_them) {
  for (const char* name : {"", "diffuse_"})
    for (const char* const letters : {"red green blue", "r g b"}) {
      if (*name != '\0' && letters[1] == ' ') continue;
      std::string properties, word;
      for (std::istringstream words(letters); words >> word;) properties += std::string("property uchar ") + name + word + "\n";
      SCOPED_TRACE(properties);
      const ReadMesh read =
          ply("ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n" + properties +
              "element face 1\n" + face_list + "end_header\n0 0 0 51 51 51 1 0 0 102 102 102 0 1 0 255 255 255 3 0 1 2");
      ASSERT_EQ(read.mesh.shades.size(), 3U);
      for (std::size_t i = 0; i < 3; ++i) EXPECT_NEAR(read.mesh.shades[i], linear_of(i == 0 ? 0.2 : i == 1 ? 0.4 : 1), 1e-6);
    }
}

TEST(ply, has_colours_of_faces) {
  // Two triangles and a square that share vertices; those between faces of different colours become several.
  for (const Encoding encoding : every_encoding) {
    PlyWriter file(
        encoding,
        "element vertex 5\nproperty float x\nproperty float y\nproperty float z\nelement face 3\nproperty list uchar int vertex_indices\n"
        "property uchar red\nproperty uchar green\nproperty uchar blue\nproperty uchar alpha\n");
    for (const auto& [x, y] : {std::pair{0, 0}, {1, 0}, {1, 1}, {0, 1}, {2, 0}}) file.put<float>(x).put<float>(y).put<float>(0);
    const auto face = [&](const std::vector<int>& corners, double grey) {
      file.put<std::uint8_t>(static_cast<double>(corners.size()));
      for (const int one : corners) file.put<std::int32_t>(one);
      for (int k = 0; k < 3; ++k) file.put<std::uint8_t>(grey);
      file.put<std::uint8_t>(255);
    };
    face({0, 1, 2, 3}, 51), face({1, 4, 2}, 102), face({4, 1, 0}, 51);
    const ReadMesh read = ply(file.bytes);
    ASSERT_EQ(read.mesh.triangles.size(), 4U);
    ASSERT_EQ(read.mesh.shades.size(), read.mesh.vertices.size());
    const double greys[] = {0.2, 0.2, 0.4, 0.2};
    for (std::size_t i = 0; i < 4; ++i)
      for (const std::int32_t corner : read.mesh.triangles[i])
        EXPECT_NEAR(read.mesh.shades[static_cast<std::size_t>(corner)], linear_of(greys[i]), 1e-6) << i;
    // Where corners are: the file's square, its first triangle.
    EXPECT_EQ(read.mesh.vertices[static_cast<std::size_t>(read.mesh.triangles[2][1])], (std::array<float, 3>{2, 0, 0}));
    EXPECT_EQ(read.mesh.vertices.size(), 5U + 3U);  // 1 and 2 in the second colour, 4 in the first
  }
}

TEST(ply, names_the_picture_that_it_wears) {
  const auto read = [&](const std::string& comment) {
    return ply("ply\nformat ascii 1.0\n" + comment +
               "element vertex 3\nproperty float x\nproperty float y\nproperty float z\nproperty float s\nproperty float t\nelement face "
               "1\n" +
               face_list + "end_header\n0 0 0 0 0 1 0 0 0 0 0 1 0 0 0 3 0 1 2");
  };
  EXPECT_TRUE(read("comment made by MeshLab\n").pictures.empty());
  EXPECT_TRUE(read("comment TextureFile\n").pictures.empty());
  const ReadMesh got = read("comment TextureFile my wood.png\n");
  ASSERT_EQ(got.pictures.size(), 1U);
  EXPECT_EQ(got.pictures[0].file, "my wood.png");
  EXPECT_EQ(got.pictures[0].place.line, 3);
  EXPECT_EQ(got.material_of, std::vector<std::int32_t>{0});
  EXPECT_TRUE(got.notices.empty());
}

// A square of two colours at a seam, as MeshLab writes it: lists of u, v, and which picture, behind each face's corners.
TEST(ply, gives_corners_the_texture_coordinates_of_their_faces) {
  const std::string header =
      "ply\nformat ascii 1.0\ncomment TextureFile a.png\ncomment TextureFile b.png\nelement vertex 5\nproperty float x\nproperty float "
      "y\nproperty float z\nproperty float nx\nproperty float ny\nproperty float nz\nelement face 3\n" +
      face_list + "property list uchar float texcoord\nproperty int texnumber\nend_header\n";
  const std::string vertices = "0 0 0 0 0 1\n1 0 0 0 1 0\n1 1 0 1 0 0\n0 1 0 0 0 1\n2 0 0 0 0 1\n";
  const ReadMesh got = ply(header + vertices + "4 0 1 2 3 8 0 0 1 0 1 1 0 1 1\n3 1 4 2 6 0.25 0 0.5 0 1 1 0\n3 0 3 4 0 -1\n");
  ASSERT_EQ(got.mesh.triangles.size(), 4U);
  EXPECT_EQ(got.materials, (std::vector<std::string>{"a.png", "b.png"}));
  EXPECT_EQ(got.material_of, (std::vector<std::int32_t>{1, 1, 0, -1}));
  const auto texcoord = [&](std::size_t triangle, std::size_t k) {
    return got.mesh.texcoords.at(static_cast<std::size_t>(got.mesh.triangles[triangle][k]));
  };
  using Texcoord = std::array<float, 2>;
  EXPECT_EQ(texcoord(0, 0), (Texcoord{0, 1}));  // v downward
  EXPECT_EQ(texcoord(0, 1), (Texcoord{1, 1}));
  EXPECT_EQ(texcoord(1, 2), (Texcoord{0, 0}));
  EXPECT_EQ(texcoord(2, 0), (Texcoord{0.25F, 1}));  // the same vertex as of triangle 0, corner 1
  EXPECT_EQ(texcoord(2, 2), (Texcoord{1, 0}));
  EXPECT_EQ(texcoord(3, 1), (Texcoord{0, 0}));
  EXPECT_EQ(got.mesh.normals.at(static_cast<std::size_t>(got.mesh.triangles[0][1])), (std::array<float, 3>{0, 1, 0}));
  EXPECT_EQ(got.mesh.normals.at(static_cast<std::size_t>(got.mesh.triangles[2][0])), (std::array<float, 3>{0, 1, 0}));
  EXPECT_NE(got.mesh.triangles[0][1], got.mesh.triangles[2][0]);
  const std::string file = header + vertices;
  expect_faults(Format::ply, {{file + "3 0 1 2 6 0 0 1 0 1 1 0\n4 0 1 2 3 6 0 0 1 0 1 1 0\n3 0 1 2 0 0\n",
                               "a face has not as many texture coordinates as corners\n  got 3 of 4"},
                              {file + "3 0 1 2 5 0 0 1 0 1 0\n3 0 1 2 0 0\n3 0 1 2 0 0\n",
                               "the texture coordinates of a face are an odd number\n  got 5"}});
}

TEST(ply, may_have_faces_before_its_vertices) {
  const std::string file =
      "ply\nformat ascii 1.0\nelement face 1\n" + face_list + vertex_4 + "end_header\n3 1 2 3\n0 0 0 1 0 0 0 2 0 0 0 0.5";
  expect_mesh(ply(file), corner_vertices, {{1, 2, 3}});
}

TEST(ply, has_lines_that_end_in_any_way) {
  for (const Encoding encoding : every_encoding) {
    const std::string file = plain_ply(encoding);
    const std::size_t data = file.find("end_header\n") + 11;
    for (const char* end : {"\r\n", "\r", " \n", "\t\r\n"})
      expect_corner(ply(replaced(file.substr(0, data), "\n", end) + file.substr(data)));
    if (encoding == Encoding::text) expect_corner(ply(replaced(file, "\n", "\r\n") + " \n\t\r"));
  }
}

TEST(ply, keeps_data_that_begin_like_an_end_of_line) {
  // The header's lines end with CR alone, and the first number's lowest byte is LF.
  const std::string header =
      "ply\rformat binary_little_endian 1.0\relement vertex 3\rproperty uchar x\rproperty char y\rproperty char z\relement face 1\r"
      "property list uchar uchar vertex_index\rend_header\r";
  const std::string data("\n\0\0\1\0\0\0\1\0\3\0\1\2", 13);
  const Vertices vertices = {{10, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  expect_mesh(ply(header + data), vertices, {{0, 1, 2}});
  expect_mesh(ply(replaced(header, "\r", "\n") + data), vertices, {{0, 1, 2}});
  expect_mesh(ply(replaced(header, "\r", "\r\n") + data), vertices, {{0, 1, 2}});
}

TEST(ply, takes_polygons_apart_as_fans) {
  for (const Encoding encoding : every_encoding) {
    expect_mesh(ply(one_list(encoding, "face", {3, 2, 1, 0})), corner_vertices, {{3, 2, 1}, {3, 1, 0}});
    std::vector<int> many(1'000'000);
    for (std::size_t i = 0; i < many.size(); ++i) many[i] = static_cast<int>(i % 4);
    const ReadMesh read = ply(one_list(encoding, "face", many));
    ASSERT_EQ(read.mesh.triangles.size(), many.size() - 2);
    EXPECT_EQ(read.mesh.triangles.back(), (std::array<std::int32_t, 3>{0, 2, 3}));
  }
}

TEST(ply, takes_strips_apart) {
  for (const Encoding encoding : every_encoding) {
    SCOPED_TRACE(static_cast<int>(encoding));
    const auto strip = [&](const std::vector<int>& indices) { return ply(one_list(encoding, "tristrips", indices)); };
    expect_mesh(strip({0, 1, 2, 3, 0}), corner_vertices, {{0, 1, 2}, {2, 1, 3}, {2, 3, 0}});
    expect_mesh(strip({0, 1, 2, -1, 3, 2, 1, -1, -1, 0, 1}), corner_vertices, {{0, 1, 2}, {3, 2, 1}});
    expect_mesh(strip({0, 1, 2, 2, 3, 0}), corner_vertices, {{0, 1, 2}, {3, 2, 0}});
  }
}

TEST(ply, drops_triangles_whose_corners_are_not_finite_and_counts_them) {
  const std::string header = vertex_4 + "element face 2\n" + face_list;
  for (const Encoding encoding : {Encoding::little, Encoding::big})
    for (const double bad : {std::nan(""), HUGE_VAL, -HUGE_VAL, 1e39}) {
      PlyWriter file(encoding, replaced(header, "float x", "double x"));
      for (int i = 0; i < 4; ++i) file.put<double>(i == 1 ? bad : i).put<float>(1).put<float>(2);
      file.put<std::uint8_t>(3).put<std::int32_t>(0).put<std::int32_t>(1).put<std::int32_t>(2);
      file.put<std::uint8_t>(3).put<std::int32_t>(0).put<std::int32_t>(2).put<std::int32_t>(3);
      expect_mesh(ply(file.bytes), {{0, 1, 2}, {2, 1, 2}, {3, 1, 2}}, {{0, 1, 2}}, 1);
    }
  for (const char* bad : {"nan", "-inf", "1e39", "0x1p1", "-nan(ind)"})
    expect_mesh(ply("ply\nformat ascii 1.0\n" + header + "end_header\n0 1 2\n" + bad + " 1 2\n2 1 2\n3 1 2\n3 0 1 2\n3 0 2 3\n"),
                {{0, 1, 2}, {2, 1, 2}, {3, 1, 2}}, {{0, 1, 2}}, 1);
}

TEST(ply, with_faults_in_its_header_says_where_and_what) {
  const std::string begin = "ply\nformat ascii 1.0\n", end = "end_header\n";
  const auto header = [&](const std::string& lines) { return begin + lines + end; };
  expect_faults(
      Format::ply,
      {{"", "m: error: this is no PLY file\n  got \"\" at its beginning, expected ply"},
       {"PLY\n", "m: error: this is no PLY file\n  got \"PLY\""},
       {"solid\n", "this is no PLY file"},
       {"ply", "m:1:1: error: the header has no end\n  expected end_header"},
       {"ply 1\n", "m:1:5: error: the line goes on where it should end\n  got \"1\""},
       {"ply\nend_header\n", "m:2:1: error: the header has no line \"format\"\n  expected format ascii 1.0"},
       {"ply\nformat\n", "m:2:7: error: the encoding is missing"},
       {"ply\nformat ascii\n", "m:2:13: error: the version is missing"},
       {"ply\nformat binary 1.0\n", "m:2:8: error: unknown encoding \"binary\"\n  expected format ascii 1.0, binary_little_endian 1.0 or"},
       {"ply\nformat ascii 1.1\n", "m:2:14: error: unknown version \"1.1\""},
       {"ply\nformat ascii 1.0 x\n", "m:2:18: error: the line goes on"},
       {begin + "format ascii 1.0\n", "m:3:14: error: the format is said twice"},
       {begin + "vertex 4\n", "m:3:1: error: unknown keyword \"vertex\" in the header\n  expected format, element, property"},
       {begin + "\x1b[1m\n", "unknown keyword \"\\x1b[1m\" in the header"},
       {begin + "element\n", "m:3:8: error: the element's name is missing"},
       {begin + "element vertex\n", "m:3:15: error: the number of the element's rows is missing"},
       {begin + "element vertex x\n", "m:3:16: error: the number of rows is none\n  got \"x\""},
       {begin + "element vertex -1\n", "the number of rows is none\n  got \"-1\""},
       {begin + "element vertex 4.0\n", "the number of rows is none\n  got \"4.0\""},
       {begin + "element vertex 18446744073709551616\n", "the number of rows is none"},
       {begin + "element vertex 4 4\n", "m:3:18: error: the line goes on"},
       {begin + vertex_4 + "element vertex 4\n", "m:7:9: error: element \"vertex\" comes twice"},
       {begin + "property float x\n", "m:3:1: error: a property stands before the first element"},
       {header(vertex_4 + "property float x\n") + "0 0 0 0", "m:7:16: error: property \"x\" comes twice"},
       {header(vertex_4 + "element face 1\n" + face_list + face_list) + "0 0 0 0 0 0 0 0 0 0 0 0 3 0 1 2",
        "m:9:25: error: property \"vertex_indices\" comes twice"},
       {begin + vertex_4 + "property\n", "m:7:9: error: the property's type is missing"},
       {begin + vertex_4 + "property float\n", "m:7:15: error: the property's name is missing"},
       {begin + vertex_4 + "property half w\n", "m:7:10: error: unknown type \"half\"\n  expected char, uchar"},
       {begin + vertex_4 + "property int64 w\n", "unknown type \"int64\""},
       {begin + vertex_4 + "property list\n", "the type of the list's length is missing"},
       {begin + vertex_4 + "property list uchar\n", "the type of the list's numbers is missing"},
       {begin + vertex_4 + "property list uchar int\n", "the property's name is missing"},
       {begin + vertex_4 + "property list float int w\n", "m:7:15: error: the length of a list is no whole number"},
       {begin + vertex_4 + "property list uchar list w\n", "unknown type \"list\""},
       {begin + vertex_4 + "property float w w\n", "the line goes on"},
       {begin + vertex_4, "m:7:1: error: the header has no end"},
       {begin + vertex_4 + "end_header x\n", "m:7:12: error: the line goes on"},
       {header(""), "m: error: the header has no element \"vertex\""},
       {header("element face 1\n" + face_list), "has no element \"vertex\""},
       {header("element vertex 1\nproperty float x\nproperty float y\n") + "0 0",
        "m:3:9: error: the vertices have no z\n  got \"x\" and \"y\", expected"},
       {header("element vertex 1\nproperty float X\n") + "0", "the vertices have no x\n  got \"X\", expected"},
       {header("element vertex 1\nproperty float x\nproperty list uchar float y\nproperty float z\n") + "0 0 0",
        "the vertices have no y\n  got \"x\", list \"y\" and \"z\""},
       {header(vertex_4 + "element face 1\nproperty uchar red\n") + "0 0 0 0 0 0 0 0 0 0 0 0 1",
        "m:7:9: error: \"face\" has no list vertex_indices\n  got \"red\""},
       {header(vertex_4 + "element face 1\nproperty int vertex_index\n") + "0 0 0 0 0 0 0 0 0 0 0 0 1",
        "vertex_index of \"face\" is no list of whole numbers"},
       {header(vertex_4 + "element face 1\nproperty list uchar float vertex_index\n") + "0 0 0 0 0 0 0 0 0 0 0 0 1",
        "is no list of whole numbers"},
       {header(vertex_4 + "element face 1\n" + face_list + "property list uchar int vertex_index\n") + "0 0 0 0 0 0 0 0 0 0 0 0 1",
        "\"face\" has both vertex_indices and vertex_index"},
       {header("element vertex 0\nproperty float x\nproperty float y\nproperty float z\n"), "m: error: the mesh is empty"},
       {header("element vertex 4\n"), "m:3:9: error: the vertices have no x\n  got none, expected x, y and z"},
       {header("element vertex 3\nelement face 1\n" + face_list) + "3 0 1 2", "m:3:9: error: the vertices have no x"},
       {header(vertex_4) + "0 0 0 0 0 0 0 0 0 0 0 0",
        "m: error: the mesh has vertices (4), but no faces\n  expected a mesh of triangles or polygons; a cloud of points has no surface"},
       {header(vertex_4 + "element face 0\n" + face_list) + "0 0 0 0 0 0 0 0 0 0 0 0", "has vertices (4), but no faces"},
       {header(vertex_4) + "0 0 0 0 0 0 0 0 0 0 0",
        "m:3:9: error: the file is too short for element \"vertex\"\n  got 4 as the number of rows"},
       {replaced(header(vertex_4), "vertex 4", "vertex 18446744073709551615") + "0 0 0",
        "too short for element \"vertex\"\n  got 18446744073709551615"},
       {replaced(header(vertex_4), "vertex 4", "vertex 2147483648") + "0 0 0", "too short for element \"vertex\""}});
}

TEST(ply, with_faults_in_its_text_says_where_and_what) {
  const std::string begin = "ply\nformat ascii 1.0\n" + vertex_4 + "element face 1\n" + face_list + "end_header\n";  // 9 lines
  const std::string vertices = "0 0 0\n1 0 0\n0 2 0\n0 0 0.5\n";
  expect_faults(
      Format::ply,
      {{begin + replaced(vertices, "2", "z") + "3 0 1 2", "m:12:3: error: a number is none\n  got \"z\", expected a number such as 0.25"},
       {begin + replaced(vertices, "2", "0,2") + "3 0 1 2", "got \"0,2\""},
       {begin + vertices, "m:7:9: error: the file is too short for element \"face\"\n  got 1"},
       {begin + vertices + "3 0 1", "the file is too short for element \"face\""},
       {begin.substr(0, begin.size() - 11) + "property uchar red\nend_header\n" + vertices + "3 0 1 0000002",
        "m:15:14: error: the file is cut short\n  expected a number"},
       {begin + vertices + "3 0 1 4",
        "m:14:7: error: an index is none of a vertex\n  got 4, and there are 4 vertices, of which the first is 0"},
       {begin + vertices + "3 0 1 -1", "m:14:7: error: an index is none of a vertex\n  got -1"},
       {begin + vertices + "3 0 1 4294967296", "an index is none of a vertex\n  got 4294967296"},
       {begin + vertices + "3 0 1 99999999999999999999", "an index is none of a vertex"},
       {begin + vertices + "3 0 1 2.0", "m:14:7: error: a whole number is none\n  got \"2.0\""},
       {begin + vertices + "3 0 1 x", "a whole number is none\n  got \"x\""},
       {begin + vertices + "2 0 1 2", "m:14:1: error: a face has fewer than 3 corners\n  got 2, expected 3 or more"},
       {begin + vertices + "0 0 1 2", "a face has fewer than 3 corners\n  got 0"},
       {begin + vertices + "-3 0 1 2", "m:14:1: error: a list is longer than the rest of the file\n  got -3 values"},
       {begin + vertices + "300 0 1 2", "m:14:1: error: a list is longer than the rest of the file\n  got 300 values in 6 bytes"},
       {begin + vertices + "99999999999999999999 0 1 2", "a list is longer than the rest of the file"},
       {begin + vertices + "3 0 1 2\n3 0 1 2\n", "m:15:1: error: 8 bytes are left over behind the last element\n  got \"3\""},
       {begin + vertices + "3 0 1 2 \x1b]0;x", "5 bytes are left over behind the last element\n  got \"\\x1b]0;x\""},
       {begin + "nan 0 0 nan 0 0 nan 0 0 nan 0 0 4 0 1 2 3", "m: error: each of the 2 triangles has a corner that is not a finite number"},
       {replaced(begin, "element face 1", "element tristrips 1") + vertices + "2 0 1", "m: error: the mesh has vertices (4), but no faces"},
       {replaced(begin, "element face 1", "element tristrips 1") + vertices + "3 0 1 -2", "an index is none of a vertex\n  got -2"},
       {replaced(begin, "element face 1", "element other 1") + vertices + "x", "a whole number is none\n  got \"x\""}});
}

TEST(ply, with_faults_in_its_binary_data_says_where_and_what) {
  for (const Encoding encoding : {Encoding::little, Encoding::big}) {
    SCOPED_TRACE(static_cast<int>(encoding));
    const std::string vertices = with_vertices(encoding, "element face 2\n" + face_list).bytes;
    const std::size_t at = vertices.size();  // of the first face
    const auto face = [&](int length, const std::vector<int>& indices) {
      std::string bytes = number_bytes(static_cast<std::uint8_t>(length), false);
      for (const int index : indices) bytes += number_bytes(index, encoding == Encoding::big);
      return bytes;
    };
    const std::string good = face(3, {0, 1, 2});
    const auto byte = [&](std::size_t offset) { return "(byte " + std::to_string(at + offset); };
    expect_faults(
        Format::ply,
        {{vertices.substr(0, at - 1), "m:3:9: error: the file is too short for element \"vertex\"\n  got 4"},
         {vertices + good, "m:7:9: error: the file is too short for element \"face\"\n  got 2"},
         {vertices + good + face(3, {0, 1}) + "abc", "too short for element \"face\""},
         {vertices + good + face(4, {0, 1, 2}),
          "m: error: a list is longer than the rest of the file " + byte(13) + ", \"face\" 2)\n  got 4 values in 12 bytes"},
         {vertices + face(255, {0, 1, 2, 3, 0, 0, 0}),
          "m: error: a list is longer than the rest of the file " + byte(0) + ", \"face\" 1)\n  got 255 values in 28 bytes"},
         {vertices + face(6, {0, 1, 2, 3, 0, 1}) + "x",
          "error: a list is longer than the rest of the file " + byte(25) + ", \"face\" 2)\n  got 120 values in 0 bytes"},
         {vertices + face(2, {0, 1}) + face(3, {0, 1, 2, 3}),
          "m: error: a face has fewer than 3 corners " + byte(0) + ", \"face\" 1)\n  got 2"},
         {vertices + good + face(3, {0, 1, 4}),
          "m: error: an index is none of a vertex " + byte(22) + ", \"face\" 2)\n  got 4, and there are 4 vertices"},
         {vertices + good + face(3, {-1, 1, 2}), "m: error: an index is none of a vertex " + byte(14) + ", \"face\" 2)\n  got -1"},
         {vertices + good + face(3, {0, 1, 0x7FFFFFFF}), "got 2147483647"},
         {vertices + good + good + "\n", "m: error: 1 bytes are left over behind the last element " + byte(26) + ")"},
         {vertices + good + good + good, "m: error: 13 bytes are left over behind the last element"},
         {replaced(vertices, "list uchar int", "list char int") + good + face(-1, {0, 1, 2}), "a list is longer than the rest of the file"},
         {replaced(vertices, "face 2", "face 1") + face(6, {0, 1, 2, 3, 0, 1}) + good.substr(0, 12), "12 bytes are left over"}});
  }
}
