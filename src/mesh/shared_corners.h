// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <array>
#include <bit>
#include <cstdint>
#include <random>
#include <vector>

#include "mesh/mesh_builder.h"

namespace tofray::mesh {

/// Gives corners at the very same place one vertex, in the order in which they come.
///
/// A hash table with chains. Its multipliers are drawn anew in each run, so that no file can be made whose corners all share a chain (the
/// family is strongly universal: Lemire and Kaser 2014, "Strongly universal string hashing is fast"); the mesh does not depend on them.
class SharedCorners {
 public:
  SharedCorners() : heads_(64, -1) {
    std::random_device source;
    for (std::uint64_t& one : multipliers_) one = std::uint64_t{source()} << 32 | source();
  }

  /// @param corner  finite; -0 is 0
  std::int32_t index_of(std::array<float, 3> corner, MeshBuilder& mesh) {
    for (float& coordinate : corner) coordinate += 0.F;
    std::size_t slot = slot_of(corner);
    for (std::int32_t i = heads_[slot]; i >= 0; i = next_[static_cast<std::size_t>(i)])
      if (mesh.position(i) == corner) return i;
    if (next_.size() == heads_.size()) {
      grow(mesh);
      slot = slot_of(corner);
    }
    const auto index = static_cast<std::int32_t>(next_.size());
    mesh.vertex(corner);
    next_.push_back(heads_[slot]);
    heads_[slot] = index;
    return index;
  }

 private:
  [[nodiscard]] std::size_t slot_of(const std::array<float, 3>& corner) const {
    std::uint64_t sum = multipliers_[3];
    for (std::size_t k = 0; k < 3; ++k) sum += multipliers_[k] * std::bit_cast<std::uint32_t>(corner[k]);
    return static_cast<std::size_t>(sum >> 32) & (heads_.size() - 1);
  }
  void grow(const MeshBuilder& mesh) {
    heads_.assign(2 * heads_.size(), -1);
    for (std::size_t i = 0; i < next_.size(); ++i) {
      std::int32_t& head = heads_[slot_of(mesh.position(static_cast<std::int32_t>(i)))];
      next_[i] = head;
      head = static_cast<std::int32_t>(i);
    }
  }

  std::array<std::uint64_t, 4> multipliers_{};
  std::vector<std::int32_t> heads_;  ///< of each chain, -1 where it is empty; a power of two of them
  std::vector<std::int32_t> next_;   ///< by vertex
};

}  // namespace tofray::mesh
