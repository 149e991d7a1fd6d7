// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <chrono>
#include <cstdint>
#include <string>

namespace tofray::app {

/// One line on how far a run is, for a terminal of so many columns: a bar, counts, rate and time left; what has no room is left out, the bar
/// first. It is shorter than the terminal is wide, so that no line wraps; empty where there is no room for counts.
/// @param seconds  since the run began
std::string progress_line(std::uint64_t done, std::uint64_t total, const char* what, double seconds, int columns);

/// How far a long run is, on stderr: a bar with rate and time left on a terminal, a plain line now and then elsewhere.
class Progress {
 public:
  /// @param what   what is counted, e.g. "frames"
  /// @param quiet  says nothing at all; neither is anything said about a single step
  Progress(std::uint64_t total, const char* what, bool quiet);
  ~Progress();
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;
  /// One more is done.
  void step();

 private:
  using Clock = std::chrono::steady_clock;
  void show();
  void clear() const;

  std::uint64_t total_, done_ = 0;
  const char* what_;
  bool silent_, terminal_, shown_ = false;
  Clock::time_point start_ = Clock::now(), last_ = start_;
};

}  // namespace tofray::app
