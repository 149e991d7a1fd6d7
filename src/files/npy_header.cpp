// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include "files/npy_header.h"

#include <fmt/core.h>

#include "files/data_limits.h"
#include "tofray/error.h"

namespace tofray::files {

void refuse(const std::string& where, const std::string& what) {
  throw Error(ErrorKind::bad_input, fmt::format("{}: error: {}", where, what));
}

namespace {

/// The header's dictionary, a literal of Python: {'descr': '<f4', 'fortran_order': False, 'shape': (3, 4), }.
class DictionaryReader {
 public:
  DictionaryReader(std::string_view text, const std::string& where) : rest_(text), where_(where) {}

  void read(NpyHeader& header) {
    bool descr = false, order = false, shape = false;
    expect('{');
    while (!accept('}')) {
      const std::string_view key = quoted();
      expect(':');
      if (key == "descr" && !descr) {
        descr = true;
        read_descr(header);
      } else if (key == "fortran_order" && !order) {
        order = true;
        header.fortran_order = truth_value();
      } else if (key == "shape" && !shape) {
        shape = true;
        read_shape(header);
      } else {
        refuse(where_, fmt::format("unexpected key \"{}\" in the array's header", printable(key)));
      }
      if (!accept(',')) {
        expect('}');
        break;
      }
    }
    skip_space();
    if (!rest_.empty()) malformed();
    if (!descr || !order || !shape) refuse(where_, "the array's header lacks one of descr, fortran_order, shape");
  }

 private:
  [[noreturn]] void malformed() const {
    refuse(where_, fmt::format("the array's header is malformed at \"{}\"", printable(rest_.substr(0, 40))));
  }
  void skip_space() {
    while (!rest_.empty() && (rest_[0] == ' ' || rest_[0] == '\n' || rest_[0] == '\t')) rest_.remove_prefix(1);
  }
  bool accept(char c) {
    skip_space();
    if (rest_.empty() || rest_[0] != c) return false;
    rest_.remove_prefix(1);
    return true;
  }
  void expect(char c) {
    if (!accept(c)) malformed();
  }
  std::string_view quoted() {
    skip_space();
    if (rest_.empty() || (rest_[0] != '\'' && rest_[0] != '"')) malformed();
    const std::size_t end = rest_.find(rest_[0], 1);
    if (end == std::string_view::npos) malformed();
    const std::string_view text = rest_.substr(1, end - 1);
    rest_.remove_prefix(end + 1);
    return text;
  }
  bool truth_value() {
    skip_space();
    for (const std::string_view word : {"True", "False"}) {
      if (!rest_.starts_with(word)) continue;
      rest_.remove_prefix(word.size());
      return word == "True";
    }
    malformed();
  }
  std::size_t number() {
    skip_space();
    std::size_t value = 0, digits = 0;
    while (!rest_.empty() && rest_[0] >= '0' && rest_[0] <= '9') {
      if (++digits > 18)
        throw Error(ErrorKind::limit, fmt::format("{}: error: the array's header declares an extent beyond any memory", where_));
      value = value * 10 + static_cast<std::size_t>(rest_[0] - '0');
      rest_.remove_prefix(1);
    }
    if (digits == 0) malformed();
    return value;
  }
  void read_shape(NpyHeader& header) {
    expect('(');
    while (!accept(')')) {
      if (header.shape.size() == max_npy_dimensions)
        throw Error(ErrorKind::limit, fmt::format("{}: error: the array has more than {} dimensions", where_, max_npy_dimensions));
      header.shape.push_back(number());
      if (!accept(',')) {
        expect(')');
        break;
      }
    }
  }
  void read_descr(NpyHeader& header) {
    skip_space();
    if (rest_.starts_with('[')) refuse(where_, "an array of records is not read\n  expected one number or character type per array");
    const std::string_view descr = quoted();
    const auto unknown = [&] {
      refuse(where_,
             fmt::format("an array of type \"{}\" is not read\n  expected bool, int8…int64, uint8…uint64, float32, float64 or str{}",
                         printable(descr), descr.find('O') != std::string_view::npos ? "; Python objects could run code when loaded" : ""));
    };
    if (descr.size() < 3 || descr.size() > 10 || std::string_view("<>|=").find(descr[0]) == std::string_view::npos) unknown();
    header.big_endian = descr[0] == '>';
    std::size_t size = 0;
    for (const char c : descr.substr(2)) {
      if (c < '0' || c > '9') unknown();
      size = size * 10 + static_cast<std::size_t>(c - '0');
    }
    const char kind = descr[1];
    const bool good = (kind == 'b' && size == 1) || (kind == 'f' && (size == 4 || size == 8)) ||
                      (kind == 'U' && size >= 1 && size <= 10'000'000) ||
                      ((kind == 'i' || kind == 'u') && (size == 1 || size == 2 || size == 4 || size == 8));
    if (!good) unknown();
    header.type = {kind, static_cast<int>(kind == 'U' ? 4 * size : size)};
  }

  std::string_view rest_;
  const std::string& where_;
};

/// Bytes of the data, without overflow.
std::size_t data_bytes(const NpyHeader& header, const std::string& where) {
  std::size_t bytes = static_cast<std::size_t>(header.type.size);
  bool empty = bytes == 0;
  for (const std::size_t extent : header.shape) empty = empty || extent == 0;
  if (empty) return 0;
  for (const std::size_t extent : header.shape) {
    if (__builtin_mul_overflow(bytes, extent, &bytes) || bytes > max_array_bytes)
      throw Error(ErrorKind::limit, fmt::format("{}: error: an array of shape {} and type {} is larger than {} bytes", where,
                                                shape_text(header.shape), header.type.name(), max_array_bytes));
  }
  return bytes;
}

}  // namespace

std::string printable(std::string_view text) {
  std::string result;
  for (const char c : text.substr(0, 80)) {
    if (c >= 32 && c < 127)
      result += c;
    else
      result += fmt::format("\\x{:02x}", static_cast<unsigned>(static_cast<unsigned char>(c)));
  }
  return text.size() > 80 ? result + "…" : result;
}

NpyHeader parse_npy_header(std::string_view file, const std::string& where) {
  constexpr std::string_view magic("\x93NUMPY", 6);
  if (!file.starts_with(magic)) refuse(where, "this is not a .npy array\n  expected the file to begin with \\x93NUMPY");
  const auto byte = [&](std::size_t i) { return static_cast<std::size_t>(static_cast<unsigned char>(file[i])); };
  if (file.size() < 12) refuse(where, "the array's header is cut short");
  const std::size_t version = byte(6);
  if (version < 1 || version > 3) refuse(where, fmt::format("version {} of the .npy format is not read\n  expected 1, 2 or 3", version));
  NpyHeader header;
  const std::size_t start = version == 1 ? 10 : 12;
  const std::size_t length = version == 1 ? byte(8) | byte(9) << 8 : byte(8) | byte(9) << 8 | byte(10) << 16 | byte(11) << 24;
  if (length > max_npy_header_bytes)
    throw Error(ErrorKind::limit,
                fmt::format("{}: error: the array's header has {} bytes, more than {}", where, length, max_npy_header_bytes));
  header.length = start + length;
  if (file.size() < header.length) refuse(where, "the array's header is cut short");
  DictionaryReader(file.substr(start, length), where).read(header);
  header.data_bytes = data_bytes(header, where);
  return header;
}

}  // namespace tofray::files
