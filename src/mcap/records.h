// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "base/bytes.h"

/// MCAP, version 0: a container for messages of many topics with their times (mcap.dev/spec). Between two magic words stand records: a byte
/// that says which, the length of what follows in 64 bits, and that; numbers are little endian, texts have their length in 32 bits before them.
namespace tofray::mcap {

inline constexpr std::string_view magic{"\x89MCAP0\r\n", 8};
inline constexpr std::size_t record_head = 1 + 8;

enum class Opcode : std::uint8_t {
  header = 0x01,
  footer = 0x02,
  schema = 0x03,
  channel = 0x04,
  message = 0x05,
  chunk = 0x06,
  message_index = 0x07,
  chunk_index = 0x08,
  attachment = 0x09,
  attachment_index = 0x0a,
  statistics = 0x0b,
  metadata = 0x0c,
  metadata_index = 0x0d,
  summary_offset = 0x0e,
  data_end = 0x0f,
};

using Pairs = std::vector<std::pair<std::string, std::string>>;

/// Appends records.
class Put {
 public:
  explicit Put(std::string& to) : to_(to) {}
  template <class T>
  Put& number(T value) {
    for (std::size_t i = 0; i < sizeof(T); ++i) to_ += static_cast<char>(static_cast<std::uint64_t>(value) >> (8 * i) & 255);
    return *this;
  }
  Put& u16(std::uint64_t v) { return number(static_cast<std::uint16_t>(v)); }
  Put& u32(std::uint64_t v) { return number(static_cast<std::uint32_t>(v)); }
  Put& u64(std::uint64_t v) { return number(v); }
  Put& text(std::string_view v) {
    u32(v.size());
    to_.append(v);
    return *this;
  }
  Put& pairs(const Pairs& all) {
    std::size_t size = 0;
    for (const auto& [key, value] : all) size += 8 + key.size() + value.size();
    u32(size);
    for (const auto& [key, value] : all) text(key).text(value);
    return *this;
  }
  Put& raw(std::string_view v) {
    to_.append(v);
    return *this;
  }
  /// Begins a record whose length is known only at its end.
  std::size_t begin(Opcode opcode) {
    to_ += static_cast<char>(opcode);
    u64(0);
    return to_.size();
  }
  /// @param start  as begin() gave it
  void end(std::size_t start) {
    const std::uint64_t size = to_.size() - start;
    for (std::size_t i = 0; i < 8; ++i) to_[start - 8 + i] = static_cast<char>(size >> (8 * i) & 255);
  }

 private:
  std::string& to_;
};

/// Takes numbers and texts off a record's bytes. Where there are too few of them, good() is false from then on and all is 0.
class Take {
 public:
  explicit Take(std::string_view from) : from_(from) {}
  template <class T>
  T number() {
    if (from_.size() < sizeof(T)) {
      good_ = false, from_ = {};
      return 0;
    }
    const T value = base::read_bytes_as<T>(from_.data());
    from_.remove_prefix(sizeof(T));
    return value;
  }
  std::uint16_t u16() { return number<std::uint16_t>(); }
  std::uint32_t u32() { return number<std::uint32_t>(); }
  std::uint64_t u64() { return number<std::uint64_t>(); }
  std::string_view raw(std::uint64_t size) {
    if (from_.size() < size) {
      good_ = false, from_ = {};
      return {};
    }
    const std::string_view out = from_.substr(0, size);
    from_.remove_prefix(size);
    return out;
  }
  std::string_view text() { return raw(u32()); }
  Pairs pairs() {
    Take inner(raw(u32()));
    Pairs out;
    while (inner.good() && !inner.rest().empty()) {
      const std::string_view key = inner.text(), value = inner.text();
      out.emplace_back(key, value);
    }
    good_ = good_ && inner.good();
    return out;
  }
  [[nodiscard]] std::string_view rest() const { return from_; }
  [[nodiscard]] bool good() const { return good_; }

 private:
  std::string_view from_;
  bool good_ = true;
};

}  // namespace tofray::mcap
