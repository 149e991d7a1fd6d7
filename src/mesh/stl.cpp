// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
// STL: triangles by their corners, as text or binary. Normals and attributes are read past; corners at one place become one vertex.
#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "base/bytes.h"
#include "base/faults.h"
#include "base/text.h"
#include "mesh/formats.h"
#include "mesh/mesh_builder.h"
#include "mesh/numbers.h"
#include "mesh/shared_corners.h"
#include "mesh/words.h"

namespace tofray::mesh {
namespace {

constexpr std::size_t stl_header = 80, stl_start = 84, stl_record = 50;  // bytes

using Corner = std::array<float, 3>;

void add_facet(const std::array<Corner, 3>& corners, SharedCorners& shared, MeshBuilder& mesh) {
  for (const Corner& corner : corners)
    if (!std::isfinite(corner[0]) || !std::isfinite(corner[1]) || !std::isfinite(corner[2])) return mesh.drop_triangle();
  std::array<std::int32_t, 3> indices{};
  for (std::size_t k = 0; k < 3; ++k) indices[k] = shared.index_of(corners[k], mesh);
  mesh.triangle(indices[0], indices[1], indices[2]);
}

std::uint64_t facets_of_header(std::string_view bytes) { return base::read_bytes_as<std::uint32_t>(bytes.data() + stl_header); }

ReadMesh read_binary_stl(std::string_view bytes, const std::string& name) {
  MeshBuilder mesh(name);
  SharedCorners shared;
  const std::uint64_t count = facets_of_header(bytes);
  mesh.expect_triangles(count);
  for (std::uint64_t i = 0; i < count; ++i) {
    const char* record = bytes.data() + stl_start + stl_record * i;
    std::array<Corner, 3> corners{};
    for (std::size_t k = 0; k < 9; ++k) corners[k / 3][k % 3] = base::read_bytes_as<float>(record + 12 + 4 * k);  // behind the normal
    add_facet(corners, shared, mesh);
  }
  return mesh.finish();
}

class StlText {
 public:
  StlText(std::string_view bytes, const std::string& name) : words_(bytes, name), mesh_(name) {}

  ReadMesh read() {
    std::string_view word;
    for (bool first = true; words_.next(word); first = false) {
      // Some programs write a line of their own behind the last solid.
      if (!is(word, "solid") && (first || is(word, "facet"))) expected("solid", word);
      if (!is(word, "solid")) ++left_over_;
      words_.next_line();  // the rest is its name
      if (is(word, "solid")) read_solid();
    }
    if (left_over_ > 0)
      mesh_.so_far().notices.push_back(
          fmt::format("{} read past behind the last solid", left_over_ == 1 ? "1 line is" : fmt::format("{} lines are", left_over_)));
    return mesh_.finish();
  }

 private:
  static bool is(std::string_view word, std::string_view keyword) { return equals_in_any_case(word, keyword); }

  [[noreturn]] void expected(std::string_view what, std::string_view got) const {
    if (got.empty()) words_.fail("the file is cut short", fmt::format("expected {}", what));
    words_.fail(fmt::format("{} is missing", what), "got " + base::in_quotes(got));
  }

  /// "endloop", or "end loop".
  void expect_end(std::string_view keyword) {
    std::string_view word;
    words_.next(word);
    std::string_view what = word;
    if (is(word, "end")) {
      words_.next(word);
      what = word;
    } else {
      what.remove_prefix(is(word.substr(0, 3), "end") ? 3 : word.size());
    }
    if (!is(what, keyword)) expected("end" + std::string(keyword), word);
  }

  void expect(std::string_view keyword) {
    std::string_view word;
    words_.next(word);
    if (!is(word, keyword)) expected(keyword, word);
  }

  double number() {
    std::string_view word;
    double value = 0;
    if (!words_.next(word)) expected("a number", word);
    if (!read_number(word, value))
      words_.fail("a coordinate is no number", "got " + base::in_quotes(word) + ", expected a number such as 0.25");
    return value;
  }

  void read_solid() {
    for (std::string_view word;;) {
      words_.next(word);
      if (is(word, "endsolid") || is(word, "end")) break;
      if (!is(word, "facet")) expected("facet or endsolid", word);
      read_facet();
    }
    words_.next_line();
  }

  void read_facet() {
    expect("normal");
    for (int k = 0; k < 3; ++k) number();
    expect("outer");
    expect("loop");
    std::array<Corner, 3> corners{};
    for (Corner& corner : corners) {
      expect("vertex");
      for (float& coordinate : corner) coordinate = to_float(number());
    }
    expect_end("loop");
    expect_end("facet");
    add_facet(corners, shared_, mesh_);
  }

  Words words_;
  MeshBuilder mesh_;
  SharedCorners shared_;
  std::size_t left_over_ = 0;  ///< lines
};

/// Whether text is meant: "solid", and no byte 0, which the count of a binary file's triangles has and a text has not.
bool looks_like_text(std::string_view bytes) {
  const std::string_view start = bytes.substr(0, stl_start);
  const std::size_t first = std::min(start.find_first_not_of(" \t\r\n\xEF\xBB\xBF"), start.size());
  std::string word(start.substr(first, 5));
  for (char& c : word) c = static_cast<char>(c | 0x20);  // to lower case
  return word == "solid" && start.find('\0') == std::string_view::npos;
}

[[noreturn]] void refuse_size(std::string_view bytes, const std::string& name) {
  const auto here = base::whole(name);
  if (bytes.size() < stl_start)
    base::fail(
        here, "this is no STL file",
        fmt::format("got {} bytes, expected a text that begins with solid, or binary data of {} bytes and more", bytes.size(), stl_start));
  const std::uint64_t count = facets_of_header(bytes), needed = stl_start + stl_record * count;
  const std::string got = fmt::format("its header says {} triangles, which make {} bytes; it has {}", count, needed, bytes.size());
  if (needed > bytes.size()) base::fail(here, "the file is cut short, or no STL file", got);
  base::fail(here, fmt::format("{} bytes are left over behind the last triangle", bytes.size() - needed), got);
}

}  // namespace

bool is_binary_stl(std::string_view bytes) {
  return bytes.size() >= stl_start && bytes.size() == stl_start + stl_record * facets_of_header(bytes);
}

ReadMesh parse_stl(std::string_view bytes, const std::string& name) {
  // The size decides: many binary files begin with "solid", too. A text has no such bytes where the count stands.
  if (is_binary_stl(bytes)) return read_binary_stl(bytes, name);
  if (!looks_like_text(bytes)) refuse_size(bytes, name);
  return StlText(bytes, name).read();
}

}  // namespace tofray::mesh
