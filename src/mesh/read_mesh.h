// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstddef>
#include <string>
#include <string_view>

#include "base/faults.h"
#include "tofray/scene.h"

/// Triangle meshes out of files: Wavefront OBJ, Stanford PLY, STL.
namespace tofray::mesh {

/// A mesh as its file has it: the file's own unit and axes.
struct ReadMesh {
  TriangleMesh mesh;           ///< indices within the vertices, coordinates finite
  std::size_t not_finite = 0;  ///< triangles dropped because a corner is not a finite number (NaN, inf, or beyond float)
};

enum class Format { obj, ply, stl };

/// ".obj" of "Chair.OBJ"; empty where the name has none.
std::string suffix_of(const std::string& path);

/// By the file name's suffix, in any case.
/// @param place  who names the file, for messages
/// @throws Error (bad_input) where it is none of the three
Format format_of(const std::string& path, const base::Place& place);

/// Reads a mesh in time and memory linear in the file's size. Polygons become fans; corners of an STL file at the very same place one
/// vertex.
/// Vertices that are not finite are left out, and so are the triangles at them.
/// @param bytes  the whole file; who reads it sees that it has at most limit::mesh_bytes
/// @param name   the file's name for messages
/// @throws Error (bad_input) for the first fault, or where there is no triangle; (limit) beyond limit::mesh_vertices or mesh_triangles
ReadMesh parse(Format format, std::string_view bytes, const std::string& name);

}  // namespace tofray::mesh
