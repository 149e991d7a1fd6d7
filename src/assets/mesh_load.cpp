// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include "assets/mesh_load.h"

#include <algorithm>
#include <cmath>

#include "assets/builtin_mesh.h"
#include "assets/gltf_load.h"
#include "assets/gltf_map.h"
#include "assets/gltf_material.h"
#include "assets/gltf_motion.h"
#include "assets/obj_load.h"
#include "base/limits.h"
#include "base/range.h"
#include "base/text.h"
#include "base/vec.h"
#include "files/sha256.h"
#include "files/text_file.h"
#include "mesh/read_mesh.h"

namespace tofray::assets {

namespace {

using Corner = std::array<float, 3>;

/// Which axis is up in a file (never automatic), and in the world.
struct Axes {
  Mesh::Up file;
  Scene::Up world;
};

template <class T>
std::array<T, 3> turned(std::array<T, 3> p, const Axes& up) {
  if (up.file == Mesh::Up::none) return p;
  if (up.file == Mesh::Up::y) p = {p[0], -p[1], -p[2]};
  if (up.file == Mesh::Up::z) p = {p[0], -p[2], p[1]};
  if (up.world == Scene::Up::y) p = {p[0], -p[1], -p[2]};
  if (up.world == Scene::Up::z) p = {p[0], p[2], -p[1]};
  return p;
}

/// In double, rounded once.
Corner in_world(const Corner& p, double scale, const Axes& up) {
  Corner out = turned(p, up);
  for (float& a : out) a = static_cast<float>(scale * static_cast<double>(a));
  return out;
}

Axes axes_of(const Mesh& mesh, Scene::Up world) {
  if (mesh.up != Mesh::Up::automatic) return {mesh.up, world};
  if (is_builtin_mesh(mesh.file)) return {Mesh::Up::minus_y, world};
  return {is_gltf(mesh.file) || is_obj(mesh.file) ? Mesh::Up::y : Mesh::Up::z, world};
}

/// All of a file as one piece.
/// @param by_material  whether the colours of its vertices are its material
std::vector<MeshPiece> whole(mesh::ReadMesh read, bool by_material, LoadedMesh& known) {
  known.notices = std::move(read.notices);
  std::vector<MeshPiece> out;
  out.push_back({std::move(read.mesh), read.not_finite, {}});
  if (!by_material) {
    out[0].mesh.shades.clear();
  } else {
    out[0].of.name = no_material;
    if (out[0].mesh.shades.empty())
      known.lacks = "has neither colours of vertices nor a picture that can be read";
    else
      out[0].of.from = FileMaterial::From::visible_colour, out[0].of.material.diffuse = 1;
  }
  return out;
}

/// What a file says of a mesh's motion, turned and scaled as the mesh is.
class PlacedMotion : public MeshMotion {
 public:
  PlacedMotion(std::shared_ptr<const MeshMotion> of_file, double scale, const Axes& up)
      : of_file_(std::move(of_file)), scale_(scale), up_(up) {}
  void at(double time_s, std::vector<Corner>& vertices, std::vector<Corner>& normals) const override {
    of_file_->at(time_s, vertices, normals);
    for (Corner& p : vertices) p = in_world(p, scale_, up_);
    for (Corner& n : normals) n = turned(n, up_);
  }

 private:
  std::shared_ptr<const MeshMotion> of_file_;
  double scale_;
  Axes up_;
};

/// Of a file with animations of which none plays: what would make one play.
std::string stands_still(std::size_t count) {
  return count == 1
             ? "its animation stands still: play: loop plays it, time: 0 s is one moment of it"
             : "its " + std::to_string(count) + " animations stand still: play: loop plays one of them, time: 0 s is one moment of it";
}

/// Of a file with several animations: which one it is.
std::string which_plays(const gltf::Model& model, int animation, std::size_t count, bool by_default) {
  const std::string& name = model.animations[static_cast<std::size_t>(animation)].name;
  const auto number = static_cast<std::size_t>(animation);
  const std::string which = number == count ? "all of its " + std::to_string(count) + " animations play"
                                            : "of its " + std::to_string(count) + " animations number " + std::to_string(number) +
                                                  (name.empty() ? "" : ", " + base::in_quotes(name) + ",") + " plays";
  return by_default ? which + ", the others do not; animation: all, a name or a number chooses" : which;
}

bool is_in_world(const Corner& p) {
  return std::all_of(p.begin(), p.end(), [](float a) { return std::abs(a) <= base::farthest_m; });  // NaN: no
}

/// Leaves out the triangles that have a corner beyond the world. @return how many
/// @param farthest_m  out: the largest coordinate of those corners, if it is larger
std::size_t keep_in_world(TriangleMesh& mesh, double& farthest_m) {
  std::vector<bool> good;
  good.reserve(mesh.vertices.size());
  for (Corner& p : mesh.vertices) {
    good.push_back(is_in_world(p));
    if (good.back()) continue;
    for (const float a : p) farthest_m = std::max(farthest_m, static_cast<double>(std::abs(a)));
    p = {0, 0, 0};
  }
  return std::erase_if(mesh.triangles, [&](const auto& triangle) {
    return !std::all_of(triangle.begin(), triangle.end(), [&](std::int32_t i) { return good[static_cast<std::size_t>(i)]; });
  });
}

/// Whether a triangle is higher over its longest side than rounding makes of three points on a line.
bool has_area(const TriangleMesh& mesh) {
  constexpr double least_height = 1e-7;  // of the longest side
  using base::operator-;
  const auto at = [&](std::int32_t i) {
    const Corner& p = mesh.vertices[static_cast<std::size_t>(i)];
    return Vec3{static_cast<double>(p[0]), static_cast<double>(p[1]), static_cast<double>(p[2])};
  };
  return std::any_of(mesh.triangles.begin(), mesh.triangles.end(), [&](const auto& triangle) {
    const Vec3 a = at(triangle[1]) - at(triangle[0]), b = at(triangle[2]) - at(triangle[0]);
    const double longest = std::max({base::length(a), base::length(b), base::length(a - b)});
    return base::length(base::cross(a, b)) > least_height * longest * longest;
  });
}

/// The scale that makes a size of centimetres to metres, by the units that files have instead of metres.
double fitting_scale(double size_m) {
  for (const double unit : {1e-3, 1e-2, 1e-6, 1e-9})
    if (unit * size_m >= 0.02 && unit * size_m <= 20) return unit;
  return std::pow(10, -std::round(std::log10(size_m)));
}

}  // namespace

std::string folder_beside(const std::string& source) { return source.starts_with("<") ? "." : files::folder_of(source); }

void MeshReader::Known::show(std::size_t piece, Mesh& mesh, bool shaded) const {
  const Piece& of = pieces[piece];
  mesh.triangles = of.triangles, mesh.motion = of.motion;
  if (!shaded && !of.triangles->shades.empty()) {
    without_shades.resize(pieces.size());
    if (without_shades[piece] == nullptr) {
      auto plain = std::make_shared<TriangleMesh>(*of.triangles);
      plain->shades.clear();
      without_shades[piece] = std::move(plain);
    }
    mesh.triangles = without_shades[piece];
  }
  mesh.sha256 = sha256, mesh.left_out = pieces[piece].left_out;
}

MeshReader::MeshReader(const std::string& source, const MeshFiles& files) : folder_(folder_beside(source)), files_(files) {}

const MeshReader::Known& MeshReader::read(const Places& places, const Mesh& mesh, bool by_material) {
  const std::tuple key{mesh.file, mesh.scale, mesh.up, mesh.animation, mesh.time_s, mesh.play, by_material};
  auto known = known_.find(key);
  if (known == known_.end()) known = known_.emplace(key, loaded(places, mesh, by_material)).first;
  return known->second;
}

MeshReader::Known MeshReader::loaded(const Places& places, const Mesh& wanted, bool by_material) {
  std::string path = wanted.file, bytes;
  if (!is_builtin_mesh(wanted.file)) {
    if (!is_gltf(wanted.file)) (void)mesh::format_of(wanted.file, places.file);
    bytes = files::read_reference(wanted.file, folder_, files_.root, places.file, path, base::limit::mesh_bytes);
  }
  MeshKey key{{},
              path,
              files_.root,
              wanted.file,
              wanted.animation,
              wanted.scale,
              wanted.up,
              wanted.play,
              wanted.time_s,
              world_up_,
              by_material,
              with_materials_.contains(wanted.file),
              with_pictures_.contains(wanted.file)};
  key.bytes.add(std::string_view(bytes));
  bool is_new = false;
  const auto make = [&] { return is_new = true, from_file(places, wanted, path, std::move(bytes), by_material); };
  const std::shared_ptr<const LoadedMesh> mesh = cached_mesh(key, make);
  if (!is_new) {
    if (!mesh->sha256.empty()) check_expected(places.file, wanted.file, path, mesh->sha256);
    count(places.file, mesh->vertices, mesh->all_triangles);
    for (const Piece& piece : mesh->pieces) count_pictures(piece.of.material, places.file, texels_);
  }
  Known known{*mesh, {}};
  for (Piece& piece : known.pieces) piece.triangles = {mesh, piece.triangles.get()};  // whoever has a piece keeps the mesh
  return known;
}

std::vector<MeshPiece> MeshReader::pieces(const Places& places, const Mesh& wanted, const std::string& path, std::string bytes,
                                          bool by_material, LoadedMesh& known) const {
  if (is_builtin_mesh(wanted.file)) return from_code(places.file, wanted.file);
  if (is_gltf(wanted.file)) return from_gltf(places, wanted, path, bytes, by_material, known);
  const mesh::Format format = mesh::format_of(wanted.file, places.file);
  if (with_materials_.contains(wanted.file)) return from_obj(places, wanted, path, std::move(bytes), by_material, known);
  mesh::ReadMesh mesh = mesh::parse(format, bytes, path);
  if (mesh.pictures.empty() || !with_pictures_.contains(wanted.file)) {
    known.sha256 = files::sha256_hex(bytes);
    check_expected(places.file, wanted.file, path, known.sha256);
    return whole(std::move(mesh), by_material, known);
  }
  const ObjMaterials pictures(mesh, path, files_.root);
  known.sha256 = files::sha256_hex(bytes + pictures.bytes());
  check_expected(places.file, wanted.file, path, known.sha256);
  if (by_material && pictures.has_pictures()) return wearing(std::move(mesh), pictures, places, known);
  std::vector<MeshPiece> out = whole(std::move(mesh), by_material, known);
  if (by_material) pictures.tell_of_files(known.notices);
  return out;
}

std::vector<MeshPiece> MeshReader::wearing(mesh::ReadMesh mesh, const ObjMaterials& materials, const Places& places, LoadedMesh& known) {
  known.notices = std::move(mesh.notices);
  for (const std::string& name : mesh.materials) known.materials.push_back(shown_name(name));
  return materials.pieces(std::move(mesh), places.file, known.notices);
}

LoadedMesh MeshReader::from_file(const Places& places, const Mesh& wanted, const std::string& path, std::string bytes, bool by_material) {
  LoadedMesh known;
  std::vector<MeshPiece> pieces = this->pieces(places, wanted, path, std::move(bytes), by_material, known);
  const Axes up = axes_of(wanted, world_up_);
  std::size_t lost = 0;
  double farthest_m = 0;
  for (MeshPiece& piece : pieces) {
    count(places.file, piece.mesh.vertices.size(), piece.mesh.triangles.size());
    known.vertices += piece.mesh.vertices.size(), known.all_triangles += piece.mesh.triangles.size();
    for (Corner& p : piece.mesh.vertices) p = in_world(p, wanted.scale, up);
    for (Corner& n : piece.mesh.normals) n = turned(n, up);
    count_pictures(piece.of.material, places.file, texels_);
    const std::size_t beyond = keep_in_world(piece.mesh, farthest_m);
    piece.left_out += beyond, lost += beyond;
    if (piece.mesh.triangles.empty()) continue;
    if (piece.of.nowhere) {
      known.notices.push_back("material " + base::in_quotes(piece.of.name) +
                              " is cut out everywhere by its alpha: its triangles are left out");
      continue;
    }
    if (by_material && piece.of.name == no_material) known.materials.emplace_back(no_material);
    std::shared_ptr<const MeshMotion> motion;
    if (piece.motion != nullptr) motion = std::make_shared<PlacedMotion>(std::move(piece.motion), wanted.scale, up);
    known.pieces.push_back({std::make_shared<const TriangleMesh>(std::move(piece.mesh)), std::move(motion),
                            static_cast<int>(piece.left_out), std::move(piece.of)});
  }
  check_seen(places, wanted, path, known, pieces, lost, farthest_m);
  return known;
}

void MeshReader::check_seen(const Places& places, const Mesh& wanted, const std::string& path, const LoadedMesh& known,
                            const std::vector<MeshPiece>& all, std::size_t lost, double farthest_m) {
  const std::string file = base::in_quotes(path, 200);
  const auto seen = [](const Piece& piece) { return piece.motion != nullptr || has_area(*piece.triangles); };
  if (std::any_of(known.pieces.begin(), known.pieces.end(), seen)) return;
  if (!known.pieces.empty())
    base::fail(places.file, "no triangle of " + file + " has an area",
               "the corners of each lie on a line or in one point: there is nothing to see");
  if (std::any_of(all.begin(), all.end(), [](const MeshPiece& piece) { return piece.of.nowhere && !piece.mesh.triangles.empty(); }))
    base::fail(
        places.file, "all of " + file + " is cut out by alpha",
        "no material's alpha comes up to its cut-off (alphaMode MASK, or 0.5 of BLEND); a reflectivity of the object makes it opaque");
  if (all.empty()) base::fail(places.file, "no triangle of " + file + " is in the world", "the file's scene shows none");
  if (lost == 0) base::fail(places.file, "no triangle of " + file + " is in the world", "each has a corner that is not a finite number");
  const std::string corners = "all have a corner beyond " + base::number_text(base::farthest_m) + " m, up to " +
                              base::number_text(farthest_m < 1e9 ? std::round(farthest_m) : farthest_m) + " m";
  constexpr double least_scale = 1e-9;
  const double scale = wanted.scale * fitting_scale(farthest_m);
  if (!(scale >= least_scale))
    base::fail(places.file, "no triangle of " + file + " is in the world", corners + ": no scale makes a thing of these");
  const std::string said = base::number_text(scale);
  base::fail(places.file, "no triangle of " + file + " is in the world",
             corners + "; is another scale meant? Such as scale: " + said +
                 (places.key.empty() ? "" : " (--set " + places.key + ".mesh.scale=" + said + ")"));
}

std::vector<MeshPiece> MeshReader::from_code(const base::Place& place, const std::string& file) {
  auto mesh = builtin_mesh(std::string_view(file).substr(builtin_mesh_prefix.size()));
  if (!mesh) {
    std::string names;
    for (const std::string& name : builtin_mesh_names()) names += (names.empty() ? "" : ", ") + std::string(builtin_mesh_prefix) + name;
    base::fail(place, "there is no mesh " + base::in_quotes(file, 200) + " in tofray itself", "expected a file, or one of " + names);
  }
  std::vector<MeshPiece> out;
  out.push_back({std::move(*mesh), 0, {}});
  return out;
}

std::vector<MeshPiece> MeshReader::from_gltf(const Places& places, const Mesh& wanted, const std::string& path, const std::string& bytes,
                                             bool by_material, LoadedMesh& known) const {
  GltfFile file = read_gltf(bytes, path, files_.root);
  check_expected(places.file, wanted.file, path, file.sha256);
  if (wanted.time_s && file.model.animations.empty())
    base::fail(places.time, base::in_quotes(path, 200) + " has no animation", "time is one of its animation; leave it away");
  if (wanted.play != Mesh::Play::still && file.model.animations.empty())
    base::fail(places.play, base::in_quotes(path, 200) + " has no animation", "there is nothing to play; leave it away");
  known.sha256 = std::move(file.sha256), known.notices = std::move(file.model.notices);
  for (std::size_t i = 0; i < file.model.materials.size(); ++i) known.materials.push_back(name_of(file.model, static_cast<int>(i)));
  if (!by_material &&
      std::any_of(file.model.materials.begin(), file.model.materials.end(), [](const gltf::Material& one) { return cutoff_of(one) > 0; }))
    known.notices.emplace_back("what its materials cut out by alpha is opaque, since the object's own material stands for all of them");
  const bool plays = wanted.time_s || wanted.play != Mesh::Play::still;
  if (!plays && !wanted.animation.empty())
    base::fail(places.animation, "animation says which one plays, and nothing plays", "add play: loop, or time: 0 s for one moment");
  const std::size_t animations = file.model.animations.size();
  const int animation = animation_of(file.model, wanted.animation, places.animation);
  if (!plays && animations > 0) known.notices.push_back(stands_still(animations));
  if (plays && animations > 1) known.notices.push_back(which_plays(file.model, animation, animations, wanted.animation.empty()));
  const std::optional<double> start_s = wanted.play == Mesh::Play::still ? wanted.time_s : wanted.time_s.value_or(0);
  std::vector<MeshPiece> pieces = pieces_of(file.model, pose_at(file.model, animation, start_s), by_material, path, places.file);
  if (wanted.play != Mesh::Play::still) play(std::move(file.model), animation, *start_s, wanted.play == Mesh::Play::loop, pieces);
  return pieces;
}

std::vector<MeshPiece> MeshReader::from_obj(const Places& places, const Mesh& wanted, const std::string& path, std::string bytes,
                                            bool by_material, LoadedMesh& known) const {
  mesh::ReadMesh mesh = mesh::parse(mesh::Format::obj, bytes, path);
  const ObjMaterials materials(mesh, path, files_.root);
  bytes += materials.bytes();
  known.sha256 = files::sha256_hex(bytes);
  check_expected(places.file, wanted.file, path, known.sha256);
  if (!by_material) return whole(std::move(mesh), false, known);
  if (mesh.libraries.empty() && mesh.mesh.shades.empty()) known.lacks = "names no mtllib";
  return wearing(std::move(mesh), materials, places, known);
}

void MeshReader::check_expected(const base::Place& place, const std::string& file, const std::string& path,
                                const std::string& sha256) const {
  if (!files_.expected) return;
  const auto expected = files_.expected->find(file);
  if (expected == files_.expected->end() || expected->second != sha256)
    base::fail(place, base::in_quotes(path, 200) + " is not the mesh that it was",
               "its SHA-256 is not the one that the manifest has; expected the same file in the same place");
}

void MeshReader::count(const base::Place& place, std::size_t vertices, std::size_t triangles) {
  vertices_ += vertices, triangles_ += triangles;
  const auto check = [&](std::size_t got, const base::Limit& limit, const char* what) {
    if (got > static_cast<std::size_t>(limit.value))
      base::fail(
          place, std::string("the scene's meshes have too many ") + what,
          "got more than " + std::to_string(limit.value) + " in all (`tofray --limits`); objects of one file, scale and up share theirs",
          ErrorKind::limit);
  };
  check(vertices_, base::limit::mesh_vertices, "vertices");
  check(triangles_, base::limit::mesh_triangles, "triangles");
}

bool has_own_materials(const std::string& file, const std::string& source, const std::string& root, std::string* unread) {
  if (is_gltf(file)) return true;
  if (!is_obj(file) && mesh::suffix_of(file) != ".ply") return false;
  std::string path, bytes;
  try {
    bytes = files::read_reference(file, folder_beside(source), root, base::whole(source), path, base::limit::mesh_bytes);
  } catch (const Error&) {
    return false;  // whoever reads the mesh tells
  }
  std::string missing;
  const bool has = has_materials(bytes, path, root, missing);
  if (unread != nullptr) *unread = missing;
  return has;
}

std::optional<Pose> camera_in(const Mesh& mesh, const std::string& source, const std::string& root, Scene::Up world_up) {
  using base::operator*;
  if (!is_gltf(mesh.file)) return std::nullopt;
  std::string path;
  const std::string bytes =
      files::read_reference(mesh.file, folder_beside(source), root, base::whole(source), path, base::limit::mesh_bytes);
  GltfFile file = read_gltf(bytes, path, root);
  const int animation = animation_of(file.model, mesh.animation, base::whole(source));
  std::optional<Pose> pose = camera_of(file.model, pose_at(file.model, animation, mesh.time_s));
  if (!pose) return pose;
  const Axes up = axes_of(mesh, world_up);
  pose->position = mesh.scale * turned(pose->position, up), pose->look_at = mesh.scale * turned(pose->look_at, up);
  pose->up = turned(pose->up, up);
  return pose;
}

}  // namespace tofray::assets
