// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <mutex>
#include <string>
#include <thread>

#include "tofray/simulator.h"

namespace tofray::app {

/// One line on how far a run is, for a terminal of so many columns: a bar, counts (of a single step: per cent), rate and time left; what
/// has no room is left out, the bar first. It is shorter than the terminal is wide, so that no line wraps; empty where there is no room for
/// counts.
/// @param done     with the part of the step under way, more than 0
/// @param seconds  since the run began
std::string progress_line(double done, std::uint64_t total, const char* what, double seconds, int columns);

/// How far a long run is, on stderr: a bar with rate and time left on a terminal, a plain line now and then elsewhere.
class Progress {
 public:
  /// @param what   what is counted, e.g. "frames"
  /// @param quiet  says nothing at all; neither is anything said about a single step of which nothing is known
  /// @param step   where not null: how far the step under way is, looked at now and then
  Progress(std::uint64_t total, const char* what, bool quiet, FrameProgress* step = nullptr);
  ~Progress();
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;
  /// One more is done.
  void step();

 private:
  using Clock = std::chrono::steady_clock;
  void show();
  void watch(const std::stop_token& ended);

  std::uint64_t total_, done_ = 0;
  const char* what_;
  FrameProgress* now_;
  bool silent_, terminal_, shown_ = false;
  Clock::time_point start_ = Clock::now(), last_ = start_;
  std::mutex mutex_;  ///< of all that changes, between whoever computes and the thread that looks
  std::condition_variable_any ended_;
  std::jthread watcher_;
};

}  // namespace tofray::app
