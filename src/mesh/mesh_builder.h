// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <array>
#include <cstddef>
#include <cstdint>
#include <string>

#include "base/limits.h"
#include "mesh/read_mesh.h"

namespace tofray::mesh {

/// Takes what a reader finds, within the limits, and makes a mesh of it whose vertices are finite.
class MeshBuilder {
 public:
  explicit MeshBuilder(const std::string& name) : name_(name) {}

  /// How many there will be; the caller knows that the file is long enough. @throws Error (limit) where a limit is passed
  void expect_vertices(std::uint64_t count);
  void expect_triangles(std::uint64_t count);

  void vertex(const std::array<float, 3>& position) {
    if (read_.mesh.vertices.size() == most_vertices) too_many_vertices();
    read_.mesh.vertices.push_back(position);
  }
  /// Corners that are vertices of the mesh when it is finished: the reader has seen to it.
  void triangle(std::int32_t a, std::int32_t b, std::int32_t c) {
    if (read_.mesh.triangles.size() == most_triangles) too_many_triangles();
    read_.mesh.triangles.push_back({a, b, c});
  }
  /// A triangle that the reader drops: a corner is not finite.
  void drop_triangle() { ++read_.not_finite; }

  [[nodiscard]] std::size_t vertices() const { return read_.mesh.vertices.size(); }
  [[nodiscard]] const std::array<float, 3>& position(std::int32_t vertex) const {
    return read_.mesh.vertices[static_cast<std::size_t>(vertex)];
  }

  /// Without the vertices that are not finite and the triangles at them. @throws Error (bad_input) where no triangle is left
  ReadMesh finish();

  static constexpr auto most_vertices = static_cast<std::size_t>(base::limit::mesh_vertices.value);
  static constexpr auto most_triangles = static_cast<std::size_t>(base::limit::mesh_triangles.value);

 private:
  [[noreturn]] void too_many_vertices() const;
  [[noreturn]] void too_many_triangles() const;
  void drop_not_finite();

  const std::string& name_;
  ReadMesh read_;
};

}  // namespace tofray::mesh
