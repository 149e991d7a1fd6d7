// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <string>
#include <vector>

#include "tofray/messages.h"

/// Which topics there are, by driver.
namespace tofray::messages {

/// What a topic's messages are made of.
enum class Content {
  depth,        ///< z of the pixels as they lie
  radial,       ///< the range along the pixels' rays
  amplitude16,  ///< mono16
  amplitude8,   ///< mono8
  noise,        ///< 32FC1 [m]
  confidence,   ///< mono8
  info,         ///< of the image as delivered
  points,       ///< the cloud
  rect_depth,   ///< z of a pinhole's pixels, by the nearest pixel
  rect_amplitude8,
  rect_info,     ///< of that pinhole
  raw,           ///< mono16, of one raw frame
  raw_meta,      ///< when and how they were exposed, as JSON
  truth_z,       ///< 32FC1
  truth_object,  ///< 32SC1
  tf,            ///< where the camera is
  tf_static,     ///< how its frames stand to each other
  diagnostics,
  clock,
};

/// One field of a cloud's points.
struct CloudField {
  enum class From { x, y, z, amplitude, noise, confidence, flags, amplitude16, amplitude8, confidence_share };
  const char* name;
  From from;
  std::uint32_t offset;
  std::uint8_t datatype;  ///< as PointField numbers them
};
inline constexpr std::uint8_t uint8_field = 2, uint16_field = 4, float32_field = 7;

struct Plan {
  Content content;
  Topic topic;
  int phase = 0;  ///< of a raw frame
};

/// What is usual with a driver.
struct Profile {
  Driver driver;
  const char* word;            ///< as options say it
  const char* name;            ///< of the camera
  const char* topics;          ///< where the names below begin: "/{}/", {} being the camera's name
  const char* depth_encoding;  ///< unless asked otherwise
  std::vector<CloudField> fields;
  std::uint32_t point_step;
  /// map → … → the optical frame; {} is the camera's name. The last two are a link (x forward) and the optical frame (z forward).
  std::vector<const char*> frames;
};

const Profile& profile_of(Driver driver);
const std::vector<Profile>& profiles();

/// The groups that MessageOptions::topics chooses from.
const std::vector<std::string>& topic_groups();
/// Groups that a driver has without being asked.
std::vector<std::string> usual_groups(Driver driver);

/// @param options  checked, with its name and groups
std::vector<Plan> plan_of(const MessageOptions& options, int phases);

}  // namespace tofray::messages
