// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include "mesh_files.h"

using namespace tofray;
using namespace tofray::mesh_test;

namespace {

ReadMesh stl(const std::string& bytes) { return mesh::parse(Format::stl, bytes, "m.stl"); }

const std::string facet = "facet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\nendloop\nendfacet\n";

std::string upper(std::string text) {
  for (char& c : text) c = c >= 'a' && c <= 'z' ? static_cast<char>(c - 'a' + 'A') : c;
  return text;
}

}  // namespace

TEST(stl, as_text_is_the_mesh_with_shared_vertices) {
  expect_mesh(stl(text_stl()), stl_vertices, stl_triangles);
  for (const char* end : {"\r\n", "\r", "\n\n\t"}) expect_mesh(stl(replaced(text_stl(), "\n", end)), stl_vertices, stl_triangles);
  expect_mesh(stl("\xEF\xBB\xBF" + text_stl()), stl_vertices, stl_triangles);
  expect_mesh(stl(" \n\t" + upper(text_stl())), stl_vertices, stl_triangles);
}

TEST(stl, as_text_needs_no_name_and_may_have_many_solids) {
  const Vertices vertices = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  expect_mesh(stl("solid\n" + facet + "endsolid"), vertices, {{0, 1, 2}});
  expect_mesh(stl("solid a\nendsolid a\nsolid facet normal\n" + facet + facet + "endsolid b c\n\nsolid\n" + facet + "endsolid\n"), vertices,
              {{0, 1, 2}, {0, 1, 2}, {0, 1, 2}});
}

TEST(stl, as_binary_is_the_mesh_with_shared_vertices) { expect_mesh(stl(binary_stl()), stl_vertices, stl_triangles); }

TEST(stl, as_binary_may_begin_with_solid) {
  for (const char* header : {"solid", "solid name\nfacet normal 0 0 1\nouter loop\n", " SOLID "})
    expect_mesh(stl(binary_stl(header)), stl_vertices, stl_triangles);
  expect_mesh(stl(binary_stl(std::string("solid\0", 6))), stl_vertices, stl_triangles);
}

TEST(stl, merges_corners_at_the_very_same_place_alone) {
  const float next = std::nextafter(1.F, 2.F);
  const std::string text = "solid\n" + facet + replaced(replaced(facet, " 0", " -0"), "vertex 1", "vertex 1.00000011920929") + "endsolid";
  expect_mesh(stl(text), {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {next, 0, 0}}, {{0, 1, 2}, {0, 3, 2}});
  EXPECT_FALSE(std::signbit(stl("solid\n" + replaced(facet, "vertex 0", "vertex -0") + "endsolid").mesh.vertices[0][0]));
}

TEST(stl, merges_the_corners_of_a_large_grid) {
  // n × n vertices, each of six triangles but for the rim
  constexpr int n = 300;
  std::string bytes(80, ' ');
  bytes += number_bytes(static_cast<std::uint32_t>(2 * (n - 1) * (n - 1)), false);
  const auto record = [&](const std::array<std::array<int, 2>, 3>& corners) {
    bytes += std::string(12, '\0');
    for (const auto& [x, y] : corners)
      bytes += number_bytes(static_cast<float>(x), false) + number_bytes(static_cast<float>(y), false) + number_bytes(1.F, false);
    bytes += std::string(2, '\0');
  };
  for (int y = 0; y + 1 < n; ++y)
    for (int x = 0; x + 1 < n; ++x) {
      record({{{x, y}, {x + 1, y}, {x, y + 1}}});
      record({{{x, y + 1}, {x + 1, y}, {x + 1, y + 1}}});
    }
  const ReadMesh read = stl(bytes);
  ASSERT_EQ(read.mesh.vertices.size(), static_cast<std::size_t>(n * n));
  ASSERT_EQ(read.mesh.triangles.size(), static_cast<std::size_t>(2 * (n - 1) * (n - 1)));
  for (std::size_t i = 0; i < read.mesh.triangles.size(); ++i) {
    const auto cell = static_cast<int>(i / 2);
    const bool second = i % 2 == 1;
    const auto& corner = read.mesh.vertices[static_cast<std::size_t>(read.mesh.triangles[i][2])];
    ASSERT_EQ(corner,
              (std::array<float, 3>{static_cast<float>(cell % (n - 1) + (second ? 1 : 0)), static_cast<float>(cell / (n - 1) + 1), 1}));
  }
}

TEST(stl, drops_triangles_whose_corners_are_not_finite_and_counts_them) {
  Vertices vertices = corner_vertices;
  vertices[1][2] = std::nanf("");  // of three of the four
  expect_mesh(stl(binary_stl("", vertices)), {{0, 0, 0}, {0, 0, 0.5F}, {0, 2, 0}}, {{0, 1, 2}}, 3);
  for (const char* number : {"nan", "-inf", "1e39", "-1.#IND", "0x1p1"})
    expect_mesh(stl("solid\n" + facet + replaced(facet, "vertex 1", std::string("vertex ") + number) + "endsolid"),
                {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}}, 1);
  expect_mesh(stl("solid\n" + replaced(facet, "normal 0 0 1", "normal nan inf -nan(ind)") + "endsolid"), {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}},
              {{0, 1, 2}});
}

TEST(stl, as_text_with_faults_says_where_and_what) {
  const auto with = [](const std::string& what, const std::string& by) { return "solid\n" + replaced(facet, what, by) + "endsolid\n"; };
  expect_faults(Format::stl, {{"solid", "m:1:6: error: the file is cut short\n  expected facet or endsolid"},
                              {"solid\n" + facet, "m:9:1: error: the file is cut short\n  expected facet or endsolid"},
                              {"solid\nendsolid", "m: error: the mesh is empty"},
                              {"solidify\n", "m:1:1: error: solid is missing\n  got \"solidify\""},
                              {"solid\n" + facet + "endsolid\nfacet", "m:10:1: error: solid is missing\n  got \"facet\""},
                              {"solid\n" + facet + "stop", "m:9:1: error: facet or endsolid is missing\n  got \"stop\""},
                              {with("endloop", "end"), "m:8:1: error: endloop is missing\n  got \"endfacet\""},
                              {"solid\n" + facet + "solid\n", "facet or endsolid is missing\n  got \"solid\""},
                              {with("normal", "n"), "m:2:7: error: normal is missing\n  got \"n\""},
                              {with("normal 0 0 1", "normal 0 0"), "m:3:1: error: a coordinate is no number\n  got \"outer\""},
                              {with("normal 0 0 1", "normal 0 0 z"), "m:2:18: error: a coordinate is no number\n  got \"z\""},
                              {with("normal 0 0 1", "normal 0 0 1 1"), "m:2:20: error: outer is missing\n  got \"1\""},
                              {with("outer", "inner"), "m:3:1: error: outer is missing"},
                              {with("outer loop", "outer"), "m:4:1: error: loop is missing\n  got \"vertex\""},
                              {with("vertex 1 0 0\n", ""), "m:6:1: error: vertex is missing\n  got \"endloop\""},
                              {with("vertex 1 0 0", "vertex 1 0"), "m:6:1: error: a coordinate is no number\n  got \"vertex\""},
                              {with("vertex 1 0 0", "vertex 1 0 0 0"), "m:5:14: error: vertex is missing\n  got \"0\""},
                              {with("vertex 1 0 0", "vertex 1 0 0,5"), "m:5:12: error: a coordinate is no number\n  got \"0,5\""},
                              {with("endloop", "vertex 0 0 0 endloop"), "m:7:1: error: endloop is missing\n  got \"vertex\""},
                              {with("endfacet", ""), "m:9:1: error: endfacet is missing\n  got \"endsolid\""},
                              {with("vertex 1 0 0", "vertex inf 0 0"), "m: error: each of the 1 triangles has a corner"},
                              {"solid\n" + replaced(facet, "1", "\x1b[2J"), "got \"\\x1b[2J\""}});
}

TEST(stl, as_binary_with_faults_says_what) {
  const std::string good = binary_stl();
  const auto counted = [&](std::uint32_t count) { return good.substr(0, 80) + number_bytes(count, false) + good.substr(84); };
  expect_faults(
      Format::stl,
      {{"", "m: error: this is no STL file\n  got 0 bytes, expected a text that begins with solid"},
       {good.substr(0, 83), "m: error: this is no STL file\n  got 83 bytes"},
       {good.substr(0, 84),
        "m: error: the file is cut short, or no STL file\n  its header says 4 triangles, which make 284 bytes; it has 84"},
       {good.substr(0, 283), "which make 284 bytes; it has 283"},
       {good + "x",
        "m: error: 1 bytes are left over behind the last triangle\n  its header says 4 triangles, which make 284 bytes; it has 285"},
       {counted(3), "50 bytes are left over behind the last triangle"},
       {counted(5), "its header says 5 triangles, which make 334 bytes; it has 284"},
       {counted(0xFFFFFFFF), "its header says 4294967295 triangles, which make 214748364834 bytes; it has 284"},
       {counted(0), "200 bytes are left over"},
       {std::string(84, '\0'), "m: error: the mesh is empty"},
       {binary_stl("solid").substr(0, 200), "which make 284 bytes; it has 200"},
       {binary_stl("solid") + "x", "1 bytes are left over"},
       {"v 0 0 0\nf 1 1 1\n", "m: error: this is no STL file\n  got 16 bytes"},
       {corner_obj, "the file is cut short, or no STL file"}});
}

TEST(stl, as_text_may_end_as_other_programs_end_it) {
  const Vertices corners = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  const std::pair<const char*, std::size_t> ends[] = {
      {"endsolid", 0},           {"end solid part", 0},   {"END", 0},
      {"EndSolid a b c\r\n", 0}, {"endsolid\r\n\x1A", 1}, {"endsolid\nexported by a program\n", 1}};
  for (const auto& [end, notices] : ends) {
    SCOPED_TRACE(end);
    const ReadMesh read = stl("solid\n" + facet + end);
    expect_mesh(read, corners, {{0, 1, 2}});
    EXPECT_EQ(read.notices.size(), notices);
  }
  expect_mesh(stl("solid\n" + replaced(replaced(facet, "endloop", "end loop"), "endfacet", "End Facet") + "endsolid\n"), corners,
              {{0, 1, 2}});
}
