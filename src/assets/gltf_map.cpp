// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include "assets/gltf_map.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "base/constants.h"
#include "base/vec.h"
#include "image/read_image.h"
#include "num/setup_math.h"

namespace tofray::assets {

namespace {

ReflectivityMap::Wrap wrap_of(gltf::Texture::Wrap wrap) {
  if (wrap == gltf::Texture::Wrap::clamp) return ReflectivityMap::Wrap::clamp;
  return wrap == gltf::Texture::Wrap::mirror ? ReflectivityMap::Wrap::mirror : ReflectivityMap::Wrap::repeat;
}

const gltf::Texture& texture_of(const gltf::Model& model, const gltf::TextureUse& use) {
  return model.textures[static_cast<std::size_t>(use.texture)];
}

image::Image read_picture_of(const gltf::Model& model, const gltf::TextureUse& use, const std::string& path) {
  const int image = texture_of(model, use).image;
  return image::read(model.images[static_cast<std::size_t>(image)].bytes, path + ": image " + std::to_string(image));
}

double share(const image::Image& picture, int x, int y, int channel) {
  return static_cast<double>(picture.at(x, y, picture.channels < 3 ? 0 : channel)) / 65535;
}

int wrapped(int i, int size, gltf::Texture::Wrap wrap) {
  if (wrap == gltf::Texture::Wrap::repeat) return (i + size) % size;
  return std::clamp(i, 0, size - 1);
}

/// What value(x, y) of a picture's texels has in texel (column, row) of `of`: the mean of those within along a side on which the picture has
/// more, bilinear between their middles along one on which it has fewer.
template <class Value>
double within(const image::Image& picture, const gltf::Texture& wrap, const VectorMap& of, int column, int row, const Value& value) {
  struct Side {
    int first, last;
    double share;  ///< of the last one, where there are two of a side that has fewer
    bool fewer;
  };
  const auto side = [](int i, int from, int to) {
    if (from >= to) {
      const auto edge = [&](int k) { return static_cast<int>(std::int64_t{k} * from / to); };
      return Side{edge(i), std::max(edge(i + 1) - 1, edge(i)), 0, false};
    }
    const double place = (i + 0.5) * from / to - 0.5;
    const int first = static_cast<int>(std::floor(place));
    return Side{first, first + 1, place - first, true};
  };
  const Side x = side(column, picture.width, of.width), y = side(row, picture.height, of.height);
  const auto share = [](const Side& s, int k) { return s.fewer ? (k == s.last ? s.share : 1 - s.share) : 1.0 / (s.last - s.first + 1); };
  double sum = 0;
  for (int j = y.first; j <= y.last; ++j)
    for (int i = x.first; i <= x.last; ++i)
      sum += share(x, i) * share(y, j) * value(wrapped(i, picture.width, wrap.wrap_s), wrapped(j, picture.height, wrap.wrap_t));
  return sum;
}

std::shared_ptr<VectorMap> vector_map(const gltf::Texture& texture, int width, int height, std::size_t most) {
  auto map = std::make_shared<VectorMap>();
  const auto texels = [&] { return static_cast<std::size_t>(width) * static_cast<std::size_t>(height); };
  while (texels() > std::max<std::size_t>(most, 1)) width = std::max(1, width / 2), height = std::max(1, height / 2);
  map->width = width, map->height = height;
  map->wrap_u = wrap_of(texture.wrap_s), map->wrap_v = wrap_of(texture.wrap_t);
  map->values.reserve(texels());
  return map;
}

}  // namespace

const gltf::TextureUse* coordinates_of(const gltf::Material& material) {
  for (const gltf::TextureUse* use : {&material.base_color_texture, &material.metallic_roughness_texture, &material.normal_texture})
    if (use->texture != gltf::none) return use;
  return nullptr;
}

bool lies_there(const gltf::TextureUse& use, const gltf::TextureUse& coordinates) {
  return use.texcoord == coordinates.texcoord && use.offset == coordinates.offset && use.scale == coordinates.scale &&
         use.rotation_rad == coordinates.rotation_rad;
}

std::shared_ptr<VectorMap> normals_of(const gltf::Model& model, const gltf::Material& material, std::size_t most, const std::string& path) {
  constexpr double least = 1e-3;
  const image::Image picture = read_picture_of(model, material.normal_texture, path);
  if (picture.channels < 3) return nullptr;
  const gltf::Texture& wrap = texture_of(model, material.normal_texture);
  auto map = vector_map(wrap, picture.width, picture.height, most);
  for (int y = 0; y < map->height; ++y)
    for (int x = 0; x < map->width; ++x) {
      const auto part = [&](int channel) {
        return 2 * within(picture, wrap, *map, x, y, [&](int i, int j) { return share(picture, i, j, channel); }) - 1;
      };
      const Vec3 lean{material.normal_scale * part(0), material.normal_scale * part(1), std::max(part(2), least)};
      const Vec3 n = base::normalized(lean);
      map->values.push_back({static_cast<float>(n[0]), static_cast<float>(n[1]), std::max(static_cast<float>(n[2]), 1e-6F)});
    }
  return map;
}

std::shared_ptr<VectorMap> finish_of(const gltf::Model& model, const gltf::Material& material, const std::array<double, 3>& color,
                                     double matt, std::size_t most, const std::string& path) {
  const gltf::TextureUse& of_finish = material.metallic_roughness_texture;
  const gltf::Texture& wrap = texture_of(model, of_finish);
  const image::Image finish = read_picture_of(model, of_finish, path);
  const bool has_base = material.base_color_texture.texture != gltf::none;
  const image::Image base = has_base ? read_picture_of(model, material.base_color_texture, path) : image::Image{};
  const double plain = luminance(color[0], color[1], color[2]);
  auto map = vector_map(wrap, std::max(finish.width, base.width), std::max(finish.height, base.height), most);
  for (int y = 0; y < map->height; ++y)
    for (int x = 0; x < map->width; ++x) {
      const auto factor = [&](int channel) {
        return within(finish, wrap, *map, x, y, [&](int i, int j) { return share(finish, i, j, channel); });
      };
      const double metal = material.metallic * factor(2), roughness = material.roughness * factor(1);
      const double rho = has_base ? within(base, texture_of(model, material.base_color_texture), *map, x, y,
                                           [&](int i, int j) { return luminance_at(base, i, j, color); })
                                  : plain;
      map->values.push_back({static_cast<float>((1 - metal) * rho), static_cast<float>(matt * (1 - metal) + metal * rho),
                             static_cast<float>(std::max(least_alpha, roughness * roughness))});
    }
  return map;
}

double cutoff_of(const gltf::Material& material) {
  if (material.alpha == gltf::Material::Alpha::opaque) return 0;
  return material.alpha == gltf::Material::Alpha::blend ? 0.5 : material.alpha_cutoff;
}

std::shared_ptr<ReflectivityMap> opacity_of(const gltf::Model& model, const gltf::Material& material, const std::string& path) {
  const image::Image picture = read_picture_of(model, material.base_color_texture, path);
  if (picture.channels != 2 && picture.channels != 4) return nullptr;
  const gltf::Texture& texture = texture_of(model, material.base_color_texture);
  auto map = std::make_shared<ReflectivityMap>();
  map->width = picture.width, map->height = picture.height;
  map->wrap_u = wrap_of(texture.wrap_s), map->wrap_v = wrap_of(texture.wrap_t);
  map->values.reserve(static_cast<std::size_t>(picture.width) * static_cast<std::size_t>(picture.height));
  const float below = std::nextafter(0.5F, 0.0F);
  const double factor = material.base_color[3], cutoff = cutoff_of(material);
  for (int y = 0; y < picture.height; ++y)
    for (int x = 0; x < picture.width; ++x) {
      const double alpha = static_cast<double>(picture.at(x, y, picture.channels - 1)) / 65535;
      const double beyond = std::max(factor * alpha - cutoff, -1.0);
      const auto opacity = static_cast<float>(0.5 + 0.5 * beyond);
      map->values.push_back(beyond < 0 ? std::min(opacity, below) : opacity);
    }
  return map;
}

PictureMap map_of(const gltf::Model& model, const gltf::Material& material, const std::array<double, 3>& color,
                  const ReflectivityMap* opacity, const std::string& path) {
  const gltf::Texture& texture = texture_of(model, material.base_color_texture);
  PictureMap out = map_of_picture(read_picture_of(model, material.base_color_texture, path), color, opacity);
  out.map->wrap_u = wrap_of(texture.wrap_s), out.map->wrap_v = wrap_of(texture.wrap_t);
  return out;
}

std::array<float, 2> placed(const gltf::TextureUse& use, const std::array<float, 2>& texcoord) {
  const double turn = std::remainder(use.rotation_rad, base::two_pi);  // exact
  const double c = num::setup::cos(turn), s = num::setup::sin(turn);
  const double u = use.scale[0] * static_cast<double>(texcoord[0]), v = use.scale[1] * static_cast<double>(texcoord[1]);
  return {static_cast<float>(use.offset[0] + c * u + s * v), static_cast<float>(use.offset[1] - s * u + c * v)};
}

}  // namespace tofray::assets
