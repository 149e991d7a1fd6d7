// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
// PLY: x, y, z of the element vertex, its normal (nx, ny, nz) and texture coordinates (s, t; u, v; texture_u, texture_v), and lists of
// vertices: polygons in the element face, strips in tristrips; and colours of vertices or faces (red, green, blue; diffuse_red, …; r, g, b).
// Of faces also the corners' texture coordinates (list texcoord), and which picture they wear (texnumber). All else is read past.
#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <initializer_list>
#include <map>
#include <memory>

#include "base/faults.h"
#include "base/text.h"
#include "mesh/corner_list.h"
#include "mesh/formats.h"
#include "mesh/mesh_builder.h"
#include "mesh/numbers.h"
#include "mesh/ply_body.h"
#include "mesh/ply_header.h"
#include "mesh/polygons.h"

namespace tofray::mesh {
namespace {

using base::in_quotes;

std::string property_names(const PlyElement& element) {
  std::vector<std::string> names;
  for (const PlyProperty& property : element.properties) names.push_back((property.list ? "list " : "") + in_quotes(property.name));
  return names.empty() ? std::string("none") : base::listed(names, "and");
}

template <class Body>
class PlyReader {
 public:
  PlyReader(std::string_view bytes, const PlyHeader& header, const std::string& name)
      : header_(header), name_(name), body_(bytes, header, name), mesh_(name) {}

  ReadMesh read() {
    const PlyElement* vertex = header_.find("vertex");
    if (vertex == nullptr) base::fail(base::whole(name_), "the header has no element \"vertex\"", "expected one with x, y and z");
    vertices_ = vertex->count;
    for (const PlyElement& element : header_.elements) {
      if (element.properties.empty() && element.name != "vertex") continue;
      if (element.name == "vertex")
        read_vertices(element);
      else if (element.name == "face")
        read_faces(element);
      else if (element.name == "tristrips")
        read_strips(element);
      else
        read_past(element);
    }
    body_.finish();
    polygons_.divide(mesh_.so_far().mesh, {&of_texcoords_}, mesh_.so_far().notices);
    // Those of corners say more: a seam has two.
    give_details({}, CornerList("a normal"), texcoords_, of_texcoords_, mesh_);
    // Colours of vertices say more: they vary across a face.
    if (!has_colors_) give_shades(shades_, mesh_);
    if (has_texcoords_ || !texcoords_.empty()) wear_pictures();
    return mesh_.finish();
  }

 private:
  [[noreturn]] void fail_at(const Mark& mark, const std::string& what, const std::string& more) const {
    base::fail({std::make_shared<const std::string>(name_), static_cast<int>(mark.line), static_cast<int>(mark.column)}, what, more);
  }
  [[noreturn]] void fail_at(const PlyElement& element, const std::string& what, const std::string& more) const {
    fail_at(element.mark, what, more);
  }

  void check_room(const PlyElement& element, const PlyProperty* polygons = nullptr) const {
    if (!body_.could_hold(element, polygons))
      fail_at(element, "the file is too short for element " + in_quotes(element.name),
              fmt::format("got {} as the number of rows", element.count));
  }

  void pass(const PlyProperty& property) {
    std::uint64_t count = property.list ? body_.length(property.count, property.type) : 1;
    for (; count > 0; --count) body_.pass(property.type);
  }

  void read_past(const PlyElement& element) {
    check_room(element);
    for (std::uint64_t row = 0; row < element.count; ++row) {
      body_.row(element.name, row);
      for (const PlyProperty& property : element.properties) pass(property);
    }
  }

  /// For each property which number of a vertex it is: 0 to 2 of its place, 3 to 5 of its normal, 6 and 7 of its texture coordinates, 8 to
  /// 10 of its colour; else -1.
  using Columns = std::vector<int>;

  /// @throws Error where it comes twice
  std::size_t find(const PlyElement& element, std::string_view name) const {
    const auto is_it = [&](const PlyProperty& property) { return property.name == name && !property.list; };
    const auto at = std::find_if(element.properties.begin(), element.properties.end(), is_it);
    if (at == element.properties.end()) return element.properties.size();
    if (const auto again = std::find_if(at + 1, element.properties.end(), is_it); again != element.properties.end())
      fail_at(again->mark, "property " + in_quotes(name) + " comes twice", "expected one of this name, which is read");
    return static_cast<std::size_t>(at - element.properties.begin());
  }

  /// Takes the columns of these names, if all are there.
  bool take(const PlyElement& element, std::initializer_list<std::string_view> names, int first, Columns& columns) const {
    const auto is_there = [&](std::string_view name) { return find(element, name) < element.properties.size(); };
    if (!std::all_of(names.begin(), names.end(), is_there)) return false;
    for (const std::string_view name : names) columns[find(element, name)] = first++;
    return true;
  }

  /// The number that stands for full colour; 0 of a type that stands for none.
  static double full(PlyType type) {
    if (type == PlyType::uint8) return 255;
    return type == PlyType::uint16 ? 65535 : is_integer(type) ? 0 : 1;
  }
  /// Takes the columns of a colour, by whichever name, if their types have a number that stands for full colour.
  bool take_color(const PlyElement& element, int first, Columns& columns) const {
    constexpr std::array<std::string_view, 3> sets[] = {
        {"red", "green", "blue"}, {"diffuse_red", "diffuse_green", "diffuse_blue"}, {"r", "g", "b"}};
    for (const auto& [red, green, blue] : sets) {
      const auto is_share = [&](std::string_view name) {
        const std::size_t at = find(element, name);
        return at < element.properties.size() && full(element.properties[at].type) > 0;
      };
      if (is_share(red) && is_share(green) && is_share(blue)) return take(element, {red, green, blue}, first, columns);
    }
    return false;
  }

  Columns columns_of(const PlyElement& element) {
    Columns columns(element.properties.size(), -1);
    for (const char* const axis : {"x", "y", "z"})
      if (find(element, axis) == element.properties.size())
        fail_at(element, fmt::format("the vertices have no {}", axis),
                "got " + property_names(element) + ", expected x, y and z, each a number");
    take(element, {"x", "y", "z"}, 0, columns);
    has_normals_ = take(element, {"nx", "ny", "nz"}, 3, columns);
    has_texcoords_ = take(element, {"s", "t"}, 6, columns) || take(element, {"u", "v"}, 6, columns) ||
                     take(element, {"texture_u", "texture_v"}, 6, columns);
    has_colors_ = take_color(element, 8, columns);
    return columns;
  }

  void read_vertices(const PlyElement& element) {
    const Columns columns = columns_of(element);
    check_room(element);
    mesh_.expect_vertices(element.count);
    for (std::uint64_t row = 0; row < element.count; ++row) {
      body_.row(element.name, row);
      std::array<float, 8> number{};
      std::array<double, 3> color{};
      for (std::size_t i = 0; i < columns.size(); ++i) {
        if (columns[i] < 0)
          pass(element.properties[i]);
        else if (columns[i] < 8)
          number[static_cast<std::size_t>(columns[i])] = to_float(body_.number(element.properties[i].type));
        else
          color[static_cast<std::size_t>(columns[i] - 8)] = share(element.properties[i]);
      }
      mesh_.vertex({number[0], number[1], number[2]});
      if (has_normals_) mesh_.normal({number[3], number[4], number[5]});
      if (has_texcoords_) mesh_.texcoord(number[6], number[7]);
      if (has_colors_) mesh_.color(color);
    }
  }

  const PlyProperty& indices_of(const PlyElement& element) const {
    const PlyProperty* found = nullptr;
    for (const PlyProperty& property : element.properties) {
      if (property.name != "vertex_indices" && property.name != "vertex_index") continue;
      if (!property.list || !is_integer(property.type))
        fail_at(element, fmt::format("{} of {} is no list of whole numbers", property.name, in_quotes(element.name)),
                "expected property list uchar int vertex_indices");
      if (found != nullptr && found->name == property.name)
        fail_at(property.mark, "property " + in_quotes(property.name) + " comes twice", "expected one of this name, which is read");
      if (found != nullptr) fail_at(element, in_quotes(element.name) + " has both vertex_indices and vertex_index", "expected one of them");
      found = &property;
    }
    if (found == nullptr)
      fail_at(element, in_quotes(element.name) + " has no list vertex_indices",
              "got " + property_names(element) + ", expected property list uchar int vertex_indices");
    return *found;
  }

  std::int32_t checked(std::int64_t index) const {
    if (index < 0 || static_cast<std::uint64_t>(index) >= vertices_)
      body_.fail("an index is none of a vertex",
                 fmt::format("got {}, and there are {} vertices, of which the first is 0", index, vertices_));
    return static_cast<std::int32_t>(index);
  }

  /// A material for each picture, by the name of its file.
  void wear_pictures() {
    ReadMesh& mesh = mesh_.so_far();
    const auto file = std::make_shared<const std::string>(name_);
    std::map<std::string, std::int32_t> places;
    std::vector<std::int32_t> place_of;
    for (const PlyHeader::Picture& picture : header_.pictures) {
      const auto [place, is_new] = places.try_emplace(picture.file, static_cast<std::int32_t>(mesh.materials.size()));
      if (is_new) {
        mesh.materials.push_back(picture.file);
        mesh.pictures.push_back({picture.file, {file, static_cast<int>(picture.mark.line), static_cast<int>(picture.mark.column)}});
      }
      place_of.push_back(place->second);
    }
    if (place_of.empty()) return;
    numbers_.resize(mesh.mesh.triangles.size(), 0);
    for (const std::int64_t number : numbers_)
      mesh.material_of.push_back(
          number >= 0 && number < static_cast<std::int64_t>(place_of.size()) ? place_of[static_cast<std::size_t>(number)] : -1);
  }

  double share(const PlyProperty& property) { return body_.number(property.type) / full(property.type); }

  /// A row whose lists of vertices `read_list` takes.
  /// @param columns  0 to 2: of the row's colour; 3: its corners' texture coordinates; 4: the number of its picture; else -1
  template <class ReadList>
  void read_rows(const PlyElement& element, const PlyProperty& indices, const Columns& columns, const ReadList& read_list) {
    const bool colored = std::find(columns.begin(), columns.end(), 0) != columns.end();
    for (std::uint64_t row = 0; row < element.count; ++row) {
      body_.row(element.name, row);
      std::array<double, 3> color{};
      const std::size_t first = mesh_.so_far().mesh.triangles.size(), first_texcoord = texcoords_.size();
      std::int64_t number = 0;
      for (std::size_t i = 0; i < element.properties.size(); ++i) {
        const PlyProperty& property = element.properties[i];
        if (&property == &indices)
          read_list(body_.length(property.count, property.type), property.type);
        else if (columns[i] == 3)
          read_texcoords(property);
        else if (columns[i] == 4)
          number = body_.integer(property.type);
        else if (columns[i] >= 0)
          color[static_cast<std::size_t>(columns[i])] = share(property);
        else
          pass(property);
      }
      if (colored) shades_.resize(mesh_.so_far().mesh.triangles.size(), mesh_.shade_of(color));
      if (texcoords_.size() > first_texcoord) give_texcoords(first, first_texcoord);
      if (number != 0) numbers_.resize(first, 0), numbers_.resize(mesh_.so_far().mesh.triangles.size(), number);
    }
  }

  /// u, v of each corner.
  void read_texcoords(const PlyProperty& property) {
    const std::uint64_t length = body_.length(property.count, property.type);
    if (length % 2 != 0)
      body_.fail("the texture coordinates of a face are an odd number", fmt::format("got {}, expected u, v of each corner", length));
    if (texcoords_.size() + length / 2 > MeshBuilder::most_vertices)
      base::fail(base::whole(name_), fmt::format("the file has more than {} texture coordinates", MeshBuilder::most_vertices),
                 "(`tofray --limits`)", ErrorKind::limit);
    for (std::uint64_t i = 0; i < length; i += 2) {
      const float u = to_float(body_.number(property.type));
      texcoords_.push_back(mesh_.place_in_picture(u, to_float(body_.number(property.type))));
    }
  }
  /// To the fan of a face's triangles.
  void give_texcoords(std::size_t first, std::size_t first_texcoord) {
    const std::size_t triangles = mesh_.so_far().mesh.triangles.size() - first, corners = texcoords_.size() - first_texcoord;
    if (corners != triangles + 2)
      body_.fail("a face has not as many texture coordinates as corners", fmt::format("got {} of {}", corners, triangles + 2));
    const auto at = static_cast<std::int32_t>(first_texcoord);
    for (std::size_t i = 0; i < triangles; ++i) {
      const auto corner = at + static_cast<std::int32_t>(i);
      of_texcoords_.add({at, corner + 1, corner + 2}, first + i + 1);
    }
  }

  void read_faces(const PlyElement& element) {
    const PlyProperty& indices = indices_of(element);
    check_room(element, &indices);
    mesh_.expect_triangles(element.count);
    Columns columns(element.properties.size(), -1);
    take_color(element, 0, columns);
    for (std::size_t i = 0; i < element.properties.size(); ++i) {
      const PlyProperty& property = element.properties[i];
      if (property.list && property.name == "texcoord" && !is_integer(property.type)) columns[i] = 3;
      if (!property.list && property.name == "texnumber" && is_integer(property.type)) columns[i] = 4;
    }
    read_rows(element, indices, columns, [this](std::uint64_t length, PlyType type) { read_polygon(length, type); });
  }

  void read_polygon(std::uint64_t length, PlyType type) {
    if (length < 3) body_.fail("a face has fewer than 3 corners", fmt::format("got {}, expected 3 or more", length));
    const std::int32_t first = checked(body_.integer(type));
    std::int32_t before = checked(body_.integer(type));
    for (std::uint64_t i = 2; i < length; ++i) {
      const std::int32_t corner = checked(body_.integer(type));
      mesh_.triangle(first, before, corner);
      before = corner;
    }
    polygons_.add(length, mesh_.so_far().mesh.triangles.size());
  }

  void read_strips(const PlyElement& element) {
    const PlyProperty& indices = indices_of(element);
    check_room(element);
    const Columns none(element.properties.size(), -1);
    read_rows(element, indices, none, [this](std::uint64_t length, PlyType type) { read_strip(length, type); });
  }

  /// Each three that follow each other are a triangle, every other one turned round; -1 begins anew. Where two of the three are the same
  /// vertex the strip only goes on elsewhere.
  void read_strip(std::uint64_t length, PlyType type) {
    std::int32_t a = 0, b = 0;
    for (std::uint64_t i = 0, have = 0; i < length; ++i) {
      const std::int64_t index = body_.integer(type);
      if (index == -1) {
        have = 0;
        continue;
      }
      const std::int32_t c = checked(index);
      if (have >= 2 && a != b && b != c && a != c) have % 2 == 0 ? mesh_.triangle(a, b, c) : mesh_.triangle(b, a, c);
      a = b, b = c;
      ++have;
    }
  }

  const PlyHeader& header_;
  const std::string& name_;
  Body body_;
  MeshBuilder mesh_;
  Polygons polygons_;
  std::vector<float> shades_;                    ///< of each triangle, where faces have colours
  std::vector<std::array<float, 2>> texcoords_;  ///< of corners, where faces have lists of them
  CornerList of_texcoords_{"a texture coordinate"};
  std::vector<std::int64_t> numbers_;  ///< of each triangle, the picture that its face names; those behind have 0
  std::uint64_t vertices_ = 0;
  bool has_normals_ = false, has_texcoords_ = false, has_colors_ = false;
};

}  // namespace

ReadMesh parse_ply(std::string_view bytes, const std::string& name) {
  const PlyHeader header = parse_ply_header(bytes, name);
  if (header.encoding == PlyHeader::Encoding::ascii) return PlyReader<PlyText>(bytes, header, name).read();
  return PlyReader<PlyBinary>(bytes, header, name).read();
}

}  // namespace tofray::mesh
