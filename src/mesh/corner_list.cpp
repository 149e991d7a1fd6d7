// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include "mesh/corner_list.h"

#include <fmt/core.h>

#include <algorithm>
#include <bit>

#include "mesh/shared_keys.h"

namespace tofray::mesh {

void CornerList::keep(const std::string& fault, const std::string& more, const Words& words) {
  if (!fault_.empty()) return;
  fault_ = fmt::format("a face has {} {}", what_, fault), more_ = more, fault_mark_ = words.mark();
}

std::int32_t CornerList::place_of(std::int64_t index, std::size_t so_far, const Words& words) {
  const auto count = static_cast<std::int64_t>(so_far);
  if (index == 0) keep("of index 0", "expected 1 for the first one, or -1 for the last one so far", words);
  if (index < -count) keep("before the first one", fmt::format("got {} after {}", index, count), words);
  if (index == 0 || index < -count) return -1;
  if (index < 0) return static_cast<std::int32_t>(count + index);
  if (index > static_cast<std::int64_t>(MeshBuilder::most_vertices)) {
    keep("beyond the last one", fmt::format("got {}", index), words);
    return -1;
  }
  if (index > largest_) largest_ = index, largest_mark_ = words.mark();  // they may stand behind the faces that use them
  return static_cast<std::int32_t>(index - 1);
}

void CornerList::add(const Corners& corners, std::size_t triangles) {
  if (std::all_of(corners.begin(), corners.end(), [](std::int32_t i) { return i < 0; })) return;
  corners_.resize(triangles - 1, {-1, -1, -1});
  corners_.push_back(corners);
}

void CornerList::replace(std::size_t first, std::size_t corners, const std::vector<Corners>& triangles) {
  if (first >= corners_.size()) return;
  corners_.resize(std::max(corners_.size(), first + triangles.size()), {-1, -1, -1});
  replace_fan(corners_, first, corners, triangles);
}

void CornerList::check(std::size_t count, const Words& words) const {
  if (count == 0) return;
  if (!fault_.empty()) words.fail(fault_mark_, fault_, more_);
  if (largest_ > static_cast<std::int64_t>(count))
    words.fail(largest_mark_, fmt::format("a face has {} beyond the last one", what_),
               fmt::format("got {}, the file has {}", largest_, count));
}

namespace {

using Normal = std::array<float, 3>;
using Texcoord = std::array<float, 2>;

/// What corner k of a triangle names; 0 where it names nothing.
template <class Row>
Row row_of(const std::vector<Row>& rows, const CornerList& list, std::size_t triangle, std::size_t k) {
  Row out{};
  if (rows.empty() || triangle >= list.all().size()) return out;
  const std::int32_t i = list.all()[triangle][k];
  if (i < 0) return out;
  out = rows[static_cast<std::size_t>(i)];
  for (float& number : out) number += 0.F;  // -0 is 0
  return out;
}

class Splitter {
 public:
  Splitter(MeshBuilder& builder, bool normals, bool texcoords)
      : builder_(builder), mesh_(builder.so_far().mesh), own_(mesh_.vertices.size()), is_given_(own_) {
    if (normals) mesh_.normals.resize(own_);
    if (texcoords) mesh_.texcoords.resize(own_);
    if (!mesh_.shades.empty()) mesh_.shades.resize(own_, 1);
  }

  /// The vertex for a corner at `vertex`, which is the file's.
  std::int32_t vertex_of(std::int32_t vertex, const Normal& normal, const Texcoord& texcoord) {
    const auto at = static_cast<std::size_t>(vertex);
    if (!is_given_[at]) {
      is_given_[at] = true;
      if (!mesh_.normals.empty()) mesh_.normals[at] = normal;
      if (!mesh_.texcoords.empty()) mesh_.texcoords[at] = texcoord;
      return vertex;
    }
    const Key key = key_of(vertex, normal, texcoord);
    if (key_at(at, vertex) == key) return vertex;
    const auto of_number = [this](std::int32_t i) {
      return key_at(own_ + static_cast<std::size_t>(i), origin_[static_cast<std::size_t>(i)]);
    };
    std::int32_t number = keys_.find(key, of_number);
    if (number < 0) {
      number = keys_.add(key, of_number);
      const Normal position = mesh_.vertices[at];
      builder_.vertex(position);
      origin_.push_back(vertex);
      if (!mesh_.shades.empty()) mesh_.shades.push_back(mesh_.shades[at]);
      if (!mesh_.normals.empty()) mesh_.normals.push_back(normal);
      if (!mesh_.texcoords.empty()) mesh_.texcoords.push_back(texcoord);
    }
    return static_cast<std::int32_t>(own_) + number;
  }

 private:
  using Key = SharedKeys<6>::Key;
  static Key key_of(std::int32_t vertex, const Normal& n, const Texcoord& t) {
    const auto bits = [](float x) { return std::bit_cast<std::uint32_t>(x); };
    return {static_cast<std::uint32_t>(vertex), bits(n[0]), bits(n[1]), bits(n[2]), bits(t[0]), bits(t[1])};
  }
  /// @param i  a vertex of the mesh
  [[nodiscard]] Key key_at(std::size_t i, std::int32_t origin) const {
    return key_of(origin, mesh_.normals.empty() ? Normal{} : mesh_.normals[i], mesh_.texcoords.empty() ? Texcoord{} : mesh_.texcoords[i]);
  }

  MeshBuilder& builder_;
  TriangleMesh& mesh_;
  std::size_t own_;                   ///< vertices of the file
  std::vector<bool> is_given_;        ///< of those, by a corner before
  std::vector<std::int32_t> origin_;  ///< of each further one: the file's vertex
  SharedKeys<6> keys_;
};

}  // namespace

void give_details(const std::vector<Normal>& normals, const CornerList& of_normals, const std::vector<Texcoord>& texcoords,
                  const CornerList& of_texcoords, MeshBuilder& mesh) {
  const bool has_normals = !normals.empty() && !of_normals.all().empty(), has_texcoords = !texcoords.empty() && !of_texcoords.all().empty();
  if (!has_normals && !has_texcoords) return;
  Splitter splitter(mesh, has_normals, has_texcoords);
  TriangleMesh& out = mesh.so_far().mesh;
  for (std::size_t i = 0; i < out.triangles.size(); ++i)
    for (std::size_t k = 0; k < 3; ++k) {
      std::int32_t& corner = out.triangles[i][k];
      // (A vertex that has its own normal already keeps it.)
      const bool own = !has_normals && !out.normals.empty();
      const Normal normal = own ? out.normals[static_cast<std::size_t>(corner)] : row_of(normals, of_normals, i, k);
      corner = splitter.vertex_of(corner, normal, row_of(texcoords, of_texcoords, i, k));
    }
}

void give_shades(const std::vector<float>& shades, MeshBuilder& builder) {
  if (shades.empty()) return;
  TriangleMesh& mesh = builder.so_far().mesh;
  const std::size_t own = mesh.vertices.size();
  mesh.shades.assign(own, -1);  // of no triangle yet
  std::vector<std::int32_t> origin;
  SharedKeys<2> keys;
  const auto key_of = [](std::int32_t vertex, float shade) {
    return SharedKeys<2>::Key{static_cast<std::uint32_t>(vertex), std::bit_cast<std::uint32_t>(shade)};
  };
  const auto key_of_number = [&](std::int32_t i) {
    return key_of(origin[static_cast<std::size_t>(i)], mesh.shades[own + static_cast<std::size_t>(i)]);
  };
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i)
    for (std::int32_t& corner : mesh.triangles[i]) {
      const float shade = i < shades.size() ? shades[i] : 1;
      const auto at = static_cast<std::size_t>(corner);
      if (mesh.shades[at] < 0) mesh.shades[at] = shade;
      if (std::bit_cast<std::uint32_t>(mesh.shades[at]) == std::bit_cast<std::uint32_t>(shade)) continue;
      std::int32_t number = keys.find(key_of(corner, shade), key_of_number);
      if (number < 0) {
        const std::array<float, 3> position = mesh.vertices[at];
        builder.vertex(position);
        number = keys.add(key_of(corner, shade), key_of_number);
        origin.push_back(corner);
        mesh.shades.push_back(shade);
        if (!mesh.normals.empty()) mesh.normals.emplace_back(mesh.normals[at]);
        if (!mesh.texcoords.empty()) mesh.texcoords.emplace_back(mesh.texcoords[at]);
      }
      corner = static_cast<std::int32_t>(own) + number;
    }
  for (float& shade : mesh.shades) shade = std::max(shade, 0.F);
}

}  // namespace tofray::mesh
