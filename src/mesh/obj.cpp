// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
// Wavefront OBJ: vertices (v) and polygons (f). Normals, textures, groups and materials are read past: a scene's material is the object's.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <iterator>

#include "base/text.h"
#include "mesh/formats.h"
#include "mesh/mesh_builder.h"
#include "mesh/numbers.h"
#include "mesh/words.h"

namespace tofray::mesh {
namespace {

using base::in_quotes;

constexpr std::string_view read_past[] = {"vt",     "vn",     "o",      "g",   "s",     "mg",       "l",        "p",          "usemtl",
                                          "usemap", "mtllib", "maplib", "lod", "bevel", "c_interp", "d_interp", "shadow_obj", "trace_obj"};
/// Curves and surfaces, and how they are to be divided.
constexpr std::string_view free_form[] = {"vp",   "cstype", "deg", "bmat", "step", "curv", "curv2", "surf", "parm", "trim",  "hole",
                                          "scrv", "sp",     "end", "con",  "bsp",  "bzp",  "cdc",   "cdp",  "res",  "stech", "ctech"};
constexpr std::string_view from_elsewhere[] = {"call", "csh"};

template <std::size_t n>
bool is_one_of(const std::string_view (&words)[n], std::string_view word) {
  return std::find(std::begin(words), std::end(words), word) != std::end(words);
}

class ObjReader {
 public:
  ObjReader(std::string_view bytes, const std::string& name) : words_(bytes, name, Words::Style::obj), mesh_(name) {}

  ReadMesh read() {
    do {
      std::string_view keyword;
      if (!words_.in_line(keyword)) continue;
      if (keyword == "v")
        read_vertex();
      else if (keyword == "f" || keyword == "fo")
        read_face();
      else if (!is_one_of(read_past, keyword))
        refuse_keyword(keyword);
    } while (words_.next_line());
    if (largest_ > static_cast<std::int64_t>(mesh_.vertices()))
      beyond(largest_mark_, fmt::format("got {}, the file has {} vertices", largest_, mesh_.vertices()));
    return mesh_.finish();
  }

 private:
  [[noreturn]] void refuse_keyword(std::string_view keyword) const {
    if (is_one_of(free_form, keyword))
      words_.fail("curves and surfaces of free form are not read: " + in_quotes(keyword),
                  "expected polygons (v, f): have the program that wrote the file divide its surfaces into them");
    if (is_one_of(from_elsewhere, keyword))
      words_.fail("what other files or programs give is not read: " + in_quotes(keyword), "expected one file that holds the whole mesh");
    std::vector<std::string> known(std::begin(read_past), std::end(read_past));
    known.insert(known.begin(), {"v", "f"});
    words_.fail("unknown keyword " + in_quotes(keyword) + base::did_you_mean(keyword, known),
                "expected an OBJ file, whose lines begin with v, f, vt, vn, g, usemtl, …");
  }

  void read_vertex() {
    const Mark start = words_.mark();
    std::array<float, 3> position{};
    std::size_t count = 0;
    for (std::string_view word; words_.in_line(word); ++count) {
      double value = 0;
      if (!read_number(word, value))
        words_.fail("a coordinate is no number", "got " + in_quotes(word) + ", expected a number such as 0.25");
      if (count < 3) position[count] = to_float(value);
    }
    // Beside x y z there may be a weight, which polygons do not use, or a colour, or both.
    if (count != 3 && count != 4 && count != 6 && count != 7)
      words_.fail(
          start, "a vertex does not have three coordinates",
          fmt::format("got {} number{}, expected x y z, and behind them a weight or a colour at most", count, count == 1 ? "" : "s"));
    mesh_.vertex(position);
  }

  void read_face() {
    const Mark start = words_.mark();
    std::int32_t first = 0, before = 0;
    std::size_t count = 0;
    for (std::string_view word; words_.in_line(word); ++count) {
      const std::int32_t corner = read_corner(word);
      if (count == 0) first = corner;
      if (count >= 2) mesh_.triangle(first, before, corner);
      before = corner;
    }
    if (count < 3) words_.fail(start, "a face has fewer than 3 corners", fmt::format("got {}, expected 3 or more", count));
  }

  /// 7, 7/1, 7//1 or 7/1/1, of which the first counts; below 0 from the last vertex so far, which is -1.
  std::int32_t read_corner(std::string_view word) {
    std::int64_t index = 0, unused = 0;
    std::size_t parts = 0;
    bool good = true;
    for (std::size_t from = 0; from <= word.size() && good; ++parts) {
      const std::size_t end = std::min(word.find('/', from), word.size());
      const std::string_view part = word.substr(from, end - from);
      good = parts < 3 && ((parts > 0 && part.empty()) || read_integer(part, parts == 0 ? index : unused));
      from = end + 1;
    }
    if (!good)
      words_.fail("the corner of a face is no index",
                  "got " + in_quotes(word) + ", expected a whole number such as 7, or with others behind it: 7/1, 7//1, 7/1/1");
    return checked(index);
  }

  std::int32_t checked(std::int64_t index) {
    const auto so_far = static_cast<std::int64_t>(mesh_.vertices());
    if (index == 0) words_.fail("a face has a corner of index 0", "expected 1 for the first vertex, or -1 for the last one so far");
    if (index < -so_far) words_.fail("a face has a corner before the first vertex", fmt::format("got {} after {} vertices", index, so_far));
    if (index < 0) return static_cast<std::int32_t>(so_far + index);
    if (index > static_cast<std::int64_t>(MeshBuilder::most_vertices)) beyond(words_.mark(), fmt::format("got {}", index));
    // Vertices may stand behind the faces that use them.
    if (index > largest_) {
      largest_ = index;
      largest_mark_ = words_.mark();
    }
    return static_cast<std::int32_t>(index - 1);
  }

  [[noreturn]] void beyond(const Mark& mark, const std::string& got) const {
    words_.fail(mark, "a face has a corner beyond the last vertex", got);
  }

  Words words_;
  MeshBuilder mesh_;
  std::int64_t largest_ = 0;
  Mark largest_mark_;
};

}  // namespace

ReadMesh parse_obj(std::string_view bytes, const std::string& name) { return ObjReader(bytes, name).read(); }

}  // namespace tofray::mesh
