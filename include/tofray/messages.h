// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "tofray/camera.h"
#include "tofray/frame.h"
#include "tofray/scene.h"

/// Frames as the messages that ROS 2 has for cameras: Image, CameraInfo, PointCloud2, TFMessage, Clock, DiagnosticArray, as CDR (XCDR1, plain,
/// little endian, with its four bytes of encapsulation). docs/reference/topics.md has all topics. As load.h, of libtofray_files.
namespace tofray {

/// Whose names topics and frames have, and what is usual there: encodings, fields of clouds.
enum class Driver { plain, pmd, pico_flexx, ifm, k4a, realsense };

/// Which moment of a frame's exposures its messages are stamped with.
enum class StampAt { start, middle, end };

/// What messages say, and under which names.
struct MessageOptions {
  Driver driver = Driver::plain;
  StampAt stamp = StampAt::middle;
  std::string name = {};  ///< name of the camera, the first part of topics and frames: letters, digits and _; empty: the driver's
  /// Out of depth, amplitude, noise, confidence, points, raw, rectified, truth, clock; empty: what the driver has, and raw. camera_info, tf
  /// and diagnostics come along.
  std::vector<std::string> topics = {};
  std::string depth_encoding = {};  ///< "32FC1" (m, NaN where invalid) or "16UC1" (mm, 0 where invalid); empty: the driver's
  bool unorganized = false;         ///< clouds of the valid points alone, in one row
  double amplitude_step_e = 0;      ///< electrons of 1 in amplitude as mono16; 0: the least power of two at which nothing clips
  double epoch_s = 0;               ///< added to simulated time in all stamps, 0…2e9
  bool operator==(const MessageOptions&) const = default;
};

/// Where messages of one type go.
struct Topic {
  std::string name;  ///< "/camera/points"
  std::string type;  ///< "sensor_msgs/msg/PointCloud2"
};

/// One message.
struct Message {
  std::size_t topic = 0;        ///< its place in Messages::topics()
  std::int64_t stamp_ns = 0;    ///< stamp of its header
  std::int64_t publish_ns = 0;  ///< when a camera could have sent it: once the last exposure is read out
  std::string data;             ///< CDR
};

/// Makes messages of a camera's frames. The same frame gives the same bytes; several threads may ask at once.
class Messages {
 public:
  /// @throws Error (bad_input) for a name, a topic, an encoding or a number that cannot be; as a Simulator's constructor for the camera
  Messages(const Scene& scene, const Camera& camera, const MessageOptions& options = {});
  ~Messages();
  Messages(Messages&&) noexcept;
  Messages& operator=(Messages&&) noexcept;

  [[nodiscard]] const std::vector<Topic>& topics() const;  ///< where messages go, one type each
  /// What is said once, before the first frame: /tf_static.
  [[nodiscard]] std::vector<Message> before(const Frame& first) const;
  /// All of a frame, in the order of topics. /diagnostics comes with the first frame and then each second.
  /// @throws Error (bad_input) where the frame lacks an array that a topic is made of, has another size, or a time that no stamp holds
  [[nodiscard]] std::vector<Message> of(const Frame& frame) const;
  /// All of a frame whose camera was placed from outside. @param seen  placed_scene() of its request
  [[nodiscard]] std::vector<Message> of(const Frame& frame, const Scene& seen) const;
  /// All messages of a frame whose camera was placed from outside, into memory that is used again.
  void of(const Frame& frame, const Scene& seen, std::vector<Message>& into) const;
  /// Arrays that a frame needs, by their names in files.
  [[nodiscard]] std::vector<std::string> arrays() const;
  /// What they are made by, with all that was left to the driver filled in.
  [[nodiscard]] const MessageOptions& options() const;

 private:
  struct Impl;
  std::unique_ptr<const Impl> impl_;
};

/// The definition of a message's type, and of all types within it, as rosbag2 stores it ("ros2msg").
/// @throws Error (bad_input) for a type that no topic has
std::string message_definition(std::string_view type);

}  // namespace tofray
