// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <bit>
#include <cstdint>
#include <cstring>
#include <string>
#include <string_view>

/// Plain CDR, version 1, little endian, as DDS and ROS 2 have it: numbers stand at multiples of their size, counted from behind the four
/// bytes of encapsulation; a text is its length with the closing 0, and its bytes; a sequence is its length and its items.
namespace tofray::messages {

static_assert(std::endian::native == std::endian::little, "numbers are written as they lie in memory");

class Cdr {
 public:
  /// @param out  emptied; memory that it has is used again
  explicit Cdr(std::string& out) : out_(out) { out_.assign({0, 1, 0, 0}); }

  template <class T>
  Cdr& put(T value) {
    align(sizeof(T));
    char bytes[sizeof(T)];
    std::memcpy(bytes, &value, sizeof(T));
    out_.append(bytes, sizeof(T));
    return *this;
  }
  Cdr& text(std::string_view value) {
    put(static_cast<std::uint32_t>(value.size() + 1));
    out_.append(value);
    out_ += '\0';
    return *this;
  }
  /// The length of a sequence; its items come next.
  Cdr& count(std::size_t items) { return put(static_cast<std::uint32_t>(items)); }
  /// Room for a sequence of bytes, to be filled in.
  char* bytes(std::size_t size) {
    count(size);
    const std::size_t at = out_.size();
    out_.resize(at + size);
    return out_.data() + at;
  }
  template <class Items>
  Cdr& items(const Items& all) {
    for (const auto& one : all) put(one);
    return *this;
  }

 private:
  void align(std::size_t size) {
    constexpr std::size_t encapsulation = 4;
    const std::size_t over = (out_.size() - encapsulation) % size;
    if (over != 0) out_.append(size - over, '\0');
  }
  std::string& out_;
};

/// std_msgs/Header.
struct Header {
  std::int64_t stamp_ns;
  std::string_view frame;
};

constexpr std::int64_t ns_per_s = 1'000'000'000;

/// builtin_interfaces/Time: seconds, rounded down, and what is left.
inline Cdr& put_time(Cdr& cdr, std::int64_t ns) {
  const std::int64_t rest = (ns % ns_per_s + ns_per_s) % ns_per_s;
  return cdr.put(static_cast<std::int32_t>((ns - rest) / ns_per_s)).put(static_cast<std::uint32_t>(rest));
}
inline Cdr& put_header(Cdr& cdr, const Header& header) { return put_time(cdr, header.stamp_ns).text(header.frame); }

}  // namespace tofray::messages
