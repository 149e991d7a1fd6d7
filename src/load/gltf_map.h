// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <array>
#include <string>

#include "gltf/model.h"
#include "load/picture_map.h"

namespace tofray::load {

/// A material's picture of its base colour, times a colour.
/// @param path  the glTF file's, for messages
/// @throws Error as image::read
PictureMap map_of(const gltf::Model& model, const gltf::Material& material, const std::array<double, 3>& color, const std::string& path);

/// Texture coordinates as the material's picture takes them (KHR_texture_transform).
std::array<float, 2> placed(const gltf::TextureUse& use, const std::array<float, 2>& texcoord);

}  // namespace tofray::load
