// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <vector>

#include "brdf/reflectivity_map.h"
#include "tofray/scene.h"

namespace tofray::scene {

/// A reflectivity map with the same picture at half, a quarter … of its size: each level's texels are means of the one before, by area,
/// so that the mean of the whole stays.
struct MapLevels {
  explicit MapLevels(const ReflectivityMap& map) : MapLevels(map.values, map.width, map.height, map.wrap_u, map.wrap_v) {}
  MapLevels(std::vector<float> values, int width, int height, ReflectivityMap::Wrap wrap_u, ReflectivityMap::Wrap wrap_v);
  std::vector<float> texels;
  brdf::MapView view{};  ///< of `texels`
};

}  // namespace tofray::scene
