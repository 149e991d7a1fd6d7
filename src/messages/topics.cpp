// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include "messages/topics.h"

#include <fmt/core.h>

#include <algorithm>

namespace tofray::messages {

namespace {

using From = CloudField::From;

/// x, y, z and what a driver has beside them.
std::vector<CloudField> cloud_fields(std::vector<CloudField> more) {
  std::vector<CloudField> all = {{"x", From::x, 0, float32_field}, {"y", From::y, 4, float32_field}, {"z", From::z, 8, float32_field}};
  all.insert(all.end(), more.begin(), more.end());
  return all;
}

struct TopicRow {
  const char* group;  ///< empty: always
  Content content;
  const char* name;  ///< below Profile::topics; with / before it as it stands
};

/// Of a driver, in the order of messages. What a driver does not have and is asked for has plain's name.
std::vector<TopicRow> rows_of(Driver driver) {
  switch (driver) {
    case Driver::pmd:
      return {{"depth", Content::depth, "depth_image_0"},
              {"amplitude", Content::amplitude8, "gray_image_0"},
              {"", Content::info, "camera_info"},
              {"points", Content::points, "point_cloud_0"}};
    case Driver::pico_flexx:
      return {{"depth", Content::depth, "image_depth"},
              {"amplitude", Content::amplitude16, "image_mono16"},
              {"amplitude", Content::amplitude8, "image_mono8"},
              {"noise", Content::noise, "image_noise"},
              {"", Content::info, "camera_info"},
              {"points", Content::points, "points"}};
    case Driver::ifm:
      return {{"depth", Content::radial, "distance"},      {"amplitude", Content::amplitude16, "amplitude"},
              {"noise", Content::noise, "distance_noise"}, {"confidence", Content::confidence, "confidence"},
              {"", Content::info, "camera_info"},          {"points", Content::points, "cloud"}};
    case Driver::k4a:
      return {{"depth", Content::depth, "depth/image_raw"},
              {"", Content::info, "depth/camera_info"},
              {"amplitude", Content::amplitude16, "ir/image_raw"},
              {"amplitude", Content::info, "ir/camera_info"},
              {"points", Content::points, "points2"}};
    case Driver::realsense:
      return {{"depth", Content::rect_depth, "depth/image_rect_raw"},
              {"", Content::rect_info, "depth/camera_info"},
              {"amplitude", Content::rect_amplitude8, "infra1/image_rect_raw"},
              {"amplitude", Content::rect_info, "infra1/camera_info"},
              {"points", Content::points, "depth/color/points"}};
    case Driver::plain: break;
  }
  return {{"depth", Content::depth, "depth_image"}, {"amplitude", Content::amplitude16, "amplitude_image"},
          {"noise", Content::noise, "noise_image"}, {"confidence", Content::confidence, "confidence_image"},
          {"", Content::info, "camera_info"},       {"points", Content::points, "points"}};
}

const char* type_of(Content content) {
  switch (content) {
    case Content::info:
    case Content::rect_info: return "sensor_msgs/msg/CameraInfo";
    case Content::points: return "sensor_msgs/msg/PointCloud2";
    case Content::raw_meta: return "std_msgs/msg/String";
    case Content::tf:
    case Content::tf_static: return "tf2_msgs/msg/TFMessage";
    case Content::diagnostics: return "diagnostic_msgs/msg/DiagnosticArray";
    case Content::clock: return "rosgraph_msgs/msg/Clock";
    default: return "sensor_msgs/msg/Image";
  }
}

}  // namespace

const std::vector<Profile>& profiles() {
  static const std::vector<CloudField> bare = cloud_fields({});
  static const std::vector<Profile> all = {
      {Driver::plain,
       "plain",
       "camera",
       "/{}/",
       "32FC1",
       cloud_fields({{"intensity", From::amplitude, 12, float32_field},
                     {"noise", From::noise, 16, float32_field},
                     {"flags", From::flags, 20, uint16_field},
                     {"confidence", From::confidence, 22, uint8_field}}),
       24,
       {"{}_link", "{}_optical_frame"}},
      {Driver::pmd,
       "pmd",
       "pmd_royale_ros_camera_node",
       "/{}/",
       "32FC1",
       cloud_fields({{"conf", From::confidence_share, 12, float32_field}}),
       16,
       {"{}_link", "{}_optical_frame"}},
      {Driver::pico_flexx,
       "pico_flexx",
       "pico_flexx",
       "/{}/",
       "32FC1",
       cloud_fields({{"noise", From::noise, 12, float32_field},
                     {"intensity", From::amplitude16, 16, uint16_field},
                     {"gray", From::amplitude8, 18, uint8_field}}),
       20,
       {"{}_link", "{}_optical_frame"}},
      {Driver::ifm, "ifm", "camera", "/ifm3d/{}/", "32FC1", bare, 12, {"ifm_base_link", "{}_mounting_link", "{}_optical_link"}},
      {Driver::k4a, "k4a", "", "/{}/", "16UC1", bare, 12, {"camera_base", "depth_camera_link"}},
      {Driver::realsense, "realsense", "camera", "/camera/{}/", "16UC1", bare, 12, {"{}_link", "{}_depth_optical_frame"}},
  };
  return all;
}

const Profile& profile_of(Driver driver) {
  return *std::find_if(profiles().begin(), profiles().end(), [&](const Profile& one) { return one.driver == driver; });
}

const std::vector<std::string>& topic_groups() {
  static const std::vector<std::string> all = {"depth", "amplitude", "noise", "confidence", "points", "raw", "rectified", "truth", "clock"};
  return all;
}

std::vector<std::string> usual_groups(Driver driver) {
  std::vector<std::string> out;
  const std::vector<TopicRow> rows = rows_of(driver);
  for (const std::string& group : topic_groups())
    if (group == "raw" || std::any_of(rows.begin(), rows.end(), [&](const TopicRow& row) { return group == row.group; }))
      out.push_back(group);
  return out;
}

std::vector<Plan> plan_of(const MessageOptions& options, int phases) {
  const std::string place = options.name.empty() ? "/" : fmt::format(fmt::runtime(profile_of(options.driver).topics), options.name);
  std::vector<Plan> out;
  const auto add = [&](Content content, const std::string& name, int phase = 0) {
    out.push_back({content, {name.starts_with("/") ? name : place + name, type_of(content)}, phase});
  };
  const auto wants = [&](const std::string& group) {
    return group.empty() || std::find(options.topics.begin(), options.topics.end(), group) != options.topics.end();
  };
  std::vector<TopicRow> rows = rows_of(options.driver);
  for (const TopicRow& plain : rows_of(Driver::plain))
    if (std::none_of(rows.begin(), rows.end(), [&](const TopicRow& row) { return std::string_view(row.group) == plain.group; }))
      rows.push_back(plain);
  for (const TopicRow& row : rows)
    if (wants(row.group)) add(row.content, row.name);
  if (wants("rectified")) add(Content::rect_depth, "rectified/image_rect"), add(Content::rect_info, "rectified/camera_info");
  if (wants("truth")) add(Content::truth_z, "gt/z"), add(Content::truth_object, "gt/object_id");
  for (int k = 0; wants("raw") && k < phases; ++k) add(Content::raw, fmt::format("raw/p{}", k), k);
  if (wants("raw")) add(Content::raw_meta, "raw/meta");
  add(Content::tf, "/tf"), add(Content::tf_static, "/tf_static");
  add(Content::diagnostics, "/diagnostics");
  if (wants("clock")) add(Content::clock, "/clock");
  return out;
}

}  // namespace tofray::messages
