// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include "load/gltf_map.h"

#include <cmath>

#include "image/read_image.h"

namespace tofray::load {

namespace {

ReflectivityMap::Wrap wrap_of(gltf::Texture::Wrap wrap) {
  if (wrap == gltf::Texture::Wrap::clamp) return ReflectivityMap::Wrap::clamp;
  return wrap == gltf::Texture::Wrap::mirror ? ReflectivityMap::Wrap::mirror : ReflectivityMap::Wrap::repeat;
}

}  // namespace

PictureMap map_of(const gltf::Model& model, const gltf::Material& material, const std::array<double, 3>& color, const std::string& path) {
  const gltf::Texture& texture = model.textures[static_cast<std::size_t>(material.base_color_texture.texture)];
  const gltf::Image& file = model.images[static_cast<std::size_t>(texture.image)];
  PictureMap out = map_of_picture(image::read(file.bytes, path + ": image " + std::to_string(texture.image)), color);
  out.map->wrap_u = wrap_of(texture.wrap_s), out.map->wrap_v = wrap_of(texture.wrap_t);
  return out;
}

std::array<float, 2> placed(const gltf::TextureUse& use, const std::array<float, 2>& texcoord) {
  const double c = std::cos(use.rotation_rad), s = std::sin(use.rotation_rad);
  const double u = use.scale[0] * static_cast<double>(texcoord[0]), v = use.scale[1] * static_cast<double>(texcoord[1]);
  return {static_cast<float>(use.offset[0] + c * u + s * v), static_cast<float>(use.offset[1] - s * u + c * v)};
}

}  // namespace tofray::load
