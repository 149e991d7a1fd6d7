// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <array>
#include <string>
#include <vector>

#include "view/scene_3d.h"
#include "view/wire.h"

namespace tofray::view {

/// Numbers of an answer's array. @param type  as WireArray::type_number
template <class T>
StaticArray array_of(std::uint8_t type, const std::vector<T>& values, std::uint8_t rank, std::array<std::size_t, 3> extents) {
  StaticArray out{type, {values.data(), values.size() * sizeof(T), rank, {}}};
  for (std::size_t i = 0; i < rank; ++i) out.view.extents[i] = static_cast<std::uint32_t>(extents[i]);
  return out;
}
inline constexpr std::uint8_t u8_type = 1, u32_type = 4, f32_type = 5;

/// The arrays of an answer to `view3d`.
inline constexpr std::array drawing_arrays{"rays", "triangles", "triangle_objects"};
std::string drawing_bytes(const WireHead& head, std::uint64_t frame, const Geometry& of);

}  // namespace tofray::view
