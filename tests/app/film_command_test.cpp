// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
// `tofray inspect` and `tofray process` of MCAP files. (What is in them: tests/ros, tests/messages, tests/mcap.)
#include <gtest/gtest.h>

#include <algorithm>

#include "files/json.h"
#include "support/tool.h"

namespace tofray::test {
namespace {

/// Three frames as npz and as MCAP, made once.
const Folder& film() {
  static const Folder folder;
  static const bool made = [] {
    const Result result =
        run(with_small_sensor({"render", "flying-ball", "-o", "out", "--frames", "3", "--emit", "npz,mcap", "--seed", "4"}),
            in_folder(folder.path()));
    EXPECT_EQ(result.code, 0) << result.err;
    return true;
  }();
  EXPECT_TRUE(made);
  return folder;
}
Result of_film(const Arguments& arguments) { return run(arguments, in_folder(film().path())); }

std::string bytes_of(const fs::path& path) {
  std::ifstream stream(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
}

TEST(inspect_film, lists_topics_types_counts_rates_and_sizes) {
  const Result result = of_film({"inspect", "out/run.mcap"});
  ASSERT_EQ(result.code, 0) << result.err;
  EXPECT_EQ(result.err, "");
  EXPECT_TRUE(has(result.out, "out/run.mcap: MCAP, profile ros2, by tofray ")) << result.out;
  EXPECT_TRUE(
      has(result.out, "/camera/points                       sensor_msgs/msg/PointCloud2                    3        15        15.0\n"))
      << result.out;
  EXPECT_TRUE(
      has(result.out, "/tf_static                           tf2_msgs/msg/TFMessage                         1         -         0.1\n"))
      << result.out;
  EXPECT_TRUE(has(result.out, "attached: camera.yaml (") && has(result.out, "attached: scene.yaml (")) << result.out;
  EXPECT_TRUE(has(result.out, "seed 4")) << result.out;
}

TEST(inspect_film, says_the_same_as_json) {
  const Result result = of_film({"inspect", "out/run.mcap", "--json"});
  ASSERT_EQ(result.code, 0) << result.err;
  const files::Json json = files::parse_json(result.out, "inspect");
  EXPECT_TRUE(*json.find("complete")->boolean());
  std::uint64_t bytes = 0, total = 0;
  EXPECT_TRUE(json.find("bytes")->unsigned_integer(bytes));
  EXPECT_EQ(bytes, fs::file_size(film() / "out/run.mcap"));
  EXPECT_TRUE(json.find("messages")->unsigned_integer(total));
  std::uint64_t sum = 0;
  for (const files::Json& channel : *json.find("channels")->items()) {
    std::uint64_t messages = 0;
    double rate = 0;
    EXPECT_TRUE(channel.find("messages")->unsigned_integer(messages) && channel.find("rate_hz")->number(rate));
    sum += messages;
    const std::string topic = *channel.find("topic")->string();
    if (topic == "/camera/points") {
      EXPECT_NEAR(rate, 15, 0.01) << topic;
    }
  }
  EXPECT_EQ(sum, total);
}

TEST(inspect_film, of_a_cut_file_says_so_and_shows_what_is_left) {
  const std::string whole = bytes_of(film() / "out/run.mcap");
  std::ofstream(film() / "cut.mcap", std::ios::binary) << whole.substr(0, whole.size() - 100);
  const Result result = of_film({"inspect", "cut.mcap"});
  EXPECT_EQ(result.code, 0);
  EXPECT_TRUE(has(result.err, "warning: cut.mcap ends early: its writer was stopped, or it was cut")) << result.err;
  EXPECT_TRUE(has(result.out, "/camera/points")) << result.out;
}

TEST(inspect_film, of_a_damaged_file_says_where) {
  std::string damaged = bytes_of(film() / "out/run.mcap");
  damaged[damaged.size() / 2] = static_cast<char>(damaged[damaged.size() / 2] ^ 1);
  std::ofstream(film() / "damaged.mcap", std::ios::binary) << damaged;
  const Result result = of_film({"inspect", "damaged.mcap"});
  EXPECT_EQ(result.code, 2);
  EXPECT_TRUE(has(result.err, "damaged.mcap: error: the chunk at byte ") && has(result.err, " is damaged\n")) << result.err;
}

TEST(process_film, makes_the_depth_that_render_made) {
  const Result result = of_film({"process", "out/run.mcap", "-o", "again"});
  ASSERT_EQ(result.code, 0) << result.err;
  for (const char* name : {"frame_0000.npz", "frame_0001.npz", "frame_0002.npz"}) {
    for (const char* array : {"raw", "z_m", "range_m", "points_m", "amplitude_e", "noise_m", "confidence", "flags", "start_time_s",
                              "reference_phase_rad", "lit", "camera_matrix"}) {
      const auto before = files::read_npz(film() / "out" / name, {array}), after = files::read_npz(film() / "again" / name, {array});
      ASSERT_EQ(after.size(), 1U) << array;
      EXPECT_EQ(after[0].array.bytes, before[0].array.bytes) << name << " " << array;
      EXPECT_EQ(after[0].array.shape, before[0].array.shape) << name << " " << array;
    }
  }
}

TEST(process_film, takes_the_frames_that_are_asked_for_and_another_camera_s_settings) {
  const Result result = of_film({"process", "out/run.mcap", "-o", "one", "--first-frame", "1", "--frames", "1", "--set",
                                 "camera.decoding.noise_threshold=1 mm", "--emit", "npz,png"});
  ASSERT_EQ(result.code, 0) << result.err;
  EXPECT_TRUE(fs::exists(film() / "one/frame_0001.npz") && fs::exists(film() / "one/preview_0001.png"));
  EXPECT_FALSE(fs::exists(film() / "one/frame_0000.npz") || fs::exists(film() / "one/frame_0002.npz"));
  EXPECT_NE(files::read_npz(film() / "one/frame_0001.npz", {"flags"})[0].array.bytes,
            files::read_npz(film() / "out/frame_0001.npz", {"flags"})[0].array.bytes);
  EXPECT_TRUE(has(of_film({"process", "out/run.mcap", "-o", "none", "--first-frame", "7"}).err,
                  "there are no raw frames of these numbers in it\n  it has 3 frames"));
}

TEST(process_film, of_a_film_without_raw_topics_says_what_would_have_them) {
  ASSERT_EQ(of_film(with_small_sensor({"render", "card", "-o", "bare", "--emit", "mcap", "--topics", "depth"})).code, 0);
  const Result result = of_film({"process", "bare/run.mcap"});
  EXPECT_EQ(result.code, 2);
  EXPECT_TRUE(has(result.err, "bare/run.mcap: error: there are no raw frames in it\n  expected the topics raw/p0")) << result.err;
}

TEST(process_film, writes_no_film) {
  const Result result = of_film({"process", "out/frame_0000.npz", "--emit", "mcap"});
  EXPECT_EQ(result.code, 2);
  EXPECT_TRUE(has(result.err, "--emit mcap is of `tofray render`")) << result.err;
}

TEST(films, given_to_other_commands_are_called_what_they_are) {
  EXPECT_TRUE(has(of_film({"render", "out/run.mcap"}).err, "this is a film (MCAP), not a scene"))
      << of_film({"render", "out/run.mcap"}).err;
  EXPECT_TRUE(has(of_film({"quality", "out/run.mcap"}).err, "`tofray process out/run.mcap -o out` makes"));
  ASSERT_EQ(of_film(with_small_sensor({"render", "card", "-o", "only", "--emit", "mcap"})).code, 0);
  EXPECT_TRUE(has(of_film({"inspect", "only"}).err, "as in `tofray inspect only/run.mcap`")) << of_film({"inspect", "only"}).err;
}

TEST(films, of_a_disk_that_fills_say_so_and_leave_what_was_written) {
  const Folder folder;
  const Prepare small_disk = [&folder] {
    if (::chdir(folder.path().c_str()) != 0) ::_exit(99);
    const rlimit limit{500'000, 500'000};  // of a file; a write beyond it fails, as on a full disk
    ::setrlimit(RLIMIT_FSIZE, &limit);
    std::signal(SIGXFSZ, SIG_IGN);
  };
  const Result result =
      run(with_small_sensor({"render", "flying-ball", "-o", "out", "--frames", "2000", "--emit", "mcap", "--mcap-compression", "none"}),
          small_disk);
  EXPECT_EQ(result.code, 3);
  EXPECT_TRUE(has(result.err, "out/run.part.mcap: error: cannot write it: File too large")) << result.err;
  EXPECT_FALSE(fs::exists(folder / "out/run.mcap"));
  const Result left = run({"inspect", "out/run.part.mcap"}, in_folder(folder.path()));
  EXPECT_EQ(left.code, 0) << left.err;
  EXPECT_TRUE(has(left.err, "ends early")) << left.err;
}

}  // namespace
}  // namespace tofray::test
