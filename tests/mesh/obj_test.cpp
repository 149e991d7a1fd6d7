// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include "mesh_files.h"

using namespace tofray;
using namespace tofray::mesh_test;

namespace {

ReadMesh obj(const std::string& text) { return mesh::parse(Format::obj, text, "m.obj"); }

const std::string four = "v 0 0 0\nv 1 0 0\nv 0 2 0\nv 0 0 0.5\n";  // lines 1 to 4

}  // namespace

TEST(obj, of_every_style_of_index_is_the_mesh) { expect_corner(obj(corner_obj)); }

TEST(obj, counts_negative_indices_from_the_last_vertex_so_far) {
  expect_corner(obj("v 0 0 0\nv 1 0 0\nv 0 2 0\nf -3 -1 -2\nv 0 0 0.5\nf -4 -3 -1\nf -4/-1 -1/-1 -2/-1\nf 2//-1 -2//-1 -1//-1\n"));
}

TEST(obj, may_have_faces_before_their_vertices) {
  expect_mesh(obj("f 1 2 3\nv 0 0 0\nv 1 0 0\nv 0 2 0\n"), {{0, 0, 0}, {1, 0, 0}, {0, 2, 0}}, {{0, 1, 2}});
}

TEST(obj, has_lines_that_end_in_any_way) {
  for (const char* end : {"\r\n", "\r", "\n\n", " \t\n", " #x\n", "\n  \r\n\t"}) expect_corner(obj(replaced(corner_obj, "\n", end)));
  expect_corner(obj(corner_obj.substr(0, corner_obj.size() - 1)));
  expect_corner(obj("\xEF\xBB\xBF" + corner_obj));
  expect_corner(obj(replaced(corner_obj.substr(13), " ", "\t ")));
}

TEST(obj, goes_on_in_the_next_line_behind_a_backslash_but_in_comments) {
  expect_corner(obj(replaced(corner_obj.substr(13), " ", " \\\n")));
  expect_corner(obj(replaced(corner_obj.substr(13), " ", "\\\r\n")));
  expect_corner(obj("# C:\\\n#\\\n" + corner_obj));
  expect_corner(obj("g a#1 \\\nf 7 8 9\n" + corner_obj));
  expect_corner(obj("v 0 0 0 # C:\\\n" + corner_obj.substr(21)));
  expect_corner(obj("g one \\\nf 7 8 9\n" + corner_obj));
  expect_corner(obj("mtllib C:\\mesh.mtl\n" + corner_obj));
}

TEST(obj, takes_polygons_apart_as_fans) {
  const Vertices corners = {{0, 0, 0}, {1, 0, 0}, {0, 2, 0}, {0, 0, 0.5F}};
  expect_mesh(obj(four + "f 1 2 3 4\n"), corners, {{0, 1, 2}, {0, 2, 3}});
  expect_mesh(obj(four + "fo 4 3 2 1 4\n"), corners, {{3, 2, 1}, {3, 1, 0}, {3, 0, 3}});
}

TEST(obj, takes_a_million_corners_of_one_face_apart_in_linear_time) {
  std::string text = four + "f";
  for (int i = 0; i < 1'000'000; ++i) text += i % 2 == 0 ? " 1" : " -1";
  const ReadMesh read = obj(text);
  ASSERT_EQ(read.mesh.triangles.size(), 999'998U);
  EXPECT_EQ(read.mesh.triangles.front(), (std::array<std::int32_t, 3>{0, 3, 0}));
  EXPECT_EQ(read.mesh.triangles.back(), (std::array<std::int32_t, 3>{0, 0, 3}));
}

TEST(obj, is_read_past_what_is_no_polygon) {
  for (const char* line : {"vt 0 1",      "vn 0 0 x",     "o name",   "g a b",        "s off",       "s 1",      "mg 1 0.5",
                           "usemtl m#1",  "mtllib a.mtl", "l 1 2 3",  "p 1",          "lod 3",       "bevel on", "c_interp off",
                           "d_interp on", "usemap off",   "maplib a", "shadow_obj a", "trace_obj b", "vn",       "# f 9 9 9"}) {
    SCOPED_TRACE(line);
    expect_corner(obj(line + std::string("\n") + corner_obj + line));
  }
}

TEST(obj, takes_vertices_with_a_weight_or_a_colour) {
  const std::string faces = "f 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n";
  expect_corner(obj("v 0 0 0 1\nv 1 0 0 0.5 0.5 0.5\nv 0 2 0 1 0.5 0.5 0.5\nv 0 0 0.5 nan\n" + faces));
}

TEST(obj, has_the_colour_behind_the_place_with_or_without_opacity) {
  // 0.2126 R + 0.7152 G + 0.0722 B of what sRGB decodes: 0.1 is 0.010023, 0.2 is 0.033105, 0.3 is 0.073239.
  const ReadMesh read = obj("v 0 0 0 0.1 0.2 0.3\nv 1 0 0 0.1 0.2 0.3 1\nv 0 1 0 0.1 0.2 0.3 0.5\nf 1 2 3\n");
  ASSERT_EQ(read.mesh.shades.size(), 3U);
  for (const float shade : read.mesh.shades) EXPECT_NEAR(shade, 0.2126 * 0.010023 + 0.7152 * 0.033105 + 0.0722 * 0.073239, 1e-6);
}

TEST(obj, tells_of_lines_that_begin_with_unknown_words) {
  expect_corner(obj("t 1 2\nvw 3\n" + corner_obj + "-colorspace sRGB\n"));
  EXPECT_EQ(
      obj("# a\nt 1 2\nvw 3\n" + corner_obj).notices,
      std::vector<std::string>{"2 lines are read past that begin with a word unknown in OBJ files: \"t\" in line 2; did you mean \"vt\"?"});
  EXPECT_EQ(obj(corner_obj + "usemlt a\n").notices,
            std::vector<std::string>{"1 line is read past that begins with a word unknown in OBJ files: "
                                     "\"usemlt\" in line 10; did you mean \"usemtl\"?"});
}

TEST(obj, names_files_of_materials_in_quotation_marks) {
  const auto libraries = [](const std::string& line) {
    std::vector<std::string> out;
    for (const mesh::Reference& one : obj(line + "\n" + corner_obj).libraries) out.push_back(one.file);
    return out;
  };
  EXPECT_EQ(libraries("mtllib \"my wood.mtl\""), std::vector<std::string>{"my wood.mtl"});
  EXPECT_EQ(libraries("mtllib \"a.mtl\" \"b c.mtl\""), (std::vector<std::string>{"a.mtl", "b c.mtl"}));
  EXPECT_EQ(libraries("mtllib \"a.mtl"), std::vector<std::string>{"a.mtl"});
  EXPECT_EQ(libraries("mtllib \"\""), std::vector<std::string>{});
}

TEST(obj, reads_numbers_of_all_forms) {
  const ReadMesh read =
      obj("v +1 -2.5 .5\nv 1. 1e2 +1E-2\nv 1e-400 -0 0.1\nv 3.4028234e38 0." + std::string(400, '0') + "1e401 0e999999999999\nf 1 2 3 4\n");
  expect_mesh(read, {{1, -2.5F, 0.5F}, {1, 100, 0.01F}, {0, 0, 0.1F}, {3.4028234e38F, 1, 0}}, {{0, 1, 2}, {0, 2, 3}});
}

TEST(obj, tells_numbers_too_small_for_double_from_those_too_large) {
  const std::string zeros(400, '0');
  expect_mesh(obj("v 0." + zeros + "1 -1e-400 1" + zeros + "e-401\nv 1 0 0\nv 0 1 0\nv 1" + zeros + " 0 0\nv 0." + zeros +
                  "1e800 0 0\nf 1 2 3\nf 1 2 4\nf 1 2 5\n"),
              {{0, 0, 0.1F}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}}, 2);
}

TEST(obj, drops_triangles_whose_corners_are_not_finite_and_counts_them) {
  for (const char* number : {"nan", "NaN", "-nan(ind)", "inf", "-Infinity", "+inf", "1e39", "-1e39", "1e999", "-1e99999999999999999999",
                             "0x1p3", "-0X1F", "1.#QNAN", "-1.#IND", "1.#INF", "3.5e38"}) {
    SCOPED_TRACE(number);
    const std::string bad = std::string("v 0 0 ") + number + "\n";
    expect_mesh(obj(bad + "v 0 0 0\nv 1 0 0\n" + bad + "v 0 2 0\nf 2 3 5\nf 1 2 3\nf 5 3 2 4\n"), {{0, 0, 0}, {1, 0, 0}, {0, 2, 0}},
                {{0, 1, 2}, {2, 1, 0}}, 2);
  }
}

TEST(obj, with_faults_says_where_and_what) {
  expect_faults(Format::obj,
                {{"", "m: error: the mesh is empty\n  got neither vertices nor faces"},
                 {"\n# nothing\n\\\n", "m: error: the mesh is empty"},
                 {four, "m: error: the mesh has vertices (4), but no faces"},
                 {"v 0 0 nan\nf 1 1 1 1", "m: error: each of the 2 triangles has a corner that is not a finite number"},
                 {four + "f 1 2 0", "m:5:7: error: a face has a corner of index 0\n  expected 1 for the first vertex"},
                 {four + "f 1 2 5", "m:5:7: error: a face has a corner beyond the last vertex\n  got 5, the file has 4 vertices"},
                 {"f 1 7 2\n" + four, "m:1:5: error: a face has a corner beyond the last vertex\n  got 7, the file has 4 vertices"},
                 {four + "f 1 2 20000001", "m:5:7: error: a face has a corner beyond the last vertex\n  got 20000001"},
                 {four + "f 1 2 99999999999999999999999", "m:5:7: error: a face has a corner beyond the last vertex"},
                 {four + "f 1 2 4294967297", "beyond the last vertex"},
                 {four + "f 1 -5 2", "m:5:5: error: a face has a corner before the first vertex\n  got -5 after 4 vertices"},
                 {"f -1 -2 -3\n" + four, "m:1:3: error: a face has a corner before the first vertex\n  got -1 after 0 vertices"},
                 {four + "f 1 2 -99999999999999999999999", "before the first vertex"},
                 {four + "f", "m:5:1: error: a face has fewer than 3 corners\n  got 0, expected 3 or more"},
                 {four + " f 1", "m:5:2: error: a face has fewer than 3 corners\n  got 1"},
                 {four + "f 1 2 # 3", "m:5:1: error: a face has fewer than 3 corners\n  got 2"},
                 {four + "f 1 2\\\n\n", "m:5:1: error: a face has fewer than 3 corners\n  got 2"},
                 {four + "f 1 2 x", "m:5:7: error: the corner of a face is no index\n  got \"x\""},
                 {four + "f 1 2 3.0", "got \"3.0\", expected a whole number"},
                 {four + "f 1 2 /3", "got \"/3\""},
                 {four + "f 1 2 3/a", "got \"3/a\""},
                 {four + "f 1 2 3/1/1/1", "got \"3/1/1/1\""},
                 {four + "f 1 2 3///", "got \"3///\""},
                 {four + "f 1 2 +-3", "got \"+-3\""},
                 {four + "f 1 2 ++3", "got \"++3\""},
                 {four + "f 1 2 0x3", "got \"0x3\""},
                 {four + "f 1 2 3\\ 4", "got \"3\\\""},
                 {four + "f 1 2 \x1b[31m", "got \"\\x1b[31m\""},
                 {four + "f 1 2 " + std::string(5000, '/'), "/…\", expected a whole number"},
                 {"v", "m:1:1: error: a vertex does not have three coordinates\n  got 0 numbers"},
                 {"v 1", "got 1 number,"},
                 {"v 1 2", "got 2 numbers,"},
                 {"v 1 2 3 4 5", "got 5 numbers,"},
                 {"\n v 1 2 3 4 5 6 7 8", "m:2:2: error: a vertex does not have three coordinates\n  got 8 numbers,"},
                 {"v 1 2 x", "m:1:7: error: a coordinate is no number\n  got \"x\""},
                 {"v 1 2 1,5", "got \"1,5\", expected a number such as 0.25"},
                 {"v 1 2 1.5f", "got \"1.5f\""},
                 {"v 1 2 0x", "got \"0x\""},
                 {"v 1 2 0xg", "got \"0xg\""},
                 {"v 1 2 1.#inf", "got \"1.#inf\""},
                 {four + "f 1 2 3#4", "got \"3#4\""},
                 {"v 1 2 +", "got \"+\""},
                 {"v 1 2 -", "got \"-\""},
                 {"v 1 2 +-1", "got \"+-1\""},
                 {"v 1 2 1e", "got \"1e\""},
                 {"v 1 2 infinit", "got \"infinit\""},
                 {"v 1 2 3 colour", "got \"colour\""},
                 {std::string("v 1 2 3\0", 8), "got \"3\\x00\""},
                 {"v 1 2 \xE2\x80\xAE", "got \"\\u202e\""},
                 {"vp 1 2", "m:1:1: error: curves and surfaces of free form are not read: \"vp\"\n  expected polygons"},
                 {four + "cstype bezier", "m:5:1: error: curves and surfaces of free form are not read: \"cstype\""},
                 {"curv 0 1 1 2", "free form are not read: \"curv\""},
                 {"curv2 1 2", "free form are not read: \"curv2\""},
                 {"surf 0 1 0 1 1", "free form are not read: \"surf\""},
                 {"deg 3", "free form are not read: \"deg\""},
                 {"bsp 1 2", "free form are not read: \"bsp\""},
                 {"end", "free form are not read: \"end\""},
                 {"call other.obj", "m:1:1: error: what other files or programs give is not read: \"call\""},
                 {"csh ls", "programs give is not read: \"csh\""},
                 {"V 1 2 3", "m:1:1: error: unknown keyword \"V\""},
                 {"usemlt a", "unknown keyword \"usemlt\"; did you mean \"usemtl\"?"},
                 {"v1 2 3", "unknown keyword \"v1\""},
                 {"ply\nformat ascii 1.0", "m:1:1: error: unknown keyword \"ply\""},
                 {"\x7F"
                  "ELF\x02\x01",
                  "unknown keyword \"\\u007fELF\\x02\\x01\""},
                 {std::string(100000, 'a'), "unknown keyword \"aaaaaaaaaa"},
                 {"\r\r\nf 1", "m:3:1: error: a face has fewer"},
                 {"v 0 0 \\\r\n0 \\\n\\\rx", "m:4:1: error: a coordinate is no number"}});
}

// As CAD programs write it: the mesh of a part, and beside it the curves that trim its surfaces.
TEST(obj, leaves_out_curves_and_surfaces_beside_polygons) {
  const mesh::ReadMesh got =
      obj("v 0 0 0\nv 1 0 0\nv 0 2 0\nv 0 0 0.5\nf 1 2 3\ncstype rat bspline\ndeg 3\ncurv 0 1 1 2 3 4\nparm u 0 0 1 1\nend\n"
          "curv 0 1 4 3 2 1\nend\ndeg 1 1\nsurf 0 1 0 1 1 2 3 4\nend\nf 1 3 4\n");
  EXPECT_EQ(got.mesh.triangles.size(), 2U);
  EXPECT_EQ(got.notices, std::vector<std::string>{"curves and surfaces of free form are left out: \"curv\" (2 times) and \"surf\", from "
                                                  "line 6 on; polygons alone are seen"});
}
