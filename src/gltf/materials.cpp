// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
// Materials, and the textures and images that they use. Images are not decoded.
#include <fmt/core.h>

#include <limits>

#include "base/limits.h"
#include "base/text.h"
#include "gltf/reading.h"
#include "gltf/uri.h"

namespace tofray::gltf {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

Texture::Wrap wrap_of(const Item& sampler, std::string_view key) {
  switch (sampler.count(key).value_or(10497)) {
    case 10497: return Texture::Wrap::repeat;
    case 33648: return Texture::Wrap::mirror;
    case 33071: return Texture::Wrap::clamp;
    default:
      sampler.fail_at(key, "is no way to wrap",
                      fmt::format("got {}, expected 10497 (repeat), 33648 (mirrored) or 33071 (clamp)", *sampler.count(key)));
  }
}

void read_textures(Reading& reading) {
  const std::vector<Item> samplers = reading.root.objects("samplers");
  const std::size_t images = reading.root.size("images");
  for (const Item& item : reading.root.objects("textures")) {
    Texture texture;
    texture.image = item.index("source", images, "images");
    if (const int sampler = item.index("sampler", samplers.size(), "samplers"); sampler != none) {
      texture.wrap_s = wrap_of(samplers[static_cast<std::size_t>(sampler)], "wrapS");
      texture.wrap_t = wrap_of(samplers[static_cast<std::size_t>(sampler)], "wrapT");
    }
    reading.model.textures.push_back(texture);
  }
}

int texcoord_of(const Item& item, int fallback) {
  constexpr auto any = static_cast<std::size_t>(std::numeric_limits<int>::max());
  const int set = item.index("texCoord", any, "sets of texture coordinates");
  return set == none ? fallback : set;
}

void read_transform(const Item& item, TextureUse& use) {
  const auto extensions = item.object("extensions");
  const auto transform = extensions ? extensions->object("KHR_texture_transform") : std::nullopt;
  if (!transform) return;
  transform->numbers("offset", use.offset);
  transform->numbers("scale", use.scale);
  use.rotation_rad = transform->number_or("rotation", 0);
  use.texcoord = texcoord_of(*transform, use.texcoord);
}

TextureUse texture_use(Reading& reading, const Item& parent, std::string_view key) {
  TextureUse use;
  const auto item = parent.object(key);
  if (!item) return use;
  use.texture = item->required_index("index", reading.model.textures.size(), "textures");
  use.texcoord = texcoord_of(*item, 0);
  read_transform(*item, use);
  if (reading.model.textures[static_cast<std::size_t>(use.texture)].image == none) {
    reading.notices.add("textures without an image are left out");
    return {};
  }
  if (use.texcoord > 1) {
    reading.notices.add("textures at texture coordinates beyond set 1 are left out");
    return {};
  }
  return use;
}

void read_metallic_roughness(Reading& reading, const Item& item, Material& material) {
  const auto pbr = item.object("pbrMetallicRoughness");
  if (!pbr) return;
  material.has_metallic_roughness = true;
  pbr->numbers("baseColorFactor", material.base_color);
  for (const double part : material.base_color)
    if (!(part >= 0 && part <= 1))
      pbr->fail_at("baseColorFactor", "is out of range", "got " + base::number_text(part) + ", expected 0 to 1 each");
  material.metallic = pbr->number_within("metallicFactor", 0, 1, 1);
  material.roughness = pbr->number_within("roughnessFactor", 0, 1, 1);
  material.base_color_texture = texture_use(reading, *pbr, "baseColorTexture");
  material.metallic_roughness_texture = texture_use(reading, *pbr, "metallicRoughnessTexture");
}

Material::Alpha alpha_of(const Item& item) {
  const std::string_view mode = item.text("alphaMode").value_or("OPAQUE");
  if (mode == "OPAQUE") return Material::Alpha::opaque;
  if (mode == "MASK") return Material::Alpha::mask;
  if (mode == "BLEND") return Material::Alpha::blend;
  item.fail_at("alphaMode", "is none", "got " + base::in_quotes(mode) + ", expected OPAQUE, MASK or BLEND");
}

void leave_out_emission(Reading& reading, const Item& item) {
  std::array<double, 3> factor{0, 0, 0};
  item.numbers("emissiveFactor", factor);
  if (factor != std::array<double, 3>{0, 0, 0}) reading.notices.add("light that materials emit is left out");
  if (item.object("occlusionTexture")) reading.notices.add("occlusion textures are left out: shadows are computed");
}

/// What people add to a material by hand. Extras may be anything else, too.
void read_extras(const Item& item, Material& material) {
  const files::Json* value = item.find("extras");
  if (value == nullptr || !value->is_object()) return;
  const Item extras = item.required_object("extras");
  if (extras.has("nir_reflectivity")) material.nir_reflectivity = extras.number_within("nir_reflectivity", 0, 1, 0);
  if (extras.has("nir_material")) material.nir_material = extras.required_text("nir_material");
  if (material.nir_reflectivity && material.nir_material)
    extras.fail("has nir_reflectivity and nir_material", "these keys say the same thing; keep one of them");
}

void read_specular(Reading& reading, const Item& item, Material& material) {
  material.specular = item.number_within("specularFactor", 0, 1, 1);
  std::array<double, 3> color{1, 1, 1};
  item.numbers("specularColorFactor", color);
  if (color != std::array<double, 3>{1, 1, 1} || item.has("specularTexture") || item.has("specularColorTexture"))
    reading.notices.add("colours and textures of KHR_materials_specular are left out");
}

/// The older way to say metal and roughness: what is diffuse becomes the base colour of what is no metal.
void read_specular_glossiness(Reading& reading, const Item& item, Material& material) {
  item.numbers("diffuseFactor", material.base_color);
  for (const double part : material.base_color)
    if (!(part >= 0 && part <= 1))
      item.fail_at("diffuseFactor", "is out of range", "got " + base::number_text(part) + ", expected 0 to 1 each");
  material.has_metallic_roughness = true;
  material.metallic = 0, material.roughness = 1 - item.number_within("glossinessFactor", 0, 1, 1);
  material.base_color_texture = texture_use(reading, item, "diffuseTexture");
  reading.notices.add("diffuse colours of KHR_materials_pbrSpecularGlossiness are taken for base colours, its specular ones are left out");
}

void read_extensions(Reading& reading, const Item& item, Material& material) {
  const auto extensions = item.object("extensions");
  if (!extensions) return;
  if (const auto older = extensions->object("KHR_materials_pbrSpecularGlossiness"); older && !material.has_metallic_roughness)
    read_specular_glossiness(reading, *older, material);
  material.unlit = extensions->has("KHR_materials_unlit");
  if (const auto specular = extensions->object("KHR_materials_specular")) read_specular(reading, *specular, material);
  const auto refraction = extensions->object("KHR_materials_ior");
  if (!refraction) return;
  material.ior = refraction->number_or("ior", 1.5);
  if (material.ior != 0 && !(material.ior >= 1))
    refraction->fail_at("ior", "is out of range", "got " + base::number_text(material.ior) + ", expected 1 or more, or 0");
}

Material read_material(Reading& reading, const Item& item) {
  Material material;
  material.name = item.name();
  read_metallic_roughness(reading, item, material);
  material.normal_texture = texture_use(reading, item, "normalTexture");
  if (const auto normal = item.object("normalTexture")) material.normal_scale = normal->number_or("scale", 1);
  leave_out_emission(reading, item);
  material.alpha = alpha_of(item);
  material.alpha_cutoff = item.number_within("alphaCutoff", 0, infinity, 0.5);
  material.double_sided = item.flag_or("doubleSided", false);
  read_extensions(reading, item, material);
  read_extras(item, material);
  return material;
}

/// Which images a material's texture uses.
std::vector<bool> used_images(const Model& model, std::size_t images) {
  std::vector<bool> used(images);
  for (const Material& material : model.materials)
    for (const TextureUse* use : {&material.base_color_texture, &material.metallic_roughness_texture, &material.normal_texture})
      if (use->texture != none) used[static_cast<std::size_t>(model.textures[static_cast<std::size_t>(use->texture)].image)] = true;
  return used;
}

std::string type_of(std::string_view bytes) {
  if (bytes.starts_with("\x89PNG\r\n\x1A\n")) return "image/png";
  return bytes.starts_with("\xFF\xD8\xFF") ? "image/jpeg" : "";
}

/// @param most  bytes that it may have
Image read_image(const Reading& reading, const Item& item, bool used, std::size_t most) {
  Image image;
  image.name = item.name();
  image.mime_type = std::string(item.text("mimeType").value_or(""));
  const int view = item.index("bufferView", reading.buffers.views(), "bufferViews");
  if (item.has("uri") == (view != none)) item.fail("has not one of uri and bufferView", view == none ? "got neither" : "got both");
  if (!used) return image;
  if (view != none) {
    if (reading.buffers.length(view) > most)
      item.fail("has too many bytes", fmt::format("at most {} are left for it (`tofray --limits`)", most), ErrorKind::limit);
    image.bytes = std::string(reading.buffers.bytes(view));
  } else {
    std::string mime_type;
    image.bytes = bytes_of_uri(item, reading.other_files, most, mime_type);
    if (image.mime_type.empty()) image.mime_type = mime_type;
  }
  if (const std::string type = type_of(image.bytes); !type.empty()) image.mime_type = type;
  return image;
}

}  // namespace

void read_materials(Reading& reading) {
  read_textures(reading);
  for (const Item& item : reading.root.objects("materials")) reading.model.materials.push_back(read_material(reading, item));
  const std::vector<Item> images = reading.root.objects("images");
  const std::vector<bool> used = used_images(reading.model, images.size());
  auto left = static_cast<std::size_t>(base::limit::gltf_image_bytes.value);
  for (std::size_t i = 0; i < images.size(); ++i) {
    reading.model.images.push_back(read_image(reading, images[i], used[i], left));
    left -= reading.model.images.back().bytes.size();
  }
}

}  // namespace tofray::gltf
