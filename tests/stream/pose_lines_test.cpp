// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
// Poses that arrive line by line, as a program writes them into a pipe.
#include "run/pose_lines.h"

#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <string>
#include <thread>

#include "tofray/error.h"

namespace tofray::run {
namespace {

namespace fs = std::filesystem;

const std::atomic<bool> go_on{false};

class pose_lines : public testing::Test {
 protected:
  pose_lines() { fs::create_directories(folder_); }
  ~pose_lines() override { fs::remove_all(folder_); }
  std::string file(const std::string& text) {
    std::ofstream(folder_ / "poses.txt", std::ios::binary) << text;
    return (folder_ / "poses.txt").string();
  }
  std::string pipe() {
    const std::string name = (folder_ / "pipe").string();
    EXPECT_EQ(::mkfifo(name.c_str(), 0600), 0);
    return name;
  }
  /// What reading to the end says.
  std::string fault(const std::string& text) {
    PoseLines poses(file(text));
    try {
      poses.reach(1e9, go_on);
    } catch (const Error& error) {
      return std::string(error.what()).substr(std::string(error.what()).find("poses.txt"));
    }
    return "";
  }

 private:
  fs::path folder_ = fs::temp_directory_path() / ("tofray-poses-" + std::to_string(::getpid()));
};

TEST_F(pose_lines, are_there_as_soon_as_they_came) {
  const std::string name = pipe();
  std::jthread writer([&] {
    std::ofstream out(name);
    out << "0 1 2 3 0 0 0 1\n0.5 2 2 3 0 0" << std::flush;  // a line comes in parts
    std::this_thread::sleep_for(std::chrono::milliseconds(30));
    out << " 0 1\n1 3 2 3 0 0 0 1" << std::flush;  // the last one without its end
  });
  PoseLines poses(name);
  EXPECT_FALSE(poses.first_s());
  EXPECT_TRUE(poses.reach(0.25, go_on));
  EXPECT_EQ(poses.first_s(), 0);
  const auto first = poses.between(0, 0.25);
  ASSERT_EQ(first.size(), 2u);
  EXPECT_EQ(first[1].time_s, 0.5);
  EXPECT_EQ(first[1].pose.position, (Vec3{2, 2, 3}));
  EXPECT_TRUE(poses.reach(1, go_on));
  writer.join();
  EXPECT_FALSE(poses.reach(1.01, go_on));  // the lines have ended
  EXPECT_EQ(poses.last_s(), 1);
}

TEST_F(pose_lines, of_a_time_are_the_last_before_those_between_and_the_first_behind) {
  PoseLines poses(
      file("# t x y z qx qy qz qw\r\n\r\n0 0 0 0 0 0 0 1\r\n1,1,0,0,0,0,0,1\r\n2 2 0 0 0 0 0 1\r\n3 3 0 0 0 0 0 1\r\n4 4 0 0 0 0 0 1\r\n"));
  ASSERT_TRUE(poses.reach(4, go_on));
  const auto times = [&](double from_s, double to_s) {
    std::vector<double> out;
    for (const CameraKeyframe& one : poses.between(from_s, to_s)) out.push_back(one.time_s);
    return out;
  };
  EXPECT_EQ(times(0.5, 0.75), (std::vector<double>{0, 1}));
  EXPECT_EQ(times(1, 2.5), (std::vector<double>{1, 2, 3}));
  EXPECT_EQ(times(3.5, 9), (std::vector<double>{3, 4}));
  EXPECT_EQ(times(5, 9), (std::vector<double>{4}));
  EXPECT_EQ(poses.first_s(), 0);
}

TEST_F(pose_lines, of_another_order_have_a_header_and_times_of_a_clock_begin_at_0) {
  PoseLines poses(file(
      "time [ns], qw, qx, qy, qz, x [mm], y, z\n1732665600000000000, 1, 0, 0, 0, 5, 6, 7\n1732665600250000000, 1, 0, 0, 0, 5, 6, 7\n"));
  ASSERT_TRUE(poses.reach(0.25, go_on));
  EXPECT_EQ(poses.between(0, 0.1).front().pose.position, (Vec3{0.005, 6, 7}));
  EXPECT_EQ(poses.last_s(), 0.25);
}

TEST_F(pose_lines, that_are_none_are_refused_with_their_number) {
  EXPECT_EQ(fault("0 0 0 0 0 0 0 1\n# a note\n1 0 0 0 0 0 1\n").substr(0, 53), "poses.txt:3:1: error: the line has the wrong number o");
  EXPECT_NE(fault("0 0 0 0 0 0 0 1\n0 0 0 0 0 0 0 1\n").find("poses.txt:2:1: error: the time is not later"), std::string::npos);
  EXPECT_NE(fault("0 0 0 0 0 0 0 1\n1 nan 0 0 0 0 0 1\n").find("poses.txt:2:3: error: x is not finite"), std::string::npos);
  EXPECT_NE(fault("0 0 0 0 0 0 0 0\n").find("poses.txt:1:9: error: "), std::string::npos);
  EXPECT_NE(fault(std::string(20'000, '1')).find("a line has more than 10000 bytes"), std::string::npos);
  EXPECT_EQ(fault(""), "");
  EXPECT_THROW(PoseLines("/nowhere/poses"), Error);
}

TEST_F(pose_lines, are_not_waited_for_once_it_stops) {
  const std::string name = pipe();
  std::ofstream writer;
  std::jthread opening([&] { writer.open(name); });
  PoseLines poses(name);
  opening.join();
  std::atomic<bool> stop{false};
  std::jthread stopping([&] { stop = true; });
  EXPECT_FALSE(poses.reach(0, stop));
  stopping.join();
}

}  // namespace
}  // namespace tofray::run
