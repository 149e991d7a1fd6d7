// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <array>
#include <cstddef>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "assets/mesh_piece.h"
#include "base/faults.h"
#include "gltf/model.h"
#include "gltf/parts.h"

/// Materials of glTF files as a near-infrared camera sees them.
namespace tofray::assets {

/// What the vertices of one material's triangles say of its colour, linear: each of them, white where it says none, and their mean by area.
class VertexColors {
 public:
  using Color = std::array<double, 3>;
  void add(const gltf::Part& part);
  /// Whether any vertex says a colour.
  [[nodiscard]] bool any() const { return any_; }
  [[nodiscard]] bool vary() const { return vary_; }
  /// Whether the alpha of any vertex is below 1.
  [[nodiscard]] bool let_through() const { return let_through_; }
  /// White where none says one.
  [[nodiscard]] Color mean() const;
  /// Of each vertex of all parts, one part after the other.
  [[nodiscard]] const std::vector<std::array<float, 3>>& all() const { return all_; }

 private:
  void add(const Color& color, double area);

  std::optional<Color> first_;
  Color sum_{};
  double area_ = 0;
  std::vector<std::array<float, 3>> all_;
  bool any_ = false, vary_ = false, let_through_ = false;
};

/// The materials of one file.
///
///     metal m, roughness r, base colour of luminance ρ:   GGX with α = r², F_0 = F·(1 − m) + m·ρ, k_d = (1 − m)·ρ
///     F = s·((n − 1)/(n + 1))², 0.04 unless the file says a refractive index n or a factor s
///
/// Lambert of ρ where the file says no metal and roughness at all, is unlit, or says nir_reflectivity.
class GltfMaterials {
 public:
  /// @param path   the file's, for messages
  /// @param place  who names the file, where its pictures are too large together
  /// @throws Error (bad_input) where a material names one that tofray does not have
  GltfMaterials(const gltf::Model& model, const std::string& path, const base::Place& place);

  /// @param index           of the model, or none
  /// @param has_texcoords  whether its triangles have coordinates in its picture
  /// @throws Error as image::read; (limit) beyond limit::map_pixels
  FileMaterial worn(int index, const VertexColors& colors, bool has_texcoords);
  /// Luminance of the base colour times that of each vertex, over that of the base colour.
  [[nodiscard]] std::vector<float> shades(int index, const VertexColors& colors) const;

 private:
  /// Blue and green of a picture as the file has it, each 0 to 1: the factors of metal and roughness.
  struct Means {
    double metal = 1, roughness = 1;
  };
  Means means(const gltf::TextureUse& use);
  /// @param color  of the base
  /// @param mean   that, times the mean of its vertices' colours
  /// @param opacity  as of map_of()
  void guess(const gltf::Material& of, const std::array<double, 3>& color, const std::array<double, 3>& mean, bool has_texcoords,
             const ReflectivityMap* opacity, FileMaterial& out);
  void lean(const gltf::Material& of, bool has_texcoords, FileMaterial& out);
  /// Where it is a surface, as its alphas say; null: everywhere, or nowhere.
  std::shared_ptr<ReflectivityMap> cut_out(const gltf::Material& of, const VertexColors& colors, bool has_texcoords, FileMaterial& out);
  /// So many texels each picture of normals and of metal and roughness may have, so that those of all materials take no more memory than
  /// other pictures may.
  [[nodiscard]] std::size_t most_texels() const;
  [[nodiscard]] const Material& named(std::size_t index) const;

  const gltf::Model& model_;
  const std::string& path_;
  const base::Place& place_;
  std::size_t texels_ = 0;
  std::map<int, Means> means_;  ///< by image: each is read once
};

/// A material's name as listings and scenes have it, or its place among the file's.
std::string name_of(const gltf::Model& model, int index);

}  // namespace tofray::assets
