// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include "cli/progress.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <system_error>

#include "cli/console.h"

namespace tofray::app {

namespace {

using namespace std::chrono_literals;

std::string time_text(double seconds) {
  const auto whole = static_cast<std::uint64_t>(seconds + 0.5);
  if (whole >= 3600) return fmt::format("{} h {:02} min", whole / 3600, whole / 60 % 60);
  if (whole >= 60) return fmt::format("{} min {:02} s", whole / 60, whole % 60);
  return fmt::format("{} s", whole);
}

constexpr int no_bar = 0;  // columns of what is no terminal: all counts on a line

/// The bar with its brackets, as long as the room lets it be; empty where that is too little to read.
std::string bar_text(double share, int room) {
  constexpr int longest = 24, shortest = 6;
  const int width = std::min(room - 3, longest);
  if (width < shortest) return {};
  const auto full = static_cast<int>(share * width);
  return fmt::format("[{:#<{}}{:.<{}}] ", "", full, "", width - full);
}

}  // namespace

std::string progress_line(double done, std::uint64_t total, const char* what, double seconds, int columns) {
  const bool single = total == 1;
  const auto of = static_cast<double>(total);
  const double rate = done / seconds, left = (of - done) / rate;
  const std::string counts = single ? fmt::format("{:.0f} %", std::floor(100 * done)) : fmt::format("{:.0f}/{}", std::floor(done), total);
  const std::string named = single ? counts : counts + " " + what, remaining = fmt::format("{}  {} left", named, time_text(left));
  const std::string all = single ? remaining : fmt::format("{}  {:.3g}/s  {} left", named, rate, time_text(left));
  if (columns == no_bar) return all;
  const int room = columns - 1;  // a terminal may wrap as soon as its last column is written
  for (const std::string& text : {all, remaining, named, counts}) {
    const auto length = static_cast<int>(text.size());
    if (length <= room) return bar_text(done / of, room - length) + text;
  }
  return {};
}

Progress::Progress(std::uint64_t total, const char* what, bool quiet, FrameProgress* step)
    : total_(total), what_(what), now_(step), silent_(quiet || (total < 2 && step == nullptr)), terminal_(stderr_is_terminal()) {
  if (silent_ || step == nullptr) return;
  try {
    watcher_ = std::jthread([this](const std::stop_token& ended) { watch(ended); });
  } catch (const std::system_error&) {
    // without a thread more, each step is told when it is done
  }
}

Progress::~Progress() {
  watcher_ = {};
  if (terminal_ && shown_) redraw("\r\x1b[K");
}

void Progress::step() {
  const std::scoped_lock lock(mutex_);
  ++done_;
  if (now_ != nullptr) now_->done = 0;
  show();
}

void Progress::watch(const std::stop_token& ended) {
  std::unique_lock lock(mutex_);
  while (!ended.stop_requested()) {
    ended_.wait_for(lock, ended, 100ms, [] { return false; });
    if (!ended.stop_requested()) show();
  }
}

void Progress::show() {
  const Clock::time_point now = Clock::now();
  if (silent_ || now - last_ < (terminal_ ? 100ms : 5000ms)) return;
  double done = static_cast<double>(done_);
  if (now_ != nullptr && now_->stop) return;  // who stops it has said so
  if (const std::int64_t total = now_ == nullptr ? 0 : now_->total.load(); total > 0 && done_ < total_)
    done += std::min(1.0, static_cast<double>(now_->done) / static_cast<double>(total));
  if (done <= 0) return;
  last_ = now, shown_ = true;
  const double seconds = std::chrono::duration<double>(last_ - start_).count();
  if (!terminal_) return say(progress_line(done, total_, what_, seconds, no_bar) + "\n");
  redraw("\r\x1b[K" + progress_line(done, total_, what_, seconds, terminal_columns()));
}

}  // namespace tofray::app
