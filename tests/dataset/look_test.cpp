// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
// Cameras that look at a thing: from how far, from where, with nothing before the lens.
#include <gtest/gtest.h>

#include <cmath>

#include "support/samples.h"
#include "support/text.h"
#include "tofray/tofray.h"

namespace {

using namespace tofray;
using out_test::write_file;
using test::has;

constexpr double half_turn = 3.141592653589793;

class LookSet {
 public:
  explicit LookSet(const std::string& look, const std::string& objects = "", const std::string& more = "") {
    write_file(folder_.file("set.yaml"), "name: trial\nsamples: 300\nseed: 3\nviews: 2\nscene:\n" + more +
                                             "  camera: {profile: pico-flexx, pose: " + look +
                                             "}\n  objects:\n"
                                             "    - plane: {name: floor, point: [0, 60 cm, 0], normal: [0, -1, 0], reflectivity: 0.5}\n"
                                             "    - sphere: {name: ball, center: [10 cm, 20 cm, 2 m], radius: 8 cm, reflectivity: 0.5}\n" +
                                             objects);
  }
  [[nodiscard]] Dataset get() const { return Dataset(folder_.file("set.yaml")); }

 private:
  out_test::TemporaryFolder folder_;
};

TEST(look, is_at_the_thing_from_the_radius_and_elevation_that_are_said) {
  const LookSet file("{look: {at: ball, radius: [0.8 m, 2 m], elevation: [20 deg, 50 deg]}}");
  const Dataset set = file.get();
  double lowest = 1000, highest = -1000, nearest = 10, farthest = 0, left = 0;
  for (std::uint64_t i = 0; i < 100; ++i)
    for (std::uint64_t view = 0; view < 2; ++view) {
      const Scene scene = set.scene(i, view);
      const Vec3 eye = scene.camera.pose.position, from{eye[0] - 0.1, eye[1] - 0.2, eye[2] - 2};
      const double radius = std::hypot(from[0], from[1], from[2]), elevation = std::asin(-from[1] / radius) * 180 / half_turn;
      nearest = std::min(nearest, radius), farthest = std::max(farthest, radius);
      lowest = std::min(lowest, elevation), highest = std::max(highest, elevation);
      left += from[0] < 0 ? 1 : 0;
      const double dot = scene.camera.pose.up[0] * from[0] + scene.camera.pose.up[1] * from[1] + scene.camera.pose.up[2] * from[2];
      EXPECT_NEAR(dot, 0, 1e-9);
      EXPECT_LT(scene.camera.pose.up[1], 0) << "what is up in the image is up in the world";
      EXPECT_NE(set.scene(i, 0).camera.pose.position, set.scene(i, 1).camera.pose.position);
      if (view == 0 && i < 5) {
        const Frame frame = Simulator(scene, load_camera(scene)).frame(0);
        EXPECT_EQ(frame.truth.object_id[static_cast<std::size_t>(85 * 224 + 111)], 1) << "the middle of the image is the ball";
      }
    }
  EXPECT_GE(nearest, 0.8 - 1e-9);
  EXPECT_LE(farthest, 2 + 1e-9);
  EXPECT_LT(nearest, 0.85);
  EXPECT_GT(farthest, 1.95);
  EXPECT_GE(lowest, 20 - 1e-6);
  EXPECT_LE(highest, 50 + 1e-6);
  EXPECT_NEAR(left, 100, 4.5 * std::sqrt(50.0)) << "from all around";
}

TEST(look, of_azimuth_0_is_from_ahead_and_straight_above_has_an_up) {
  const LookSet ahead("{look: {at: [0, 0, 0], radius: 50 cm, azimuth: 0 deg}}"),
      above("{look: {at: [0, 0, 0], radius: 50 cm, elevation: 90 deg}}");
  const Vec3 eye = ahead.get().scene(0).camera.pose.position;
  EXPECT_NEAR(eye[2], 0.5, 1e-12);
  EXPECT_NEAR(eye[0], 0, 1e-12);
  const Pose pose = above.get().scene(0).camera.pose;
  EXPECT_NEAR(pose.position[1], -0.5, 1e-12);
  EXPECT_NEAR(std::hypot(pose.up[0], pose.up[2]), 1, 1e-9);
  const LookSet z_up("{look: {at: [0, 0, 0], radius: 50 cm, elevation: 90 deg}}", "", "  world_up: z\n");
  EXPECT_NEAR(z_up.get().scene(0).camera.pose.position[2], 0.5, 1e-12);
}

TEST(look, turns_the_image_by_roll) {
  const LookSet level("{look: {at: ball, radius: 1 m, azimuth: 180 deg}}"),
      rolled("{look: {at: ball, radius: 1 m, azimuth: 180 deg, roll: 30 deg}}");
  const Vec3 a = level.get().scene(0).camera.pose.up, b = rolled.get().scene(0).camera.pose.up;
  EXPECT_NEAR(a[0] * b[0] + a[1] * b[1] + a[2] * b[2], std::cos(half_turn / 6), 1e-9);
}

TEST(look, keeps_clear_of_things_and_stays_on_their_side_of_planes) {
  const LookSet file("{look: {at: ball, radius: [10 cm, 1.5 m], elevation: [-90 deg, 90 deg], clear: 20 cm}}",
                     "    - box: {name: post, min: [-40 cm, -1 m, 1.5 m], max: [-20 cm, 60 cm, 1.7 m], reflectivity: 0.5}\n");
  const Dataset set = file.get();
  double tries = 0;
  for (std::uint64_t i = 0; i < 150; ++i) {
    const Vec3 eye = set.scene(i).camera.pose.position;
    EXPECT_LE(eye[1], 0.4 + 1e-9) << "above the floor";
    EXPECT_GE(std::hypot(eye[0] - 0.1, eye[1] - 0.2, eye[2] - 2), 0.28 - 1e-9);
    const double dx = std::max(0.0, std::abs(eye[0] + 0.3) - 0.1), dy = std::max(0.0, std::abs(eye[1] + 0.2) - 0.8),
                 dz = std::max(0.0, std::abs(eye[2] - 1.6) - 0.1);
    EXPECT_GE(std::hypot(dx, dy, dz), 0.2 - 1e-9);
    tries += set.drawn(i).back().value;
  }
  EXPECT_GT(tries, 50) << "many places were refused";
  const LookSet nowhere("{look: {at: ball, radius: 10 cm, clear: 20 cm, tries: 7}}");
  EXPECT_TRUE(
      has(out_test::error_of([&] { (void)nowhere.get().scene_yaml(0); }).what(), "the camera finds no place to look from in 7 tries"));
}

TEST(look, is_at_a_scatter_and_at_names_that_are_drawn) {
  const std::string things =
      "    - scatter: {name: clutter, count: 4, of: {sphere: {center: [0, 0, 0], radius: 3 cm, reflectivity: 0.5}}, surface: floor, "
      "within: 50 cm}\n";
  const Scene scene = LookSet("{look: {at: clutter, radius: 1 m, elevation: 40 deg}}", things).get().scene(2);
  Vec3 middle{};
  for (std::size_t i = 2; i < 6; ++i)
    for (std::size_t k = 0; k < 3; ++k) middle[k] += scene.objects[i].position[k] / 4;
  for (std::size_t k = 0; k < 3; ++k) EXPECT_NEAR(scene.camera.pose.look_at[k], middle[k], 1e-9);
  const Dataset drawn = LookSet("{look: {at: {choice: [ball, floor]}, radius: 1 m, elevation: 40 deg}}").get();
  int balls = 0;
  for (std::uint64_t i = 0; i < 100; ++i) balls += drawn.scene(i).camera.pose.look_at[2] > 1 ? 1 : 0;
  EXPECT_GT(balls, 25);
  EXPECT_LT(balls, 75);
}

TEST(look, that_makes_no_sense_is_refused_where_it_stands) {
  for (const auto& [look, message] : std::vector<std::pair<std::string, std::string>>{
           {"{look: {at: bal, radius: 1 m}}", "there is no object \"bal\" to look at; did you mean \"ball\""},
           {"{look: {radius: 1 m}}", "look lacks the key at"},
           {"{look: {at: ball}}", "look lacks the key radius"},
           {"{look: {at: ball, radius: 0 m}}", "radius of look is not above 0"},
           {"{look: {at: ball, radius: [2 m, 1 m]}}", "the lower end first"},
           {"{look: {at: ball, radius: [2 m, 1 m, 3 m]}}", "or two"},
           {"{look: {at: ball, radius: 30 deg}}", "expected a length"},
           {"{look: {at: ball, radius: 1 m, elevation: 100 deg}}", "beyond straight up or down"},
           {"{look: {at: [0, 1 m], radius: 1 m}}", "at of look is no point"},
           {"{look: {at: ball, radius: 1 m, tries: 0}}", "tries of look"},
           {"{look: {at: ball, radius: 1 m, raduis: 2}}", "unknown key \"raduis\" in look; did you mean \"radius\""},
           {"{look: {at: ball, radius: 1 m}, up: [0, -1, 0]}", "beside look stands another key of a pose"},
           {"{look: 5}", "look is not what belongs here"}}) {
    const LookSet file(look);
    const Error error = out_test::error_of([&] { (void)file.get().scene_yaml(0); });
    EXPECT_TRUE(has(error.what(), message) && has(error.what(), "set.yaml:6:")) << look << "\n" << error.what();
  }
  const LookSet viewed(
      "{look: {at: ball, radius: 1 m}}",
      "    - scatter: {name: a, count: 1, of: {sphere: {center: [0, 0, 0], radius: 3 cm, reflectivity: 0.5}}, view: [1 m, 2 m]}\n");
  EXPECT_TRUE(has(out_test::error_of([&] { (void)viewed.get().scene_yaml(0); }).what(),
                  "things are put into the view of a camera that is put by `look`"));
}

}  // namespace
