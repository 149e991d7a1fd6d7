// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <atomic>
#include <deque>
#include <optional>
#include <string>
#include <vector>

#include "load/trajectory.h"
#include "tofray/scene.h"

namespace tofray::run {

/// Poses of a camera that arrive while it streams, a line each, as files of poses have them ("t x y z qx qy qz qw"): from a program that moves
/// it.
class PoseLines {
 public:
  /// @param file  "-": standard input; else a file or a pipe @throws Error (io)
  explicit PoseLines(const std::string& file);
  PoseLines(const PoseLines&) = delete;
  PoseLines& operator=(const PoseLines&) = delete;
  ~PoseLines();

  /// Waits for lines until one has that time or a later one. @return false where they end before, or `stop` is set
  /// @throws Error (bad_input) naming the line that is none; (io)
  bool reach(double time_s, const std::atomic<bool>& stop);
  /// When the first pose is; none before reach() saw one.
  [[nodiscard]] std::optional<double> first_s() const { return first_s_; }
  /// When the last pose is that came.
  [[nodiscard]] std::optional<double> last_s() const;
  /// What says where the camera is from one time to another: the last pose before, those between, the first behind. Those before are forgotten.
  std::vector<CameraKeyframe> between(double from_s, double to_s);

 private:
  void take(std::string_view line);
  void take_lines();

  std::string name_;
  int file_;
  bool ended_ = false;
  std::string text_;  ///< of which no line has ended yet
  load::TrajectoryLines lines_;
  std::deque<CameraKeyframe> poses_;
  std::optional<double> first_s_;
};

}  // namespace tofray::run
