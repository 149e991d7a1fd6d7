// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/faults.h"
#include "tofray/scene.h"

/// Poses at times out of text files, a line each, as motion capture, SLAM and robots write them: TUM's and EuRoC's files, CSV with a header.
namespace tofray::load {

/// Seconds as whole ones and the rest, 0…1 where they are not below 0: a clock of today to the nanosecond, which one double does not hold.
struct Stamp {
  std::int64_t whole = 0;
  double rest = 0;
  double seconds = 0;  ///< both together, rounded once
};
Stamp stamp_of(double seconds);

struct TimedPose {
  double time_s = 0;
  Vec3 position{};
  Quaternion quaternion{};
};

/// What a scene says of its times.
struct TrajectoryTimes {
  std::string unit = {};           ///< s, ms, us or ns; empty: the header's, else s
  std::optional<Stamp> zero = {};  ///< of the file's times: the scene's 0
};

/// @param path   for messages
/// @param clock  the zero of all files of a scene whose times are of a clock; the first of them sets it
/// @return ascending in time, quaternions of unit length; none where there is a fault
std::vector<TimedPose> parse_trajectory(std::string_view text, const std::string& path, const TrajectoryTimes& times,
                                        std::optional<Stamp>& clock, base::Faults& faults);

/// Poses of such a text whose lines come one after the other; a header may come first.
class TrajectoryLines {
 public:
  explicit TrajectoryLines(const std::string& path);
  TrajectoryLines(const TrajectoryLines&) = delete;
  TrajectoryLines& operator=(const TrajectoryLines&) = delete;
  ~TrajectoryLines();
  /// @param line  without its end
  /// @return the pose that it says; none of a header, a comment or an empty line @throws Error (bad_input) naming the line
  std::optional<TimedPose> take(std::string_view line);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace tofray::load
