// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include "mesh/ply_body.h"

#include <fmt/core.h>

#include "base/bytes.h"
#include "base/faults.h"
#include "base/text.h"
#include "mesh/numbers.h"

namespace tofray::mesh {
namespace {

/// A whole number of binary data as 64 bits; -1 where the type is none.
std::int64_t integer_at(const char* at, PlyType type, bool big_endian) {
  switch (type) {
    case PlyType::int8: return base::read_bytes_as<std::int8_t>(at, big_endian);
    case PlyType::uint8: return base::read_bytes_as<std::uint8_t>(at, big_endian);
    case PlyType::int16: return base::read_bytes_as<std::int16_t>(at, big_endian);
    case PlyType::uint16: return base::read_bytes_as<std::uint16_t>(at, big_endian);
    case PlyType::int32: return base::read_bytes_as<std::int32_t>(at, big_endian);
    case PlyType::uint32: return base::read_bytes_as<std::uint32_t>(at, big_endian);
    case PlyType::float32:
    case PlyType::float64: break;
  }
  return -1;
}

const char* const bad_length = "a list is longer than the rest of the file";

std::string length_text(std::int64_t length, std::uint64_t bytes) { return fmt::format("got {} values in {} bytes", length, bytes); }

}  // namespace

std::string_view PlyText::word() {
  std::string_view text;
  if (!words_.next(text)) words_.fail("the file is cut short", "expected a number");
  return text;
}

double PlyText::number(PlyType) {
  const std::string_view text = word();
  double value = 0;
  if (!read_number(text, value)) fail("a number is none", "got " + base::in_quotes(text) + ", expected a number such as 0.25");
  return value;
}

std::int64_t PlyText::integer(PlyType) {
  const std::string_view text = word();
  std::int64_t value = 0;
  if (!read_integer(text, value)) fail("a whole number is none", "got " + base::in_quotes(text) + ", expected a whole number such as 3");
  return value;
}

std::uint64_t PlyText::length(PlyType type, PlyType) {
  const std::int64_t value = integer(type);
  // A blank and a digit each.
  if (value < 0 || static_cast<std::uint64_t>(value) > words_.left() / 2) fail(bad_length, length_text(value, words_.left()));
  return static_cast<std::uint64_t>(value);
}

bool PlyText::could_hold(const PlyElement& element, const PlyProperty* polygons) const {
  std::uint64_t words = 0;
  for (const PlyProperty& property : element.properties) words += &property == polygons ? 4 : 1;
  return words == 0 || element.count <= (words_.left() + 1) / 2 / words;
}

void PlyText::finish() {
  std::string_view rest;
  if (!words_.next(rest)) return;
  const std::size_t bytes = rest.size() + words_.left();
  fail(fmt::format("{} bytes are left over behind the last element", bytes), "got " + base::in_quotes(rest));
}

const char* PlyBinary::take(std::size_t size) {
  last_ = at_;
  if (bytes_.size() - at_ < size) fail("the file is cut short", {});
  at_ += size;
  return bytes_.data() + last_;
}

double PlyBinary::number(PlyType type) {
  const char* const at = take(size_of(type));
  if (type == PlyType::float32) return base::read_bytes_as<float>(at, big_endian_);
  if (type == PlyType::float64) return base::read_bytes_as<double>(at, big_endian_);
  return static_cast<double>(integer_at(at, type, big_endian_));
}

std::int64_t PlyBinary::integer(PlyType type) { return integer_at(take(size_of(type)), type, big_endian_); }

std::uint64_t PlyBinary::length(PlyType type, PlyType item) {
  const std::int64_t value = integer(type);
  const std::size_t left = bytes_.size() - at_;
  if (value < 0 || static_cast<std::uint64_t>(value) > left / size_of(item)) fail(bad_length, length_text(value, left));
  return static_cast<std::uint64_t>(value);
}

bool PlyBinary::could_hold(const PlyElement& element, const PlyProperty* polygons) const {
  std::uint64_t row = 0;
  for (const PlyProperty& property : element.properties)
    row += !property.list ? size_of(property.type) : size_of(property.count) + (&property == polygons ? 3 * size_of(property.type) : 0);
  return row == 0 || element.count <= (bytes_.size() - at_) / row;
}

void PlyBinary::fail(const std::string& what, const std::string& more) const {
  const std::string where = element_ != nullptr ? fmt::format(" (byte {}, {} {})", last_, base::in_quotes(*element_), row_ + 1)
                                                : fmt::format(" (byte {})", last_);
  base::fail(base::whole(name_), what + where, more);
}

void PlyBinary::finish() const {
  if (at_ < bytes_.size())
    base::fail(base::whole(name_), fmt::format("{} bytes are left over behind the last element (byte {})", bytes_.size() - at_, at_));
}

}  // namespace tofray::mesh
