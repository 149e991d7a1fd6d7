// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstddef>
#include <memory>
#include <string>

#include "base/faults.h"
#include "tofray/scene.h"

namespace tofray::load {

/// What one object shows of a mesh's file: all of it, or the triangles of one material.
struct MeshPiece {
  enum class From { nothing, file, visible_colour };
  TriangleMesh mesh;  ///< vertices, and normals and texture coordinates where the file has any
  std::size_t left_out = 0;
  std::string material;                             ///< its name, or its place among the file's
  double reflectivity = 0.5;                        ///< of the material
  From from = From::nothing;                        ///< how that is known
  std::shared_ptr<const ReflectivityMap> map = {};  ///< of the material, or none
};

/// Adds a picture's pixels to those that the meshes of a scene wear. @throws Error (limit) beyond limit::map_pixels
void count_texels(int width, int height, const base::Place& place, std::size_t& texels);

/// What a listing may show of a material's name, which a stranger gave.
std::string shown_name(const std::string& name);

}  // namespace tofray::load
