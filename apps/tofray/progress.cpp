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

}  // namespace

Progress::Progress(std::uint64_t total, const char* what, bool quiet)
    : total_(total), what_(what), silent_(quiet || total < 2), terminal_(stderr_is_terminal()) {}

Progress::~Progress() { clear(); }

void Progress::clear() const {
  if (terminal_ && shown_) say("\r\x1b[K");
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
  const double rate = static_cast<double>(done_) / seconds, left = static_cast<double>(total_ - done_) / rate;
  const std::string counts = fmt::format("{}/{} {}  {:.3g}/s  {} left", done_, total_, what_, rate, time_text(left));
  if (!terminal_) return say(counts + "\n");
  constexpr std::uint64_t width = 24;
  const std::uint64_t full = done_ * width / total_;
  say(fmt::format("\r\x1b[K[{:#<{}}{:.<{}}] {}", "", full, "", width - full, counts));
}

}  // namespace tofray::app
