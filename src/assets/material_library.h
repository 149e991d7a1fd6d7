// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <string>
#include <vector>

#include "tofray/scene.h"

/// Materials that a scene may name without describing them: near-infrared reflectivities that somebody measured.
namespace tofray::assets {

struct LibraryMaterial {
  Material material;
  std::string what;    ///< what was measured, and how
  std::string source;  ///< who measured it, and where it is written
};

/// By name, in the order of the alphabet.
const std::vector<LibraryMaterial>& material_library();
/// The one of that name, or none.
const LibraryMaterial* find_library_material(const std::string& name);

/// A material's BRDF and its numbers, as files say them: "ggx, diffuse 0, specular 0.9, alpha 0.3".
std::string numbers_of(const Material& material);

/// The page docs/reference/materials.md.
std::string material_page();

}  // namespace tofray::assets
