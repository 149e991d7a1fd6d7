// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstdint>
#include <string>
#include <string_view>

namespace tofray::stream {

/// Where messages of one type go, by ROS's names.
struct TopicForm {
  std::string name;       ///< "/camera/points"
  std::string type;       ///< "sensor_msgs/msg/PointCloud2"
  std::string type_hash;  ///< "RIHS01_…"
  /// Reliable (what is lost on the way is sent again) and transient local (who comes later gets what is kept), which suits every subscription;
  /// otherwise best effort and volatile.
  bool lasting = true;
};

/// What carries messages to those who read them: DDS, or the WebSocket of Foxglove. One thread at a time.
class Publisher {
 public:
  virtual ~Publisher() = default;
  /// Offers a topic. @return its number, from 0 on  @throws std::runtime_error
  virtual int offer(const TopicForm& topic) = 0;
  /// Sends one message. @param cdr  with its four bytes of encapsulation  @param time_ns  when it was published, by the camera's clock; DDS
  /// stamps by the machine's  @return false where a reader is so far behind that it was not sent to it  @throws std::runtime_error
  virtual bool send(int topic, std::string_view cdr, std::int64_t time_ns) = 0;
  /// How many subscriptions there are to all topics together.
  virtual int readers() = 0;
  /// Waits until readers (of DDS those that are reliable) have all that was sent. @return whether they have it in time
  virtual bool delivered(double at_most_s) = 0;
};

}  // namespace tofray::stream
