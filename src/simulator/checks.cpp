// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include "simulator/checks.h"

#include "base/text.h"
#include "base/vec.h"

namespace tofray::simulator {

void refuse(const std::string& what, const std::string& more, ErrorKind kind) { throw Error(kind, "error: " + what + "\n  " + more); }

void within(double value, const base::Range& range, const std::string& path) {
  if (range.contains(value)) return;
  refuse(path + " is out of range",
         "got " + base::number_text(value) + ", expected " + base::number_text(range.low) + " to " + base::number_text(range.high));
}

void within(const std::vector<double>& values, const base::Range& range, const std::string& path) {
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (!range.contains(values[i])) within(values[i], range, path + "[" + std::to_string(i) + "]");
  }
}

void within(const Vec3& values, const base::Range& range, const std::string& path) {
  for (std::size_t i = 0; i < 3; ++i) within(values[i], range, path + "[" + std::to_string(i) + "]");
}

void direction(const Vec3& value, const std::string& path) {
  within(value, range::component, path);
  if (base::length(value) < range::shortest_m) refuse(path + " has no length", "expected a direction such as {0, 0, 1}");
}

void samples(const std::vector<double>& x, const base::Range& x_range, const std::vector<double>& y, const base::Range& y_range,
             std::size_t least, const std::string& path) {
  if (x.size() != y.size() || x.size() < least) {
    refuse(path + " has the wrong number of samples", "got " + std::to_string(x.size()) + " positions and " + std::to_string(y.size()) +
                                                          " values, expected as many of both, at least " + std::to_string(least));
  }
  if (x.size() > 1) within(x, x_range, path + ".x");  // where a single sample stands means nothing
  within(y, y_range, path + ".y");
  for (std::size_t i = 1; i < x.size(); ++i) {
    if (!(x[i] > x[i - 1])) {
      refuse(path + ".x does not ascend", "got " + base::number_text(x[i]) + " after " + base::number_text(x[i - 1]));
    }
  }
}

void at_most(std::size_t count, std::int64_t most, const std::string& path) {
  if (count <= static_cast<std::size_t>(most)) return;
  refuse("too many " + path, "got " + std::to_string(count) + ", at most " + std::to_string(most), ErrorKind::limit);
}

}  // namespace tofray::simulator
