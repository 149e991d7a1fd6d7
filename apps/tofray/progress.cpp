// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include "progress.h"

#include <fmt/format.h>

#include <algorithm>
#include <string>

#include "console.h"

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
std::string bar_text(std::uint64_t done, std::uint64_t total, int room) {
  constexpr int longest = 24, shortest = 6;
  const int width = std::min(room - 3, longest);
  if (width < shortest) return {};
  const auto full = static_cast<int>(static_cast<double>(done) / static_cast<double>(total) * width);
  return fmt::format("[{:#<{}}{:.<{}}] ", "", full, "", width - full);
}

}  // namespace

std::string progress_line(std::uint64_t done, std::uint64_t total, const char* what, double seconds, int columns) {
  const double rate = static_cast<double>(done) / seconds, left = static_cast<double>(total - done) / rate;
  const std::string counts = fmt::format("{}/{}", done, total);
  const std::string named = fmt::format("{} {}", counts, what), remaining = fmt::format("{}  {} left", named, time_text(left));
  const std::string all = fmt::format("{}  {:.3g}/s  {} left", named, rate, time_text(left));
  if (columns == no_bar) return all;
  const int room = columns - 1;  // a terminal may wrap as soon as its last column is written
  for (const std::string& text : {all, remaining, named, counts}) {
    const auto length = static_cast<int>(text.size());
    if (length <= room) return bar_text(done, total, room - length) + text;
  }
  return {};
}

Progress::Progress(std::uint64_t total, const char* what, bool quiet)
    : total_(total), what_(what), silent_(quiet || total < 2), terminal_(stderr_is_terminal()) {}

Progress::~Progress() { clear(); }

void Progress::clear() const {
  if (terminal_ && shown_) redraw("\r\x1b[K");
}

void Progress::step() {
  ++done_;
  if (silent_) return;
  const Clock::time_point now = Clock::now();
  if (now - last_ < (terminal_ ? 100ms : 5000ms)) return;
  last_ = now;
  show();
}

void Progress::show() {
  shown_ = true;
  const double seconds = std::chrono::duration<double>(last_ - start_).count();
  if (!terminal_) return say(progress_line(done_, total_, what_, seconds, no_bar) + "\n");
  redraw("\r\x1b[K" + progress_line(done_, total_, what_, seconds, terminal_columns()));
}

}  // namespace tofray::app
