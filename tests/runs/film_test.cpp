// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
// Films of things in motion: --fps, --exposure-samples, and what the manifest remembers of both.
#include <gtest/gtest.h>

#include "support/tool.h"

namespace tofray::test {
namespace {

constexpr const char* film_scene =
    "camera: {profile: pico-flexx, mode: MODE_5_35FPS_600, keyframes: [{time: 0 s, pose: {position: [0, 0, 0], look_at: [0, 0, 1]}}, "
    "{time: 1 "
    "s, pose: {position: [0.2, 0, 0], look_at: [0, 0, 1]}}]}\n"
    "objects:\n"
    "  - plane: {point: [0, 0, 1.2], normal: [0, 0, -1], reflectivity: 0.6}\n"
    "  - box: {min: [-0.2, -0.2, 0.7], max: [0.2, 0.2, 0.9], reflectivity: 0.8, angular_velocity: [0, 300 deg/s, 90 rpm]}\n";

/// A folder with the scene in it.
struct FilmFolder {
  FilmFolder() { std::ofstream(folder / "film.yaml") << film_scene; }
  [[nodiscard]] Result run(const Arguments& arguments) const { return test::run(with_small_sensor(arguments), in_folder(folder.path())); }
  [[nodiscard]] std::vector<double> numbers(const std::string& file, const char* name) const { return numbers_of(folder / file, name); }
  Folder folder;
};

}  // namespace

TEST(film, of_from_a_manifest_has_the_same_bytes) {
  const FilmFolder film;
  const Result made = film.run({"render", "film.yaml", "-o", "out", "--frames", "3", "--fps", "12.5", "--exposure-samples", "3"});
  ASSERT_EQ(made.code, 0) << made.err;
  const Result again = run({"render", "--from", "out/manifest.json", "-o", "again"}, in_folder(film.folder.path()));
  EXPECT_EQ(again.code, 0) << again.err;
  EXPECT_EQ(files_of(film.folder / "out"), files_of(film.folder / "again"));
  EXPECT_EQ(run({"render", "--from", "out/manifest.json", "--fps", "10"}, in_folder(film.folder.path())).code, 2);
  EXPECT_EQ(run({"render", "--from", "out/manifest.json", "--exposure-samples", "2"}, in_folder(film.folder.path())).code, 2);
  // Both count.
  ASSERT_EQ(film.run({"render", "film.yaml", "-o", "once", "--frames", "3", "--fps", "12.5"}).code, 0);
  EXPECT_NE(film.numbers("out/frame_0001.npz", "tap_a"), film.numbers("once/frame_0001.npz", "tap_a"));
}

TEST(film, begins_each_frame_at_its_time_and_says_where_the_camera_is_then) {
  const FilmFolder film;
  ASSERT_EQ(film.run({"render", "film.yaml", "-o", "out", "--frames", "3", "--fps", "12.5"}).code, 0);
  EXPECT_NEAR(film.numbers("out/frame_0002.npz", "start_time_s").at(0), 2 / 12.5, 1e-12);
  const std::vector<double> pose = film.numbers("out/frame_0002.npz", "camera_pose");
  // The middle one of five raw frames: after the grey one of 0.2 ms and a lit one of 0.6 ms, with 3.5 ms behind each.
  const double truth = 2 / 12.5 + 0.2e-3 + 0.6e-3 + 2 * 3.5e-3 + 0.3e-3;
  EXPECT_NEAR(pose.at(3), 0.2 * truth, 1e-9);
}

TEST(film, of_too_many_frames_a_second_is_refused_with_the_way_out) {
  const FilmFolder film;
  const Result fast = film.run({"render", "film.yaml", "-o", "out", "--fps", "300"});
  EXPECT_EQ(fast.code, 2);
  EXPECT_TRUE(has(fast.err, "camera.frame_rate: error: the sequence does not fit into a frame")) << fast.err;
  EXPECT_TRUE(has(fast.err, "lower integration_time or frame_rate (--fps)")) << fast.err;
  for (const char* wrong : {"0", "-3", "abc", "", "nan", "inf", "1e9", "15 Hz", "15x"}) {
    const Result result = film.run({"render", "film.yaml", "-o", "out", "--fps", wrong});
    EXPECT_EQ(result.code, 2) << wrong;
    EXPECT_TRUE(has(result.err,
                    "error: --fps cannot be \"" + std::string(wrong) + "\"\n  expected frames per second, a number of 0.0001 to 100000"))
        << result.err;
  }
  for (const char* wrong : {"0", "-1", "1001", "2.5", "many"}) {
    const Result result = film.run({"render", "film.yaml", "-o", "out", "--exposure-samples", wrong});
    EXPECT_EQ(result.code, 2) << wrong;
    EXPECT_TRUE(has(result.err, "expected a whole number of 1 to 1000")) << result.err;
  }
  EXPECT_FALSE(fs::exists(film.folder / "out"));
}

}  // namespace tofray::test
