// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include "run/pose_lines.h"

#include <fcntl.h>
#include <fmt/core.h>
#include <poll.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <system_error>
#include <utility>

#include "tofray/error.h"

namespace tofray::run {

namespace {

constexpr int moment_ms = 20;  // after which `stop` is looked at
constexpr std::size_t longest_line = 10'000;

[[noreturn]] void fail(const std::string& name, const char* what, int code) {
  throw Error(ErrorKind::io, fmt::format("{}: error: cannot {}: {}", name, what, std::generic_category().message(code)));
}

/// Opening a pipe waits for who writes into it.
int opened(const std::string& name) {
  int file = -1;
  do {
    file = ::open(name.c_str(), O_RDONLY | O_CLOEXEC);
  } while (file < 0 && errno == EINTR);
  if (file < 0) fail(name, "read it", errno);
  return file;
}

}  // namespace

PoseLines::PoseLines(const std::string& file)
    : name_(file == "-" ? "<stdin>" : file), file_(file == "-" ? STDIN_FILENO : opened(file)), lines_(name_) {}

PoseLines::~PoseLines() {
  if (file_ != STDIN_FILENO) ::close(file_);
}

std::optional<double> PoseLines::last_s() const { return poses_.empty() ? std::nullopt : std::optional(poses_.back().time_s); }

void PoseLines::take(std::string_view line) {
  if (line.ends_with('\r')) line.remove_suffix(1);
  const std::optional<load::TimedPose> found = lines_.take(line);
  if (!found) return;
  CameraKeyframe& key = poses_.emplace_back();
  key.time_s = found->time_s, key.pose.position = found->position, key.pose.quaternion = found->quaternion;
  if (!first_s_) first_s_ = found->time_s;
}

/// Takes the lines that are complete.
void PoseLines::take_lines() {
  std::size_t from = 0;
  for (std::size_t end = text_.find('\n'); end != std::string::npos; end = text_.find('\n', from)) {
    take(std::string_view(text_).substr(from, end - from));
    from = end + 1;
  }
  text_.erase(0, from);
  if (ended_ && !text_.empty()) take(std::exchange(text_, {}));
  if (text_.size() > longest_line)
    throw Error(ErrorKind::bad_input,
                fmt::format("{}: error: a line has more than {} bytes\n  expected lines of t x y z qx qy qz qw", name_, longest_line));
}

bool PoseLines::reach(double time_s, const std::atomic<bool>& stop) {
  const auto there = [&] { return !poses_.empty() && poses_.back().time_s >= time_s; };
  while (!there() && !ended_ && !stop) {
    pollfd waiting{file_, POLLIN, 0};
    const int ready = ::poll(&waiting, 1, moment_ms);
    if (ready < 0 && errno != EINTR) fail(name_, "wait for poses", errno);
    if (ready <= 0) continue;
    std::array<char, 4096> bytes{};
    const ssize_t count = ::read(file_, bytes.data(), bytes.size());
    if (count < 0 && errno != EINTR && errno != EAGAIN) fail(name_, "read poses", errno);
    if (count == 0) ended_ = true;
    if (count > 0) text_.append(bytes.data(), static_cast<std::size_t>(count));
    take_lines();
  }
  return there();
}

std::vector<CameraKeyframe> PoseLines::between(double from_s, double to_s) {
  while (poses_.size() > 1 && poses_[1].time_s <= from_s) poses_.pop_front();
  std::vector<CameraKeyframe> out;
  for (const CameraKeyframe& one : poses_) {
    out.push_back(one);
    if (one.time_s >= to_s) break;
  }
  return out;
}

}  // namespace tofray::run
