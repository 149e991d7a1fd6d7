// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
// Motion in files: what is read, and what is refused with the way out.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "base/limits.h"
#include "load/load.h"
#include "support/pi.h"
#include "support/text.h"
#include "tofray/tofray.h"

namespace {

using namespace tofray;
using test::has;

std::string ball(const std::string& keys) {
  return "objects: [sphere: {center: [0, 0, 1], radius: 0.2 m, reflectivity: 0.5, " + keys + "}]\n";
}
std::string with_camera(const std::string& keyframes) { return "camera: {keyframes: [" + keyframes + "]}\nobjects: []\n"; }

std::string motion_refusal(const std::string& text, ErrorKind kind = ErrorKind::bad_input) {
  try {
    load::scene_from_text(text, "m.yaml", {});
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), kind) << error.what();
    return error.what();
  }
  return "";
}

Vec3 spin_of(const std::string& said) {
  return load::scene_from_text(ball("angular_velocity: " + said), "m.yaml", {}).objects[0].angular_velocity_rad_per_s;
}

}  // namespace

TEST(motion_in_files, has_angular_velocities_in_any_unit) {
  EXPECT_NEAR(spin_of("[90 deg/s, 0, 0]")[0], test::pi / 2, 1e-15);
  EXPECT_NEAR(spin_of("[0, 90 °/s, 0]")[1], test::pi / 2, 1e-15);
  EXPECT_EQ(spin_of("[0, 0, -2 rad/s]")[2], -2);
  EXPECT_NEAR(spin_of("[0, 60 rpm, 0]")[1], 2 * test::pi, 1e-15);
  EXPECT_EQ(spin_of("[0, 0, 0]"), (Vec3{0, 0, 0}));
}

TEST(motion_in_files, refuses_angular_velocities_without_their_unit) {
  const std::string bare = motion_refusal(ball("angular_velocity: [0, 90, 0]"));
  EXPECT_TRUE(has(bare, "m.yaml:1:95: error: angular_velocity[1] has no unit")) << bare;
  EXPECT_TRUE(has(bare, "got \"90\", expected an angular speed such as \"90 deg/s\" (units: deg/s, rad/s, rpm and °/s)")) << bare;
  EXPECT_TRUE(has(motion_refusal(ball("angular_velocity: [0, 3 m/s, 0]")), "angular_velocity[1] is a speed, not an angular speed"));
  EXPECT_TRUE(has(motion_refusal(ball("angular_velocity: [0, 10001 rad/s, 0]")), "angular_velocity[1] is out of range"));
  EXPECT_TRUE(has(motion_refusal(ball("velocity: [0, 1 rpm, 0]")), "velocity[1] is an angular speed, not a speed"));
}

TEST(motion_in_files, has_keyframes_of_objects_and_of_the_camera) {
  const Scene scene = load::scene_from_text(
      "camera: {keyframes: [{time: -1 s, pose: {position: [0.1, 0.2, -0.3], look_at: [0, 0, 1]}}, {time: 500 ms, pose: {position: [0, 0, "
      "0], "
      "look_at: [0, 0, 1], up: [0.1, -1, 0]}}], lens.f_number: 2}\n" +
          ball("keyframes: [{time: 0 s}, {time: 2 s, position: [1, 2, 3], rotation: {axis: [0, 1, 0], angle: 720 deg}}]"),
      "m.yaml", {});
  ASSERT_EQ(scene.camera.keyframes.size(), 2u);
  EXPECT_EQ(scene.camera.keyframes[0].time_s, -1);
  EXPECT_EQ(scene.camera.keyframes[0].pose.position, (Vec3{0.1, 0.2, -0.3}));
  EXPECT_EQ(scene.camera.keyframes[1].time_s, 0.5);
  EXPECT_EQ(scene.camera.keyframes[1].pose.up, (Vec3{0.1, -1, 0}));
  EXPECT_EQ(load_camera(scene).lens.f_number, 2) << "keys of the profile beside them";
  const std::vector<Keyframe>& keys = scene.objects[0].keyframes;
  ASSERT_EQ(keys.size(), 2u);
  EXPECT_EQ(keys[0].position, (Vec3{0, 0, 0}));
  EXPECT_EQ(keys[1].time_s, 2);
  EXPECT_NEAR(keys[1].rotation.angle_rad, 4 * test::pi, 1e-14);
}

TEST(motion_in_files, refuses_what_goes_two_ways_or_backward) {
  const std::pair<std::string, const char*> cases[] = {
      {ball("keyframes: [{time: 1 s}, {time: 0.5 s}]"),
       "m.yaml:1:105: error: a keyframe is not later than the one before\n  got 0.5 s after 1 s"},
      {ball("keyframes: [{time: 1 s}, {time: 1 s}]"), "a keyframe is not later than the one before\n  got 1 s after 1 s"},
      {ball("position: [1, 0, 0], keyframes: [{time: 0 s}]"), "the object has keyframes and a position"},
      {ball("rotation: {axis: [0, 1, 0], angle: 1 deg}, keyframes: [{time: 0 s}]"), "the object has keyframes and a rotation"},
      {ball("velocity: [1 m/s, 0, 0], keyframes: [{time: 0 s}]"), "the object has keyframes and a velocity"},
      {ball("angular_velocity: [1 rpm, 0, 0], keyframes: [{time: 0 s}]"),
       "the object has keyframes and an angular velocity\n  its keyframes say where it is; take the one out or the other"},
      {ball("keyframes: [{position: [0, 0, 1]}]"), "keyframes[0] lacks the key \"time\""},
      {ball("keyframes: [{time: 5}]"), "time has no unit"},
      {ball("keyframes: [{time: 1000001 s}]"), "time is out of range"},
      {with_camera("{time: 1 s}, {time: 1 s}"), "a keyframe is not later than the one before"},
      {"camera: {pose: {position: [0, 0, 0], look_at: [0, 0, 2]}, keyframes: [{time: 0 s}]}\nobjects: []\n",
       "the camera has keyframes and a pose"},
      {with_camera("{time: 0 s, pose: {position: [0, 0, 0], look_at: [0, 0, 0]}}"), "the camera looks at the point where it stands"},
  };
  for (const auto& [text, expected] : cases) EXPECT_TRUE(has(motion_refusal(text), expected)) << text << motion_refusal(text);
}

TEST(motion_in_files, refuses_a_camera_that_turns_a_quarter_between_two_keyframes) {
  const auto turning = [](const std::string& look_at, const std::string& up) {
    return with_camera("{time: 0 s, pose: {position: [0, 0, 0], look_at: [0, 0, 1]}}, {time: 1 s, pose: {position: [0, 0, 0], look_at: " +
                       look_at + ", up: " + up + "}}");
  };
  for (const char* look_at : {"[1, 0, 0]", "[1, 0, -0.1]", "[0, 0, -1]"})
    EXPECT_TRUE(has(motion_refusal(turning(look_at, "[0, -1, 0]")), "the camera turns too far between two keyframes")) << look_at;
  for (const char* up : {"[1, 0, 0]", "[1, 0.1, 0]", "[0, 1, 0]"})
    EXPECT_TRUE(has(motion_refusal(turning("[0, 0, 1]", up)), "put another keyframe between them")) << up;
  EXPECT_EQ(motion_refusal(turning("[1, 0, 0.1]", "[0, -1, 0]")), "");
  EXPECT_EQ(motion_refusal(turning("[0, 0, 1]", "[1, -0.1, 0]")), "");
}

TEST(motion_in_files, has_a_camera_that_turns_as_far_as_quaternions_say) {
  EXPECT_EQ(motion_refusal(with_camera("{time: 0 s, pose: {quaternion: [0, 0, 0, 1]}}, "
                                       "{time: 1 s, pose: {position: [0, 0, 3], quaternion: [0, 1, 0, 0]}}, {time: 2 s}")),
            "");
}

TEST(motion_in_files, has_no_more_keyframes_than_the_limit) {
  for (const int more : {0, 1}) {
    std::string keys;
    for (std::int64_t i = 0; i < base::limit::keyframes.value + more; ++i) keys += "{time: " + std::to_string(i) + " ms}, ";
    const std::string said = motion_refusal(ball("keyframes: [" + keys + "]"), ErrorKind::limit);
    EXPECT_EQ(has(said, "keyframes has too many elements\n  got 100001, at most 100000"), more == 1) << said;
    if (more == 0) {
      EXPECT_EQ(said, "");
    }
  }
}

// Faults of motion in structs are told by the names of their members.
TEST(motion_in_code, is_checked_as_that_of_files) {
  const auto refused = [](const std::function<void(Scene&)>& change) -> std::string {
    Scene scene;
    scene.materials.push_back({"", Material::Brdf::lambert, 0.5});
    scene.objects.push_back({"", Sphere{{0, 0, 1}, 0.2}, 0});
    change(scene);
    try {
      const Simulator simulator(scene, load_camera("pico-flexx"));
    } catch (const Error& error) {
      return error.what();
    }
    return "";
  };
  EXPECT_TRUE(has(refused([](Scene& s) {
                    s.objects[0].keyframes = {{1}, {1}};
                  }),
                  "a keyframe is not later than the one before"))
      << refused([](Scene& s) {
           s.objects[0].keyframes = {{1}, {1}};
         });
  EXPECT_TRUE(has(refused([](Scene& s) {
                    s.objects[0].keyframes = {{1}}, s.objects[0].position = {0, 0, 1};
                  }),
                  "keyframes and a position"));
  EXPECT_TRUE(has(refused([](Scene& s) {
                    s.objects[0].angular_velocity_rad_per_s = {0, std::nan(""), 0};
                  }),
                  "angular_velocity_rad_per_s[1]"));
  EXPECT_TRUE(has(refused([](Scene& s) { s.objects[0].keyframes = {{std::nan("")}}; }), "keyframes[0].time_s"));
  EXPECT_TRUE(has(refused([](Scene& s) {
                    s.camera.keyframes = {{0, {{0, 0, 0}, {0, 0, 1}}}, {1, {{0, 0, 0}, {0, 0, -1}}}};
                  }),
                  "the camera turns too far between two keyframes"));
  EXPECT_TRUE(has(refused([](Scene& s) {
                    s.camera.keyframes = {{0, {}}}, s.camera.pose.position = {1, 0, 0};
                  }),
                  "the camera has keyframes and a pose"));
}
