// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <algorithm>
#include <iterator>
#include <string>
#include <string_view>
#include <vector>

#include "tofray/load.h"

namespace tofray::test {

/// Whether a built-in scene's camera has a single light, and that at one point, whose light comes straight back. (By name: a test program that
/// read all scenes to know its own tests would do so each time that it starts.)
inline bool is_of_one_point_light(std::string_view scene) {
  constexpr std::string_view others[] = {"cornell-nir", "mirror", "penumbra", "sphere"};
  return std::find(std::begin(others), std::end(others), scene) == std::end(others);
}

inline std::vector<std::string> scenes_of_one_point_light() {
  std::vector<std::string> names = scene_names();
  std::erase_if(names, [](const std::string& name) { return !is_of_one_point_light(name); });
  return names;
}

}  // namespace tofray::test
