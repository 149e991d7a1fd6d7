// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include "load/gltf_map.h"

#include <algorithm>
#include <cmath>

#include "image/read_image.h"

namespace tofray::load {

namespace {

/// IEC 61966-2-1, of all 16-bit samples.
const std::vector<float>& linear_of_srgb() {
  static const std::vector<float> table = [] {
    std::vector<float> out(65536);
    for (std::size_t i = 0; i < out.size(); ++i) {
      const double a = static_cast<double>(i) / 65535;
      out[i] = static_cast<float>(a <= 0.04045 ? a / 12.92 : std::pow((a + 0.055) / 1.055, 2.4));
    }
    return out;
  }();
  return table;
}

ReflectivityMap::Wrap wrap_of(gltf::Texture::Wrap wrap) {
  if (wrap == gltf::Texture::Wrap::clamp) return ReflectivityMap::Wrap::clamp;
  return wrap == gltf::Texture::Wrap::mirror ? ReflectivityMap::Wrap::mirror : ReflectivityMap::Wrap::repeat;
}

}  // namespace

double luminance(const std::array<double, 4>& color) { return std::min(0.2126 * color[0] + 0.7152 * color[1] + 0.0722 * color[2], 1.0); }

GltfMap map_of(const gltf::Model& model, const gltf::Material& material, const std::string& path) {
  const gltf::Texture& texture = model.textures[static_cast<std::size_t>(material.base_color_texture.texture)];
  const gltf::Image& file = model.images[static_cast<std::size_t>(texture.image)];
  const image::Image picture = image::read(file.bytes, path + ": image " + std::to_string(texture.image));
  const auto map = std::make_shared<ReflectivityMap>();
  map->width = picture.width, map->height = picture.height;
  map->wrap_u = wrap_of(texture.wrap_s), map->wrap_v = wrap_of(texture.wrap_t);
  map->values.reserve(static_cast<std::size_t>(picture.width) * static_cast<std::size_t>(picture.height));
  const std::vector<float>& linear = linear_of_srgb();
  const auto& factor = material.base_color;
  float brightest = 0;
  for (int y = 0; y < picture.height; ++y)
    for (int x = 0; x < picture.width; ++x) {
      const auto sample = [&](int channel) { return static_cast<double>(linear[picture.at(x, y, picture.channels < 3 ? 0 : channel)]); };
      const auto value = static_cast<float>(luminance({factor[0] * sample(0), factor[1] * sample(1), factor[2] * sample(2), 1}));
      brightest = std::max(brightest, value);
      map->values.push_back(value);
    }
  if (brightest > 0)
    for (float& value : map->values) value = std::min(value / brightest, 1.0F);
  return {map, static_cast<double>(brightest)};
}

std::array<float, 2> placed(const gltf::TextureUse& use, const std::array<float, 2>& texcoord) {
  const double c = std::cos(use.rotation_rad), s = std::sin(use.rotation_rad);
  const double u = use.scale[0] * static_cast<double>(texcoord[0]), v = use.scale[1] * static_cast<double>(texcoord[1]);
  return {static_cast<float>(use.offset[0] + c * u + s * v), static_cast<float>(use.offset[1] - s * u + c * v)};
}

}  // namespace tofray::load
