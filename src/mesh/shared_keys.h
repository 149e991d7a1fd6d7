// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <array>
#include <cstddef>
#include <cstdint>
#include <random>
#include <vector>

namespace tofray::mesh {

/// Numbers keys of some words in the order in which they come, each once.
///
/// A hash table with chains. Its multipliers are drawn anew in each run, so that no file can be made whose keys all share a chain (the
/// family is strongly universal: Lemire and Kaser 2014, "Strongly universal string hashing is fast"); the numbers do not depend on them.
/// The keys themselves are kept by the caller: `key_of` gives that of a number.
template <std::size_t words>
class SharedKeys {
 public:
  using Key = std::array<std::uint32_t, words>;

  SharedKeys() : heads_(64, -1) {
    std::random_device source;
    for (std::uint64_t& one : multipliers_) one = std::uint64_t{source()} << 32 | source();
  }

  /// @return -1 where the key is new
  template <class KeyOf>
  [[nodiscard]] std::int32_t find(const Key& key, const KeyOf& key_of) const {
    std::int32_t i = heads_[slot_of(key)];
    while (i >= 0 && key_of(i) != key) i = next_[static_cast<std::size_t>(i)];
    return i;
  }

  /// Takes a new key. @return its number
  template <class KeyOf>
  std::int32_t add(const Key& key, const KeyOf& key_of) {
    if (next_.size() == heads_.size()) grow(key_of);
    const auto number = static_cast<std::int32_t>(next_.size());
    std::int32_t& head = heads_[slot_of(key)];
    next_.push_back(head);
    head = number;
    return number;
  }

 private:
  [[nodiscard]] std::size_t slot_of(const Key& key) const {
    std::uint64_t sum = multipliers_[words];
    for (std::size_t k = 0; k < words; ++k) sum += multipliers_[k] * key[k];
    return static_cast<std::size_t>(sum >> 32) & (heads_.size() - 1);
  }
  template <class KeyOf>
  void grow(const KeyOf& key_of) {
    heads_.assign(2 * heads_.size(), -1);
    for (std::size_t i = 0; i < next_.size(); ++i) {
      std::int32_t& head = heads_[slot_of(key_of(static_cast<std::int32_t>(i)))];
      next_[i] = head;
      head = static_cast<std::int32_t>(i);
    }
  }

  std::array<std::uint64_t, words + 1> multipliers_{};
  std::vector<std::int32_t> heads_;  ///< of each chain, -1 where it is empty; a power of two of them
  std::vector<std::int32_t> next_;   ///< by number
};

}  // namespace tofray::mesh
