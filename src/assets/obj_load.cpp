// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include "assets/obj_load.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <iterator>
#include <map>
#include <optional>
#include <utility>

#include "assets/beside.h"
#include "assets/picture_map.h"
#include "base/limits.h"
#include "base/text.h"
#include "files/text_file.h"
#include "image/read_image.h"

namespace tofray::assets {

namespace {

constexpr float farthest_texcoord = 1e6F;
constexpr std::array<double, 3> white{1, 1, 1};
constexpr std::size_t most_left_out = 20;

/// What a file's own materials need may be missing or broken: the scene can do without.
template <class Read>
auto with_way_out(const Read& read) {
  try {
    return read();
  } catch (const Error& error) {
    throw Error(error.kind(), std::string(error.what()) +
                                  "\n  or give the object a reflectivity or a material: what its file says of materials is not read then");
  }
}

/// What is left of a limit that holds for all files of a kind together.
base::Limit rest_of(const base::Limit& all, std::size_t before) {
  return {all.name, all.value - static_cast<std::int64_t>(before), all.what};
}

std::string joined(const std::vector<std::string>& words) {
  std::string out;
  for (const std::string& word : words) out += (out.empty() ? "" : ", ") + word;
  return out;
}

/// Takes the triangles of one material after the other out of a mesh.
class Divider {
 public:
  explicit Divider(const TriangleMesh& mesh) : mesh_(mesh), place_(mesh.vertices.size(), -1) {}

  TriangleMesh piece(const std::vector<std::int32_t>& triangles) {
    TriangleMesh out;
    used_.clear();
    for (const std::int32_t i : triangles) {
      std::array<std::int32_t, 3> corners = mesh_.triangles[static_cast<std::size_t>(i)];
      for (std::int32_t& corner : corners) corner = place_of(corner);
      out.triangles.push_back(corners);
    }
    const auto take = [this](const auto& rows, auto& to) {
      if (rows.empty()) return;
      to.reserve(used_.size());
      for (const std::int32_t i : used_) to.push_back(rows[static_cast<std::size_t>(i)]);
    };
    take(mesh_.vertices, out.vertices), take(mesh_.normals, out.normals), take(mesh_.texcoords, out.texcoords),
        take(mesh_.shades, out.shades);
    for (const std::int32_t i : used_) place_[static_cast<std::size_t>(i)] = -1;
    return out;
  }

 private:
  std::int32_t place_of(std::int32_t vertex) {
    std::int32_t& place = place_[static_cast<std::size_t>(vertex)];
    if (place < 0) {
      place = static_cast<std::int32_t>(used_.size());
      used_.push_back(vertex);
    }
    return place;
  }

  const TriangleMesh& mesh_;
  std::vector<std::int32_t> place_, used_;  ///< of each vertex in the piece, and the other way round
};

/// The triangles of each material; the first are those of none.
std::vector<std::vector<std::int32_t>> by_material(const mesh::ReadMesh& mesh) {
  std::vector<std::vector<std::int32_t>> out(mesh.materials.size() + 1);
  for (std::size_t i = 0; i < mesh.mesh.triangles.size(); ++i)
    out[mesh.material_of.empty() ? 0 : static_cast<std::size_t>(mesh.material_of[i] + 1)].push_back(static_cast<std::int32_t>(i));
  return out;
}

/// Where a picture that is scaled and shifted is seen, v downward as before; 0 beyond what a mesh may have.
std::array<float, 2> placed(const mesh::MtlPicture& picture, const std::array<float, 2>& texcoord) {
  const auto u = static_cast<float>(picture.scale[0] * static_cast<double>(texcoord[0]) + picture.offset[0]);
  const auto v = static_cast<float>(1 - (picture.scale[1] * (1 - static_cast<double>(texcoord[1])) + picture.offset[1]));
  if (std::abs(u) <= farthest_texcoord && std::abs(v) <= farthest_texcoord) return {u, v};
  return {0, 0};
}

}  // namespace

bool is_obj(const std::string& path) { return mesh::suffix_of(path) == ".obj"; }

bool has_materials(std::string_view bytes, const std::string& path, const std::string& root, std::string& unread) {
  try {
    if (!is_obj(path)) {
      const mesh::ReadMesh mesh = mesh::parse(mesh::format_of(path, base::whole(path)), bytes, path);
      for (const mesh::Reference& picture : mesh.pictures) {
        if (read_beside(picture, files::folder_of(path), root, base::limit::mtl_image_bytes)) return true;
        if (unread.empty()) unread = picture.file;
      }
      if (!mesh.mesh.shades.empty()) unread.clear();
      return !mesh.mesh.shades.empty();
    }
    for (const mesh::Reference& file : mesh::libraries_of_obj(bytes, path)) {
      if (read_beside(file, files::folder_of(path), root, base::limit::mtl_bytes)) return true;
      if (unread.empty()) unread = file.file;
    }
    if (mesh::parse(mesh::Format::obj, bytes, path).mesh.shades.empty()) return false;
    unread.clear();
    return true;
  } catch (const Error&) {
    return false;  // whoever reads the mesh tells
  }
}

ObjMaterials::ObjMaterials(const mesh::ReadMesh& mesh, const std::string& path, const std::string& root) {
  with_way_out([&] { read_libraries(mesh, path, root); });
  for (const mesh::Reference& picture : mesh.pictures) {
    all_.push_back({picture.file, std::nullopt, std::nullopt, mesh::MtlPicture{picture}});
    folder_of_.push_back(files::folder_of(path));
  }
  std::map<std::string_view, int> places;
  for (std::size_t i = 0; i < all_.size(); ++i) twice_ += places.emplace(all_[i].name, static_cast<int>(i)).second ? 0U : 1U;
  if (const auto nameless = places.find(""); nameless != places.end()) nameless_ = nameless->second;
  for (const std::string& name : mesh.materials) {
    const auto found = places.find(name);
    known_.push_back(found == places.end() ? -1 : found->second);
  }
  picture_of_.assign(known_.size(), -1);
  if (mesh.mesh.texcoords.empty()) return;
  std::vector<bool> worn(known_.size());
  for (const std::int32_t i : mesh.material_of)
    if (i >= 0) worn[static_cast<std::size_t>(i)] = true;
  for (std::size_t i = 0; i < known_.size(); ++i)
    if (worn[i]) with_way_out([&] { read_picture(i, root); });
}

void ObjMaterials::read_libraries(const mesh::ReadMesh& mesh, const std::string& path, const std::string& root) {
  for (const mesh::Reference& library : mesh.libraries) {
    std::optional<Beside> file = read_beside(library, files::folder_of(path), root, rest_of(base::limit::mtl_bytes, bytes_.size()));
    if (!file) {
      lost_files_.push_back(base::in_quotes(library.file));
      continue;
    }
    if (!file->notice.empty()) notices_.push_back(file->notice);
    const std::string found = file->found;
    mesh::Mtl more = mesh::parse_mtl(file->bytes, found, static_cast<std::size_t>(base::limit::mtl_materials.value) - all_.size());
    bytes_ += file->bytes;
    all_.insert(all_.end(), std::make_move_iterator(more.materials.begin()), std::make_move_iterator(more.materials.end()));
    folder_of_.resize(all_.size(), files::folder_of(found));
    for (std::string& one : more.left_out)
      if (left_out_.size() < most_left_out && std::find(left_out_.begin(), left_out_.end(), one) == left_out_.end())
        left_out_.push_back(std::move(one));
  }
}

const mesh::MtlMaterial* ObjMaterials::material(int used) const {
  const int known = used < 0 ? nameless_ : known_[static_cast<std::size_t>(used)];
  return known < 0 ? nullptr : &all_[static_cast<std::size_t>(known)];
}

void ObjMaterials::read_picture(std::size_t used, const std::string& root) {
  const mesh::MtlMaterial* const of = material(static_cast<int>(used));
  if (of == nullptr || of->nir_reflectivity || !of->picture) return;
  const std::string& folder = folder_of_[static_cast<std::size_t>(known_[used])];
  const auto [known, is_new] = picture_at_.try_emplace(folder + "/" + of->picture->reference.file, static_cast<int>(pictures_.size()));
  if (is_new) {
    const std::optional<Beside> file =
        read_beside(of->picture->reference, folder, root, rest_of(base::limit::mtl_image_bytes, picture_bytes_));
    if (!file) {
      known->second = -1;
      lost_files_.push_back(base::in_quotes(of->picture->reference.file));
    } else {
      if (!file->notice.empty()) notices_.push_back(file->notice);
      pictures_.push_back({file->found, bytes_.size(), file->bytes.size()});
      picture_bytes_ += file->bytes.size();
      bytes_ += file->bytes;
    }
  }
  picture_of_[used] = known->second;
}

std::vector<MeshPiece> ObjMaterials::pieces(mesh::ReadMesh mesh, const base::Place& place, std::vector<std::string>& notices) const {
  std::vector<MeshPiece> out;
  std::vector<int> used;  // by each piece
  std::size_t vertices = 0;
  Divider divider(mesh.mesh);
  const std::vector<std::vector<std::int32_t>> triangles = by_material(mesh);
  for (std::size_t i = 0; i < triangles.size(); ++i) {
    if (triangles[i].empty()) continue;
    MeshPiece& piece = out.emplace_back();
    piece.mesh = divider.piece(triangles[i]);
    piece.of.name = i == 0 ? no_material : shown_name(mesh.materials[i - 1]);
    used.push_back(static_cast<int>(i) - 1);
    vertices += piece.mesh.vertices.size();
    if (vertices > static_cast<std::size_t>(base::limit::mesh_vertices.value))
      base::fail(place, "the mesh has too many vertices",
                 "at most " + std::to_string(base::limit::mesh_vertices.value) + " (`tofray --limits`), once for each material at them",
                 ErrorKind::limit);
  }
  out[0].left_out = mesh.not_finite;
  wear(out, used, notices);
  with_way_out([&] { wear_pictures(out, used, place); });
  return out;
}

void ObjMaterials::wear(std::vector<MeshPiece>& pieces, const std::vector<int>& used, std::vector<std::string>& notices) const {
  using From = FileMaterial::From;
  for (std::size_t i = 0; i < pieces.size(); ++i) {
    const mesh::MtlMaterial* const of = material(used[i]);
    FileMaterial& piece = pieces[i].of;
    if (of == nullptr || (!of->nir_reflectivity && !of->color && !of->picture)) {
      piece.from = used[i] < 0 ? From::nothing : From::colourless;
      if (!pieces[i].mesh.shades.empty()) piece.from = From::visible_colour, piece.material.diffuse = 1;
      continue;
    }
    pieces[i].mesh.shades.clear();  // its material says more
    const std::array<double, 3> color = of->color.value_or(white);
    piece.from = of->nir_reflectivity ? From::file : From::visible_colour;
    piece.material.diffuse = of->nir_reflectivity.value_or(luminance(color[0], color[1], color[2]));
    if (!of->nir_reflectivity && of->picture) piece.material.diffuse *= 0.5;  // until the picture is read
  }
  tell_of_files(notices);
  if (twice_ > 0)
    notices.push_back("materials that come twice in its MTL files (" + std::to_string(twice_) + "): the first of each counts");
  if (!left_out_.empty()) notices.push_back("of its materials is left out: " + joined(left_out_));
}

void ObjMaterials::tell_of_files(std::vector<std::string>& notices) const {
  notices.insert(notices.end(), notices_.begin(), notices_.end());
  if (!lost_files_.empty())
    notices.push_back("cannot be read and " + std::string(lost_files_.size() == 1 ? "is" : "are") + " left out: " + joined(lost_files_) +
                      "; files lie beside the one that names them or below (--root DIR widens that)");
}

void ObjMaterials::wear_pictures(std::vector<MeshPiece>& pieces, const std::vector<int>& used, const base::Place& place) const {
  std::vector<std::vector<std::size_t>> wearers(pictures_.size());
  for (std::size_t i = 0; i < pieces.size(); ++i)
    if (used[i] >= 0 && picture_of_[static_cast<std::size_t>(used[i])] >= 0)
      wearers[static_cast<std::size_t>(picture_of_[static_cast<std::size_t>(used[i])])].push_back(i);
  std::size_t texels = 0;
  // One picture after the other, each read once: they may be large.
  for (std::size_t k = 0; k < pictures_.size(); ++k) {
    const Picture& of = pictures_[k];
    const image::Image picture = image::read(std::string_view(bytes_).substr(of.from, of.size), of.path);
    for (const std::size_t i : wearers[k]) {
      count_texels(picture.width, picture.height, place, texels);
      const mesh::MtlMaterial& material = *this->material(used[i]);
      PictureMap map = map_of_picture(picture, material.color.value_or(white));
      if (material.picture->clamp) map.map->wrap_u = map.map->wrap_v = ReflectivityMap::Wrap::clamp;
      pieces[i].of.material.map = std::move(map.map), pieces[i].of.material.diffuse = map.brightest;
      for (auto& texcoord : pieces[i].mesh.texcoords) texcoord = placed(*material.picture, texcoord);
    }
  }
}

}  // namespace tofray::assets
