// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include "assets/gltf_material.h"

#include <algorithm>

#include "assets/gltf_map.h"
#include "assets/material_library.h"
#include "base/limits.h"
#include "base/text.h"
#include "base/vec.h"
#include "image/read_image.h"

namespace tofray::assets {

namespace {

std::array<double, 3> rgb(const std::array<double, 4>& base) { return {base[0], base[1], base[2]}; }

std::array<double, 3> product(const std::array<double, 3>& base, const std::array<double, 3>& color) {
  return {base[0] * color[0], base[1] * color[1], base[2] * color[2]};
}

/// What a surface that is no metal reflects at normal incidence.
double dielectric(const gltf::Material& of) {
  const double root = (of.ior - 1) / (of.ior + 1);
  return of.specular * root * root;
}

/// @param brightest, mean  luminance of the base colour: where its picture is brightest, and on the whole
Material finish(const gltf::Material& of, double metal, double roughness, double brightest, double mean) {
  Material out{"", Material::Brdf::lambert, brightest};
  if (!of.has_metallic_roughness || of.unlit) return out;
  out.brdf = Material::Brdf::ggx;
  out.diffuse = (1 - metal) * brightest;
  out.specular = dielectric(of) * (1 - metal) + metal * mean;
  out.alpha = std::max(least_alpha, roughness * roughness);
  return out;
}

}  // namespace

void VertexColors::add(const Color& color, double area) {
  if (!first_) first_ = color;
  vary_ = vary_ || color != *first_;
  area_ += area;
  for (std::size_t k = 0; k < 3; ++k) sum_[k] += area * color[k];
}

void VertexColors::add(const gltf::Part& part) {
  using base::operator-;
  any_ = any_ || !part.colors.empty();
  const auto color_of = [&](std::size_t vertex) {
    Color color{1, 1, 1};
    if (!part.colors.empty())
      for (std::size_t k = 0; k < 3; ++k) color[k] = std::clamp(static_cast<double>(part.colors[vertex][k]), 0.0, 1.0);
    return color;
  };
  for (const auto& color : part.colors) let_through_ = let_through_ || color[3] < 1;
  for (std::size_t i = 0; i < part.mesh.vertices.size(); ++i) {
    const Color color = color_of(i);
    all_.push_back({static_cast<float>(color[0]), static_cast<float>(color[1]), static_cast<float>(color[2])});
  }
  const auto corner = [&](std::int32_t vertex) {
    const auto& p = part.mesh.vertices[static_cast<std::size_t>(vertex)];
    return Vec3{static_cast<double>(p[0]), static_cast<double>(p[1]), static_cast<double>(p[2])};
  };
  for (const auto& [a, b, c] : part.mesh.triangles) {
    const double area = base::length(base::cross(corner(b) - corner(a), corner(c) - corner(a))) / 2;
    for (const std::int32_t vertex : {a, b, c}) add(color_of(static_cast<std::size_t>(vertex)), area / 3);
  }
}

std::array<double, 3> VertexColors::mean() const {
  if (!first_) return {1, 1, 1};
  return vary_ && area_ > 0 ? Color{sum_[0] / area_, sum_[1] / area_, sum_[2] / area_} : *first_;
}

GltfMaterials::GltfMaterials(const gltf::Model& model, const std::string& path, const base::Place& place)
    : model_(model), path_(path), place_(place) {
  for (std::size_t i = 0; i < model.materials.size(); ++i)
    if (model.materials[i].nir_material) (void)named(i);
}

const Material& GltfMaterials::named(std::size_t index) const {
  const std::string& name = *model_.materials[index].nir_material;
  if (const LibraryMaterial* known = find_library_material(name)) return known->material;
  std::vector<std::string> names;
  for (const LibraryMaterial& one : material_library()) names.push_back(one.material.name);
  base::fail(base::whole(path_),
             "materials[" + std::to_string(index) + "].extras.nir_material names no material of tofray" + base::did_you_mean(name, names),
             "got " + base::in_quotes(name) + ", of the material " + base::in_quotes(name_of(model_, static_cast<int>(index)), 200) +
                 "; `tofray list materials` names those that there are");
}

GltfMaterials::Means GltfMaterials::means(const gltf::TextureUse& use) {
  const int index = model_.textures[static_cast<std::size_t>(use.texture)].image;
  const auto [known, is_new] = means_.try_emplace(index);
  if (!is_new) return known->second;
  const gltf::Image& file = model_.images[static_cast<std::size_t>(index)];
  const image::Image picture = image::read(file.bytes, path_ + ": image " + std::to_string(index));
  count_texels(picture.width, picture.height, place_, texels_);
  std::uint64_t blue = 0, green = 0;
  for (int y = 0; y < picture.height; ++y)
    for (int x = 0; x < picture.width; ++x)
      blue += picture.at(x, y, picture.channels < 3 ? 0 : 2), green += picture.at(x, y, picture.channels < 3 ? 0 : 1);
  const double full = 65535.0 * picture.width * picture.height;
  known->second = {static_cast<double>(blue) / full, static_cast<double>(green) / full};
  return known->second;
}

std::size_t GltfMaterials::most_texels() const {
  constexpr std::size_t numbers = 3 + 5, largest = std::size_t{1} << 22;
  const std::size_t materials = std::max<std::size_t>(model_.materials.size(), 1);
  return std::min(largest, static_cast<std::size_t>(base::limit::map_pixels.value) / (numbers * materials));
}

void GltfMaterials::guess(const gltf::Material& of, const std::array<double, 3>& color, const std::array<double, 3>& mean_color,
                          bool has_texcoords, const ReflectivityMap* opacity, FileMaterial& out) {
  const gltf::TextureUse &base = of.base_color_texture, &of_finish = of.metallic_roughness_texture;
  const bool has_base = base.texture != gltf::none, has_finish = of_finish.texture != gltf::none && !of.unlit;
  double metal = of.metallic, roughness = of.roughness;
  if (has_finish) {
    const Means of_picture = means(of_finish);
    metal *= of_picture.metal, roughness *= of_picture.roughness;
  }
  double brightest = luminance(color[0], color[1], color[2]), mean = luminance(mean_color[0], mean_color[1], mean_color[2]);
  PictureMap picture;
  if (has_base && !has_texcoords) {
    brightest *= 0.5, mean *= 0.5;  // nobody knows where on the picture its triangles are
  } else if (has_base) {
    picture = map_of(model_, of, color, opacity, path_);
    count_texels(picture.map->width, picture.map->height, place_, texels_);
    mean *= brightest > 0 ? picture.mean / brightest : 1;
    brightest = picture.brightest;
  }
  out.material = finish(of, metal, roughness, brightest, mean);
  if (has_finish && has_texcoords && lies_there(of_finish, *coordinates_of(of))) {
    out.material.finish = finish_of(model_, of, color, dielectric(of), most_texels(), path_);
    return;
  }
  out.mean_finish = has_finish;
  if (out.material.diffuse > 0 || out.material.brdf == Material::Brdf::lambert) out.material.map = std::move(picture.map);
}

void GltfMaterials::lean(const gltf::Material& of, bool has_texcoords, FileMaterial& out) {
  const gltf::TextureUse& use = of.normal_texture;
  if (use.texture == gltf::none || of.unlit) return;
  std::shared_ptr<VectorMap> map;
  if (has_texcoords && lies_there(use, *coordinates_of(of))) map = normals_of(model_, of, most_texels(), path_);
  out.lost_normals = map == nullptr;
  out.material.normals = std::move(map);
}

std::shared_ptr<ReflectivityMap> GltfMaterials::cut_out(const gltf::Material& of, const VertexColors& colors, bool has_texcoords,
                                                        FileMaterial& out) {
  const double cutoff = cutoff_of(of);
  if (!(cutoff > 0)) return nullptr;
  const bool has_picture = of.base_color_texture.texture != gltf::none;
  out.lost_alpha = colors.let_through() || (has_picture && !has_texcoords);
  std::shared_ptr<ReflectivityMap> map;
  if (has_picture && has_texcoords) map = opacity_of(model_, of, path_);
  if (map == nullptr) {
    out.nowhere = of.base_color[3] < cutoff;
    out.lets_through = of.alpha == gltf::Material::Alpha::blend && of.base_color[3] < 1;
    return nullptr;
  }
  count_texels(map->width, map->height, place_, texels_);
  const auto [least, most] = std::minmax_element(map->values.begin(), map->values.end());
  out.nowhere = *most < 0.5F;
  out.lets_through = of.alpha == gltf::Material::Alpha::blend && *least < 0.75F;  // where an alpha is below 1
  return *least < 0.5F && !out.nowhere ? map : nullptr;
}

FileMaterial GltfMaterials::worn(int index, const VertexColors& colors, bool has_texcoords) {
  FileMaterial out;
  out.name = name_of(model_, index);
  const std::array<double, 3> mean = colors.mean();
  if (index == gltf::none) {
    if (!colors.any()) return out;
    out.from = FileMaterial::From::visible_colour, out.varying_color = colors.vary();
    out.material.diffuse = colors.vary() ? 1 : luminance(mean[0], mean[1], mean[2]);
    return out;
  }
  const gltf::Material& of = model_.materials[static_cast<std::size_t>(index)];
  out.from = FileMaterial::From::file;
  std::shared_ptr<ReflectivityMap> opacity = cut_out(of, colors, has_texcoords, out);
  if (of.nir_material) {
    out.material = named(static_cast<std::size_t>(index));
  } else if (of.nir_reflectivity) {
    out.material.diffuse = *of.nir_reflectivity;
  } else {
    out.from = FileMaterial::From::visible_colour, out.varying_color = colors.vary();
    const std::array<double, 3> color = rgb(of.base_color), all = product(color, mean);
    guess(of, colors.vary() ? color : all, all, has_texcoords, opacity.get(), out);
    out.mean_color = colors.vary() && out.material.brdf == Material::Brdf::ggx && of.metallic > 0;
  }
  lean(of, has_texcoords, out);
  out.material.opacity = std::move(opacity);
  return out;
}

std::vector<float> GltfMaterials::shades(int index, const VertexColors& colors) const {
  const std::array<double, 3> base =
      index == gltf::none ? std::array<double, 3>{1, 1, 1} : rgb(model_.materials[static_cast<std::size_t>(index)].base_color);
  const double white = luminance(base[0], base[1], base[2]);
  std::vector<float> out;
  for (const auto& [red, green, blue] : colors.all()) {
    const double here =
        luminance(base[0] * static_cast<double>(red), base[1] * static_cast<double>(green), base[2] * static_cast<double>(blue));
    out.push_back(white > 0 ? std::min(static_cast<float>(here / white), 1.0F) : 1.0F);
  }
  return out;
}

std::string name_of(const gltf::Model& model, int index) {
  if (index == gltf::none) return no_material;
  const std::string& name = model.materials[static_cast<std::size_t>(index)].name;
  return name.empty() ? "material " + std::to_string(index) : shown_name(name);
}

}  // namespace tofray::assets
