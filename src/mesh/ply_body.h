// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstdint>
#include <string>
#include <string_view>

#include "mesh/ply_header.h"
#include "mesh/words.h"

namespace tofray::mesh {

/// The numbers behind a PLY file's header, one after the other. Text and binary data have the same functions:
///   number(type), integer(type)   the next number; pass(type) goes past it
///   length(type, item)            a list's length, which the rest of the file has room for
///   could_hold(element, polygons) whether the rest has room for its rows, lists empty but for 3 numbers in those of polygons, if any
///   fail(what, more)              @throws Error with the place of what was read last
///   finish()                      @throws Error where anything is left over
class PlyText {
 public:
  PlyText(std::string_view bytes, const PlyHeader& header, const std::string& name)
      : words_(bytes, name, Words::Style::plain, header.length, header.lines + 1) {}

  void row(const std::string&, std::uint64_t) {}  // lines say where
  double number(PlyType);
  std::int64_t integer(PlyType);
  std::uint64_t length(PlyType, PlyType);
  void pass(PlyType) { (void)word(); }
  [[nodiscard]] bool could_hold(const PlyElement& element, const PlyProperty* polygons) const;
  [[noreturn]] void fail(const std::string& what, const std::string& more) const { words_.fail(what, more); }
  void finish();

 private:
  std::string_view word();
  Words words_;
};

class PlyBinary {
 public:
  PlyBinary(std::string_view bytes, const PlyHeader& header, const std::string& name)
      : bytes_(bytes), at_(header.length), name_(name), big_endian_(header.encoding == PlyHeader::Encoding::big_endian) {}

  /// What is read now, for messages.
  void row(const std::string& element, std::uint64_t number) {
    element_ = &element;
    row_ = number;
  }
  double number(PlyType type);
  std::int64_t integer(PlyType type);
  std::uint64_t length(PlyType type, PlyType item);
  void pass(PlyType type) { (void)take(size_of(type)); }
  [[nodiscard]] bool could_hold(const PlyElement& element, const PlyProperty* polygons) const;
  [[noreturn]] void fail(const std::string& what, const std::string& more) const;
  void finish() const;

 private:
  const char* take(std::size_t size);
  std::string_view bytes_;
  std::size_t at_, last_ = 0;
  const std::string& name_;
  bool big_endian_;
  const std::string* element_ = nullptr;
  std::uint64_t row_ = 0;
};

}  // namespace tofray::mesh
