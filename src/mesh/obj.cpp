// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
// Wavefront OBJ: vertices (v), their normals (vn) and texture coordinates (vt), polygons (f), and the materials they wear (mtllib, usemtl).
// Groups, lines and points are read past.
#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <iterator>
#include <limits>
#include <map>
#include <memory>
#include <utility>

#include "base/limits.h"
#include "base/text.h"
#include "mesh/corner_list.h"
#include "mesh/formats.h"
#include "mesh/mesh_builder.h"
#include "mesh/numbers.h"
#include "mesh/polygons.h"
#include "mesh/words.h"

namespace tofray::mesh {
namespace {

using base::in_quotes;

constexpr std::string_view read_past[] = {"o",      "g",   "s",     "mg",       "l",        "p",          "usemap",
                                          "maplib", "lod", "bevel", "c_interp", "d_interp", "shadow_obj", "trace_obj"};
/// Curves and surfaces, and how they are to be divided.
constexpr std::string_view free_form[] = {"vp",   "cstype", "deg", "bmat", "step", "curv", "curv2", "surf", "parm", "trim",  "hole",
                                          "scrv", "sp",     "end", "con",  "bsp",  "bzp",  "cdc",   "cdp",  "res",  "stech", "ctech"};
constexpr std::string_view from_elsewhere[] = {"call", "csh"};

template <std::size_t n>
bool is_one_of(const std::string_view (&words)[n], std::string_view word) {
  return std::find(std::begin(words), std::end(words), word) != std::end(words);
}

/// What stands in quotation marks.
std::vector<std::string> in_quotation_marks(const std::string& text) {
  std::vector<std::string> out;
  for (std::size_t from = text.find('"'); from != std::string::npos;) {
    const std::size_t end = std::min(text.find('"', from + 1), text.size());
    if (end > from + 1) out.push_back(text.substr(from + 1, end - from - 1));
    from = end < text.size() ? text.find('"', end + 1) : std::string::npos;
  }
  return out;
}

/// The files that lines "mtllib" name. A name may have blanks: it goes on until it ends in .mtl, or the line ends.
class Libraries {
 public:
  explicit Libraries(const std::string& name) : name_(std::make_shared<const std::string>(name)) {}

  /// Behind the keyword.
  void read_line(Words& words) {
    Mark mark;
    std::string file;
    Words ahead = words;
    if (std::string_view first; ahead.in_line(first) && first.starts_with('"')) {
      mark = ahead.mark();
      for (const std::string& one : in_quotation_marks(words.rest_of_line())) add(one, mark, words);
      return;
    }
    for (std::string_view word; words.in_line(word);) {
      if (file.empty()) mark = words.mark();
      file += (file.empty() ? "" : " ") + std::string(word);
      if (suffix_of(std::string(word)) != ".mtl") continue;
      add(file, mark, words);
      file.clear();
    }
    if (!file.empty()) add(file, mark, words);
  }
  std::vector<Reference> all;

 private:
  void add(const std::string& file, const Mark& mark, const Words& words) {
    if (std::any_of(all.begin(), all.end(), [&](const Reference& one) { return one.file == file; })) return;
    constexpr auto most = static_cast<std::size_t>(base::limit::mtl_files.value);
    if (all.size() == most)
      words.fail(mark, fmt::format("the file names more than {} files of materials", most), "(`tofray --limits`)", ErrorKind::limit);
    all.push_back({file, words.place(mark, name_)});
  }
  std::shared_ptr<const std::string> name_;
};

/// A corner of a face: places among the file's vertices, texture coordinates and normals, -1 where it names none.
struct ObjCorner {
  std::int32_t vertex = 0, texcoord = -1, normal = -1;
};

class ObjReader {
 public:
  ObjReader(std::string_view bytes, const std::string& name) : words_(bytes, name, Words::Style::obj), mesh_(name), libraries_(name) {}

  ReadMesh read() {
    do {
      std::string_view keyword;
      if (!words_.in_line(keyword)) continue;
      if (keyword == "v")
        read_vertex();
      else if (keyword == "f" || keyword == "fo")
        read_face();
      else if (keyword == "vn")
        read_normal();
      else if (keyword == "vt")
        read_texcoord();
      else if (keyword == "mtllib")
        libraries_.read_line(words_);
      else if (keyword == "usemtl")
        read_material();
      else if (!is_one_of(read_past, keyword))
        pass_unknown(keyword);
    } while (words_.next_line());
    if (!free_form_.empty()) tell_of_free_form();
    if (unknown_ > 0) tell_of_unknown();
    if (largest_ > static_cast<std::int64_t>(mesh_.vertices()))
      beyond(largest_mark_, fmt::format("got {}, the file has {} vertices", largest_, mesh_.vertices()));
    of_normals_.check(normals_.size(), words_);
    of_texcoords_.check(texcoords_.size(), words_);
    polygons_.divide(mesh_.so_far().mesh, {&of_normals_, &of_texcoords_}, mesh_.so_far().notices);
    give_details(normals_, of_normals_, texcoords_, of_texcoords_, mesh_);
    mesh_.so_far().libraries = std::move(libraries_.all);
    return mesh_.finish();
  }

 private:
  void pass_unknown(std::string_view keyword) {
    if (is_one_of(free_form, keyword)) {
      if (free_form_.empty()) free_form_mark_ = words_.mark();
      const auto known = std::find_if(free_form_.begin(), free_form_.end(), [&](const auto& one) { return one.first == keyword; });
      if (known == free_form_.end())
        free_form_.emplace_back(keyword, 1);
      else
        ++known->second;
      return;
    }
    if (is_one_of(from_elsewhere, keyword))
      words_.fail("what other files or programs give is not read: " + in_quotes(keyword), "expected one file that holds the whole mesh");
    if (unknown_++ == 0) unknown_word_ = keyword.substr(0, 100), unknown_mark_ = words_.mark();
  }

  /// What of a file is curves and surfaces is left out, where there are polygons besides: trim curves of a CAD program beside its mesh.
  void tell_of_free_form() {
    std::vector<std::string> parts;
    for (const auto& [word, times] : free_form_)
      if (word == "curv" || word == "curv2" || word == "surf")
        parts.push_back(in_quotes(word) + (times > 1 ? fmt::format(" ({} times)", times) : ""));
    if (parts.empty()) parts.push_back(in_quotes(free_form_.front().first));
    if (mesh_.so_far().mesh.triangles.empty())
      words_.fail(free_form_mark_, "curves and surfaces of free form are not read: " + base::listed(parts, "and"),
                  "expected polygons (v, f): have the program that wrote the file divide its surfaces into them");
    mesh_.so_far().notices.push_back(
        fmt::format("curves and surfaces of free form are left out: {}, from line {} on; polygons alone are seen",
                    base::listed(parts, "and"), free_form_mark_.line));
  }

  /// Programs write words of their own; where there is no mesh besides it is another kind of file.
  void tell_of_unknown() {
    std::vector<std::string> known(std::begin(read_past), std::end(read_past));
    known.insert(known.begin(), {"v", "f", "vn", "vt", "mtllib", "usemtl"});
    const std::string meant = base::did_you_mean(unknown_word_, known);
    if (mesh_.so_far().mesh.triangles.empty())
      words_.fail(unknown_mark_, "unknown keyword " + in_quotes(unknown_word_) + meant,
                  "expected an OBJ file, whose lines begin with v, f, vt, vn, g, usemtl, …");
    mesh_.so_far().notices.push_back(fmt::format("{} read past that begin{} with a word unknown in OBJ files: {} in line {}{}",
                                                 unknown_ == 1 ? "1 line is" : fmt::format("{} lines are", unknown_),
                                                 unknown_ == 1 ? "s" : "", in_quotes(unknown_word_), unknown_mark_.line, meant));
  }

  void read_vertex() {
    const Mark start = words_.mark();
    std::array<float, 3> position{};
    std::array<double, 6> numbers{};
    std::size_t count = 0;
    for (std::string_view word; words_.in_line(word); ++count) {
      double value = 0;
      if (!read_number(word, value))
        words_.fail("a coordinate is no number", "got " + in_quotes(word) + ", expected a number such as 0.25");
      if (count < 3) position[count] = to_float(value);
      if (count < numbers.size()) numbers[count] = value;
    }
    // Beside x y z there may be a weight, which polygons do not use, or a colour, or a colour and its opacity.
    if (count != 3 && count != 4 && count != 6 && count != 7)
      words_.fail(
          start, "a vertex does not have three coordinates",
          fmt::format("got {} number{}, expected x y z, and behind them a weight or a colour at most", count, count == 1 ? "" : "s"));
    mesh_.vertex(position);
    if (count >= 6) mesh_.color({numbers[3], numbers[4], numbers[5]});
  }

  /// The numbers of a line, NaN where one is none.
  std::array<float, 3> numbers_of_line(std::size_t& count) {
    std::array<float, 3> out{};
    count = 0;
    for (std::string_view word; words_.in_line(word); ++count) {
      double value = std::numeric_limits<double>::quiet_NaN();
      (void)read_number(word, value);
      if (count < 3) out[count] = to_float(value);
    }
    return out;
  }

  template <class Row>
  void check_room(const std::vector<Row>& rows, const char* what) const {
    if (rows.size() == MeshBuilder::most_vertices)
      words_.fail(fmt::format("the file has more than {} {}", rows.size(), what), "(`tofray --limits`)", ErrorKind::limit);
  }

  void read_normal() {
    check_room(normals_, "normals");
    std::size_t count = 0;
    std::array<float, 3> direction = numbers_of_line(count);
    if (count < 3) direction[2] = std::numeric_limits<float>::quiet_NaN();
    normals_.push_back(mesh_.unit_normal(direction));
  }

  void read_texcoord() {
    check_room(texcoords_, "texture coordinates");
    std::size_t count = 0;
    const auto [u, v, w] = numbers_of_line(count);
    texcoords_.push_back(mesh_.place_in_picture(count == 0 ? std::numeric_limits<float>::quiet_NaN() : u, v));
  }

  void read_material() {
    const Mark start = words_.mark();
    const std::string name = words_.rest_of_line();
    if (name.empty()) return mesh_.wear(-1);
    std::vector<std::string>& names = mesh_.so_far().materials;
    const auto [place, is_new] = materials_.try_emplace(name, static_cast<std::int32_t>(names.size()));
    constexpr auto most = static_cast<std::size_t>(base::limit::mtl_materials.value);
    if (is_new && names.size() == most)
      words_.fail(start, fmt::format("the file uses more than {} materials", most), "(`tofray --limits`)", ErrorKind::limit);
    if (is_new) names.push_back(name);
    mesh_.wear(place->second);
  }

  void read_face() {
    const Mark start = words_.mark();
    ObjCorner first, before;
    std::size_t count = 0;
    for (std::string_view word; words_.in_line(word); ++count) {
      const ObjCorner corner = read_corner(word);
      if (count == 0) first = corner;
      if (count >= 2) add_triangle(first, before, corner);
      before = corner;
    }
    polygons_.add(count, mesh_.so_far().mesh.triangles.size());
    if (count < 3) words_.fail(start, "a face has fewer than 3 corners", fmt::format("got {}, expected 3 or more", count));
  }

  void add_triangle(const ObjCorner& a, const ObjCorner& b, const ObjCorner& c) {
    mesh_.triangle(a.vertex, b.vertex, c.vertex);
    const std::size_t triangles = mesh_.so_far().mesh.triangles.size();
    of_normals_.add({a.normal, b.normal, c.normal}, triangles);
    of_texcoords_.add({a.texcoord, b.texcoord, c.texcoord}, triangles);
  }

  /// 7, 7/1, 7//1 or 7/1/1: vertex, texture coordinates, normal; below 0 from the last one so far, which is -1.
  ObjCorner read_corner(std::string_view word) {
    std::array<std::int64_t, 3> index{};
    std::array<bool, 3> is_given{};
    std::size_t parts = 0;
    bool good = true;
    for (std::size_t from = 0; from <= word.size() && good; ++parts) {
      const std::size_t end = std::min(word.find('/', from), word.size());
      const std::string_view part = word.substr(from, end - from);
      if (parts < 3) is_given[parts] = parts == 0 || !part.empty();
      good = parts < 3 && (!is_given[parts] || read_integer(part, index[parts]));
      from = end + 1;
    }
    if (!good)
      words_.fail("the corner of a face is no index",
                  "got " + in_quotes(word) + ", expected a whole number such as 7, or with others behind it: 7/1, 7//1, 7/1/1");
    return {checked(index[0]), is_given[1] ? of_texcoords_.place_of(index[1], texcoords_.size(), words_) : -1,
            is_given[2] ? of_normals_.place_of(index[2], normals_.size(), words_) : -1};
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
  Libraries libraries_;
  std::map<std::string, std::int32_t> materials_;
  std::vector<std::array<float, 3>> normals_;
  std::vector<std::array<float, 2>> texcoords_;
  Polygons polygons_;
  CornerList of_normals_{"a normal"}, of_texcoords_{"a texture coordinate"};
  std::int64_t largest_ = 0;
  std::size_t unknown_ = 0;   ///< lines
  std::string unknown_word_;  ///< of the first of them
  Mark largest_mark_, unknown_mark_, free_form_mark_;
  std::vector<std::pair<std::string, std::size_t>> free_form_;  ///< words of curves and surfaces, and in how many lines
};

}  // namespace

ReadMesh parse_obj(std::string_view bytes, const std::string& name) { return ObjReader(bytes, name).read(); }

std::vector<Reference> libraries_of_obj(std::string_view bytes, const std::string& name) {
  Words words(bytes, name, Words::Style::obj);
  Libraries libraries(name);
  do {
    std::string_view keyword;
    if (words.in_line(keyword) && keyword == "mtllib") libraries.read_line(words);
  } while (words.next_line());
  return std::move(libraries.all);
}

}  // namespace tofray::mesh
