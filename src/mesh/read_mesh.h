// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "base/faults.h"
#include "tofray/scene.h"

/// Triangle meshes out of files: Wavefront OBJ, Stanford PLY, STL.
namespace tofray::mesh {

/// A file that another one names, and where it does.
struct Reference {
  std::string file;
  base::Place place;
};

/// A mesh as its file has it: the file's own unit and axes.
struct ReadMesh {
  /// Indices within the vertices, coordinates finite; normals of unit length or 0, texture coordinates within ±1e6, their v downward. No
  /// normals where all are 0. Shades are the luminances of the vertices' colours.
  TriangleMesh mesh;
  std::size_t not_finite = 0;             ///< triangles dropped because a corner is not a finite number (NaN, inf, or beyond float)
  std::vector<std::string> notices;       ///< sentences: what was mended
  std::vector<Reference> libraries;       ///< OBJ: the files of materials (mtllib), each once, in their order
  std::vector<Reference> pictures;        ///< PLY: what its triangles wear (comment TextureFile), where they have texture coordinates
  std::vector<std::string> materials;     ///< OBJ: the names that usemtl says, each once, in their order; PLY: those of the pictures
  std::vector<std::int32_t> material_of;  ///< index in `materials` of each triangle's, -1: it has none. Empty: none has any
};

enum class Format { obj, ply, stl };

/// ".obj" of "Chair.OBJ"; empty where the name has none.
std::string suffix_of(const std::string& path);

/// By the file name's suffix, in any case.
/// @param place  who names the file, for messages
/// @throws Error (bad_input) where it is none of the three
Format format_of(const std::string& path, const base::Place& place);

/// Reads a mesh in time and memory linear in the file's size. Polygons become fans; corners of an STL file at the very same place one
/// vertex. A vertex of an OBJ file whose corners have several normals or texture coordinates becomes several: itself with the first ones,
/// and others behind the file's.
/// Vertices that are not finite are left out, and so are the triangles at them. Normals and texture coordinates that are not finite, or
/// beyond 1e6, become 0.
/// @param bytes  the whole file; who reads it sees that it has at most limit::mesh_bytes
/// @param name   the file's name for messages
/// @throws Error (bad_input) for the first fault, or where there is no triangle; (limit) beyond limit::mesh_vertices,
///         mesh_triangles, mtl_files or mtl_materials
ReadMesh parse(Format format, std::string_view bytes, const std::string& name);

/// The files of materials that an OBJ file names: ReadMesh::libraries alone. @throws Error (limit) beyond limit::mtl_files
std::vector<Reference> libraries_of_obj(std::string_view bytes, const std::string& name);

}  // namespace tofray::mesh
