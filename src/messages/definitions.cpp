// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include <fmt/core.h>

#include <algorithm>
#include <string>
#include <string_view>
#include <vector>

#include "base/text.h"
#include "tofray/error.h"
#include "tofray/messages.h"

namespace tofray {

namespace {

/// A type and its members, one a line, without the comments that ROS's own files have.
struct Definition {
  std::string_view type, members;
  std::vector<std::string_view> within;  ///< types of its members
};

const std::vector<Definition>& message_types() {
  static const std::vector<Definition> all = {
      {"builtin_interfaces/msg/Time", "int32 sec\nuint32 nanosec\n", {}},
      {"std_msgs/msg/Header", "builtin_interfaces/Time stamp\nstring frame_id\n", {"builtin_interfaces/msg/Time"}},
      {"std_msgs/msg/String", "string data\n", {}},
      {"sensor_msgs/msg/Image",
       "std_msgs/Header header\nuint32 height\nuint32 width\nstring encoding\nuint8 is_bigendian\nuint32 step\nuint8[] data\n",
       {"std_msgs/msg/Header"}},
      {"sensor_msgs/msg/RegionOfInterest", "uint32 x_offset\nuint32 y_offset\nuint32 height\nuint32 width\nbool do_rectify\n", {}},
      {"sensor_msgs/msg/CameraInfo",
       "std_msgs/Header header\nuint32 height\nuint32 width\nstring distortion_model\nfloat64[] d\nfloat64[9] k\nfloat64[9] r\n"
       "float64[12] p\nuint32 binning_x\nuint32 binning_y\nRegionOfInterest roi\n",
       {"std_msgs/msg/Header", "sensor_msgs/msg/RegionOfInterest"}},
      {"sensor_msgs/msg/PointField",
       "uint8 INT8=1\nuint8 UINT8=2\nuint8 INT16=3\nuint8 UINT16=4\nuint8 INT32=5\nuint8 UINT32=6\nuint8 FLOAT32=7\nuint8 FLOAT64=8\n"
       "string name\nuint32 offset\nuint8 datatype\nuint32 count\n",
       {}},
      {"sensor_msgs/msg/PointCloud2",
       "std_msgs/Header header\nuint32 height\nuint32 width\nPointField[] fields\nbool is_bigendian\nuint32 point_step\nuint32 row_step\n"
       "uint8[] data\nbool is_dense\n",
       {"std_msgs/msg/Header", "sensor_msgs/msg/PointField"}},
      {"geometry_msgs/msg/Vector3", "float64 x\nfloat64 y\nfloat64 z\n", {}},
      {"geometry_msgs/msg/Quaternion", "float64 x 0\nfloat64 y 0\nfloat64 z 0\nfloat64 w 1\n", {}},
      {"geometry_msgs/msg/Transform",
       "Vector3 translation\nQuaternion rotation\n",
       {"geometry_msgs/msg/Vector3", "geometry_msgs/msg/Quaternion"}},
      {"geometry_msgs/msg/TransformStamped",
       "std_msgs/Header header\nstring child_frame_id\nTransform transform\n",
       {"std_msgs/msg/Header", "geometry_msgs/msg/Transform"}},
      {"tf2_msgs/msg/TFMessage", "geometry_msgs/TransformStamped[] transforms\n", {"geometry_msgs/msg/TransformStamped"}},
      {"rosgraph_msgs/msg/Clock", "builtin_interfaces/Time clock\n", {"builtin_interfaces/msg/Time"}},
      {"diagnostic_msgs/msg/KeyValue", "string key\nstring value\n", {}},
      {"diagnostic_msgs/msg/DiagnosticStatus",
       "byte OK=0\nbyte WARN=1\nbyte ERROR=2\nbyte STALE=3\nbyte level\nstring name\nstring message\nstring hardware_id\n"
       "KeyValue[] values\n",
       {"diagnostic_msgs/msg/KeyValue"}},
      {"diagnostic_msgs/msg/DiagnosticArray",
       "std_msgs/Header header\nDiagnosticStatus[] status\n",
       {"std_msgs/msg/Header", "diagnostic_msgs/msg/DiagnosticStatus"}},
  };
  return all;
}

const Definition* find_type(std::string_view type) {
  for (const Definition& one : message_types())
    if (one.type == type) return &one;
  return nullptr;
}

/// Each type within once, nearer ones first.
void collect_types(const Definition& of, std::vector<const Definition*>& into) {
  const std::size_t from = into.size();
  for (const std::string_view type : of.within) {
    const Definition* one = find_type(type);
    if (std::find(into.begin(), into.end(), one) == into.end()) into.push_back(one);
  }
  for (std::size_t i = from; i < into.size(); ++i) collect_types(*into[i], into);
}

/// "sensor_msgs/msg/Image" as it stands in definitions: "sensor_msgs/Image".
std::string without_msg(std::string_view type) {
  const std::size_t at = type.find("/msg/");
  return std::string(type.substr(0, at)) + "/" + std::string(type.substr(at + 5));
}

}  // namespace

std::string message_definition(std::string_view type) {
  const Definition* top = find_type(type);
  if (top == nullptr)
    throw Error(ErrorKind::bad_input,
                fmt::format("error: no message has the type {}\n  expected a name as sensor_msgs/msg/Image", base::in_quotes(type)));
  std::vector<const Definition*> parts;
  collect_types(*top, parts);
  std::string text(top->members);
  const std::string line(80, '=');
  for (const Definition* one : parts) text += fmt::format("{}\nMSG: {}\n{}", line, without_msg(one->type), one->members);
  return text;
}

}  // namespace tofray
