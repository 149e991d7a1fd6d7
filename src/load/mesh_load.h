// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <map>
#include <memory>
#include <string>
#include <tuple>
#include <vector>

#include "base/faults.h"
#include "load/load.h"

namespace tofray::load {

/// Reads the meshes that a scene names: each file once, turned so that its up is the world's −y, and scaled to metres.
///
///     up y:   (x, −y, −z)     its front, +z, looks at a camera at zero that looks along +z
///     up z:   (x, −z, y)      its front, −y, does
///     up −y:  (x, y, z)
class MeshReader {
 public:
  /// @param source  the scene's file: meshes lie beside it or below
  MeshReader(const std::string& source, const MeshFiles& files);
  /// Fills `mesh` by its file, scale and up.
  /// @throws Error as files::read_reference and mesh::parse, and (bad_input) where the file is not the one that is expected, or where no
  /// triangle is in the world
  void read(const base::Place& place, Mesh& mesh);

 private:
  struct Known {
    std::shared_ptr<const TriangleMesh> triangles;
    std::string sha256;
    int left_out;
  };
  Known from_file(const base::Place& place, const Mesh& wanted);
  /// The limits of one mesh are those of all meshes of a scene: of many it may take no more memory.
  void count(const base::Place& place, const TriangleMesh& mesh);

  std::string folder_;
  const MeshFiles& files_;
  std::size_t vertices_ = 0, triangles_ = 0;
  std::map<std::tuple<std::string, double, Mesh::Up>, Known> known_;
};

}  // namespace tofray::load
