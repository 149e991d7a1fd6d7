// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include "files/npy.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cstring>

#include "files/data_limits.h"
#include "files/npy_header.h"
#include "files/read_bytes.h"
#include "tofray/error.h"

namespace tofray::files {
namespace {

static_assert(std::endian::native == std::endian::little, "arrays are written as they lie in memory");

template <class T>
double element(const std::string& bytes, std::size_t i) {
  T value;
  std::memcpy(&value, bytes.data() + i * sizeof(T), sizeof(T));
  return static_cast<double>(value);
}

/// Turns each element's bytes round; text is made of 4-byte characters.
void swap_byte_order(NpyArray& array) {
  const auto unit = static_cast<std::size_t>(array.type.kind == 'U' ? 4 : array.type.size);
  for (std::size_t at = 0; at + unit <= array.bytes.size(); at += unit)
    std::reverse(array.bytes.begin() + static_cast<std::ptrdiff_t>(at), array.bytes.begin() + static_cast<std::ptrdiff_t>(at + unit));
}

/// First index fastest → last index fastest.
void to_c_order(NpyArray& array) {
  const auto size = static_cast<std::size_t>(array.type.size);
  const std::size_t count = array.count();
  if (array.shape.size() < 2 || count == 0) return;
  std::string turned(array.bytes.size(), '\0');
  NpyShape stride(array.shape.size());
  std::size_t step = size;
  for (std::size_t axis = 0; axis < stride.size(); ++axis) {
    stride[axis] = step;
    step *= array.shape[axis];
  }
  NpyShape index(array.shape.size(), 0);
  std::size_t from = 0;
  for (std::size_t to = 0; to < count; ++to) {
    std::memcpy(turned.data() + to * size, array.bytes.data() + from, size);
    // next index, the last axis fastest
    for (std::size_t axis = index.size(); axis-- > 0;) {
      from += stride[axis];
      if (++index[axis] < array.shape[axis]) break;
      from -= stride[axis] * array.shape[axis];
      index[axis] = 0;
    }
  }
  array.bytes = std::move(turned);
}

void append_utf8(std::string& text, std::uint32_t code) {
  if (code > 0x10FFFF || (code >= 0xD800 && code <= 0xDFFF)) code = 0xFFFD;
  const auto put = [&](std::uint32_t byte) { text += static_cast<char>(byte); };
  if (code < 0x80) {
    put(code);
  } else if (code < 0x800) {
    put(0xC0 | code >> 6);
    put(0x80 | (code & 63));
  } else if (code < 0x10000) {
    put(0xE0 | code >> 12);
    put(0x80 | (code >> 6 & 63));
    put(0x80 | (code & 63));
  } else {
    put(0xF0 | code >> 18);
    put(0x80 | (code >> 12 & 63));
    put(0x80 | (code >> 6 & 63));
    put(0x80 | (code & 63));
  }
}

/// Takes one character off the front. Overlong forms, surrogates and stray bytes are U+FFFD, one byte each.
std::uint32_t take_utf8(std::string_view& text) {
  const auto byte = [&](std::size_t i) { return static_cast<std::uint32_t>(static_cast<unsigned char>(text[i])); };
  const std::uint32_t first = byte(0);
  const std::size_t length = first < 0x80                    ? 1
                             : first >= 0xC2 && first < 0xE0 ? 2
                             : first >= 0xE0 && first < 0xF0 ? 3
                             : first >= 0xF0 && first < 0xF5 ? 4
                                                             : 0;
  std::uint32_t code = length == 1 ? first : length == 2 ? first & 31 : length == 3 ? first & 15 : first & 7;
  bool good = length > 0 && text.size() >= length;
  for (std::size_t i = 1; good && i < length; ++i) {
    good = (byte(i) & 0xC0) == 0x80;
    code = code << 6 | (byte(i) & 63);
  }
  good = good && !(length == 3 && (code < 0x800 || (code >= 0xD800 && code < 0xE000))) &&
         !(length == 4 && (code < 0x10000 || code > 0x10FFFF));
  text.remove_prefix(good ? length : 1);
  return good ? code : 0xFFFD;
}

}  // namespace

std::string NpyType::name() const {
  switch (kind) {
    case 'b': return "bool";
    case 'i': return fmt::format("int{}", size * 8);
    case 'u': return fmt::format("uint{}", size * 8);
    case 'f': return fmt::format("float{}", size * 8);
    default: return "str";
  }
}

std::string NpyType::descr() const {
  if (kind == 'U') return fmt::format("<U{}", size / 4);
  return fmt::format("{}{}{}", size == 1 ? '|' : '<', kind, size);
}

std::string shape_text(const NpyShape& shape) {
  return shape.size() == 1 ? fmt::format("({},)", shape[0]) : fmt::format("({})", fmt::join(shape, ", "));
}

std::size_t NpyArray::count() const {
  std::size_t n = 1;
  for (const std::size_t extent : shape) n *= extent;
  return n;
}

double NpyArray::number(std::size_t i) const {
  switch (type.kind) {
    case 'b': return element<std::uint8_t>(bytes, i) != 0 ? 1.0 : 0.0;
    case 'f': return type.size == 4 ? element<float>(bytes, i) : element<double>(bytes, i);
    case 'i':
      return type.size == 1   ? element<std::int8_t>(bytes, i)
             : type.size == 2 ? element<std::int16_t>(bytes, i)
             : type.size == 4 ? element<std::int32_t>(bytes, i)
                              : element<std::int64_t>(bytes, i);
    case 'u':
      return type.size == 1   ? element<std::uint8_t>(bytes, i)
             : type.size == 2 ? element<std::uint16_t>(bytes, i)
             : type.size == 4 ? element<std::uint32_t>(bytes, i)
                              : element<std::uint64_t>(bytes, i);
    default: throw Error(ErrorKind::bug, "error: text has no number");
  }
}

std::string NpyArray::text() const {
  std::string result;
  if (type.kind != 'U') return result;
  for (std::size_t at = 0; at + 4 <= bytes.size(); at += 4) {
    std::uint32_t code = 0;
    std::memcpy(&code, bytes.data() + at, 4);
    if (code == 0) break;
    append_utf8(result, code);
  }
  return result;
}

std::string npy_header(const NpyType& type, const NpyShape& shape) {
  std::string dictionary = fmt::format("{{'descr': '{}', 'fortran_order': False, 'shape': {}, }}", type.descr(), shape_text(shape));
  constexpr std::size_t before = 10;  // magic, version, length
  dictionary.append(63 - (before + dictionary.size()) % 64, ' ');
  dictionary += '\n';
  std::string header("\x93NUMPY\x01\x00", 8);
  header += static_cast<char>(dictionary.size() & 255);
  header += static_cast<char>(dictionary.size() >> 8);
  return header + dictionary;
}

std::string utf32_of(std::string_view utf8) {
  std::string result;
  while (!utf8.empty()) {
    const std::uint32_t code = take_utf8(utf8);
    char four[4];
    std::memcpy(four, &code, 4);
    result.append(four, 4);
  }
  return result;
}

namespace {

void check_size(const NpyHeader& header, std::size_t size, const std::string& where) {
  const std::size_t data = size - header.length;
  if (data == header.data_bytes) return;
  throw Error(ErrorKind::bad_input, fmt::format("{}: error: the array is {}\n  got {} bytes of data, expected {} for {} of shape {}", where,
                                                data < header.data_bytes ? "cut short" : "followed by bytes that are not its own", data,
                                                header.data_bytes, header.type.name(), shape_text(header.shape)));
}

}  // namespace

void check_npy_size(std::string_view first, std::size_t size, const std::string& where) {
  check_size(parse_npy_header(first, where), size, where);
}

NpyArray parse_npy(std::string_view file, const std::string& where) {
  const NpyHeader header = parse_npy_header(file, where);
  check_size(header, file.size(), where);
  const std::string_view data = file.substr(header.length);
  NpyArray array{header.type, header.shape, std::string(data)};
  if (header.big_endian) swap_byte_order(array);
  if (header.fortran_order) to_c_order(array);
  return array;
}

NpyArray read_npy(const std::string& path) { return parse_npy(read_bytes(path, max_data_file_bytes), path); }

}  // namespace tofray::files
