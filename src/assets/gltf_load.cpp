// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include "assets/gltf_load.h"

#include <algorithm>
#include <charconv>
#include <map>
#include <utility>

#include "assets/beside.h"
#include "assets/gltf_map.h"
#include "assets/gltf_material.h"
#include "base/limits.h"
#include "base/text.h"
#include "base/vec.h"
#include "files/sha256.h"
#include "files/text_file.h"
#include "gltf/parts.h"
#include "gltf/read.h"
#include "mesh/read_mesh.h"

namespace tofray::assets {

namespace {

/// What one more part of a piece has, zeros where it lacks what others have.
template <class Row>
void append_details(const std::vector<Row>& more, std::size_t before, std::size_t after, std::vector<Row>& rows) {
  if (more.empty() && rows.empty()) return;
  rows.resize(before);
  rows.insert(rows.end(), more.begin(), more.end());
  rows.resize(after);
}

/// @param use  how the material takes texture coordinates; null where it takes none
void append(const gltf::Part& part, const gltf::TextureUse* use, TriangleMesh& mesh) {
  const std::size_t before = mesh.vertices.size(), after = before + part.mesh.vertices.size();
  mesh.vertices.insert(mesh.vertices.end(), part.mesh.vertices.begin(), part.mesh.vertices.end());
  const auto first = static_cast<std::int32_t>(before);
  for (const auto& [a, b, c] : part.mesh.triangles) mesh.triangles.push_back({first + a, first + b, first + c});
  append_details(part.normals, before, after, mesh.normals);
  if (use == nullptr) return;
  std::vector<std::array<float, 2>> texcoords = part.texcoords[static_cast<std::size_t>(use->texcoord)];
  for (auto& one : texcoords) one = placed(*use, one);
  append_details(texcoords, before, after, mesh.texcoords);
}

/// How the pictures that a part's material shows lie on it, if there are any.
const gltf::TextureUse* coordinates_in(const gltf::Model& model, int material) {
  return material == gltf::none ? nullptr : coordinates_of(model.materials[static_cast<std::size_t>(material)]);
}

}  // namespace

bool is_gltf(const std::string& path) {
  const std::string suffix = mesh::suffix_of(path);
  return suffix == ".gltf" || suffix == ".glb";
}

GltfFile read_gltf(std::string_view bytes, const std::string& path, const std::string& root) {
  std::string all;  // with those of other files, where there are any
  const auto other = [&](const std::string& name, std::size_t most) {
    const base::Limit limit{base::limit::mesh_bytes.name, static_cast<std::int64_t>(most), ""};
    std::string found;
    std::string more = files::read_reference(name, files::folder_of(path), root, base::whole(path), found, limit);
    NamedReads::note(false, name, files::folder_of(path), root, limit, &more, found);
    if (all.empty()) all = bytes;
    all += more;
    return more;
  };
  GltfFile out{gltf::read(path, bytes, other), {}};
  out.sha256 = files::sha256_hex(all.empty() ? bytes : all);
  return out;
}

namespace {

/// All channels; of two that move the same thing, the last.
gltf::Animation all_at_once(const gltf::Model& model) {
  gltf::Animation out;
  out.name = "all";
  std::map<std::pair<int, gltf::Channel::Path>, std::size_t> found;
  for (const gltf::Animation& one : model.animations)
    for (const gltf::Channel& channel : one.channels) {
      const auto [at, is_new] = found.emplace(std::pair{channel.node, channel.path}, out.channels.size());
      if (is_new)
        out.channels.push_back(channel);
      else
        out.channels[at->second] = channel;
    }
  for (const gltf::Channel& channel : out.channels) {
    const bool first = &channel == &out.channels.front();
    out.start_s = first ? channel.times_s->front() : std::min<double>(out.start_s, channel.times_s->front());
    out.end_s = first ? channel.times_s->back() : std::max<double>(out.end_s, channel.times_s->back());
  }
  return out;
}

std::string names_of(const std::vector<gltf::Animation>& animations) {
  constexpr std::size_t most = 20;
  std::vector<std::string> names;
  for (std::size_t i = 0; i < animations.size() && i < most; ++i) names.push_back(base::in_quotes(animations[i].name));
  if (animations.size() > most) names.push_back(std::to_string(animations.size() - most) + " more");
  return base::listed(names, "and");
}

}  // namespace

int animation_of(gltf::Model& model, const std::string& wanted, const base::Place& place) {
  const std::vector<gltf::Animation>& all = model.animations;
  if (wanted.empty()) return all.empty() ? gltf::none : 0;
  for (std::size_t i = 0; i < all.size(); ++i)
    if (all[i].name == wanted) return static_cast<int>(i);
  if (wanted == "all" && !all.empty()) {
    model.animations.push_back(all_at_once(model));
    return static_cast<int>(all.size()) - 1;
  }
  std::size_t number = 0;
  const auto [end, fault] = std::from_chars(wanted.data(), wanted.data() + wanted.size(), number);
  if (fault == std::errc() && end == wanted.data() + wanted.size() && number < all.size()) return static_cast<int>(number);
  base::fail(place, "there is no animation " + base::in_quotes(wanted),
             all.empty()
                 ? "the file has none"
                 : "expected a name, a number from 0 to " + std::to_string(all.size() - 1) + ", or all; the file has " + names_of(all));
}

gltf::Pose pose_at(const gltf::Model& model, int animation, const std::optional<double>& time_s) {
  return gltf::at(model, time_s ? animation : gltf::none, time_s.value_or(0));
}

std::vector<MeshPiece> pieces_of(const gltf::Model& model, const gltf::Pose& pose, bool by_material, const std::string& path,
                                 const base::Place& place) {
  std::map<int, MeshPiece> found;
  std::map<int, VertexColors> colors;
  for (const gltf::Part& part : gltf::parts(model, pose)) {
    MeshPiece& piece = found[by_material ? part.material : gltf::none];
    append(part, by_material ? coordinates_in(model, part.material) : nullptr, piece.mesh);
    piece.left_out += part.not_finite;
    if (by_material) colors[part.material].add(part);
  }
  std::vector<MeshPiece> out;
  for (auto& [material, piece] : found) piece.by_material = by_material, piece.number = material;
  if (by_material) {
    GltfMaterials materials(model, path, place);
    for (auto& [material, piece] : found) {
      piece.of = materials.worn(material, colors[material], !piece.mesh.texcoords.empty());
      if (piece.of.varying_color) piece.mesh.shades = materials.shades(material, colors[material]);
    }
  }
  for (auto& [material, piece] : found) out.push_back(std::move(piece));
  return out;
}

std::optional<Pose> camera_of(const gltf::Model& model, const gltf::Pose& pose) {
  using base::operator-;
  for (std::size_t i = 0; i < model.nodes.size(); ++i) {
    const int camera = model.nodes[i].camera;
    if (camera == gltf::none || pose.in_scene[i] == 0 || !model.cameras[static_cast<std::size_t>(camera)].perspective) continue;
    const gltf::Matrix& world = pose.world[i];
    const auto column = [&](std::size_t k) { return Vec3{world[0][k], world[1][k], world[2][k]}; };
    const Vec3 position = column(3), up = column(1), back = column(2);
    if (!(base::length(up) > 0 && base::length(back) > 0)) continue;
    return Pose{position, position - base::normalized(back), base::normalized(up)};
  }
  return std::nullopt;
}

}  // namespace tofray::assets
