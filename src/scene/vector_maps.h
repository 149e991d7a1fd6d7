// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <memory>
#include <vector>

#include "scene/map_levels.h"
#include "tofray/scene.h"

/// Pictures of several numbers, taken apart into those that kernels read, one for each number.
namespace tofray::scene {

using Levels = std::vector<std::unique_ptr<const MapLevels>>;

/// How normals lean: three pictures, of unit length. A level's mean is shorter where they differ; who reads it takes its direction.
/// @param opacity  as of MapLevels
Levels levels_of_normals(const VectorMap& normals, const ReflectivityMap* opacity = nullptr);

/// What a GGX surface has at each place, five pictures: its BRDF's numbers (brdf/ggx.h), the reflectivity and its matt part. All of them
/// are what light is linear in, or nearly, so that a level's means stand for what a pixel sees.  [theory: metal-roughness-map]
/// @param opacity  as of MapLevels
Levels levels_of_finish(const VectorMap& finish, const ReflectivityMap* opacity = nullptr);

}  // namespace tofray::scene
