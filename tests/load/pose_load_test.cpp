// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
// Poses as other software writes them: quaternions, matrices, Euler angles, other axes, another world; and what is refused.
#include <gtest/gtest.h>

#include <cmath>

#include "load/load.h"
#include "support/same_frame.h"
#include "support/samples.h"
#include "support/text.h"
#include "tofray/tofray.h"

namespace {

using namespace tofray;
using test::has;
using Matrix = std::array<double, 16>;

Scene scene_with(const std::string& pose, const std::string& more = "") {
  return load::scene_from_text(more + "camera: {pose: {" + pose + "}}\nobjects: []\n", "p.yaml");
}
Matrix pose_of(const std::string& pose, const std::string& more = "") { return pose_matrix(scene_with(pose, more).camera.pose); }

std::string pose_refusal(const std::string& pose, const std::string& more = "") {
  try {
    scene_with(pose, more);
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::bad_input);
    return error.what();
  }
  return "";
}
std::string turn_refusal(const std::string& rotation) {
  try {
    load::scene_from_text("objects: [sphere: {center: [0, 0, 1], radius: 20 cm, reflectivity: 0.5, rotation: {" + rotation + "}}]\n",
                          "t.yaml");
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

void expect_near(const Matrix& got, const Matrix& expected, double tolerance = 1e-15) {
  for (std::size_t i = 0; i < got.size(); ++i) EXPECT_NEAR(got[i], expected[i], tolerance) << i;
}

/// Rz(yaw)·Ry(pitch)·Rx(roll), and a position.
Matrix by_angles(double roll, double pitch, double yaw, const Vec3& p) {
  const double a = std::cos(roll), b = std::sin(roll), c = std::cos(pitch), d = std::sin(pitch), e = std::cos(yaw), f = std::sin(yaw);
  return {
      e * c, e * d * b - f * a, e * d * a + f * b, p[0], f * c, f * d * b + e * a, f * d * a - e * b, p[1], -d, c * b, c * a, p[2], 0, 0, 0,
      1};
}

}  // namespace

TEST(pose, by_quaternion_has_the_scalar_last) {
  // A quarter turn about z: the image's right looks along the world's y.
  EXPECT_EQ(pose_of("position: [1, 2, 3], quaternion: [0, 0, 0.70710678, 0.70710678]"),
            (Matrix{0, -1, 0, 1, 1, 0, 0, 2, 0, 0, 1, 3, 0, 0, 0, 1}));
  EXPECT_EQ(pose_of("quaternion: [0, 0, 0, 1]"), (Matrix{1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1}));
}

TEST(pose, by_quaternion_is_of_unit_length_when_it_is_read) {
  const Pose pose = scene_with("quaternion: [0, 0.6004, 0, 0.8002]").camera.pose;
  ASSERT_TRUE(pose.quaternion);
  EXPECT_NEAR(std::hypot((*pose.quaternion)[1], (*pose.quaternion)[3]), 1, 1e-15);
  EXPECT_NEAR((*pose.quaternion)[1] / (*pose.quaternion)[3], 0.6004 / 0.8002, 1e-15);
}

TEST(pose, by_matrix_euler_or_quaternion_is_the_same) {
  const Matrix expected = by_angles(0.3, -0.5, 1.1, {0.1, -0.2, 1.5});
  expect_near(pose_of("position: [0.1, -0.2, 1.5], euler: {roll: 0.3 rad, pitch: -0.5 rad, yaw: 1.1 rad}"), expected);
  const auto row = [&](std::size_t i, std::size_t columns) {
    std::string text = "[";
    for (std::size_t j = 0; j < columns; ++j) text += (j == 0 ? "" : ", ") + std::to_string(expected[4 * i + j]);
    return text + "]";
  };
  const std::string three = row(0, 3) + ", " + row(1, 3) + ", " + row(2, 3), four = row(0, 4) + ", " + row(1, 4) + ", " + row(2, 4);
  expect_near(pose_of("position: [0.1, -0.2, 1.5], matrix: [" + three + "]"), expected, 1e-6);
  expect_near(pose_of("matrix: [" + four + "]"), expected, 1e-6);
  expect_near(pose_of("matrix: [" + four + ", [0, 0, 0, 1]]"), expected, 1e-6);
  expect_near(pose_matrix(pose_from_matrix(expected)), expected);
}

TEST(pose, by_euler_angles_turns_about_fixed_axes_x_first) {
  expect_near(pose_of("euler: {roll: 90 deg, yaw: 90 deg}"), by_angles(std::acos(0.0), 0, std::acos(0.0), {0, 0, 0}));
  EXPECT_NEAR(pose_of("euler: {roll: 90 deg, yaw: 90 deg}")[1], 0, 1e-15) << "y goes to z by the roll, and stays there";
  EXPECT_NEAR(pose_of("euler: {roll: 90 deg, yaw: 90 deg}")[9], 1, 1e-15);
}

TEST(pose, of_a_body_or_of_opengl_is_turned_to_the_optical_axes) {
  // Columns are right, down and forward. A robot that is not turned looks along x, its left is y.
  const Matrix body{0, 0, 1, 0, -1, 0, 0, 0, 0, -1, 0, 0, 0, 0, 0, 1}, opengl{1, 0, 0, 0, 0, -1, 0, 0, 0, 0, -1, 0, 0, 0, 0, 1};
  for (const char* turn : {"quaternion: [0, 0, 0, 1]", "matrix: [[1, 0, 0], [0, 1, 0], [0, 0, 1]]", "euler: {}"}) {
    EXPECT_EQ(pose_of(std::string(turn) + ", axes: body"), body) << turn;
    EXPECT_EQ(pose_of(std::string(turn) + ", axes: opengl"), opengl) << turn;
  }
  EXPECT_EQ(pose_of("axes: body"), body) << "not turned";
  // It turns left by 90 degrees: it looks along y.
  EXPECT_EQ(pose_of("quaternion: [0, 0, 0.70710678, 0.70710678], axes: body")[6], 1);
  EXPECT_EQ(pose_of("quaternion: [-0.5, 0.5, -0.5, 0.5], axes: optical"), body) << "what ROS has between camera_link and its optical frame";
}

TEST(pose, gives_the_bytes_that_look_at_gives) {
  const std::string room =
      "objects:\n  - plane: {point: [2, 0, 0], normal: [-1, 0, 0], reflectivity: 0.8}\n  - sphere: {center: [1.3, 0.1, 0.5], radius: 25 "
      "cm, "
      "reflectivity: 40 %}\n";
  const auto frame = [&](const std::string& pose) {
    const Scene scene = load::scene_from_text("camera: {pose: {position: [0, 0, 0.5], " + pose + "}}\n" + room, "f.yaml");
    return Simulator(scene, load_camera(scene), {.seed = 3}).frame(0);
  };
  const Frame looked = frame("look_at: [1, 0, 0.5], up: [0, 0, 1]");
  for (const char* pose : {"quaternion: [0, 0, 0, 1], axes: body", "matrix: [[0, 0, 1], [-1, 0, 0], [0, -1, 0]]",
                           "matrix: [[0, 0, -1], [-1, 0, 0], [0, 1, 0]], axes: opengl"}) {
    EXPECT_EQ(test::first_difference(frame(pose), looked), "") << pose;
  }
  EXPECT_NE(test::first_difference(frame("quaternion: [0, 0.01, 0, 0.99995], axes: body"), looked), "");
}

TEST(pose, that_cannot_be_says_what_helps) {
  const std::pair<const char*, const char*> cases[] = {
      {"quaternion: [0, 0, 0, 2]",
       "p.yaml:1:29: error: the quaternion is not of unit length\n  got a length of 2, expected 1; its order is x, y, z, w"},
      {"quaternion: [0, 0, 0, 0]", "got a length of 0"},
      {"quaternion: [0, 0, 1]", "quaternion has the wrong number of elements\n  got 3, expected 4"},
      {"quaternion: {x: 0, y: 0, z: 0, w: 1}", "quaternion is not a list"},
      {"matrix: [[1, 0, 0], [0, 1, 0], [0, 0, -1]]", "p.yaml:1:25: error: the matrix mirrors: its determinant is -1"},
      {"matrix: [[1, 0, 0], [0, 1, 0]]", "matrix has the wrong number of elements"},
      {"matrix: [[1, 0, 0], [0, 1, 0], [0, 0, 1, 2]]",
       "p.yaml:1:48: error: the matrix has rows of other lengths than a pose's\n  got 4 numbers"},
      {"matrix: [[1, 0, 0], [0, 1, 0], [0, 0, 1], [0, 0, 0]]", "the matrix has rows of other lengths than a pose's"},
      {"matrix: [[1, 0, 0, 0], [0, 1, 0, 0], [0, 0, 1, 0], [0, 0, 0, 2]]",
       "the last row of a matrix of 4 x 4 is not 0, 0, 0, 1\n  expected [0,"},
      {"matrix: [[1, 0, 0, 0], [0, 1, 0, 0], [0, 0, 1, 0], [1, 2, 3, 1]]",
       "the matrix is transposed: expected the position in the last column"},
      {"matrix: [[1, 0, 0, 1], [0, 1, 0, 2], [0, 0, 1, 3]], position: [1, 2, 3]", "the pose has a position, and its matrix another one"},
      {"matrix: [[1, 0, 0, 200000], [0, 1, 0, 2], [0, 0, 1, 3]]", "position is out of range"},
      {"euler: {yaw: 90}", "yaw has no unit"},
      {"euler: {heading: 90 deg}", "unknown key \"heading\" in euler"},
      {"quaternion: [0, 0, 0, 1], look_at: [0, 0, 1]", "pose has \"look_at\" and \"quaternion\""},
      {"quaternion: [0, 0, 0, 1], euler: {yaw: 90 deg}", "these keys say the same thing; keep one of them"},
      {"quaternion: [0, 0, 0, 1], up: [0, 0, 1]", "up goes with look_at alone"},
      {"look_at: [0, 0, 1], axes: body", "axes says nothing of look_at"},
      {"quaternion: [0, 0, 0, 1], axes: ros", "axes is unknown: \"ros\""},
      {"frame: body", "unknown key \"frame\" in pose; did you mean \"axes\"?"},
      {"rotation: {axis: [0, 0, 1], angle: 3 deg}", "unknown key \"rotation\" in pose; did you mean \"quaternion\"?"},
  };
  for (const auto& [text, expected] : cases) EXPECT_TRUE(has(pose_refusal(text), expected)) << text << "\n" << pose_refusal(text);
}

TEST(pose, in_a_world_whose_z_is_up_looks_along_x_and_has_z_up_unless_it_says_so) {
  const Matrix body{0, 0, 1, 0, -1, 0, 0, 0, 0, -1, 0, 0, 0, 0, 0, 1};
  const Scene bare = load::scene_from_text("world_up: z\nobjects: []\n", "z.yaml");
  EXPECT_EQ(bare.world_up, Scene::Up::z);
  EXPECT_EQ(pose_matrix(bare.camera.pose), body);
  EXPECT_EQ(pose_matrix(load::scene_from_text("world_up: z\ncamera: {mode: MODE_9_5FPS_2000}\nobjects: []\n", "z.yaml").camera.pose), body);
  expect_near(pose_of("look_at: [2, 0, 0]", "world_up: z\n"), body);
  expect_near(pose_of("look_at: [0, 2, 0]", "world_up: z\n"), {1, 0, 0, 0, 0, 0, 1, 0, 0, -1, 0, 0, 0, 0, 0, 1});
  EXPECT_EQ(pose_of("look_at: [2, 0, 0], up: [0, 1, 0]", "world_up: z\n")[1], 0) << "its own up counts";
  EXPECT_EQ(pose_of("quaternion: [0, 0, 0, 1]", "world_up: z\n"), pose_of("quaternion: [0, 0, 0, 1]")) << "numbers stay what they are";
  const Scene keys = load::scene_from_text(
      "world_up: z\ncamera: {keyframes: [{time: 0 s}, {time: 1 s, pose: {look_at: [3, 0, 0]}}]}\nobjects: []\n", "z.yaml");
  for (const CameraKeyframe& key : keys.camera.keyframes) expect_near(pose_matrix(key.pose), body);
  EXPECT_EQ(pose_matrix(load::scene_from_text("world_up: y\nobjects: []\n", "y.yaml").camera.pose),
            (Matrix{1, 0, 0, 0, 0, -1, 0, 0, 0, 0, -1, 0, 0, 0, 0, 1}));
  EXPECT_EQ(pose_of(""), (Matrix{1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1}));
  EXPECT_TRUE(has(pose_refusal("", "world_up: x\n"), "p.yaml:1:11: error: world_up is unknown: \"x\""))
      << pose_refusal("", "world_up: x\n");
}

TEST(rotation, of_an_object_may_be_a_quaternion_a_matrix_or_euler_angles) {
  const auto turned = [](const std::string& rotation) {
    const Scene scene = load::scene_from_text(
        "objects: [box: {min: [-0.1, -0.2, 1], max: [0.1, 0.2, 1.3], reflectivity: 0.5, rotation: {" + rotation + "}}]\n", "r.yaml");
    return Simulator(scene, load_camera(scene), {.noise = Noise::off}).frame(0).truth.position_m;
  };
  const auto axis = turned("axis: [0, 0, 1], angle: 90 deg"), quaternion = turned("quaternion: [0, 0, 0.70710678, 0.70710678]");
  ASSERT_EQ(axis.size(), quaternion.size());
  std::size_t seen = 0;
  for (std::size_t i = 0; i < axis.size(); ++i) {
    ASSERT_EQ(std::isnan(axis[i]), std::isnan(quaternion[i])) << i;
    if (std::isnan(axis[i])) continue;
    ++seen;
    EXPECT_NEAR(axis[i], quaternion[i], 2e-6);
  }
  EXPECT_GT(seen, 1000U);
  EXPECT_EQ(turned("matrix: [[0, -1, 0], [1, 0, 0], [0, 0, 1]]").size(), axis.size());
  EXPECT_TRUE(has(turn_refusal("axis: [0, 0, 1]"), "rotation lacks the key \"angle\""));
  EXPECT_TRUE(has(turn_refusal("angle: 3 deg"), "rotation lacks a key\n  expected one of axis, quaternion, matrix or euler"))
      << turn_refusal("angle: 3 deg");
  EXPECT_TRUE(has(turn_refusal("angle: 3 deg, quaternion: [0, 0, 0, 1]"), "angle goes with axis alone"));
  EXPECT_TRUE(has(turn_refusal("axis: [0, 0, 1], angle: 3 deg, euler: {yaw: 1 deg}"), "rotation has \"axis\" and \"euler\""));
  EXPECT_TRUE(has(turn_refusal("matrix: [[1, 0, 0, 0], [0, 1, 0, 0], [0, 0, 1, 0]]"), "matrix[0] has the wrong number of elements"));
  EXPECT_TRUE(has(turn_refusal("quaternion: [1, 1, 0, 0]"), "got a length of 1.414"));
}

// Rotations in structs are checked as those of files are: told by the names of their members.
TEST(pose, in_code_is_checked_as_that_of_files) {
  const auto refused = [](const Pose& pose, const Rotation& rotation = {}) -> std::string {
    Scene scene;
    scene.materials.push_back({"", Material::Brdf::lambert, 0.5});
    scene.objects.push_back({"", Sphere{{0, 0, 1}, 0.2}, 0});
    scene.camera.pose = pose, scene.objects[0].rotation = rotation;
    try {
      const Simulator simulator(scene, load_camera("pico-flexx"));
    } catch (const Error& error) {
      return error.what();
    }
    return "";
  };
  const Quaternion good{0, 0, 0, 1};
  EXPECT_EQ(refused({{0, 0, 0}, {0, 0, 1}, {0, -1, 0}, good}), "");
  EXPECT_TRUE(has(refused({{0, 0, 0}, {0, 0, 1}, {0, -1, 0}, Quaternion{0, 0, 0, 0.9}}),
                  "camera.pose.quaternion: the quaternion is not of unit length"));
  EXPECT_TRUE(
      has(refused({{0, 0, 0}, {0, 0, 1}, {0, -1, 0}, Quaternion{0, 0, 0, std::nan("")}}), "camera.pose.quaternion[3] is out of range"));
  EXPECT_TRUE(has(refused({{0, 0, 0}, {0, 0, 2}, {0, -1, 0}, good}), "the pose has a quaternion, and look_at or up"));
  EXPECT_TRUE(has(refused({}, {{0, 0, 1}, 1, good}), "the rotation has a quaternion and an angle"));
  Matrix matrix{1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};
  const auto no_pose = [&](std::size_t i, double value) {
    Matrix changed = matrix;
    changed[i] = value;
    return std::string(out_test::error_of([&] { (void)pose_from_matrix(changed); }).what());
  };
  EXPECT_TRUE(has(no_pose(10, -1), "error: the matrix mirrors: its determinant is -1"));
  EXPECT_TRUE(has(no_pose(13, 2), "the last row of the matrix of a pose is not 0, 0, 0, 1"));
  EXPECT_TRUE(has(no_pose(6, std::nan("")), "a number that is not finite, at row 1, column 2"));
}
