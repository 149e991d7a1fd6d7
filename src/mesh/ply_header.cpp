// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include "mesh/ply_header.h"

#include <fmt/core.h>

#include <algorithm>
#include <charconv>

#include "base/faults.h"
#include "base/text.h"

namespace tofray::mesh {
namespace {

using base::in_quotes;

/// Both names of each type, in the order of PlyType.
constexpr std::string_view type_names[][2] = {{"char", "int8"}, {"uchar", "uint8"}, {"short", "int16"},   {"ushort", "uint16"},
                                              {"int", "int32"}, {"uint", "uint32"}, {"float", "float32"}, {"double", "float64"}};

class PlyHeaderReader {
 public:
  PlyHeaderReader(std::string_view bytes, const std::string& name) : bytes_(bytes), name_(name), words_(bytes, name) {}

  PlyHeader read() {
    check_first_line();
    while (read_line()) {}
    if (!has_format_) words_.fail("the header has no line \"format\"", expected_format);
    header_.length = words_.position() + end_of_line_bytes();
    header_.lines = words_.mark().line;
    return std::move(header_);
  }

 private:
  static constexpr const char* expected_format = "expected format ascii 1.0, binary_little_endian 1.0 or binary_big_endian 1.0";

  void check_first_line() {
    std::string_view word;
    if (!words_.in_line(word) || word != "ply")
      base::fail(base::whole(name_), "this is no PLY file", "got " + in_quotes(word) + " at its beginning, expected ply");
    // Whether a binary file's data begin behind CR or behind CR LF, this line's end says.
    cr_alone_ = bytes_.substr(words_.position(), 1) == "\r" && bytes_.substr(words_.position(), 2) != "\r\n";
    end_line();
  }

  /// @return false behind end_header
  bool read_line() {
    const bool more = words_.next_line();
    if (words_.position() > max_ply_header_bytes)
      words_.fail(fmt::format("the header is longer than {} bytes", max_ply_header_bytes), "expected end_header before", ErrorKind::limit);
    if (!more) words_.fail("the header has no end", "expected end_header");
    std::string_view keyword;
    if (!words_.in_line(keyword) || keyword == "obj_info") return true;
    if (keyword == "comment") {
      std::string_view what;
      if (!words_.in_line(what) || what != "TextureFile") return true;
      const Mark mark = words_.mark();
      std::string file = words_.rest_of_line();
      if (!file.empty()) header_.pictures.push_back({std::move(file), mark});
      return true;
    }
    if (keyword == "end_header") {
      end_line();
      return false;
    }
    if (keyword == "format")
      read_format();
    else if (keyword == "element")
      read_element();
    else if (keyword == "property")
      read_property();
    else
      words_.fail("unknown keyword " + in_quotes(keyword) + " in the header",
                  "expected format, element, property, comment, obj_info or end_header");
    end_line();
    return true;
  }

  std::string_view word(const char* what) {
    std::string_view text;
    if (!words_.in_line(text)) words_.fail(fmt::format("{} is missing", what), {});
    return text;
  }

  void end_line() {
    Words ahead = words_;
    std::string_view text;
    if (ahead.in_line(text)) ahead.fail("the line goes on where it should end", "got " + in_quotes(text));
  }

  void read_format() {
    const std::string_view encoding = word("the encoding");
    if (encoding == "ascii")
      header_.encoding = PlyHeader::Encoding::ascii;
    else if (encoding == "binary_little_endian")
      header_.encoding = PlyHeader::Encoding::little_endian;
    else if (encoding == "binary_big_endian")
      header_.encoding = PlyHeader::Encoding::big_endian;
    else
      words_.fail("unknown encoding " + in_quotes(encoding), expected_format);
    const std::string_view version = word("the version");
    if (version != "1.0") words_.fail("unknown version " + in_quotes(version), expected_format);
    if (has_format_) words_.fail("the format is said twice", {});
    has_format_ = true;
  }

  void read_element() {
    PlyElement element;
    element.name = word("the element's name");
    element.mark = words_.mark();
    if (header_.find(element.name) != nullptr) words_.fail("element " + in_quotes(element.name) + " comes twice", {});
    const std::string_view count = word("the number of the element's rows");
    const auto read = std::from_chars(count.data(), count.data() + count.size(), element.count);
    if (read.ec != std::errc() || read.ptr != count.data() + count.size())
      words_.fail("the number of rows is none", "got " + in_quotes(count) + ", expected a whole number such as 8");
    header_.elements.push_back(std::move(element));
  }

  PlyType type_of(std::string_view text) {
    for (std::size_t i = 0; i < std::size(type_names); ++i)
      if (text == type_names[i][0] || text == type_names[i][1]) return static_cast<PlyType>(i);
    words_.fail("unknown type " + in_quotes(text),
                "expected char, uchar, short, ushort, int, uint, float or double, or int8, uint8, int16, uint16, int32, uint32, float32 or "
                "float64");
  }

  void read_property() {
    if (header_.elements.empty()) words_.fail("a property stands before the first element", {});
    PlyProperty property;
    std::string_view type = word("the property's type");
    if (type == "list") {
      property.list = true;
      property.count = type_of(word("the type of the list's length"));
      if (!is_integer(property.count)) words_.fail("the length of a list is no whole number", "expected an integer type such as uchar");
      type = word("the type of the list's numbers");
    }
    property.type = type_of(type);
    property.name = word("the property's name");
    property.mark = words_.mark();
    header_.elements.back().properties.push_back(std::move(property));
  }

  [[nodiscard]] std::size_t end_of_line_bytes() const {
    const std::string_view rest = bytes_.substr(words_.position());
    const std::size_t end = std::min(rest.find_first_of("\r\n"), rest.size());  // behind blanks, if any
    const bool two = rest.substr(end).starts_with("\r\n") && !cr_alone_;
    return std::min(rest.size(), end + (two ? 2 : 1));
  }

  std::string_view bytes_;
  const std::string& name_;
  Words words_;
  PlyHeader header_;
  bool has_format_ = false, cr_alone_ = false;
};

}  // namespace

const PlyElement* PlyHeader::find(std::string_view element) const {
  for (const PlyElement& one : elements)
    if (one.name == element) return &one;
  return nullptr;
}

PlyHeader parse_ply_header(std::string_view bytes, const std::string& name) { return PlyHeaderReader(bytes, name).read(); }

}  // namespace tofray::mesh
