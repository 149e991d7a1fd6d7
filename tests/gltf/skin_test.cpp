// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
// Skins: vertices that follow joints.
#include "gltf_files.h"

using namespace tofray;
using namespace tofray::gltf_test;

namespace {

std::vector<float> columns(const std::array<double, 3>& shift) {
  std::vector<float> out = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};
  for (std::size_t k = 0; k < 3; ++k) out[12 + k] = static_cast<float>(shift[k]);
  return out;
}

/// An arm along x: a joint at zero and one, its child, at (1 0 0). Vertices at x = 0, 2, 3 and 1, the last moved by both alike.
struct Arm {
  File file;
  Document weights, joints;
  explicit Arm(bool bytes = false) {
    const std::vector<float> positions = {0, 0, 0, 2, 0, 0, 3, 0.5F, 0, 1, 0, 0};
    std::vector<float> matrices = columns({0, 0, 0}), second = columns({-1, 0, 0});
    matrices.insert(matrices.end(), second.begin(), second.end());
    const int at = file.floats(positions, "VEC3"), normals = file.floats({0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1, 0}, "VEC3");
    const int joint = bytes ? file.accessor<std::uint8_t>({0, 0, 0, 0, 1, 0, 0, 0, 1, 1, 0, 0, 0, 1, 0, 0}, "VEC4")
                            : file.accessor<std::uint16_t>({0, 0, 0, 0, 1, 0, 0, 0, 1, 1, 0, 0, 0, 1, 0, 0}, "VEC4");
    const int weight = bytes ? file.accessor<std::uint8_t>({255, 0, 0, 0, 255, 0, 0, 0, 102, 153, 0, 0, 127, 127, 0, 0}, "VEC4", true)
                             : file.floats({1, 0, 0, 0, 1, 0, 0, 0, 0.25F, 0.75F, 0, 0, 0.5F, 0.5F, 0, 0}, "VEC4");
    file.mesh({{"POSITION", at}, {"NORMAL", normals}, {"JOINTS_0", joint}, {"WEIGHTS_0", weight}},
              file.accessor<std::uint8_t>({0, 1, 2, 0, 3, 2}, "SCALAR"));
    file.add("skins", {{"joints", {1, 2}}, {"inverseBindMatrices", file.floats(matrices, "MAT4")}, {"skeleton", 1}, {"name", "arm"}});
    file.node({{"mesh", 0}, {"skin", 0}});
    file.node({{"children", {2}}});
    file.node({{"translation", {1, 0, 0}}});
  }
  [[nodiscard]] Part part() const { return parts_at_rest(model_of(file)).at(0); }
};

}  // namespace

TEST(skin, at_rest_changes_nothing) {
  const Part part = Arm().part();
  EXPECT_EQ(part.mesh.vertices, (Vertices{{0, 0, 0}, {2, 0, 0}, {3, 0.5F, 0}, {1, 0, 0}}));
  EXPECT_EQ(part.mesh.triangles, (Triangles{{0, 1, 2}, {0, 3, 2}}));
}

TEST(skin, bends_at_a_joint) {
  // The second joint turns by 90° about z: (x y) behind it, counted from (1 0), becomes (1 − y, x − 1).
  for (const bool bytes : {false, true}) {
    Arm arm(bytes);
    arm.file.json["nodes"][2]["rotation"] = {0, 0, half_root, half_root};
    const Part part = arm.part();
    expect_near(part.mesh.vertices[0], {0, 0, 0}, 1e-6);
    expect_near(part.mesh.vertices[1], {1, 1, 0}, 1e-6);
    expect_near(part.mesh.vertices[2], {0.5, 2, 0}, 1e-6);
    expect_near(part.mesh.vertices[3], {1, 0, 0}, 1e-6);  // the joint's own place: both leave it there
    expect_near(part.normals[0], {0, 1, 0}, 1e-6);
    expect_near(part.normals[1], {-1, 0, 0}, 1e-6);
    expect_near(part.normals[3], {-half_root, half_root, 0}, 1e-6);  // half of each
  }
}

TEST(skin, takes_the_mean_of_joints_by_weight) {
  Arm arm;
  arm.file.json["nodes"][2]["translation"] = {1, 4, 0};  // the second joint moves up by 4
  const Vertices vertices = arm.part().mesh.vertices;
  expect_near(vertices[3], {1, 2, 0}, 1e-6);
  expect_near(vertices[1], {2, 4, 0}, 1e-6);
}

TEST(skin, follows_joints_and_not_the_mesh_s_own_node) {
  Arm arm;
  arm.file.json["nodes"][0]["translation"] = {100, 100, 100};
  arm.file.json["nodes"][0]["scale"] = {-5, 5, 5};
  EXPECT_EQ(arm.part().mesh.vertices, Arm().part().mesh.vertices);
  EXPECT_EQ(arm.part().mesh.triangles, Arm().part().mesh.triangles);
  arm.file.json["nodes"][1]["translation"] = {0, 0, 7};
  expect_near(arm.part().mesh.vertices[1], {2, 0, 7}, 1e-6);
}

TEST(skin, without_matrices_has_those_that_change_nothing) {
  Arm arm;
  arm.file.json["skins"][0].erase("inverseBindMatrices");
  EXPECT_EQ(arm.part().mesh.vertices[1], (std::array<float, 3>{3, 0, 0}));  // once more by the joint's own place
}

TEST(skin, that_mirrors_turns_triangles_round) {
  Arm arm;
  arm.file.json["nodes"][1]["scale"] = {1, 1, -1};
  EXPECT_EQ(arm.part().mesh.triangles, (Triangles{{0, 2, 1}, {0, 2, 3}}));
}

TEST(skin, counts_all_four_weights_of_a_vertex) {
  Arm arm;
  Document& attributes = arm.file.json["meshes"][0]["primitives"][0]["attributes"];
  attributes["JOINTS_0"] = arm.file.accessor<std::uint8_t>({0, 0, 0, 0, 0, 1, 0, 1, 0, 1, 0, 1, 1, 1, 0, 1}, "VEC4");
  attributes["WEIGHTS_0"] = arm.file.floats({1, 0, 0, 0, 0.5F, 0.125F, 0.25F, 0.125F, 0, 0, 0.25F, 0.75F, 0, 0.5F, 0.25F, 0.25F}, "VEC4");
  arm.file.json["nodes"][2]["translation"] = {1, 4, 0};  // the second joint moves up by 4
  const Vertices rest = Arm().part().mesh.vertices, vertices = arm.part().mesh.vertices;
  const double shares[] = {0, 0.25, 0.75, 0.75};
  for (std::size_t i = 0; i < 4; ++i)
    expect_near(vertices[i],
                {static_cast<double>(rest[i][0]), static_cast<double>(rest[i][1]) + 4 * shares[i], static_cast<double>(rest[i][2])}, 1e-6);
}

TEST(skin, scales_weights_that_do_not_add_up_to_1) {
  Arm arm;
  const auto weights = [&](const std::vector<float>& all) {
    arm.file.json["meshes"][0]["primitives"][0]["attributes"]["WEIGHTS_0"] = arm.file.floats(all, "VEC4");
  };
  arm.file.json["nodes"][2]["translation"] = {1, 4, 0};
  weights({2, 0, 0, 0, 0.5F, 0, 0, 0, 1, 3, 0, 0, 0.1F, 0.1F, 0, 0});
  const Model model = model_of(arm.file);
  expect_near(parts_at_rest(model)[0].mesh.vertices[3], {1, 2, 0}, 1e-6);
  expect_near(parts_at_rest(model)[0].mesh.vertices[1], {2, 4, 0}, 1e-6);
  EXPECT_TRUE(has_notice(model, "weights of vertices that do not add up to 1 are scaled"));
  weights({1, 0, 0, 0, 0, 0, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0});
  EXPECT_TRUE(has_notice(model_of(arm.file), "vertices without weights follow their first joint"));
  EXPECT_FALSE(has_notice(model_of(arm.file), "weights of vertices that do not add up to 1 are scaled"));
  expect_near(arm.part().mesh.vertices[1], {2, 4, 0}, 1e-6);
  weights({1, 0, 0, 0, 1, 0, 0, 0, 1, -0.5F, 0, 0, 0, 1, 0, 0});
  expect_fault(arm.file.glb(), "meshes[0].primitives[0].attributes.WEIGHTS_0 is negative\n  got -0.5 at vertex 2");
  weights({1, 0, 0, 0, 1, 0, 0, 0, 1, std::nanf(""), 0, 0, 0, 1, 0, 0});
  expect_fault(arm.file.glb(), "has numbers that are not finite\n  got nan in element 2");
}

TEST(skin, is_that_of_a_mesh_with_joints_and_has_all_that_are_named) {
  Arm arm;
  arm.file.json["skins"][0]["joints"] = {1};
  expect_fault(arm.file.glb(), "nodes[0].skin has fewer joints than its mesh names\n  meshes[0] names joint 1, and there are 1");
  arm = Arm();
  arm.file.json["skins"][0]["joints"] = {1, 2, 0};
  expect_fault(arm.file.glb(), "skins[0].inverseBindMatrices has too few matrices\n  got 2, and there are 3 joints");
  arm.file.json["skins"][0]["joints"] = {1, 1};
  expect_fault(arm.file.glb(), "skins[0].joints names 1 twice");
  arm.file.json["skins"][0]["joints"] = Document::array();
  expect_fault(arm.file.glb(), "skins[0].joints are missing");
  arm = Arm();
  arm.file.json["nodes"][0].erase("mesh");
  expect_fault(arm.file.glb(), "nodes[0].skin is that of a node without a mesh");
  arm = Arm();
  Document& attributes = arm.file.json["meshes"][0]["primitives"][0]["attributes"];
  attributes.erase("WEIGHTS_0");
  expect_fault(arm.file.glb(), "attributes has only one of JOINTS_0 and WEIGHTS_0");
  attributes.erase("JOINTS_0");
  expect_fault(arm.file.glb(), "nodes[0].skin moves a mesh without joints");
}

TEST(skin, with_a_matrix_that_is_not_affine_is_refused) {
  Arm arm;
  std::vector<float> matrices = columns({0, 0, 0}), second = columns({-1, 0, 0});
  second[3] = 0.01F;
  matrices.insert(matrices.end(), second.begin(), second.end());
  arm.file.json["skins"][0]["inverseBindMatrices"] = arm.file.floats(matrices, "MAT4");
  expect_fault(arm.file.glb(), "skins[0].inverseBindMatrices has a matrix whose last row is not 0 0 0 1\n  it is that of joint 1");
}
