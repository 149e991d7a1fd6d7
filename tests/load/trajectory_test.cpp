// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
// Files of poses as trackers, robots and spreadsheets write them, and what is refused.
#include "load/trajectory.h"

#include <gtest/gtest.h>

#include <sys/stat.h>
#include <map>

#include <cmath>

#include "base/limits.h"
#include "load/load.h"
#include "support/samples.h"
#include "support/text.h"
#include "tofray/tofray.h"

namespace {

using namespace tofray;
using load::TimedPose;
using out_test::write_file;
using test::has;

std::vector<TimedPose> poses_in(const std::string& text, const load::TrajectoryTimes& times = {}) {
  base::Faults faults;
  std::optional<load::Stamp> clock;
  std::vector<TimedPose> out = load::parse_trajectory(text, "p.csv", times, clock, faults);
  EXPECT_EQ(faults.text(), "") << text;
  return out;
}
std::string fault_in(const std::string& text, const load::TrajectoryTimes& times = {}) {
  base::Faults faults;
  std::optional<load::Stamp> clock;
  EXPECT_TRUE(load::parse_trajectory(text, "p.csv", times, clock, faults).empty()) << text;
  return faults.text();
}

/// Two poses: at 0.5 s and 1 s.
void expect_the_two(const std::vector<TimedPose>& poses, const std::string& text) {
  ASSERT_EQ(poses.size(), 2U) << text;
  EXPECT_EQ(poses[0].time_s, 0.5) << text;
  EXPECT_EQ(poses[1].time_s, 1.0) << text;
  EXPECT_EQ(poses[0].position, (Vec3{1, -2, 3.25})) << text;
  EXPECT_EQ(poses[1].position, (Vec3{1.5, 0, 1e-3})) << text;
  EXPECT_EQ(poses[0].quaternion, (Quaternion{0, 0, 0, 1})) << text;
  EXPECT_EQ(poses[1].quaternion, (Quaternion{0.5, -0.5, 0.5, 0.5})) << text;
}

class keyframe_files : public testing::Test {
 protected:
  void SetUp() override { std::filesystem::create_directory(folder_.path() / "in"); }
  void file(const std::string& name, const std::string& text) const { write_file(folder_.path() / name, text); }
  [[nodiscard]] Scene scene(const std::string& camera, const std::string& ball = "", const assets::MeshFiles& files = {},
                            const std::string& before = "") const {
    return load::scene_from_text(
        before + "camera: {" + camera + "}\nobjects:\n  - sphere: {center: [0, 0, 2], radius: 20 cm, reflectivity: 0.5" + ball + "}\n",
        folder_.file("in/s.yaml"), {}, files);
  }
  [[nodiscard]] std::string refusal(const std::string& camera, ErrorKind kind = ErrorKind::bad_input,
                                    const assets::MeshFiles& files = {}) const {
    const Error error = out_test::error_of([&] { (void)scene(camera, "", files); });
    EXPECT_EQ(error.kind(), kind) << error.what();
    return error.what();
  }
  out_test::TemporaryFolder folder_;
};

}  // namespace

TEST(trajectory, is_read_with_any_separators_line_ends_and_headers) {
  for (const char* text : {
           "0.5 1 -2 3.25 0 0 0 1\n1 1.5 0 0.001 0.5 -0.5 0.5 0.5\n",
           "0.5,1,-2,3.25,0,0,0,1\n1,1.5,0,0.001,0.5,-0.5,0.5,0.5",
           "0.5, 1, -2, 3.25, 0, 0, 0, 1,\r\n1, 1.5, 0, 0.001, 0.5, -0.5, 0.5, 0.5,\r\n\r\n",
           "0.5;1;-2;3.25;0;0;0;1\n1;1.5;0;0.001;0.5;-0.5;0.5;0.5\n   \n",
           "0.5\t1\t-2\t3.25\t0\t0\t0\t1\r1\t1.5\t0\t0.001\t0.5\t-0.5\t0.5\t0.5\r",
           "  0.5  1 -2 \t 3.25 0 0 0 1\n\n1 1.5 0 0.001 0.5 -0.5 0.5 0.5 # the last\n",
           "+5.0e-1 1e0 -2.0E+0 325e-2 0e0 0 0 1\n1 1.5 0 1e-3 .5 -.5 .5 .5\n",
           "\xEF\xBB\xBF"
           "0.5 1 -2 3.25 0 0 0 1\n1 1.5 0 0.001 0.5 -0.5 0.5 0.5\n",
           "\xEF\xBB\xBFt,x,y,z,qx,qy,qz,qw\n\"0.5\",\"1\",-2,3.25,0,0,0,1\n1,1.5,0,0.001,0.5,-0.5,0.5,0.5\n",
           // TUM
           "# ground truth trajectory\n# file: 'room.bag'\n# timestamp tx ty tz qx qy qz qw\n0.5 1 -2 3.25 0 0 0 1\n1 1.5 0 0.001 0.5 -0.5 "
           "0.5 "
           "0.5\n",
           // EuRoC: w first, units, further columns
           "#timestamp [ns], p_RS_R_x [m], p_RS_R_y [m], p_RS_R_z [m], q_RS_w [], q_RS_x [], q_RS_y [], q_RS_z [], v_RS_R_x [m s^-1]\n"
           "500000000,1,-2,3.25,1,0,0,0,7\n1000000000,1.5,0,0.001,0.5,0.5,-0.5,0.5,8\n",
           "time,tx,ty,tz,qw,qx,qy,qz\n0.5,1,-2,3.25,1,0,0,0\n1,1.5,0,0.001,0.5,0.5,-0.5,0.5\n",
           // rostopic and PlotJuggler
           "%time,field.header.seq,field.pose.position.x,field.pose.position.y,field.pose.position.z,field.pose.orientation.x,field.pose."
           "orientation.y,field.pose.orientation.z,field.pose.orientation.w,field.twist.linear.x\n0.5,1,1,-2,3.25,0,0,0,1,9\n"
           "1,2,1.5,0,0.001,0.5,-0.5,0.5,0.5,9\n",
           "/odom/header/stamp,/odom/pose/position/x,/odom/pose/position/y,/odom/pose/position/z,/odom/pose/orientation/x,/odom/pose/"
           "orientation/"
           "y,/odom/pose/orientation/z,/odom/pose/orientation/w\n0.5,1,-2,3.25,0,0,0,1\n1,1.5,0,0.001,0.5,-0.5,0.5,0.5\n",
           "Timestamp (ms)\tPosition X (mm)\tPosition Y (mm)\tPosition Z (mm)\tRotation X\tRotation Y\tRotation Z\tRotation W\n"
           "500\t1000\t-2000\t3250\t0\t0\t0\t1\n1000\t1500\t0\t1\t0.5\t-0.5\t0.5\t0.5\n",
           "t [ms] x [mm] y [cm] z [m] qx qy qz qw\n500 1000 -200 3.25 0 0 0 1\n1000 1500 0 0.001 0.5 -0.5 0.5 0.5\n",
           "t_us x y z qx qy qz qw\n500000 1 -2 3.25 0 0 0 1\n1.0e6 1.5 0 0.001 0.5 -0.5 0.5 0.5\n",
       })
    expect_the_two(poses_in(text), text);
  expect_the_two(poses_in("500 1 -2 3.25 0 0 0 1\n1000 1.5 0 0.001 0.5 -0.5 0.5 0.5\n", {"ms", {}}), "its unit said by the scene");
}

TEST(trajectory, of_a_clock_begins_at_zero_and_keeps_its_nanoseconds) {
  const auto times = [](const std::vector<TimedPose>& poses) {
    std::vector<double> out;
    for (const TimedPose& one : poses) out.push_back(one.time_s);
    return out;
  };
  const std::string rest = " 0 0 0 0 0 0 1\n";
  const std::string tum = "1305031449.7996" + rest + "1305031449.8096" + rest + "1305031450.799600001" + rest;
  std::vector<double> got = times(poses_in(tum));
  ASSERT_EQ(got.size(), 3U);
  EXPECT_EQ(got[0], 0);
  EXPECT_NEAR(got[1], 0.01, 1e-15);
  EXPECT_NEAR(got[2], 1.000000001, 1e-15);
  // Beyond 2^53: a double alone holds no more than 256 of these.
  const std::string ns = "1403636579758555392" + rest + "1403636579758555393" + rest + "1.403636580758555392e18" + rest;
  got = times(poses_in(ns, {"ns", {}}));
  ASSERT_EQ(got.size(), 3U);
  EXPECT_NEAR(got[1], 1e-9, 1e-15);
  EXPECT_NEAR(got[2], 1, 1e-15);
  // The zero that the scene says; times that are no clock's stay.
  EXPECT_NEAR(times(poses_in(tum, {"", load::stamp_of(1305031449)}))[0], 0.7996, 1e-15);
  EXPECT_EQ(times(poses_in("3.2" + rest + "3.3" + rest)), (std::vector<double>{3.2, 3.3}));
  EXPECT_EQ(times(poses_in("-3.2" + rest + "3.3" + rest, {"", load::stamp_of(-4)})), (std::vector<double>{0.8, 7.3}));
  EXPECT_EQ(times(poses_in("1000000" + rest)), (std::vector<double>{1e6})) << "no clock yet";
  EXPECT_EQ(times(poses_in("1000000.5" + rest)), (std::vector<double>{0}));
}

TEST(trajectory, that_is_wrong_is_told_with_line_and_column) {
  const std::string good = "0 0 0 0 0 0 0 1\n";
  const std::pair<std::string, const char*> cases[] = {
      {"", "p.csv: error: there are no poses in it\n  expected lines of t x y z qx qy qz qw"},
      {"# t x y z qx qy qz qw\n\n", "there are no poses in it"},
      {good + "1 0 0 0 0 0 1\n",
       "p.csv:2:1: error: the line has the wrong number of columns\n  got 7, expected 8: t x y z qx qy qz qw, or a header"},
      {"t,x,y,z,qx,qy,qz,qw,v\n1,0,0,0,0,0,0,1\n",
       "p.csv:2:1: error: the line has the wrong number of columns\n  got 8, expected 9 as in the header"},
      {"0,5,1,5,2,5,0,0,0,1\n", "a decimal comma makes two of one"},
      {good + "1,5 0 0 0 0 0 0 1\n",
       "p.csv:2:1: error: the line has the wrong number of columns\n  got 2, expected 8: t x y z qx qy qz qw, or a header that names "
       "them\n  a decimal comma"},
      {"0,5;1;2;3;0;0;0;1\n", "p.csv:1:1: error: t is not a number\n  got \"0,5\", expected a number such as 1.5, with a decimal point"},
      {good + "1 0 zero 0 0 0 0 1\n", "p.csv:2:5: error: y is not a number\n  got \"zero\""},
      {"1,0,,0,0,0,0,1\n", "p.csv:1:5: error: y is empty"},
      {good + "1 0 nan 0 0 0 0 1\n", "p.csv:2:5: error: y is not finite\n  got \"nan\"; take the line out"},
      {good + "1 0 0 0 0 0 0 0.9\n",
       "p.csv:2:9: error: the quaternion is not of unit length\n  got a length of 0.9, expected 1; its order is x, y, z, w"},
      {good + "0 0 0 0 0 0 0 1\n", "p.csv:2:1: error: the time is not later than that of the line before\n  got \"0\"; sort the lines"},
      {"1 0 0 0 0 0 0 1\n" + good, "the time is not later"},
      {"0 0 0 100001 0 0 0 1\n", "p.csv:1:7: error: z is out of range\n  got 100001 m"},
      {"x,y,z,qx,qy,qz,qw\n", "p.csv:1:1: error: the header has no column for t\n  got \"x\", \"y\""},
      {"t,x,y,z,roll,pitch,yaw\n1,0,0,0,0,0,0\n", "the header has no column for qx, qy, qz and qw"},
      {"t,x,y,z,qx,qy,qz,qw,time\n",
       "p.csv:1:21: error: the header has two columns for t\n  got \"t\" and \"time\"; take one of them out, or rename it"},
      {"t,x [furlong],y,z,qx,qy,qz,qw\n", "p.csv:1:3: error: the header has an unknown unit of length\n  got \"x [furlong]\""},
      {"t [min],x,y,z,qx,qy,qz,qw\n", "p.csv:1:1: error: the header has an unknown unit of time\n  got \"t [min]\""},
      {"1403636579758555392 0 0 0 0 0 0 1\n",
       "p.csv:1:1: error: the time is out of range\n  got \"1403636579758555392\" s; nanoseconds? say so in the header, timestamp [ns], or "
       "in the scene, time_unit: ns"},
      {"1e99 0 0 0 0 0 0 1\n", "the time is out of range"},
      {"1e999 0 0 0 0 0 0 1\n", "t is not finite"},
      {"0 0 0 0 0 0 0 1\n2000000 0 0 0 0 0 0 1\n",
       "p.csv:2:1: error: the time is out of range\n  got 2000000 s, expected -1e6 s to 1e6 s; time_zero says"},
      {"\xEF\xBB\xBFx 0 0 0 0 0 0 1\n", "p.csv:1:4: error: the header has no column for"},
      {"t;x;y;z;qx;qy;qz;qw\nt;x;y;z;qx;qy;qz;qw\n", "p.csv:2:1: error: t is not a number"},
  };
  for (const auto& [text, expected] : cases) EXPECT_TRUE(has(fault_in(text), expected)) << text << "\n" << fault_in(text);
  EXPECT_TRUE(has(fault_in(good, {"", load::stamp_of(1e9)}), "got -1e+09 s after the scene's zero"));
}

TEST(trajectory, of_any_bytes_is_read_or_refused) {
  const std::string seeds[] = {"# t [ns], x, y, z, qx, qy, qz, qw\n1403636579758555392,1,2,3,0,0,0,1\n",
                               "0.5;1e3;-2;3;0;0.6;0;-0.8\r\n1;1;1;1;1;0;0;0"};
  const std::string letters = "0123456789.,;eE+-#%[]() \t\r\nxyzqwtn\"";
  std::uint64_t state = 1;
  const auto random = [&](std::size_t below) {
    state = state * 6364136223846793005U + 1442695040888963407U;
    return static_cast<std::size_t>(state >> 33U) % below;
  };
  int read = 0, refused = 0;
  for (int i = 0; i < 20'000; ++i) {
    std::string text = seeds[i % 2];
    for (std::size_t k = 0; k <= random(4); ++k) {
      const std::size_t at = random(text.size());
      if (random(3) == 0)
        text.erase(at, 1 + random(3));
      else
        text[at] = random(10) == 0 ? static_cast<char>(random(256)) : letters[random(letters.size())];
    }
    base::Faults faults;
    std::optional<load::Stamp> clock;
    for (const TimedPose& one : load::parse_trajectory(text, "p.csv", {}, clock, faults)) {
      ++read;
      EXPECT_NEAR(std::hypot(one.quaternion[0], one.quaternion[1], one.quaternion[2]) *
                          std::hypot(one.quaternion[0], one.quaternion[1], one.quaternion[2]) +
                      one.quaternion[3] * one.quaternion[3],
                  1, 1e-14)
          << text;
      EXPECT_TRUE(std::abs(one.time_s) <= 1e6) << text;
    }
    refused += faults.empty() ? 0 : 1;
  }
  EXPECT_GT(read, 1000);
  EXPECT_GT(refused, 1000);
  const std::string digits(1'000'000, '9');
  EXPECT_TRUE(has(fault_in(digits + " 0 0 0 0 0 0 1\n"), "t is not finite"));
  EXPECT_TRUE(has(fault_in("0." + digits + " 0 0 0 0 0 0 1\n"), "the time is out of range"));
}

TEST(trajectory, has_no_more_poses_than_there_may_be_keyframes) {
  std::string text;
  for (std::int64_t i = 0; i < base::limit::keyframes.value; ++i) text += std::to_string(i) + " 0 0 0 0 0 0 1\n";
  EXPECT_EQ(poses_in(text).size(), static_cast<std::size_t>(base::limit::keyframes.value));
  const std::string more = fault_in(text + "100000 0 0 0 0 0 0 1\n100001 0 0 0 0 0 0 1\n");
  EXPECT_TRUE(has(more, "p.csv:100001:1: error: there are too many poses\n  at most 100000 (`tofray --limits`)")) << more;
  EXPECT_FALSE(has(more, "p.csv:100002")) << "once";
}

TEST_F(keyframe_files, move_camera_and_objects) {
  file("in/c.csv", "0 0 0 -0.5 0 0 0 1\n1 0.1 0 -0.5 0 0.6 0 0.8\n"), file("in/b.csv", "0 0 0 0 0 0 0 1\n2 0.4 0 0 0 0 0 1\n");
  const Scene read = scene("keyframes: {file: c.csv}", ", keyframes: {file: b.csv}");
  ASSERT_EQ(read.camera.keyframes.size(), 2U);
  EXPECT_EQ(read.camera.keyframes[1].time_s, 1);
  EXPECT_EQ(read.camera.keyframes[1].pose.position, (Vec3{0.1, 0, -0.5}));
  EXPECT_EQ(*read.camera.keyframes[1].pose.quaternion, (Quaternion{0, 0.6, 0, 0.8}));
  ASSERT_EQ(read.objects[0].keyframes.size(), 2U);
  EXPECT_EQ(read.objects[0].keyframes[1].position, (Vec3{0.4, 0, 0}));
  ASSERT_EQ(read.files.size(), 2U);
  EXPECT_EQ(read.files[0].file, "c.csv");
  EXPECT_EQ(read.files[1].sha256.size(), 64U);
  // What is written out gives the same frame.
  const Scene said = scene(
      "keyframes: [{time: 0 s, pose: {position: [0, 0, -0.5], quaternion: [0, 0, 0, 1]}}, "
      "{time: 1 s, pose: {position: [0.1, 0, -0.5], quaternion: [0, 0.6, 0, 0.8]}}]",
      ", keyframes: [{time: 0 s}, {time: 2 s, position: [0.4, 0, 0]}]");
  const auto raw = [](const Scene& of) { return Simulator(of, load_camera(of)).frame(2).raw.raw; };
  EXPECT_EQ(raw(read), raw(said));
}

TEST_F(keyframe_files, of_one_clock_have_one_zero_the_cameras_first) {
  file("in/c.csv", "1305031449.5 0 0 0 0 0 0 1\n1305031450.5 0 0 0 0 0 0 1\n"),
      file("in/b.csv", "1305031449.25 0 0 0 0 0 0 1\n1305031450 0 0 0 0 0 0 1\n");
  const Scene both = scene("keyframes: {file: c.csv}", ", keyframes: {file: b.csv}");
  ASSERT_EQ(both.camera.keyframes.size(), 2U);
  EXPECT_EQ(both.camera.keyframes[0].time_s, 0);
  EXPECT_EQ(both.objects[0].keyframes[0].time_s, -0.25);
  EXPECT_EQ(scene("mode: MODE_9_5FPS_2000", ", keyframes: {file: b.csv}").objects[0].keyframes[0].time_s, 0);
  const Scene said = scene("keyframes: {file: c.csv, time_zero: 1305031449 s}", ", keyframes: {file: b.csv}");
  EXPECT_EQ(said.camera.keyframes[0].time_s, 0.5);
  EXPECT_EQ(said.objects[0].keyframes[0].time_s, 0) << "a zero of one file is not that of another";
}

TEST_F(keyframe_files, of_a_robot_say_its_axes_or_where_the_camera_is_on_it) {
  file("in/r.csv", "0 1 2 0 0 0 0.70710678 0.70710678\n");  // it looks along y
  const auto pose = [&](const std::string& more) {
    return pose_matrix(scene("keyframes: {file: r.csv" + more + "}").camera.keyframes[0].pose);
  };
  using Matrix = std::array<double, 16>;
  EXPECT_EQ(pose(", axes: body"), (Matrix{1, 0, 0, 1, 0, 0, 1, 2, 0, -1, 0, 0, 0, 0, 0, 1}));
  // 0.5 m ahead of the robot's zero and 0.25 m above it, looking ahead.
  const Matrix mounted{1, 0, 0, 1, 0, 0, 1, 2.5, 0, -1, 0, 0.25, 0, 0, 0, 1};
  EXPECT_EQ(pose(", mount: {position: [0.5, 0, 0.25], axes: body}"), mounted);
  EXPECT_EQ(pose(", mount: {position: [0.5, 0, 0.25], quaternion: [-0.5, 0.5, -0.5, 0.5]}"), mounted);
  EXPECT_EQ(pose(", mount: {matrix: [[0, 0, 1, 0.5], [-1, 0, 0, 0], [0, -1, 0, 0.25], [0, 0, 0, 1]]}"), mounted);
  EXPECT_TRUE(has(refusal("keyframes: {file: r.csv, axes: body, mount: {axes: body}}"), "keyframes have axes and a mount"));
  EXPECT_TRUE(has(refusal("keyframes: {file: r.csv, mount: {quaternion: [0, 0, 0, 2]}}"),
                  "s.yaml:1:55: error: the quaternion is not of unit length"));
  EXPECT_TRUE(has(refusal("keyframes: {file: r.csv, mount: {look_at: [0, 0, 1]}}"), "unknown key \"look_at\" in mount"));
  EXPECT_TRUE(has(out_test::error_of([&] { (void)scene("mode: MODE_9_5FPS_2000", ", keyframes: {file: r.csv, axes: body}"); }).what(),
                  "unknown key \"axes\" in keyframes"));
}

TEST_F(keyframe_files, lie_beside_the_scene_or_below_and_are_known_by_their_sha256) {
  const std::string text = "0 0 0 0 0 0 0 1\n";
  file("in/c.csv", text), file("out.csv", text);
  EXPECT_TRUE(has(refusal("keyframes: {file: ../out.csv}"), "s.yaml:1:28: error: \"../out.csv\" leads out of the folder"));
  EXPECT_EQ(scene("keyframes: {file: ../out.csv}", "", {folder_.path().string(), {}}).camera.keyframes.size(), 1U);
  EXPECT_TRUE(has(refusal("keyframes: {file: none.csv}", ErrorKind::io), "cannot open"));
  ASSERT_EQ(::mkfifo(folder_.file("in/pipe.csv").c_str(), 0600), 0);
  EXPECT_TRUE(has(refusal("keyframes: {file: pipe.csv}", ErrorKind::io), "is not a plain file"));
  const assets::MeshFiles same{{}, {{{"c.csv", scene("keyframes: {file: c.csv}").files.at(0).sha256}}}},
      none{{}, std::map<std::string, std::string>{}};
  EXPECT_EQ(scene("keyframes: {file: c.csv}", "", same).camera.keyframes.size(), 1U);
  EXPECT_TRUE(has(refusal("keyframes: {file: c.csv}", ErrorKind::bad_input, none), "does not hold the keyframes that it did"));
  file("in/c.csv", text + "\n");
  EXPECT_TRUE(has(refusal("keyframes: {file: c.csv}", ErrorKind::bad_input, same), "does not hold the keyframes that it did"));
  EXPECT_TRUE(has(refusal("keyframes: {time_unit: ns}"), "keyframes lacks the key \"file\""));
  EXPECT_TRUE(has(refusal("keyframes: c.csv"), "keyframes is not what belongs here"));
  EXPECT_TRUE(has(refusal("keyframes: {file: c.csv}, pose: {quaternion: [0, 0, 0, 1]}"), "the camera has keyframes and a pose"));
  file("in/bad.csv", "0 0 0 0 0 0 0 2\n");
  EXPECT_TRUE(has(refusal("keyframes: {file: bad.csv}"), "bad.csv:1:9: error: the quaternion"));
  EXPECT_FALSE(has(refusal("keyframes: {file: bad.csv}, profil: x"), "bad.csv:1:9")) << "what else is wrong is told first";
}

TEST_F(keyframe_files, are_of_any_world) {
  file("in/c.csv", "0 0 0 0 0 0 0 1\n");
  EXPECT_EQ(pose_matrix(scene("keyframes: {file: c.csv}", "", {}, "world_up: z\n").camera.keyframes[0].pose),
            (std::array<double, 16>{1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1}));
}
