// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <string_view>
#include <type_traits>
#include <vector>

namespace tofray::base {

/// What arrays hold, in 128 bits: two that differ have the same with a chance of 10⁻³⁸. Several gigabytes a second; no protection against
/// an attacker who looks for two.
class Content {
 public:
  template <class T>
  void add(const std::vector<T>& array) {
    static_assert(std::is_trivially_copyable_v<T>);  // numbers, or arrays of them: without gaps
    add(array.data(), array.size() * sizeof(T));
  }
  void add(std::string_view bytes) { add(bytes.data(), bytes.size()); }
  bool operator==(const Content&) const = default;

 private:
  __extension__ using Wide = unsigned __int128;

  /// Both halves of the product of two words, one upon the other.
  static std::uint64_t folded(std::uint64_t a, std::uint64_t b) {
    const Wide product = static_cast<Wide>(a) * b;
    return static_cast<std::uint64_t>(product) ^ static_cast<std::uint64_t>(product >> 64);
  }

  void take(std::uint64_t x, std::uint64_t y) {
    one_ = folded(x ^ 0xa0761d6478bd642f, y ^ one_);
    other_ = folded(x ^ other_, y ^ 0xe7037ed1a0b428db);
  }

  void add(const void* data, std::size_t bytes) {
    const auto* from = static_cast<const unsigned char*>(data);
    take(bytes, 0x8ebc6af09c88c6e3);
    for (; bytes >= 16; from += 16, bytes -= 16) {
      std::uint64_t x[2];
      std::memcpy(x, from, 16);
      take(x[0], x[1]);
    }
    std::uint64_t rest[2] = {0, 0};
    if (bytes > 0) std::memcpy(rest, from, bytes);
    take(rest[0], rest[1]);
  }

  std::uint64_t one_ = 0x589965cc75374cc3, other_ = 0x1d8e4e27c47d124f;
};

}  // namespace tofray::base
