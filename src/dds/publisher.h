// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <memory>
#include <string>
#include <string_view>

/// Messages by DDS, as ROS 2 sees them. What speaks DDS is a library of its own, libtofray_dds.so, which is loaded when it is first wanted:
/// this header is all that both sides know of each other.
namespace tofray::dds {

/// Which network, and how it is used.
struct Settings {
  int domain = 0;                ///< 0…232
  std::string interface = "lo";  ///< the one network interface, by its name or its address; "auto": Cyclone DDS chooses
  std::string config;            ///< Cyclone DDS's own (CYCLONEDDS_URI), which then says all about the network
  int history = 5;               ///< how many messages of a topic are kept
};

/// Where messages of one type go, by ROS's names.
struct TopicForm {
  std::string name;       ///< "/camera/points"
  std::string type;       ///< "sensor_msgs/msg/PointCloud2"
  std::string type_hash;  ///< "RIHS01_…"
  /// Reliable (what is lost on the way is sent again) and transient local (who comes later gets what is kept), which suits every subscription;
  /// otherwise best effort and volatile.
  bool lasting = true;
};

/// "rt/camera/points"
inline std::string dds_topic(std::string_view ros_topic) { return "rt" + std::string(ros_topic); }

/// "sensor_msgs::msg::dds_::PointCloud2_"
inline std::string dds_type(std::string_view ros_type) {
  const std::size_t package = ros_type.find('/'), name = ros_type.rfind('/');
  return std::string(ros_type.substr(0, package)) + "::msg::dds_::" + std::string(ros_type.substr(name + 1)) + "_";
}

/// Sends messages. One thread at a time.
class Publisher {
 public:
  virtual ~Publisher() = default;
  /// Offers a topic. @return its number, from 0 on  @throws std::runtime_error
  virtual int offer(const TopicForm& topic) = 0;
  /// Sends one message. @param cdr  with its four bytes of encapsulation  @return false where readers are so far behind that it was not sent
  /// @throws std::runtime_error
  virtual bool send(int topic, std::string_view cdr) = 0;
  /// How many subscriptions there are to all topics together.
  virtual int readers() = 0;
  /// Waits until reliable readers have all that was sent. @return whether they have it in time
  virtual bool delivered(double at_most_s) = 0;
};

/// The library's name and its two functions: `const char* identity()` and `Publisher* open(const Settings&)`, whose errors are
/// std::runtime_error.
inline constexpr const char* library_file = "libtofray_dds.so";
inline constexpr const char* identity_function = "tofray_dds_identity";
inline constexpr const char* open_function = "tofray_dds_open";

}  // namespace tofray::dds
