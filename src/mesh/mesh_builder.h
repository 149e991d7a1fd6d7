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
    if (material_ >= 0 || !read_.material_of.empty()) note_material();
  }
  /// Of the triangles that follow: an index of ReadMesh::materials, -1: none.
  void wear(std::int32_t material) { material_ = material; }
  /// Of the vertex that came last, in the file's own form; each vertex has some, or none has.
  void normal(const std::array<float, 3>& direction) { read_.mesh.normals.push_back(unit_normal(direction)); }
  void texcoord(float u, float v) { read_.mesh.texcoords.push_back(place_in_picture(u, v)); }
  /// Its colour, 0…1 as programs show it (sRGB): how bright it is. Vertices before the first one with a colour, and others without, are
  /// white.
  void color(const std::array<double, 3>& red_green_blue);
  /// Its luminance; counted where it is beyond 0…1.
  float shade_of(const std::array<double, 3>& red_green_blue);

  /// The direction in unit length; 0 where there is none, and counted where it is not finite.
  std::array<float, 3> unit_normal(const std::array<float, 3>& direction);
  /// (u, v) with v downward; 0 and counted where they are not finite, or beyond what a mesh may have.
  std::array<float, 2> place_in_picture(float u, float v);

  /// A triangle that the reader drops: a corner is not finite.
  void drop_triangle() { ++read_.not_finite; }

  /// What there is so far; who changes it keeps to the limits.
  [[nodiscard]] ReadMesh& so_far() { return read_; }
  [[nodiscard]] std::size_t vertices() const { return read_.mesh.vertices.size(); }
  [[nodiscard]] const std::array<float, 3>& position(std::int32_t vertex) const {
    return read_.mesh.vertices[static_cast<std::size_t>(vertex)];
  }

  /// Without the vertices that are not finite and the triangles at them, nor normals that are all 0. @throws Error (bad_input) where no triangle is left
  ReadMesh finish();

  static constexpr auto most_vertices = static_cast<std::size_t>(base::limit::mesh_vertices.value);
  static constexpr auto most_triangles = static_cast<std::size_t>(base::limit::mesh_triangles.value);

 private:
  [[noreturn]] void too_many_vertices() const;
  [[noreturn]] void too_many_triangles() const;
  void note_material();
  void drop_not_finite();
  void tell_of_mended();

  const std::string& name_;
  ReadMesh read_;
  std::int32_t material_ = -1;
  std::size_t mended_normals_ = 0, mended_texcoords_ = 0, mended_colors_ = 0;
};

}  // namespace tofray::mesh
