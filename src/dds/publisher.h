// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <string>
#include <string_view>

#include "stream/publisher.h"

/// Messages by DDS, as ROS 2 sees them. What speaks DDS is a library of its own, libtofray_dds.so, which is loaded when it is first wanted:
/// this header, and that of what it makes, are all that both sides know of each other.
namespace tofray::dds {

/// Which network, and how it is used.
struct Settings {
  int domain = 0;                ///< 0…232
  std::string interface = "lo";  ///< the one network interface, by its name or its address; "auto": Cyclone DDS chooses
  std::string config;            ///< Cyclone DDS's own (CYCLONEDDS_URI), which then says all about the network
  int history = 5;               ///< how many messages of a topic are kept
};

/// "rt/camera/points"
inline std::string dds_topic(std::string_view ros_topic) { return "rt" + std::string(ros_topic); }

/// "sensor_msgs::msg::dds_::PointCloud2_"
inline std::string dds_type(std::string_view ros_type) {
  const std::size_t package = ros_type.find('/'), name = ros_type.rfind('/');
  return std::string(ros_type.substr(0, package)) + "::msg::dds_::" + std::string(ros_type.substr(name + 1)) + "_";
}

/// The library's name and its two functions: `const char* identity()` and `stream::Publisher* open(const Settings&)`, whose errors are
/// std::runtime_error.
inline constexpr const char* library_file = "libtofray_dds.so";
inline constexpr const char* identity_function = "tofray_dds_identity";
inline constexpr const char* open_function = "tofray_dds_open";

}  // namespace tofray::dds
