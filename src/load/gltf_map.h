// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <array>
#include <memory>
#include <string>

#include "gltf/model.h"

namespace tofray::load {

/// Relative luminance (ITU-R BT.709) of a linear colour, 1 at most.
double luminance(const std::array<double, 4>& color);

/// A material's picture of its base colour as one of reflectivities: the luminance of each texel, decoded from sRGB, times the colour's
/// factor, over the brightest one.
struct GltfMap {
  std::shared_ptr<const ReflectivityMap> map;
  double brightest = 0;
};
/// @param path  the glTF file's, for messages
/// @throws Error as image::read
GltfMap map_of(const gltf::Model& model, const gltf::Material& material, const std::string& path);

/// Texture coordinates as the material's picture takes them (KHR_texture_transform).
std::array<float, 2> placed(const gltf::TextureUse& use, const std::array<float, 2>& texcoord);

}  // namespace tofray::load
