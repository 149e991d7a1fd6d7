// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "mesh/corner_list.h"
#include "tofray/scene.h"

namespace tofray::mesh {

/// Faces of more than three corners. A reader takes each apart as a fan at once, since vertices may stand behind the faces that use them;
/// divide() mends those that are no fans.
class Polygons {
 public:
  /// The last corners − 2 triangles are the fan of a face, each (first corner, the one before, the next one).
  /// @param triangles  how many there are, with them
  void add(std::size_t corners, std::size_t triangles) {
    if (corners > 3) faces_.push_back({static_cast<std::uint32_t>(triangles - (corners - 2)), static_cast<std::uint32_t>(corners)});
  }

  /// Divides the faces whose fans leave them, by EarClipping in the plane of the two axes along which they are largest. A fan stays that
  /// covers less than a millionth of the face's area beside it: rounding makes many convex faces hollow by as much.
  /// @param lists    what else the corners name: its triangles are divided likewise
  /// @param notices  a sentence is added where faces stay fans: they cross themselves, or all are too much work
  void divide(TriangleMesh& mesh, const std::vector<CornerList*>& lists, std::vector<std::string>& notices) const;

  /// Points that may be looked at in all faces of a file, which takes some seconds; and corners of one.
  static constexpr std::int64_t most_work = 4'000'000'000;
  static constexpr std::uint32_t most_corners = 1'000'000;

 private:
  struct Face {
    std::uint32_t first, corners;
  };
  std::vector<Face> faces_;
};

}  // namespace tofray::mesh
