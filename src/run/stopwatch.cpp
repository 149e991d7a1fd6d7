// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include "run/stopwatch.h"

namespace tofray::run {

void Stopwatch::lap(const std::string& stage) {
  const Clock::time_point now = Clock::now();
  const double seconds = std::chrono::duration<double>(now - last_).count();
  last_ = now;
  for (auto& [name, sum] : stages_) {
    if (name == stage) {
      sum += seconds;
      return;
    }
  }
  stages_.emplace_back(stage, seconds);
}

double Stopwatch::total() const {
  double sum = 0;
  for (const auto& [name, seconds] : stages_) sum += seconds;
  return sum;
}

}  // namespace tofray::run
