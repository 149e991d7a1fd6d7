// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstddef>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "assets/mesh_piece.h"
#include "mesh/mtl.h"
#include "mesh/read_mesh.h"

/// OBJ files of a scene: with the files of materials and pictures that they name, taken apart by material; and PLY files with pictures.
namespace tofray::assets {

/// By the file name's suffix, in any case.
bool is_obj(const std::string& path);

/// Whether an OBJ file names files of materials that can be read, or its vertices have colours; of a PLY file whether it wears a picture that
/// can be read, or they have.
/// @param path    where it lies
/// @param unread  out: the first of those that it names, where none can be read
bool has_materials(std::string_view bytes, const std::string& path, const std::string& root, std::string& unread);

/// The materials of one OBJ file, or the pictures of a PLY file.
class ObjMaterials {
 public:
  /// Reads the MTL files that the mesh names and the pictures that its triangles wear, by read_beside(); those that are not there are left
  /// out, and told.
  /// @param path  where the OBJ file lies
  /// @throws Error as mesh::parse_mtl, and (limit) as read_beside(); it says that a material of the object's own is a way out
  ObjMaterials(const mesh::ReadMesh& mesh, const std::string& path, const std::string& root);

  /// Bytes of the MTL files, as mtllib names them, and of the pictures, as usemtl first names their materials; each once.
  [[nodiscard]] const std::string& bytes() const { return bytes_; }
  /// Whether there is a picture that it wears.
  [[nodiscard]] bool has_pictures() const { return !pictures_.empty(); }
  /// Notices of files that are not there, and of those that were found elsewhere.
  void tell_of_files(std::vector<std::string>& notices) const;

  /// A piece for each material that has triangles: those without one first, then as usemtl first names them.
  /// @param mesh     the one of the constructor
  /// @param place    who names the OBJ file, for messages
  /// @param notices  sentences are added: what is left out
  /// @throws Error as image::read; (limit) beyond limit::mesh_vertices or map_pixels
  std::vector<MeshPiece> pieces(mesh::ReadMesh mesh, const base::Place& place, std::vector<std::string>& notices) const;

 private:
  struct Picture {
    std::string path;        ///< where it was found
    std::size_t from, size;  ///< in bytes_
  };
  void read_libraries(const mesh::ReadMesh& mesh, const std::string& path, const std::string& root);
  // A material that is used: its place among the names that the mesh uses, -1: the one without a name.
  void read_picture(std::size_t used, const std::string& root);
  void wear(std::vector<MeshPiece>& pieces, const std::vector<int>& used, std::vector<std::string>& notices) const;
  void wear_pictures(std::vector<MeshPiece>& pieces, const std::vector<int>& used, const base::Place& place) const;
  [[nodiscard]] const mesh::MtlMaterial* material(int used) const;

  std::string bytes_;
  std::vector<mesh::MtlMaterial> all_;
  std::vector<std::string> folder_of_;  ///< of each: its MTL file's
  std::vector<int> known_;              ///< index in all_ of each name that the mesh uses, or -1
  std::vector<int> picture_of_;         ///< index in pictures_ of each name that the mesh uses, or -1
  std::vector<Picture> pictures_;
  std::map<std::string, int> picture_at_;  ///< by name
  std::size_t picture_bytes_ = 0;
  int nameless_ = -1;  ///< in all_: the material whose name is empty
  std::vector<std::string> left_out_, lost_files_, notices_;
  std::size_t twice_ = 0;
};

}  // namespace tofray::assets
