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
  /// @param opacity  where there is no surface: texels that lie there count in no mean, and are given the mean about them, so that their
  ///                 neighbours do not fade into what nobody sees. Null: there is one everywhere
  explicit MapLevels(const ReflectivityMap& map, const ReflectivityMap* opacity = nullptr)
      : MapLevels(map.values, map.width, map.height, map.wrap_u, map.wrap_v, opacity) {}
  /// @param most  levels
  MapLevels(std::vector<float> values, int width, int height, ReflectivityMap::Wrap wrap_u, ReflectivityMap::Wrap wrap_v,
            const ReflectivityMap* opacity = nullptr, int most = brdf::most_map_levels);
  std::vector<float> texels;
  brdf::MapView view{};  ///< of `texels`

 private:
  void give_means(const std::vector<float>& covered);
};

}  // namespace tofray::scene
