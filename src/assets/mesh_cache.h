// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstddef>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "assets/beside.h"
#include "assets/mesh_piece.h"
#include "base/content.h"
#include "tofray/scene.h"

/// Meshes that were read, for whoever reads the same file in the same way next: by what the file and all that it names hold, not by their
/// names' times. They live as long as a scene has any of them, and a while longer (base/shared.h).
namespace tofray::assets {

/// A mesh's file, read, turned and scaled.
struct LoadedMesh {
  struct Piece {
    std::shared_ptr<const TriangleMesh> triangles;
    std::shared_ptr<const MeshMotion> motion;
    int left_out = 0;
    FileMaterial of;
  };
  std::vector<Piece> pieces;  ///< at least one; each has triangles
  std::string sha256;         ///< of the file and all that it names; empty of built-in meshes
  std::vector<std::string> notices;
  std::vector<std::string> materials;  ///< names of all that the file has, where they were asked for
  std::string lacks;                   ///< what of an OBJ or PLY file would be its material, if it has none
  // what counts against the limits of a scene
  std::size_t vertices = 0, all_triangles = 0;
};

/// All that a LoadedMesh depends on but for files that the file names.
struct MeshKey {
  base::Content bytes;     ///< the file's
  std::string path, root;  ///< where it lies; below what its own files may lie
  std::string file, animation;
  double scale = 1;
  Mesh::Up up = Mesh::Up::automatic;
  Mesh::Play play = Mesh::Play::still;
  std::optional<double> time_s;
  Scene::Up world_up = Scene::Up::minus_y;
  bool by_material = false, with_materials = false, with_pictures = false;
  bool operator==(const MeshKey&) const = default;
};

/// The mesh of a key: one that was made before where all files that it names hold what they held, else a new one.
/// @param make  may throw: then there is none
std::shared_ptr<const LoadedMesh> cached_mesh(const MeshKey& key, const std::function<LoadedMesh()>& make);

}  // namespace tofray::assets
