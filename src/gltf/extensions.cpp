// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
// What a file says of itself: its version, and the extensions that it uses.
#include <fmt/core.h>

#include <algorithm>
#include <iterator>

#include "base/text.h"
#include "gltf/reading.h"

namespace tofray::gltf {
namespace {

constexpr std::string_view supported[] = {"KHR_texture_transform",  "KHR_mesh_quantization",  "KHR_materials_unlit",
                                          "KHR_materials_ior",      "KHR_materials_specular", "KHR_materials_pbrSpecularGlossiness",
                                          "EXT_mesh_gpu_instancing"};

/// Extensions whose absence moves no surface: what a sentence says of them.
struct LeftOut {
  std::string_view name;
  const char* sentence;
};
constexpr LeftOut left_out[] = {
    {"KHR_lights_punctual", "lights (KHR_lights_punctual) are left out"},
    {"EXT_lights_image_based", "lights (EXT_lights_image_based) are left out"},
    {"EXT_lights_ies", "lights (EXT_lights_ies) are left out"},
    {"KHR_xmp", "metadata (KHR_xmp) are left out"},
    {"KHR_xmp_json_ld", "metadata (KHR_xmp_json_ld) are left out"},
    {"KHR_materials_variants", "the variants of KHR_materials_variants are left out: materials are the file's own"}};

/// What says how a material looks, and by its name nothing else.
bool is_of_looks(std::string_view name) { return name.find("_materials_") != std::string_view::npos; }

/// How a file is made that needs no such extension.
struct WayOut {
  std::string_view name;
  const char* text;
};
constexpr WayOut ways_out[] = {
    {"KHR_draco_mesh_compression", "export without Draco compression"}, {"EXT_meshopt_compression", "export without meshopt compression"},
    {"KHR_meshopt_compression", "export without meshopt compression"},  {"KHR_texture_basisu", "export with textures as PNG or JPEG"},
    {"EXT_texture_webp", "export with textures as PNG or JPEG"},        {"EXT_texture_avif", "export with textures as PNG or JPEG"},
    {"MSFT_texture_dds", "export with textures as PNG or JPEG"},
};

bool is_supported(std::string_view name) { return std::find(std::begin(supported), std::end(supported), name) != std::end(supported); }

const LeftOut* found_left_out(std::string_view name) {
  const auto* at = std::find_if(std::begin(left_out), std::end(left_out), [&](const LeftOut& one) { return one.name == name; });
  return at == std::end(left_out) ? nullptr : at;
}

void check_version(const Item& root) {
  const Item asset = root.required_object("asset");
  const std::string_view version = asset.required_text("version");
  if (!version.starts_with("2.")) asset.fail_at("version", "is not 2.0", "got " + base::in_quotes(version) + ": export it as glTF 2.0");
  if (const auto least = asset.text("minVersion"); least && *least != "2.0")
    asset.fail_at("minVersion", "is not 2.0", "got " + base::in_quotes(*least) + ": export it as glTF 2.0");
}

}  // namespace

void check_version_and_extensions(const Item& root, Notices& notices) {
  check_version(root);
  for (const std::string& name : root.texts("extensionsRequired")) {
    if (is_supported(name) || found_left_out(name) != nullptr || is_of_looks(name)) continue;
    const auto* way = std::find_if(std::begin(ways_out), std::end(ways_out), [&](const WayOut& one) { return one.name == name; });
    root.fail("the file requires the extension " + base::in_quotes(name) + ", which cannot be read",
              way == std::end(ways_out) ? "expected an export without it" : way->text);
  }
  std::vector<std::string> used = root.texts("extensionsUsed");
  for (const std::string& name : root.texts("extensionsRequired"))  // ought to be among them
    if (std::find(used.begin(), used.end(), name) == used.end()) used.push_back(name);
  for (const std::string& name : used) {
    if (is_supported(name)) continue;
    const LeftOut* known = found_left_out(name);
    notices.add(known != nullptr    ? known->sentence
                : is_of_looks(name) ? "the extension " + base::in_quotes(name) + " is left out: surfaces do not look as it says"
                                    : "the extension " + base::in_quotes(name) + " is left out");
  }
}

}  // namespace tofray::gltf
