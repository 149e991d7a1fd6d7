// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <algorithm>
#include <cstddef>
#include <new>
#include <vector>

namespace tofray {

/// Memory that begins with a line of the processor's caches.
template <class T>
struct AlignedMemory {
  using value_type = T;
  static constexpr std::align_val_t alignment{64};  ///< bytes

  AlignedMemory() = default;
  template <class Other>
  AlignedMemory(const AlignedMemory<Other>&) {}
  [[nodiscard]] T* allocate(std::size_t count) {
    if (count > static_cast<std::size_t>(-1) / sizeof(T)) throw std::bad_array_new_length();
    return static_cast<T*>(::operator new(count * sizeof(T), alignment));
  }
  void deallocate(T* memory, std::size_t) noexcept { ::operator delete(memory, alignment); }
  template <class Other>
  bool operator==(const AlignedMemory<Other>&) const {
    return true;
  }
};

/// An array of a frame: a std::vector whose memory is aligned to 64 bytes, so that kernels can write whole lines of it past the caches.
/// It is copied from and to a plain std::vector where one stands in its place.
template <class T>
class Array : public std::vector<T, AlignedMemory<T>> {
 public:
  using std::vector<T, AlignedMemory<T>>::vector;
  Array() = default;
  /// A copy of a plain vector.
  Array(const std::vector<T>& from) : std::vector<T, AlignedMemory<T>>(from.begin(), from.end()) {}
  /// A copy as a plain vector.
  operator std::vector<T>() const { return std::vector<T>(this->begin(), this->end()); }

  friend bool operator==(const Array& a, const Array& b) {
    return static_cast<const std::vector<T, AlignedMemory<T>>&>(a) == static_cast<const std::vector<T, AlignedMemory<T>>&>(b);
  }
  friend bool operator==(const Array& a, const std::vector<T>& b) { return std::equal(a.begin(), a.end(), b.begin(), b.end()); }
};

}  // namespace tofray
