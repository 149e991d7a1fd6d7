// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

/// A face's triangles as a fan: (first corner, the one before, the next one). All its corners can be told from it.
namespace tofray::mesh {

using Corners = std::array<std::int32_t, 3>;

/// @param first   the fan's first triangle
/// @param corner  which corner of the face
inline std::int32_t corner_of_fan(const std::vector<Corners>& rows, std::size_t first, std::size_t corner) {
  return corner < 2 ? rows[first][corner] : rows[first + corner - 2][2];
}

/// Puts others in place of a fan's triangles: `triangles` of the same corners, counted within the face.
inline void replace_fan(std::vector<Corners>& rows, std::size_t first, std::size_t corners, const std::vector<Corners>& triangles) {
  std::vector<std::int32_t> names(corners);
  for (std::size_t i = 0; i < corners; ++i) names[i] = corner_of_fan(rows, first, i);
  for (std::size_t i = 0; i < triangles.size(); ++i)
    for (std::size_t k = 0; k < 3; ++k) rows[first + i][k] = names[static_cast<std::size_t>(triangles[i][k])];
}

}  // namespace tofray::mesh
