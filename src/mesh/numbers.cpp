// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include "mesh/numbers.h"

#include <algorithm>
#include <charconv>
#include <cstddef>
#include <system_error>

namespace tofray::mesh {
namespace {

constexpr auto npos = std::string_view::npos;

/// The text without a leading '+', which std::from_chars does not take.
std::string_view without_plus(std::string_view text) {
  if (text.size() > 1 && text[0] == '+' && text[1] != '-') text.remove_prefix(1);
  return text;
}

/// Whether a number that double cannot hold is too large, not too small: by the place of its first digit that is not 0.
bool too_large(std::string_view text) {
  const std::size_t mark = std::min(text.find_first_of("eE"), text.size());
  std::int64_t exponent = 0;
  if (mark < text.size()) read_integer(text.substr(mark + 1), exponent);
  const std::string_view digits = text.substr(0, mark);
  const auto point = static_cast<std::int64_t>(std::min(digits.find('.'), digits.size()));
  const std::size_t found = digits.find_first_of("123456789");
  if (found == npos) return false;
  const auto first = static_cast<std::int64_t>(found);
  const auto bounded = std::clamp<std::int64_t>(exponent, -(std::int64_t{1} << 60), std::int64_t{1} << 60);
  return bounded + point - first > 0;
}

/// 0x1p-3, and what Microsoft's C library writes for numbers that are not finite: 1.#INF, -1.#IND.
bool has_odd_form(std::string_view text) {
  if (text.starts_with('-')) text.remove_prefix(1);
  if (text.starts_with("1.#")) return text.find_first_not_of("ABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789", 3) == npos;
  if (!text.starts_with("0x") && !text.starts_with("0X")) return false;
  return text.size() > 2 && text.find_first_not_of("0123456789abcdefABCDEF.pP+-", 2) == npos;
}

}  // namespace

bool read_number(std::string_view text, double& value) {
  text = without_plus(text);
  const char* const end = text.data() + text.size();
  const auto read = std::from_chars(text.data(), end, value);
  if (read.ptr == end && read.ec == std::errc()) return true;
  if (read.ptr == end && read.ec == std::errc::result_out_of_range) {
    value = too_large(text) ? std::numeric_limits<double>::infinity() : 0.0;
    return true;
  }
  value = std::numeric_limits<double>::quiet_NaN();
  return has_odd_form(text);
}

bool read_integer(std::string_view text, std::int64_t& value) {
  using Limits = std::numeric_limits<std::int64_t>;
  text = without_plus(text);
  const char* const end = text.data() + text.size();
  const auto read = std::from_chars(text.data(), end, value);
  if (read.ptr != end) return false;
  if (read.ec == std::errc::result_out_of_range) value = text.starts_with('-') ? Limits::min() : Limits::max();
  return read.ec == std::errc() || read.ec == std::errc::result_out_of_range;
}

}  // namespace tofray::mesh
