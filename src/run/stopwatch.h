// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <chrono>
#include <string>
#include <utility>
#include <vector>

namespace tofray::run {

/// Seconds from one stage to the next, added up by name.
class Stopwatch {
 public:
  /// The time since the last call (or the start) belongs to `stage`.
  void lap(const std::string& stage);
  [[nodiscard]] const std::vector<std::pair<std::string, double>>& stages() const { return stages_; }
  [[nodiscard]] double total() const;

 private:
  using Clock = std::chrono::steady_clock;
  Clock::time_point last_ = Clock::now();
  std::vector<std::pair<std::string, double>> stages_;
};

}  // namespace tofray::run
