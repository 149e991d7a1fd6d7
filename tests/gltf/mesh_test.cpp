// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
// Triangles of primitives, and what is given at their vertices.
#include "base/limits.h"
#include "gltf_files.h"

using namespace tofray;
using namespace tofray::gltf_test;

namespace {

/// Five vertices in the plane z = 0, and triangles of them in one of glTF's modes.
Part of_mode(int mode, const std::vector<std::uint16_t>& indices) {
  File file;
  const int mesh = file.mesh({{"POSITION", file.floats({0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0, 0, 2, 0}, "VEC3")}});
  if (!indices.empty()) file.primitive(mesh)["indices"] = file.accessor<std::uint16_t>(indices, "SCALAR");
  file.primitive(mesh)["mode"] = mode;
  file.node({{"mesh", mesh}});
  return parts_at_rest(model_of(file)).at(0);
}

/// Twice the area of each triangle in the plane z = 0, above 0 where it is counterclockwise as seen from +z.
std::vector<float> turns(const Part& part) {
  std::vector<float> out;
  for (const auto& [a, b, c] : part.mesh.triangles) {
    const auto at = [&](std::int32_t i) { return part.mesh.vertices[static_cast<std::size_t>(i)]; };
    out.push_back((at(b)[0] - at(a)[0]) * (at(c)[1] - at(a)[1]) - (at(c)[0] - at(a)[0]) * (at(b)[1] - at(a)[1]));
  }
  return out;
}

File morphing_file() {
  File file;
  file.mesh({{"POSITION", file.floats(corner_positions, "VEC3")}, {"NORMAL", file.floats({0, 0, 1, 0, 0, 1, 0, 0, 1}, "VEC3")}});
  Document first = {{"POSITION", file.floats({0, 0, 1, 0, 0, 2, 0, 0, 3}, "VEC3")}};
  Document second = {{"POSITION", file.accessor<std::int8_t>({127, 0, 0, 0, 0, 0, -127, 0, 0}, "VEC3", true)},
                     {"NORMAL", file.floats({1, 0, -1, 0, 0, 0, 0, 0, -1}, "VEC3")}};
  file.primitive(0)["targets"] = {first, second};
  file.node({{"mesh", 0}});
  return file;
}

}  // namespace

TEST(primitive, of_triangles_takes_three_corners_each) {
  EXPECT_EQ(of_mode(4, {0, 1, 2, 2, 1, 3}).mesh.triangles, (Triangles{{0, 1, 2}, {2, 1, 3}}));
}

TEST(primitive, of_a_strip_turns_every_other_triangle_round) {
  // 0 1 2, then 1 3 2 and 2 3 4: all face +z.
  const Part strip = of_mode(5, {0, 1, 2, 3, 4});
  EXPECT_EQ(strip.mesh.vertices, (Vertices{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}, {0, 2, 0}}));
  EXPECT_EQ(strip.mesh.triangles, (Triangles{{0, 1, 2}, {1, 3, 2}, {2, 3, 4}}));
  for (const float turn : turns(strip)) EXPECT_GT(turn, 0);
  EXPECT_EQ(of_mode(5, {}).mesh.triangles, strip.mesh.triangles);
}

TEST(primitive, of_a_strip_that_repeats_a_vertex_goes_on_elsewhere) {
  const Part strip = of_mode(5, {0, 1, 2, 2, 3, 3, 4});
  EXPECT_EQ(strip.mesh.triangles.size(), 1U);
  EXPECT_EQ(strip.not_finite, 0U);
}

TEST(primitive, of_a_fan_turns_about_its_first_corner) {
  const Part fan = of_mode(6, {0, 1, 3, 4});
  EXPECT_EQ(fan.mesh.vertices, (Vertices{{1, 0, 0}, {1, 1, 0}, {0, 0, 0}, {0, 2, 0}}));
  EXPECT_EQ(fan.mesh.triangles, (Triangles{{0, 1, 2}, {1, 3, 2}}));
  for (const float turn : turns(fan)) EXPECT_GT(turn, 0);
}

TEST(primitive, of_points_or_lines_is_left_out_with_a_notice) {
  for (const int mode : {0, 1, 2, 3}) {
    File file = triangle_file();
    file.primitive(0)["mode"] = mode;
    const Model model = model_of(file);
    EXPECT_TRUE(parts_at_rest(model).empty());
    EXPECT_EQ(model.notices, std::vector<std::string>{"primitives of points or lines are left out"});
  }
}

TEST(primitive, without_positions_or_triangles_is_left_out_with_a_notice) {
  File file = triangle_file();
  file.json["accessors"][0]["count"] = 2;
  EXPECT_TRUE(has_notice(model_of(file), "primitives without triangles are left out"));
  file.json["accessors"][0]["count"] = 0;
  EXPECT_TRUE(has_notice(model_of(file), "primitives without triangles are left out"));
  file.primitive(0)["attributes"] = {{"NORMAL", 0}};
  EXPECT_TRUE(has_notice(model_of(file), "primitives without positions are left out"));
}

TEST(primitive, leaves_out_corners_that_make_no_triangle) {
  File file = triangle_file();
  file.primitive(0)["indices"] = file.accessor<std::uint8_t>({0, 1, 2, 1, 2}, "SCALAR");
  const Model model = model_of(file);
  EXPECT_EQ(parts_at_rest(model)[0].mesh.triangles, (Triangles{{0, 1, 2}}));
  EXPECT_TRUE(has_notice(model, "corners behind a primitive's last whole triangle"));
}

TEST(primitive, has_only_vertices_that_triangles_use) {
  const Part part = of_mode(4, {4, 3, 1});
  EXPECT_EQ(part.mesh.vertices, (Vertices{{0, 2, 0}, {1, 1, 0}, {1, 0, 0}}));
  EXPECT_EQ(part.mesh.triangles, (Triangles{{0, 1, 2}}));
}

TEST(primitive, has_normals_coordinates_and_colors) {
  File file = triangle_file();
  Document& attributes = file.primitive(0)["attributes"];
  attributes["NORMAL"] = file.floats({0, 0, 1, 0, 3, 0, 0, 0, 0}, "VEC3");
  attributes["TEXCOORD_0"] = file.floats({0, 1, 2, 3, 4, 5}, "VEC2");
  attributes["TEXCOORD_1"] = file.accessor<std::uint8_t>({0, 51, 102, 153, 204, 255}, "VEC2", true);
  attributes["COLOR_0"] = file.accessor<std::uint16_t>({0, 65535, 0, 65535, 0, 0, 0, 0, 13107}, "VEC3", true);
  file.json["materials"] = {Document::object(), Document::object()};
  file.primitive(0)["material"] = 1;
  const Part part = parts_at_rest(model_of(file))[0];
  EXPECT_EQ(part.normals, (Vertices{{0, 0, 1}, {0, 1, 0}, {0, 0, 0}}));
  EXPECT_EQ(part.texcoords[0], (std::vector<std::array<float, 2>>{{0, 1}, {2, 3}, {4, 5}}));
  EXPECT_EQ(part.texcoords[1], (std::vector<std::array<float, 2>>{{0, 0.2F}, {0.4F, 0.6F}, {0.8F, 1}}));
  EXPECT_EQ(part.colors, (std::vector<std::array<float, 4>>{{0, 1, 0, 1}, {1, 0, 0, 1}, {0, 0, 0.2F, 1}}));
  EXPECT_EQ(part.material, 1);
  EXPECT_EQ(part.node, 0);
}

TEST(primitive, has_colors_with_an_alpha_of_their_own) {
  File file = triangle_file();
  file.primitive(0)["attributes"]["COLOR_0"] = file.accessor<std::uint8_t>({0, 0, 0, 255, 255, 0, 0, 0, 0, 0, 51, 102}, "VEC4", true);
  const Part part = parts_at_rest(model_of(file))[0];
  EXPECT_EQ(part.colors, (std::vector<std::array<float, 4>>{{0, 0, 0, 1}, {1, 0, 0, 0}, {0, 0, 0.2F, 0.4F}}));
}

TEST(primitive, with_other_attributes_says_that_they_are_left_out) {
  File file = triangle_file();
  file.primitive(0)["attributes"]["_HEAT"] = 0;
  file.primitive(0)["attributes"]["_WEAR"] = file.floats(std::vector<float>(12, 0), "VEC4");
  const Model model = model_of(file);
  EXPECT_TRUE(has_notice(model, "the attribute \"_HEAT\" is left out"));
  EXPECT_TRUE(has_notice(model, "the attribute \"_WEAR\" is left out"));
}

TEST(primitive, with_quantized_positions_needs_its_node_s_scale) {
  // 16 bits over [−1, 1], spread to metres by the node: KHR_mesh_quantization's own way.
  File file;
  file.json["extensionsUsed"] = file.json["extensionsRequired"] = {"KHR_mesh_quantization"};
  const std::vector<std::int16_t> positions = {-32767, 0, 32767, 0,     0, 32767,
                                               0,      0, 16384, -8192, 1, 0};  // four for each vertex, one unused
  const int view = file.view(bytes_of(positions));
  file.json["bufferViews"][0]["byteStride"] = 8;
  file.mesh({{"POSITION", file.accessor(view, 5122, "VEC3", 3)}});
  file.json["accessors"][0]["normalized"] = true;
  file.node({{"mesh", 0}, {"scale", {2, 2, 2}}, {"translation", {1, 0, 0}}});
  const Model model = model_of(file);
  EXPECT_TRUE(model.notices.empty());
  const Part part = parts_at_rest(model)[0];
  const auto meant = [](double whole) { return 2 * static_cast<double>(static_cast<float>(whole / 32767)); };
  expect_near(part.mesh.vertices[0], {-1, 0, 2}, 0);
  expect_near(part.mesh.vertices[1], {1, 2, 0}, 0);
  expect_near(part.mesh.vertices[2], {1 + meant(16384), meant(-8192), meant(1)}, 1e-7);
}

TEST(primitive, leaves_out_triangles_at_positions_that_are_not_finite) {
  const float nan = std::nanf(""), infinite = HUGE_VALF;
  File file;
  file.mesh({{"POSITION", file.floats({0, 0, 0, 1, 0, 0, 0, 1, 0, nan, 0, 0, 0, infinite, 0}, "VEC3")}},
            file.accessor<std::uint8_t>({0, 1, 2, 3, 1, 2, 0, 4, 2}, "SCALAR"));
  file.node({{"mesh", 0}});
  const Part part = parts_at_rest(model_of(file))[0];
  EXPECT_EQ(part.mesh.triangles, (Triangles{{0, 1, 2}}));
  EXPECT_EQ(part.mesh.vertices, (Vertices{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 0}, {0, 0, 0}}));
  EXPECT_EQ(part.not_finite, 2U);
}

TEST(primitive, leaves_out_triangles_beyond_the_range_of_float) {
  File file = triangle_file();
  for (const double scale : {1e300, -1e300, 3.5e38}) {
    file.json["nodes"][0]["scale"] = {scale, 1, 1};
    const Part part = parts_at_rest(model_of(file))[0];
    EXPECT_TRUE(part.mesh.triangles.empty());
    EXPECT_EQ(part.not_finite, 1U);
  }
}

TEST(primitive, takes_other_numbers_that_are_not_finite_as_0_and_says_so) {
  File file = triangle_file();
  file.primitive(0)["attributes"]["TEXCOORD_0"] = file.floats({0, std::nanf(""), 2, HUGE_VALF, 4, 5}, "VEC2");
  file.primitive(0)["attributes"]["NORMAL"] = file.floats({0, 0, 1, std::nanf(""), 0, 1, HUGE_VALF, -HUGE_VALF, 1}, "VEC3");
  const Model model = model_of(file);
  EXPECT_EQ(*model.meshes[0].primitives[0].texcoords[0], (std::vector<float>{0, 0, 2, 0, 4, 5}));
  EXPECT_TRUE(has_notice(model, "numbers of TEXCOORD_0 that are not finite are taken as 0"));
}

TEST(morph_targets, are_added_times_their_weights) {
  File file = morphing_file();
  const auto vertices = [&] { return parts_at_rest(model_of(file))[0].mesh.vertices; };
  EXPECT_EQ(vertices(), corner_vertices);  // weights are 0 unless given
  file.json["meshes"][0]["weights"] = {1, 0};
  EXPECT_EQ(vertices(), (Vertices{{0, 0, 1}, {1, 0, 2}, {0, 1, 3}}));
  file.json["meshes"][0]["weights"] = {-0.5, 2};
  EXPECT_EQ(vertices(), (Vertices{{2, 0, -0.5F}, {1, 0, -1}, {-2, 1, -1.5F}}));
  file.json["nodes"][0]["weights"] = {0, 0.25};  // a node's own come first
  EXPECT_EQ(vertices(), (Vertices{{0.25F, 0, 0}, {1, 0, 0}, {-0.25F, 1, 0}}));
}

TEST(morph_targets, turn_normals_too) {
  File file = morphing_file();
  file.json["meshes"][0]["weights"] = {5, 1};
  const Part part = parts_at_rest(model_of(file))[0];
  EXPECT_EQ(part.normals, (Vertices{{1, 0, 0}, {0, 0, 1}, {0, 0, 0}}));  // (0 0 1) + (1 0 −1), + 0, + (0 0 −1)
}

TEST(morph_targets, come_before_the_node_s_matrix) {
  File file = morphing_file();
  file.json["meshes"][0]["weights"] = {1, 0};
  file.json["nodes"][0]["scale"] = {1, 1, 10};
  EXPECT_EQ(parts_at_rest(model_of(file))[0].mesh.vertices, (Vertices{{0, 0, 10}, {1, 0, 20}, {0, 1, 30}}));
}

TEST(totals, of_many_nodes_that_share_a_mesh_are_refused_before_memory_is_taken) {
  // A mesh of 1,000 triangles at 20,001 nodes.
  File file;
  file.mesh({{"POSITION", file.floats(corner_positions, "VEC3")}},
            file.accessor<std::uint8_t>(std::vector<std::uint8_t>(3000, 1), "SCALAR"));
  for (int i = 0; i < 20'001; ++i) file.node({{"mesh", 0}});
  expect_fault(file.glb(), "m: error: the nodes show too many triangles\n  got more than 20000000 in all", ErrorKind::limit);
}

TEST(totals, of_parts_are_limited) {
  File file = triangle_file();
  const Document primitive = file.primitive(0);
  for (int i = 0; i < 20; ++i) file.json["meshes"][0]["primitives"].push_back(primitive);
  for (int i = 1; i < 10'000; ++i) file.node({{"mesh", 0}});
  expect_fault(file.glb(), "the nodes show too many primitives", ErrorKind::limit);
}

TEST(totals, of_vertices_and_morphs_are_limited) {
  File file;
  const std::size_t vertices = 30'000;
  const int positions = file.view(std::string(3 * vertices, '\0'));
  file.mesh({{"POSITION", file.accessor(positions, 5121, "VEC3", vertices)}});
  for (int i = 0; i < 700; ++i) file.node({{"mesh", 0}});
  expect_fault(file.glb(), "the nodes show too many vertices", ErrorKind::limit);
  file.json["nodes"] = {{{"mesh", 0}}};
  file.primitive(0)["targets"] = std::vector<Document>(2000, {{"POSITION", 0}});
  expect_fault(file.glb(), "the nodes show too many vertices times morph targets", ErrorKind::limit);
}

TEST(totals, of_nodes_and_values_are_limited) {
  File file = triangle_file();
  file.json["nodes"] = std::vector<Document>(100'001, Document::object());
  expect_fault(file.glb(), "m: error: nodes are too many\n  got 100001, at most 100000", ErrorKind::limit);
  file = triangle_file();
  file.json["materials"] = std::vector<Document>(10'001, Document::object());
  expect_fault(file.glb(), "m: error: materials are too many", ErrorKind::limit);
  file = triangle_file();
  file.json["cameras"] = std::vector<Document>(500'001, nullptr);
  expect_fault(file.glb(), "m: error: cameras are too many", ErrorKind::limit);
  std::string many = R"({"asset": {"version": "2.0"}, "extras": [0)";
  for (int i = 0; i < 4'000'000; ++i) many += ",0";
  expect_fault(many + "]}", "m: error: more than 4000000 values", ErrorKind::limit);
  const std::string long_text(static_cast<std::size_t>(base::limit::gltf_json_bytes.value) + 1, ' ');
  expect_fault(long_text, "m: error: there are too many bytes of JSON", ErrorKind::limit);
}
