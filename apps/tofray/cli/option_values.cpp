// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include "cli/option_values.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "base/text.h"
#include "base/units.h"
#include "tofray/error.h"

namespace tofray::app {

void refuse(const char* option, const std::string& value, const std::string& expected) {
  throw Error(ErrorKind::bad_input, fmt::format("error: {} cannot be {}\n  expected {}", option, base::in_quotes(value), expected));
}

std::uint64_t whole(const char* option, const std::string& value, std::uint64_t low, std::uint64_t high, const std::string& expected) {
  std::uint64_t number = 0;
  const char* const end = value.data() + value.size();
  const auto read = std::from_chars(value.data(), end, number);
  if (read.ec != std::errc() || read.ptr != end || number < low || number > high) refuse(option, value, expected);
  return number;
}

double length_of(const char* option, const std::string& value, double low, double high, const char* example) {
  const base::Quantity length = base::parse_quantity(value, base::Dimension::length);
  const bool number = length.status == base::Quantity::Status::good || length.status == base::Quantity::Status::bare;
  if (!number || !(length.value >= low && length.value <= high))
    refuse(option, value, fmt::format("a length of {} to {} m, as in {} {}", low, high, option, example));
  return length.value;
}

void take_frame_rate(const char* option, Options& o, const std::string& value) {
  double number = 0;
  const char* const end = value.data() + value.size();
  const auto read = std::from_chars(value.data(), end, number);
  if (read.ec != std::errc() || read.ptr != end || !(number >= 1e-4 && number <= 1e5))
    refuse(option, value, "frames per second, a number of 0.0001 to 100000");
  o.set.emplace_back("camera.frame_rate", value + " Hz");
}

std::vector<std::string> split(const std::string& text, char at) {
  std::vector<std::string> parts;
  for (std::size_t from = 0; from <= text.size();) {
    const std::size_t end = std::min(text.find(at, from), text.size());
    parts.push_back(text.substr(from, end - from));
    from = end + 1;
  }
  return parts;
}

std::size_t word_of(const char* option, const std::string& value, const std::vector<std::string>& words) {
  const auto found = std::find(words.begin(), words.end(), value);
  if (found == words.end()) refuse(option, value, base::listed(words) + base::did_you_mean(value, words));
  return static_cast<std::size_t>(found - words.begin());
}

double number_of(const char* option, const std::string& value, double low, double high, const std::string& expected) {
  double number = 0;
  const char* const end = value.data() + value.size();
  const auto read = std::from_chars(value.data(), end, number);
  if (read.ec != std::errc() || read.ptr != end || !(number >= low && number <= high)) refuse(option, value, expected);
  return number;
}

void add_distances(const char* name, Options& o, const std::string& value) {
  constexpr std::size_t most = 1000;
  const std::string like = "0.5m,1m or 0.3m..4m";
  for (const std::string& part : split(value, ',')) {
    const std::size_t dots = part.find(".."), first_colon = part.find(':');
    const std::size_t between = std::min(dots, first_colon);
    if (between == std::string::npos) {
      o.at_m.push_back(length_of(name, part, 0.01, 1000, like.c_str()));
      continue;
    }
    const std::size_t behind = between + (between == dots ? 2 : 1), colon = part.find(':', behind);
    const std::uint64_t count =
        colon == std::string::npos
            ? 8
            : whole(name, part.substr(colon + 1), 2, most, fmt::format("a number of distances of 2 to 1000, as in {} 0.3m..4m:50", name));
    const double first = length_of(name, part.substr(0, between), 0.01, 1000, like.c_str());
    const double last = length_of(name, part.substr(behind, colon == std::string::npos ? colon : colon - behind), 0.01, 1000, like.c_str());
    for (std::uint64_t i = 0; i < count; ++i)
      o.at_m.push_back(first + (last - first) * static_cast<double>(i) / static_cast<double>(count - 1));
  }
  if (o.at_m.size() > most) refuse(name, value, "1000 distances at most");
}

void take_budget_file(Options& o, const std::string& value) {
  if (!value.ends_with(".csv") && !value.ends_with(".json")) refuse("-o", value, "a name that ends in .csv or .json, as in -o budget.csv");
  o.output = value;
}

}  // namespace tofray::app
