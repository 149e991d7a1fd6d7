// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <array>
#include <cstddef>
#include <memory>
#include <string>

#include "assets/picture_map.h"
#include "gltf/model.h"

namespace tofray::assets {

/// GGX has no narrower mirrors.
inline constexpr double least_alpha = 1e-3;

/// A material's picture of its base colour, times a colour.
/// @param opacity  as of map_of_picture()
/// @param path     the glTF file's, for messages
/// @throws Error as image::read
PictureMap map_of(const gltf::Model& model, const gltf::Material& material, const std::array<double, 3>& color,
                  const ReflectivityMap* opacity, const std::string& path);

/// Alpha from which on a material is a surface; 0: it is one everywhere.
double cutoff_of(const gltf::Material& material);
/// A material's picture of its alpha a, times its factor f, as an opacity: ½ + ½(f·a − cut-off), below ½ where it is cut out.
/// @return null where the picture has no alpha
/// @throws Error as image::read
std::shared_ptr<ReflectivityMap> opacity_of(const gltf::Model& model, const gltf::Material& material, const std::string& path);

/// Whose coordinates a material's triangles have: its first picture's, of base colour, of metal and roughness, of normals. Null: none.
const gltf::TextureUse* coordinates_of(const gltf::Material& material);
/// Whether a picture lies where those coordinates say.
bool lies_there(const gltf::TextureUse& use, const gltf::TextureUse& coordinates);

/// A material's picture of how normals lean, of unit length: 2c − 1 of red, green and blue c, the first two times its scale, the last one
/// 0.001 at least.
/// @param most  texels that it may have: larger pictures are reduced by means
/// @return null where the picture is grey
/// @throws Error as image::read
std::shared_ptr<VectorMap> normals_of(const gltf::Model& model, const gltf::Material& material, std::size_t most, const std::string& path);

/// Metal m (blue) and roughness r (green) of a material's picture times its factors, base colour of luminance ρ of its other picture, as
/// k_d = (1 − m)·ρ, F_0 = F·(1 − m) + m·ρ, α = r². The smaller picture is interpolated between the texels of the larger.
/// @param color  of the base
/// @param matt   F
/// @param most   as of normals_of()
/// @throws Error as image::read
std::shared_ptr<VectorMap> finish_of(const gltf::Model& model, const gltf::Material& material, const std::array<double, 3>& color,
                                     double matt, std::size_t most, const std::string& path);

/// Texture coordinates as the material's picture takes them (KHR_texture_transform).
std::array<float, 2> placed(const gltf::TextureUse& use, const std::array<float, 2>& texcoord);

}  // namespace tofray::assets
