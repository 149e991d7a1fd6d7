// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <tuple>
#include <vector>

#include "assets/mesh_cache.h"
#include "assets/mesh_piece.h"
#include "base/faults.h"
#include "mesh/read_mesh.h"

namespace tofray::assets {

class ObjMaterials;

/// Which files a scene may take: those of meshes and of keyframes.
struct MeshFiles {
  std::string root = {};  ///< they lie in or below the scene's folder, or in or below this one where it is not empty
  std::optional<std::map<std::string, std::string>> expected = {};  ///< SHA-256 by name as the scene has it: these files and no others
};

/// Of an object that has no material, and whose file has none.
inline constexpr const char* lacks_material =
    "expected one of \"reflectivity\" or \"material\"; glTF files, OBJ files that name an mtllib, PLY files that wear a picture, and "
    "vertices "
    "with colours have their own";

/// Where the files that a scene names lie.
/// @param source  the scene's file, or <NAME> of a built-in one
std::string folder_beside(const std::string& source);

/// Reads the meshes that a scene names: each file once, turned so that its up is the world's, and scaled to metres. In a world where −y is up:
///
///     up y:   (x, −y, −z)     its front, +z, looks at a camera at zero that looks along +z
///     up z:   (x, −z, y)      its front, −y, does
///     up −y:  (x, y, z)
///
/// and then, where y is up in the world, to (x, −y, −z), where z is, to (x, z, −y). Up none: (x, y, z) in any world.
class MeshReader {
 public:
  /// Where the scene names what a mesh is made of.
  struct Places {
    base::Place file, time, play, animation;
    std::string key = {};  ///< the object's: objects.0
  };
  /// What the file shows; of a glTF or OBJ file one for each material, where that is asked for. Shades are those of a material of the file.
  using Piece = LoadedMesh::Piece;
  struct Known : LoadedMesh {
    mutable std::vector<std::shared_ptr<const TriangleMesh>> without_shades = {};  ///< of each piece, once somebody asked for them

    /// Fills `mesh` by one piece.
    /// @param shaded  whether it is of the file's material
    void show(std::size_t piece, Mesh& mesh, bool shaded = true) const;
  };

  /// @param source  the scene's file: meshes lie beside it or below
  MeshReader(const std::string& source, const MeshFiles& files);
  void set_world_up(Scene::Up up) { world_up_ = up; }
  /// Says that read() will want this file's materials: its SHA-256 then is that of all that it names, for all objects.
  void want_materials(const std::string& file) { with_materials_.insert(file); }
  /// Says that read() will want the pictures that this PLY file wears: its SHA-256 then is that of all that it names.
  void want_pictures(const std::string& file) { with_pictures_.insert(file); }
  /// What `mesh` shows by its file, scale, up, time and play.
  /// @param by_material  whether a glTF or OBJ file's materials are wanted apart
  /// @throws Error as files::read_reference, mesh::parse and gltf::read, and (bad_input) where the file is not the one that is expected,
  /// has no animation though there is a time, or where no triangle is in the world or has an area
  const Known& read(const Places& places, const Mesh& mesh, bool by_material);

 private:
  /// Of this or an earlier scene.
  Known loaded(const Places& places, const Mesh& wanted, bool by_material);
  /// @param path  where it lies  @param bytes  of the file
  LoadedMesh from_file(const Places& places, const Mesh& wanted, const std::string& path, std::string bytes, bool by_material);
  /// As they are in the file.
  std::vector<MeshPiece> pieces(const Places& places, const Mesh& wanted, const std::string& path, std::string bytes, bool by_material,
                                LoadedMesh& known) const;
  static std::vector<MeshPiece> from_code(const base::Place& place, const std::string& file);
  std::vector<MeshPiece> from_gltf(const Places& places, const Mesh& wanted, const std::string& path, const std::string& bytes,
                                   bool by_material, LoadedMesh& known) const;
  std::vector<MeshPiece> from_obj(const Places& places, const Mesh& wanted, const std::string& path, std::string bytes, bool by_material,
                                  LoadedMesh& known) const;
  static std::vector<MeshPiece> wearing(mesh::ReadMesh mesh, const ObjMaterials& materials, const Places& places, LoadedMesh& known);
  /// What is left of a file is seen. @param lost  triangles beyond the world
  static void check_seen(const Places& places, const Mesh& wanted, const std::string& path, const LoadedMesh& known,
                         const std::vector<MeshPiece>& all, std::size_t lost, double farthest_m);
  void check_expected(const base::Place& place, const std::string& file, const std::string& path, const std::string& sha256) const;
  /// The limits of one mesh are those of all meshes of a scene: of many it may take no more memory.
  void count(const base::Place& place, std::size_t vertices, std::size_t triangles);

  std::string folder_;
  const MeshFiles& files_;
  Scene::Up world_up_ = Scene::Up::minus_y;
  std::set<std::string> with_materials_, with_pictures_;
  std::size_t vertices_ = 0, triangles_ = 0, texels_ = 0;
  std::map<std::tuple<std::string, double, Mesh::Up, std::string, std::optional<double>, Mesh::Play, bool>, Known> known_;
};

/// Where the first perspective camera of a glTF file stands in the world; nothing where there is none, or the file is of another kind.
/// @param mesh      its file, scale, up and time: a mesh that was read
/// @param world_up  of its scene
/// @param source  the scene's file, beside which the mesh lies
std::optional<Pose> camera_in(const Mesh& mesh, const std::string& source, const std::string& root,
                              Scene::Up world_up = Scene::Up::minus_y);

/// Whether a mesh's file has materials of its own: glTF, OBJ where the files of materials that it names can be read, and OBJ and PLY whose
/// vertices have colours.
/// @param file    as a scene has it
/// @param source  the scene's file, beside which it lies
/// @param unread  out: the first file of materials that the mesh's file names and that cannot be read
bool has_own_materials(const std::string& file, const std::string& source, const std::string& root, std::string* unread = nullptr);

}  // namespace tofray::assets
