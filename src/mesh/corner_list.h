// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "mesh/fan.h"
#include "mesh/mesh_builder.h"
#include "mesh/words.h"

namespace tofray::mesh {

/// Which of an OBJ file's normals, or texture coordinates, the corners of its triangles name. A file that has none may name any: many
/// programs write the indices, but not what they are of.
class CornerList {
 public:
  /// @param what  "a normal" or "a texture coordinate", for messages
  explicit CornerList(const char* what) : what_(what) {}

  /// The place among all, or -1 where it cannot be one: check() tells.
  /// @param index   as the file has it: from 1, or below 0 from the last so far
  /// @param so_far  how many there are
  std::int32_t place_of(std::int64_t index, std::size_t so_far, const Words& words);
  /// Of the triangle that came last. @param triangles  how many there are, with it
  void add(const Corners& corners, std::size_t triangles);

  /// Divides a face anew whose triangles are a fan. @param triangles  of its corners, as many as the fan has
  void replace(std::size_t first, std::size_t corners, const std::vector<Corners>& triangles);

  /// @throws Error where the file has some, but not all that are named
  void check(std::size_t count, const Words& words) const;
  /// By triangle, -1 where a corner has none; shorter than their number where those behind have none.
  [[nodiscard]] const std::vector<Corners>& all() const { return corners_; }

 private:
  void keep(const std::string& fault, const std::string& more, const Words& words);
  const char* what_;
  std::vector<Corners> corners_;
  std::int64_t largest_ = 0;
  Mark largest_mark_, fault_mark_;
  std::string fault_, more_;  ///< the first one
};

/// Gives each vertex what its corners name. One whose corners name different things becomes several: the first corner's is in its place,
/// the others follow behind all vertices of the file.
/// @param normals    of unit length; none where it is empty: then vertices keep what they have
/// @param texcoords  likewise
void give_details(const std::vector<std::array<float, 3>>& normals, const CornerList& of_normals,
                  const std::vector<std::array<float, 2>>& texcoords, const CornerList& of_texcoords, MeshBuilder& mesh);

/// Gives each triangle its shade. A vertex whose triangles have different ones becomes several, as above.
/// @param shades  by triangle; those behind have 1. None where it is empty
void give_shades(const std::vector<float>& shades, MeshBuilder& builder);

}  // namespace tofray::mesh
