// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

/// NumPy's array format (.npy). Written: version 1.0, little endian, C order. Read: versions 1 to 3, either byte order, either order of
/// the indices. See "NEP 1" of NumPy for the format.
namespace tofray::files {

/// What one element is: numpy's kind and its size in bytes.
struct NpyType {
  char kind = 'f';  ///< 'b' bool, 'i' signed, 'u' unsigned, 'f' IEEE float, 'U' UTF-32 text
  int size = 4;     ///< bytes per element: b 1; i, u 1 2 4 8; f 4 8; U 4 per character
  bool operator==(const NpyType&) const = default;
  /// As numpy names it: "float32", "uint16", "bool", "str".
  [[nodiscard]] std::string name() const;
  /// As the file says it: "<f4", "|b1", "<U17".
  [[nodiscard]] std::string descr() const;
};

/// The type that holds a T of C++.
template <class T>
constexpr NpyType npy_type_of() {
  static_assert(std::is_arithmetic_v<T>);
  if constexpr (std::is_same_v<T, bool>) return {'b', 1};
  const char kind = std::is_floating_point_v<T> ? 'f' : std::is_signed_v<T> ? 'i' : 'u';
  return {kind, static_cast<int>(sizeof(T))};
}

using NpyShape = std::vector<std::size_t>;

/// "(3, 172, 224)", as numpy writes it.
std::string shape_text(const NpyShape& shape);

/// An array in memory: little endian, C order.
struct NpyArray {
  NpyType type;
  NpyShape shape;
  std::string bytes;

  /// How many elements.
  [[nodiscard]] std::size_t count() const;
  /// Element i as a number (64-bit integers beyond 2^53 are rounded). Not for text.
  [[nodiscard]] double number(std::size_t i) const;
  /// Text of a 0-d or one-element 'U' array, as UTF-8.
  [[nodiscard]] std::string text() const;
};

/// Version 1.0 header, padded with spaces so that the data start at a multiple of 64 bytes.
std::string npy_header(const NpyType& type, const NpyShape& shape);

/// UTF-8 → the bytes of a 'U' array's element (UTF-32, little endian). Bytes that are not UTF-8 become U+FFFD.
std::string utf32_of(std::string_view utf8);

/// Whether a file of so many bytes is as long as its header says. @param first  its first bytes, the header among them
/// @throws Error as parse_npy
void check_npy_size(std::string_view first, std::size_t size, const std::string& where);

/// Reads one .npy file that is in memory.
/// @param where   path (and entry) for messages
/// @throws Error (bad_input): truncated, lying or unknown header, data of another size than the header says; (limit): too many dimensions
NpyArray parse_npy(std::string_view file, const std::string& where);

/// Reads a .npy file. @throws Error as parse_npy, and (io) where it cannot be read.
NpyArray read_npy(const std::string& path);

}  // namespace tofray::files
