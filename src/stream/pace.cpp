// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include "stream/pace.h"

#include <algorithm>
#include <cmath>

namespace tofray::stream {

void Lateness::add(double late_s) {
  const double late = std::max(late_s, 0.0);
  const double step = std::min(std::floor(late / step_s_), static_cast<double>(counts_.size() - 1));
  ++counts_[static_cast<std::size_t>(step)];
  ++all_;
  largest_s_ = std::max(largest_s_, late);
}

double Lateness::quantile(double share) const {
  const double wanted = share * static_cast<double>(all_);
  std::uint64_t seen = 0;
  for (std::size_t i = 0; i < counts_.size(); ++i) {
    seen += counts_[i];
    if (seen > 0 && static_cast<double>(seen) >= wanted) return std::min(step_s_ * static_cast<double>(i + 1), largest_s_);
  }
  return 0;
}

namespace {

/// Where a camera's stream stands.
struct Course {
  Eye* eye;
  std::uint64_t next = 0;  ///< the frame that is made, or that is to be made next
  bool made = false;
  Account account = {};

  [[nodiscard]] double due_s() const { return eye->due_s(next); }
  [[nodiscard]] bool ended(std::uint64_t frames) const { return frames > 0 && next >= frames; }
};

void drop_past(Course& course, std::uint64_t frames, double now_s) {
  while (!course.ended(frames) && course.eye->due_s(course.next + 1) <= now_s) ++course.next, ++course.account.dropped;
}

void send_now(Course& course, double now_s) {
  course.eye->send();
  course.account.lateness.add(now_s - course.due_s());
  ++course.account.sent, ++course.next;
  course.made = false;
}

/// The first of those that are (not) made, by when they are due.
Course* first_due(std::vector<Course>& courses, std::uint64_t frames, bool made) {
  Course* out = nullptr;
  for (Course& one : courses)
    if (!one.ended(frames) && one.made == made && (out == nullptr || one.due_s() < out->due_s())) out = &one;
  return out;
}

/// One thing at a time. @return whether there was something to do
bool step(std::vector<Course>& courses, std::uint64_t frames, Clock& clock) {
  Course* const waiting = first_due(courses, frames, true);
  if (waiting != nullptr && waiting->due_s() <= clock.now_s()) return send_now(*waiting, clock.now_s()), true;
  if (Course* const idle = first_due(courses, frames, false); idle != nullptr) {
    drop_past(*idle, frames, clock.now_s());
    if (!idle->ended(frames)) idle->eye->make(idle->next), idle->made = true;
    return true;
  }
  if (waiting != nullptr) clock.wait_until(waiting->due_s());
  return waiting != nullptr;
}

}  // namespace

std::vector<Account> run(const std::vector<Eye*>& eyes, std::uint64_t frames, Clock& clock, const std::atomic<bool>& stop) {
  std::vector<Course> courses;
  for (Eye* eye : eyes) courses.push_back({eye});
  while (!stop && step(courses, frames, clock)) {}
  std::vector<Account> out;
  for (const Course& one : courses) out.push_back(one.account);
  return out;
}

}  // namespace tofray::stream
