// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <array>
#include <bit>
#include <cstdint>

#include "mesh/mesh_builder.h"
#include "mesh/shared_keys.h"

namespace tofray::mesh {

/// Gives corners at the very same place one vertex, in the order in which they come.
class SharedCorners {
 public:
  /// @param corner  finite; -0 is 0
  std::int32_t index_of(std::array<float, 3> corner, MeshBuilder& mesh) {
    for (float& coordinate : corner) coordinate += 0.F;
    const auto key_of = [&](std::int32_t vertex) { return key(mesh.position(vertex)); };
    const std::int32_t known = keys_.find(key(corner), key_of);
    if (known >= 0) return known;
    const std::int32_t index = keys_.add(key(corner), key_of);
    mesh.vertex(corner);
    return index;
  }

 private:
  static SharedKeys<3>::Key key(const std::array<float, 3>& corner) { return std::bit_cast<SharedKeys<3>::Key>(corner); }
  SharedKeys<3> keys_;
};

}  // namespace tofray::mesh
