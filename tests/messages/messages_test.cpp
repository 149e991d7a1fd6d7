// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
// Messages against bytes that were put together by hand. (Their fields against whole frames, and the geometry of CameraInfo: tests/ros.)
#include "tofray/messages.h"

#include <gtest/gtest.h>

#include <cmath>
#include <thread>

#include "messages/parts.h"
#include "messages/type_hash.h"
#include "support/samples.h"
#include "tofray/load.h"
#include "tofray/simulator.h"

using namespace tofray;
using out_test::error_of;

namespace {

std::string le(std::uint64_t value, int bytes) {
  std::string out;
  for (int i = 0; i < bytes; ++i) out += static_cast<char>(value >> (8 * i) & 255);
  return out;
}
std::string number(double value) {
  std::uint64_t bits = 0;
  std::memcpy(&bits, &value, 8);
  return le(bits, 8);
}
std::string numbers(const std::vector<double>& all) {
  std::string out;
  for (const double one : all) out += number(one);
  return out;
}

/// The 2 x 1 image of what is tested.
constexpr messages::Size two_pixels{2, 1};
const messages::Header header{1'500'000'002, "ab"};  // 1.500000002 s
/// 4 + 4 + (4 + 3) bytes, and one to the next multiple of 4.
const std::string header_bytes = le(1, 4) + le(500'000'002, 4) + le(3, 4) + std::string("ab\0", 3) + std::string(1, '\0');
const std::string encapsulation("\0\1\0\0", 4);

/// Of 12 x 9 pixels and nine raw frames, as out_test::sample_frame(12, 9) has them.
Camera small_camera() { return load_camera("pico-flexx", {"MODE_9_5FPS_2000", {{"sensor.width", "12"}, {"sensor.height", "9"}}, {}}); }

const Message& message_on(const std::vector<Message>& all, const Messages& of, const std::string& topic) {
  for (const Message& one : all)
    if (of.topics()[one.topic].name == topic) return one;
  throw std::runtime_error("no message on " + topic);
}

}  // namespace

TEST(cdr, of_an_image_is_that_of_its_definition) {
  std::string out;
  messages::put_depth(out, header, two_pixels, {1.5F, out_test::nan_f}, false);
  std::uint32_t nan_bits = 0;
  std::memcpy(&nan_bits, &out_test::nan_f, 4);
  const std::string expected = encapsulation + header_bytes + le(1, 4) + le(2, 4) + le(6, 4) + std::string("32FC1\0", 6) + le(0, 1) +
                               std::string(1, '\0') + le(8, 4) + le(8, 4) + le(0x3fc00000, 4) + le(nan_bits, 4);
  EXPECT_EQ(out, expected);
}

TEST(cdr, of_camera_info_is_that_of_its_definition) {
  Lens lens;
  lens.fx_px = 200, lens.fy_px = 210, lens.cx_px = 110, lens.cy_px = 80;
  lens.k1 = 1, lens.k2 = 2, lens.p1 = 3, lens.p2 = 4, lens.k3 = 5;
  std::string out;
  messages::put_camera_info(out, header, {224, 172}, lens, false);
  std::string expected = header_bytes + le(172, 4) + le(224, 4) + le(10, 4) + std::string("plumb_bob\0", 10);
  expected += std::string((8 - (expected.size() + 4) % 8) % 8 == 0 ? 0 : (4 - expected.size() % 4) % 4, '\0') + le(5, 4);
  expected += std::string((8 - expected.size() % 8) % 8, '\0') + numbers({1, 2, 3, 4, 5});
  expected += numbers({200, 0, 110, 0, 210, 80, 0, 0, 1}) + numbers({1, 0, 0, 0, 1, 0, 0, 0, 1});
  expected += numbers({200, 0, 110, 0, 0, 210, 80, 0, 0, 0, 1, 0});
  expected += le(0, 4) + le(0, 4) + le(0, 4) + le(0, 4) + le(0, 4) + le(0, 4) + le(0, 1);
  EXPECT_EQ(out, encapsulation + expected);
}

TEST(cdr, has_times_before_zero_and_whole_seconds_right) {
  for (const auto& [ns, sec, nanosec] : std::vector<std::tuple<std::int64_t, std::uint64_t, std::uint64_t>>{
           {0, 0, 0}, {999'999'999, 0, 999'999'999}, {1'000'000'000, 1, 0}, {-1, 0xffffffff, 999'999'999}}) {
    std::string out;
    messages::Cdr cdr(out);
    messages::put_time(cdr, ns);
    EXPECT_EQ(out, encapsulation + le(sec, 4) + le(nanosec, 4)) << ns;
  }
}

TEST(cdr, uses_memory_again_and_leaves_nothing_of_before) {
  std::string out, fresh;
  messages::put_depth(out, header, {20, 20}, std::vector<float>(400, 7.F), false);
  messages::put_depth(out, header, two_pixels, {1, 2}, false);
  messages::put_depth(fresh, header, two_pixels, {1, 2}, false);
  EXPECT_EQ(out, fresh);
}

TEST(amplitude, is_rounded_and_clipped) {
  EXPECT_EQ(messages::amplitude_code(10.24F, 0.5), 20);
  EXPECT_EQ(messages::amplitude_code(10.26F, 0.5), 21);
  EXPECT_EQ(messages::amplitude_code(-3, 0.5), 0);
  EXPECT_EQ(messages::amplitude_code(out_test::nan_f, 0.5), 0);
  EXPECT_EQ(messages::amplitude_code(1e9F, 0.5), 65535);
}

TEST(depth_in_millimetres, is_0_where_there_is_none_or_too_much) {
  std::string out;
  messages::put_depth(out, {0, "a"}, {5, 1}, {1.2344F, 1.2346F, out_test::nan_f, 65.535F, 65.536F}, true);
  EXPECT_EQ(out.substr(out.size() - 10), le(1234, 2) + le(1235, 2) + le(0, 2) + le(65535, 2) + le(0, 2));
}

TEST(definitions, have_all_types_within_them_once) {
  const std::string text = message_definition("tf2_msgs/msg/TFMessage");
  const std::string line(80, '=');
  EXPECT_TRUE(text.starts_with("geometry_msgs/TransformStamped[] transforms\n" + line + "\nMSG: geometry_msgs/TransformStamped\n")) << text;
  for (const char* type :
       {"std_msgs/Header", "builtin_interfaces/Time", "geometry_msgs/Transform", "geometry_msgs/Vector3", "geometry_msgs/Quaternion"}) {
    const std::size_t at = text.find(line + "\nMSG: " + type + "\n");
    EXPECT_NE(at, std::string::npos) << type;
    EXPECT_EQ(text.find(std::string("MSG: ") + type + "\n", at + 90), std::string::npos) << type;
  }
  EXPECT_EQ(error_of([] { (void)message_definition("sensor_msgs/msg/Imu"); }).kind(), ErrorKind::bad_input);
}

TEST(Messages, are_the_same_from_several_threads_and_for_each_driver) {
  const Camera camera = small_camera();
  const Frame frame = out_test::sample_frame(12, 9);
  for (const Driver driver : {Driver::plain, Driver::pmd, Driver::pico_flexx, Driver::ifm, Driver::k4a, Driver::realsense}) {
    MessageOptions options;
    options.driver = driver;
    options.topics = {"depth", "amplitude", "noise", "confidence", "points", "raw", "rectified", "truth", "clock"};
    const Messages maker({}, camera, options);
    const std::vector<Message> expected = maker.of(frame);
    std::vector<std::thread> threads;
    std::atomic<int> same{0};
    for (int i = 0; i < 4; ++i)
      threads.emplace_back([&] {
        const std::vector<Message> got = maker.of(frame);
        same += std::equal(got.begin(), got.end(), expected.begin(), expected.end(), [](const Message& a, const Message& b) {
          return a.topic == b.topic && a.data == b.data && a.stamp_ns == b.stamp_ns && a.publish_ns == b.publish_ns;
        });
      });
    for (std::thread& one : threads) one.join();
    EXPECT_EQ(same, 4);
    EXPECT_EQ(maker.before(frame).size(), 1U);
    EXPECT_EQ(expected.size() + 1, maker.topics().size());  // all but /tf_static
  }
}

TEST(Messages, of_a_camera_placed_from_outside_say_where_it_is) {
  const Camera camera = small_camera();
  const Frame frame = out_test::sample_frame(12, 9);
  const Messages maker({}, camera);
  Scene seen;
  seen.camera.pose.position = {0.25, 0, 0};  // to the right: on the map −y
  const std::string here = message_on(maker.of(frame), maker, "/tf").data, there = message_on(maker.of(frame, seen), maker, "/tf").data;
  EXPECT_EQ(here.find(number(-0.25)), std::string::npos);
  EXPECT_NE(there.find(number(-0.25)), std::string::npos);
}

TEST(Messages, warn_where_few_pixels_have_a_depth) {
  const Camera camera = small_camera();
  Frame frame = out_test::sample_frame(12, 9);
  const Messages maker({}, camera);
  const std::string name = std::string("camera: depth\0", 14);
  const auto level = [&] {
    const std::string data = message_on(maker.of(frame), maker, "/diagnostics").data;
    const std::size_t at = data.find(name);
    return static_cast<int>(data.at(at - 8));  // the byte before the padding and the length of the name
  };
  EXPECT_EQ(level(), 0);
  std::fill(frame.depth.flags.begin(), frame.depth.flags.end(), flag_saturated);
  EXPECT_EQ(level(), 1);
}

TEST(Messages, name_what_a_frame_lacks) {
  const Camera camera = small_camera();
  Frame frame = out_test::sample_frame(12, 9);
  const Messages maker({}, camera);
  frame.depth.noise_m.clear();
  const std::string text = error_of([&] { (void)maker.of(frame); }).what();
  EXPECT_NE(text.find("the frame's noise_m has 0 values\n  expected 108: 12 x 9 pixels; the simulator was asked for other arrays"),
            std::string::npos)
      << text;
  frame = out_test::sample_frame(12, 9);
  for (double& time : frame.raw.start_time_s) time -= 100;
  EXPECT_NE(std::string(error_of([&] { (void)maker.of(frame); }).what()).find("fits into no stamp"), std::string::npos);
  MessageOptions later;
  later.epoch_s = 1e9;
  EXPECT_EQ(Messages({}, camera, later).of(frame).front().stamp_ns / 1'000'000'000, 999'999'900);
  EXPECT_NE(std::string(error_of([&] { (void)maker.of(out_test::sample_frame(9, 12)); }).what())
                .find("the frame has 9 x 12 pixels\n  expected 12 x 9"),
            std::string::npos);
}

TEST(Messages, need_the_arrays_that_they_say) {
  const Camera camera = small_camera();
  for (const char* group : {"depth", "amplitude", "noise", "confidence", "points", "raw", "rectified", "truth"}) {
    MessageOptions options;
    options.topics = {group};
    const Messages maker({}, camera, options);
    const std::vector<std::string> needed = maker.arrays();
    Frame full = out_test::sample_frame(12, 9), frame = full;
#define TOFRAY_KEEP(name, part, member, ...) \
  if (std::find(needed.begin(), needed.end(), #name) == needed.end()) frame.part.member.clear();
    TOFRAY_RAW_ARRAYS(TOFRAY_KEEP)
    TOFRAY_DEPTH_ARRAYS(TOFRAY_KEEP)
    TOFRAY_TRUTH_ARRAYS(TOFRAY_KEEP)
#undef TOFRAY_KEEP
    EXPECT_NO_THROW((void)maker.of(frame)) << group;
  }
}

// As ROS 2's own packages have them from Iron on.
TEST(type_hash, is_the_one_that_ros_has) {
  const std::vector<std::pair<const char*, const char*>> published = {
      {"sensor_msgs/msg/Image", "d31d41a9a4c4bc8eae9be757b0beed306564f7526c88ea6a4588fb9582527d47"},
      {"sensor_msgs/msg/CameraInfo", "b3dfd68ff46c9d56c80fd3bd4ed22c7a4ddce8c8348f2f59c299e73118e7e275"},
      {"sensor_msgs/msg/PointCloud2", "9198cabf7da3796ae6fe19c4cb3bdd3525492988c70522628af5daa124bae2b5"},
      {"sensor_msgs/msg/RegionOfInterest", "ad16bcba5f9131dcdba6fbded19f726f5440e3c513b4fb586dd3027eeed8abb1"},
      {"std_msgs/msg/Header", "f49fb3ae2cf070f793645ff749683ac6b06203e41c891e17701b1cb597ce6a01"},
      {"std_msgs/msg/String", "df668c740482bbd48fb39d76a70dfd4bd59db1288021743503259e948f6b1a18"},
      {"tf2_msgs/msg/TFMessage", "e369d0f05a23ae52508854b66f6aa0437f3449d652e8cbf22d5abe85d020f087"},
      {"rosgraph_msgs/msg/Clock", "692f7a66e93a3c83e71765d033b60349ba68023a8c689a79e48078bcb5c58564"},
      {"diagnostic_msgs/msg/DiagnosticArray", "5a8a36efb05fb25070fa0fb3810290c0e6cd4862b54a8fb975a1ee8dc55a333e"},
  };
  for (const auto& [type, sha256] : published) EXPECT_EQ(messages::type_hash(type), std::string("RIHS01_") + sha256) << type;
}

TEST(type_hash, is_of_a_description_that_one_can_read) {
  EXPECT_EQ(messages::type_description_json("rosgraph_msgs/msg/Clock"),
            R"({"type_description": {"type_name": "rosgraph_msgs/msg/Clock", "fields": [{"name": "clock", "type": )"
            R"({"type_id": 1, "capacity": 0, "string_capacity": 0, "nested_type_name": "builtin_interfaces/msg/Time"}}]}, )"
            R"("referenced_type_descriptions": [{"type_name": "builtin_interfaces/msg/Time", "fields": [{"name": "sec", "type": )"
            R"({"type_id": 6, "capacity": 0, "string_capacity": 0, "nested_type_name": ""}}, {"name": "nanosec", "type": )"
            R"({"type_id": 7, "capacity": 0, "string_capacity": 0, "nested_type_name": ""}}]}]})");
}
