// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
// Nodes, scenes, cameras: where things stand.
#include <functional>

#include "gltf_files.h"
#include "support/pi.h"

using namespace tofray;
using namespace tofray::gltf_test;

namespace {

Vertices vertices_of(const File& file) { return parts_at_rest(model_of(file)).at(0).mesh.vertices; }

/// One triangle at a node, and further nodes above it.
File with_nodes(const Document& nodes) {
  File file;
  file.mesh({{"POSITION", file.floats(corner_positions, "VEC3")}, {"NORMAL", file.floats({0, 0, 1, 0, 0, 1, 0, 0, 1}, "VEC3")}});
  file.json["nodes"] = nodes;
  return file;
}

}  // namespace

TEST(node, scales_then_turns_then_moves) {
  // A quarter turn about z takes x to y and y to −x.
  const File file =
      with_nodes({{{"mesh", 0}, {"translation", {10, 20, 30}}, {"rotation", {0, 0, half_root, half_root}}, {"scale", {2, 3, 4}}}});
  const Vertices vertices = vertices_of(file);
  expect_near(vertices[0], {10, 20, 30}, 1e-6);
  expect_near(vertices[1], {10, 22, 30}, 1e-6);
  expect_near(vertices[2], {7, 20, 30}, 1e-6);
}

// M = T·R·S, with the matrix of a quaternion as it is printed.
TEST(node, has_the_matrix_of_any_rotation_and_scale) {
  const double x = 0.1, y = -0.5, z = 0.7, w = 0.5;  // of unit length
  const double rotation[3][3] = {{1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)},
                                 {2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)},
                                 {2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)}};
  const double scale[3] = {2, 3, 5}, translation[3] = {10, 20, 30};
  File file;
  const float corners[3][3] = {{1, 2, 3}, {-2, 1, 4}, {3, -1, 0.5}};
  file.mesh({{"POSITION", file.floats({1, 2, 3, -2, 1, 4, 3, -1, 0.5}, "VEC3")}});
  file.json["nodes"] = {{{"mesh", 0}, {"translation", {10, 20, 30}}, {"rotation", {x, y, z, w}}, {"scale", {2, 3, 5}}}};
  const Vertices vertices = vertices_of(file);
  for (std::size_t i = 0; i < 3; ++i) {
    Vec3 expected{};
    for (std::size_t row = 0; row < 3; ++row) {
      expected[row] = translation[row];
      for (std::size_t k = 0; k < 3; ++k) expected[row] += rotation[row][k] * scale[k] * static_cast<double>(corners[i][k]);
    }
    expect_near(vertices[i], expected, 1e-5);
  }
}

TEST(node, turns_by_the_right_hand_rule) {
  const auto turned = [](const Document& rotation) { return vertices_of(with_nodes({{{"mesh", 0}, {"rotation", rotation}}})); };
  expect_near(turned({half_root, 0, 0, half_root})[2], {0, 0, 1}, 1e-7);   // about x: y to z
  expect_near(turned({0, half_root, 0, half_root})[1], {0, 0, -1}, 1e-7);  // about y: x to −z
  expect_near(turned({0, 0, -half_root, half_root})[1], {0, -1, 0}, 1e-7);
  // About (1 1 1) by a third of a turn: x to y to z. The quaternion is not of unit length.
  const Vertices third = turned({1, 1, 1, 1});
  expect_near(third[1], {0, 1, 0}, 1e-7);
  expect_near(third[2], {0, 0, 1}, 1e-7);
}

TEST(node, with_a_rotation_that_is_not_of_unit_length_says_so) {
  EXPECT_TRUE(has_notice(model_of(with_nodes({{{"mesh", 0}, {"rotation", {1, 1, 1, 1}}}})), "rotations that are not of unit length"));
  EXPECT_TRUE(model_of(with_nodes({{{"mesh", 0}, {"rotation", {0, 0, 0.70710678, 0.70710678}}}})).notices.empty());
}

TEST(node, has_a_matrix_by_columns) {
  // x to 2y, y to −3x, moved by (5 6 7).
  const File file = with_nodes({{{"mesh", 0}, {"matrix", {0, 2, 0, 0, -3, 0, 0, 0, 0, 0, 1, 0, 5, 6, 7, 1}}}});
  EXPECT_EQ(vertices_of(file), (Vertices{{5, 6, 7}, {5, 8, 7}, {2, 6, 7}}));
}

TEST(node, stands_in_its_parent_s_frame) {
  // The child lies before its parent in the file.
  const File file = with_nodes({{{"mesh", 0}, {"translation", {1, 0, 0}}},
                                {{"children", {0}}, {"scale", {2, 2, 2}}},
                                {{"children", {1}}, {"translation", {0, 100, 0}}}});
  EXPECT_EQ(vertices_of(file), (Vertices{{2, 100, 0}, {4, 100, 0}, {2, 102, 0}}));
}

TEST(node, that_mirrors_turns_its_triangles_round) {
  for (const Document& scale : {Document({-1, 1, 1}), Document({1, -1, 1}), Document({-2, -2, -2}), Document({1, 1, -1})}) {
    const Part part = parts_at_rest(model_of(with_nodes({{{"mesh", 0}, {"scale", scale}}})))[0];
    EXPECT_EQ(part.mesh.triangles, (Triangles{{0, 2, 1}}));
    // The front, which was +z, is mirrored as the triangle is.
    EXPECT_EQ(part.normals[0], (std::array<float, 3>{0, 0, scale[2].get<double>() < 0 ? -1.F : 1.F}));
  }
  const Part twice = parts_at_rest(model_of(with_nodes({{{"mesh", 0}, {"scale", {-1, -1, 1}}}})))[0];
  EXPECT_EQ(twice.mesh.triangles, (Triangles{{0, 1, 2}}));
}

TEST(node, that_mirrors_within_one_that_mirrors_does_not) {
  const File file = with_nodes({{{"children", {1}}, {"scale", {-1, 1, 1}}}, {{"mesh", 0}, {"scale", {1, -1, 1}}}});
  EXPECT_EQ(parts_at_rest(model_of(file))[0].mesh.triangles, (Triangles{{0, 1, 2}}));
}

TEST(node, turns_normals_so_that_they_stay_upright_on_the_surface) {
  // The plane y + z = const, flattened to a tenth in z: its normal (0 1 1) becomes (0 0.1 1) times a factor.
  File file;
  const float s = static_cast<float>(half_root);
  file.mesh({{"POSITION", file.floats(corner_positions, "VEC3")}, {"NORMAL", file.floats({0, s, s, 0, s, s, 0, s, s}, "VEC3")}});
  for (const double mirror : {1.0, -1.0}) {
    file.json["nodes"] = {{{"mesh", 0}, {"scale", {mirror, 1, 0.1}}}};
    expect_near(parts_at_rest(model_of(file))[0].normals[0], {0, 0.1 / std::sqrt(1.01), 1 / std::sqrt(1.01)}, 1e-6);
  }
  file.json["nodes"] = {{{"mesh", 0}, {"scale", {1e-100, 1e-100, 1e-100}}}};
  expect_near(parts_at_rest(model_of(file))[0].normals[0], {0, half_root, half_root}, 1e-6);
  file.json["nodes"] = {{{"mesh", 0}, {"scale", {0, 0, 0}}}};
  EXPECT_EQ(parts_at_rest(model_of(file))[0].normals[0], (std::array<float, 3>{0, 0, 0}));
}

TEST(node, keeps_normals_upright_by_any_matrix) {
  // Of a triangle that lies in no axis's plane, by matrices that scale, turn and shear at once: upright on what becomes of its edges.
  const std::vector<float> corners = {1, 0, 0, 0, 2, 0, 0, 0, 3};
  const float nx = 6.F / 7, ny = 3.F / 7, nz = 2.F / 7;
  File file;
  file.mesh({{"POSITION", file.floats(corners, "VEC3")}, {"NORMAL", file.floats({nx, ny, nz, nx, ny, nz, nx, ny, nz}, "VEC3")}});
  for (const Document& matrix :
       {Document({1, 2, 3, 0, -4, 5, 6, 0, 7, -8, 10, 0, 0, 0, 0, 1}), Document({0, 3, 0.5, 0, 0.25, 0, -2, 0, 1, 1, 0, 0, 3, 2, 1, 1})}) {
    file.json["nodes"] = {{{"mesh", 0}, {"matrix", matrix}}};
    const Part part = parts_at_rest(model_of(file))[0];
    const auto edge = [&](std::size_t i) {
      const auto &to = part.mesh.vertices[i], &from = part.mesh.vertices[0];
      return tofray::Vec3{to[0] - from[0], to[1] - from[1], to[2] - from[2]};
    };
    const tofray::Vec3 expected = base::normalized(base::cross(edge(1), edge(2)));
    const double sign = part.mesh.triangles[0] == std::array<std::int32_t, 3>{0, 1, 2} ? 1 : -1;  // turned round where the matrix mirrors
    expect_near(part.normals[0], {sign * expected[0], sign * expected[1], sign * expected[2]}, 1e-6);
  }
}

TEST(node, may_share_its_mesh_with_others) {
  const auto parts =
      parts_at_rest(model_of(with_nodes({{{"mesh", 0}, {"name", "a"}}, {{"mesh", 0}, {"translation", {0, 0, 1}}, {"name", "b"}}})));
  ASSERT_EQ(parts.size(), 2U);
  EXPECT_EQ(parts[0].node, 0);
  EXPECT_EQ(parts[1].node, 1);
  EXPECT_EQ(parts[1].mesh.vertices, (Vertices{{0, 0, 1}, {1, 0, 1}, {0, 1, 1}}));
}

TEST(node, may_be_as_deep_as_the_limit_and_no_deeper) {
  const auto chain = [](int depth) {
    Document nodes = Document::array();
    for (int i = 0; i < depth; ++i) nodes.push_back({{"translation", {1, 0, 0}}});
    for (int i = 0; i + 1 < depth; ++i) nodes[static_cast<std::size_t>(i)]["children"] = {i + 1};
    nodes.back()["mesh"] = 0;
    return with_nodes(nodes);
  };
  EXPECT_EQ(vertices_of(chain(256))[0], (std::array<float, 3>{256, 0, 0}));
  expect_fault(chain(257).glb(), "m: error: nodes[256] is too deep", ErrorKind::limit);
}

TEST(node, has_one_parent_and_is_not_below_itself) {
  expect_fault(with_nodes({{{"children", {1}}}, {{"children", {0}}}}).glb(), "nodes[0] is below itself");
  expect_fault(with_nodes({{{"children", {0}}}}).glb(), "nodes[0] is below itself");
  expect_fault(with_nodes({Document::object(), {{"children", {2}}}, {{"children", {3}}}, {{"children", {1}}}}).glb(),
               "nodes[1] is below itself");
  expect_fault(with_nodes({{{"children", {2}}}, {{"children", {2}}}, Document::object()}).glb(),
               "nodes[2] has two parents\n  they are nodes[0] and nodes[1]");
  expect_fault(with_nodes({{{"children", {1, 1}}}, Document::object()}).glb(), "nodes[0].children names 1 twice");
}

TEST(scene, shows_its_own_nodes_and_what_is_below_them) {
  File file = with_nodes({{{"mesh", 0}}, {{"children", {2}}}, {{"mesh", 0}}});
  file.json["scenes"] = {{{"nodes", {0}}, {"name", "first"}}, {{"nodes", {1}}}, {{"nodes", {1, 0}}}, Document::object()};
  const auto shown = [&](int scene) {
    const Model model = model_of(file);
    std::vector<int> nodes;
    for (const Part& part : gltf::parts(model, gltf::at(model, gltf::none, 0, scene))) nodes.push_back(part.node);
    return nodes;
  };
  EXPECT_EQ(shown(0), std::vector<int>{0});
  EXPECT_EQ(shown(1), std::vector<int>{2});
  EXPECT_EQ(shown(2), (std::vector<int>{0, 2}));
  EXPECT_TRUE(shown(3).empty());
  EXPECT_EQ(shown(gltf::none), std::vector<int>{0});
  EXPECT_TRUE(has_notice(model_of(file), "names none of them: the first is taken"));
  file.json["scene"] = 1;
  EXPECT_EQ(shown(gltf::none), std::vector<int>{2});
  EXPECT_TRUE(model_of(file).notices.empty());
  EXPECT_EQ(model_of(file).scenes[0].name, "first");
  file.json.erase("scenes"), file.json.erase("scene");
  EXPECT_EQ(shown(gltf::none), (std::vector<int>{0, 2}));  // all that have no parent
}

TEST(scene, shows_only_nodes_without_parent) {
  File file = with_nodes({{{"children", {1}}}, Document::object()});
  file.json["scenes"] = {{{"nodes", {1}}}};
  expect_fault(file.glb(), "scenes[0].nodes has a node with a parent");
}

TEST(pose, of_what_is_not_there_is_refused) {
  const Model model = model_of(triangle_file());
  const auto message = [&](int animation, double time, int scene) {
    return std::string(out_test::error_of([&] { (void)gltf::at(model, animation, time, scene); }).what());
  };
  EXPECT_TRUE(test::has(message(0, 0, 0), "animation 0 is none of the file's"));
  EXPECT_TRUE(test::has(message(-2, 0, 0), "animation -2 is none"));
  EXPECT_TRUE(test::has(message(-1, 0, 1), "scene 1 is none of the file's"));
  EXPECT_TRUE(test::has(message(-1, 0, -7), "scene -7 is none"));
  EXPECT_TRUE(test::has(message(-1, std::nan(""), 0), "not a finite number"));
}

// The node's own frame moves by (0, 0, 10) and is scaled by 2; its instances stand in it: p = N·T·R·S·v, from the extension's text.
TEST(instances, stand_in_the_frame_of_their_node) {
  File file = with_nodes({{{"mesh", 0}, {"translation", {0, 0, 10}}, {"scale", {2, 2, 2}}}});
  const auto root = static_cast<float>(half_root);
  file.json["nodes"][0]["extensions"]["EXT_mesh_gpu_instancing"]["attributes"] = {
      {"TRANSLATION", file.floats({1, 0, 0, 0, 5, 0}, "VEC3")},
      {"ROTATION", file.floats({0, 0, 0, 1, 0, 0, root, root}, "VEC4")},  // none; a quarter turn about z
      {"SCALE", file.floats({1, 1, 1, 3, 3, 3}, "VEC3")},
      {"_ID", file.floats({0, 1}, "SCALAR")}};
  const Model model = model_of(file);
  EXPECT_TRUE(model.notices.empty());
  const auto parts = parts_at_rest(model);
  ASSERT_EQ(parts.size(), 2U);
  expect_near(parts[0].mesh.vertices[0], {2, 0, 10}, 1e-6);
  expect_near(parts[0].mesh.vertices[1], {4, 0, 10}, 1e-6);
  expect_near(parts[1].mesh.vertices[0], {0, 10, 10}, 1e-6);
  expect_near(parts[1].mesh.vertices[1], {0, 16, 10}, 1e-5);  // x to y, 3 times, 2 times
  expect_near(parts[1].mesh.vertices[2], {-6, 10, 10}, 1e-5);
  // Normalized bytes for turns; what is missing is no turn, scale 1, the middle.
  File turned = with_nodes({{{"mesh", 0}}});
  turned.json["nodes"][0]["extensions"]["EXT_mesh_gpu_instancing"]["attributes"] = {
      {"ROTATION", turned.accessor<std::int8_t>({0, 0, 127, 0}, "VEC4", true)}};  // half a turn about z
  expect_near(parts_at_rest(model_of(turned)).at(0).mesh.vertices[1], {-1, 0, 0}, 1e-6);
  turned.json["nodes"][0]["extensions"]["EXT_mesh_gpu_instancing"]["attributes"] = Document::object();
  EXPECT_EQ(parts_at_rest(model_of(turned)).size(), 1U);
  EXPECT_TRUE(has_notice(model_of(turned), "one of each is shown"));
}

TEST(instances, that_make_no_sense_are_refused) {
  const auto with = [](const Document& attributes, const std::function<void(File&)>& more = {}) {
    File file = with_nodes({{{"mesh", 0}}});
    file.floats({1, 0, 0, 0, 5, 0}, "VEC3"), file.floats({0, 0, 0, 1}, "VEC4"), file.floats({0, 0, 0, 0, 0, 0, 0, 1}, "VEC4");  // 2, 3, 4
    file.json["nodes"][0]["extensions"]["EXT_mesh_gpu_instancing"]["attributes"] = attributes;
    if (more) more(file);
    return file.glb();
  };
  expect_fault(with({{"TRANSLATION", 2}, {"ROTATION", 3}}), "has another number of instances\n  got 1, and another attribute has 2");
  expect_fault(with({{"ROTATION", 4}}), "got a quaternion of length 0 of instance 0");
  expect_fault(with({{"TRANSLATION", 3}}), "expected VEC3 of floats");
  expect_fault(with({{"TRANSLATION", 9}}), "attributes.TRANSLATION");
  // Instances count as what nodes show: zeros need no bytes, and would be 10⁹ triangles.
  expect_fault(with({{"TRANSLATION", 2}},
                    [](File& file) {
                      file.json["accessors"][2].erase("bufferView"), file.json["accessors"][2].erase("byteOffset");
                      file.json["accessors"][2]["count"] = 1'000'000'000;
                    }),
               "too many", ErrorKind::limit);
  expect_fault(with({{"TRANSLATION", 2}},
                    [](File& file) {
                      file.json["accessors"][2].erase("bufferView"), file.json["accessors"][2].erase("byteOffset");
                      file.json["accessors"][2]["count"] = 1'000'000;
                    }),
               "the nodes show too many primitives", ErrorKind::limit);
}

// What nobody uses may be anything: a type that is none, elements beyond its view.
TEST(accessor, that_nobody_uses_may_be_anything) {
  File file = triangle_file();
  file.add("accessors", {{"bufferView", 0}, {"componentType", 5126}, {"type", "MAT2"}, {"count", 900}});
  file.add("accessors", {{"bufferView", 0}, {"componentType", 5130}, {"type", "VEC9"}, {"count", 1}});
  file.add("accessors", {{"componentType", 5126}});
  EXPECT_EQ(parts_at_rest(model_of(file)).size(), 1U);
  file.primitive(0)["attributes"]["NORMAL"] = 2;
  expect_fault(file.glb(), "accessors[2].type is none of an accessor");
}

// 60 written for 60 degrees: where it stands is good all the same.
TEST(camera, of_half_a_turn_or_more_is_told_and_stands_where_it_stands) {
  File file = with_nodes({{{"mesh", 0}}, {{"camera", 0}, {"translation", {0, 0, 5}}}});
  file.json["cameras"] = {{{"type", "perspective"}, {"perspective", {{"yfov", 60}, {"znear", 0.1}}}}};
  EXPECT_TRUE(has_notice(model_of(file), "cameras whose yfov is half a turn or more"));
  EXPECT_EQ(model_of(file).cameras[0].yfov_rad, 60);
}

TEST(camera, has_an_angle_or_a_size) {
  File file = with_nodes({{{"camera", 1}, {"translation", {0, 0, 5}}}});
  file.json["cameras"] = {
      {{"type", "perspective"}, {"name", "eye"}, {"perspective", {{"yfov", 0.8}, {"znear", 0.1}, {"zfar", 10}, {"aspectRatio", 1.5}}}},
      {{"type", "orthographic"}, {"orthographic", {{"xmag", 2}, {"ymag", 3}, {"znear", 0}, {"zfar", 7}}}},
      {{"type", "perspective"}, {"perspective", {{"yfov", 0.8}, {"znear", 0.1}}}}};
  const Model model = model_of(file);
  ASSERT_EQ(model.cameras.size(), 3U);
  EXPECT_TRUE(model.cameras[0].perspective);
  EXPECT_EQ(model.cameras[0].name, "eye");
  EXPECT_EQ(model.cameras[0].yfov_rad, 0.8);
  EXPECT_EQ(model.cameras[0].znear_m, 0.1);
  EXPECT_EQ(model.cameras[0].zfar_m, 10);
  EXPECT_EQ(model.cameras[0].aspect_ratio, 1.5);
  EXPECT_FALSE(model.cameras[1].perspective);
  EXPECT_EQ(model.cameras[1].xmag, 2);
  EXPECT_EQ(model.cameras[1].ymag, 3);
  EXPECT_EQ(model.cameras[1].zfar_m, 7);
  EXPECT_FALSE(model.cameras[2].zfar_m);
  EXPECT_FALSE(model.cameras[2].aspect_ratio);
  EXPECT_EQ(model.nodes[0].camera, 1);
  EXPECT_EQ(gltf::at(model, gltf::none, 0).world[0][2][3], 5);
}
