// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <string>
#include <vector>

#include "tofray/load.h"

namespace tofray::test {

/// The built-in scenes whose cameras have a single light, and that at one point, whose light comes straight back.
inline std::vector<std::string> scenes_of_one_point_light() {
  std::vector<std::string> names = scene_names();
  std::erase_if(names, [](const std::string& name) {
    if (load_scene(name).transport.bounces > 0) return true;
    const std::vector<Illumination> lights = load_camera(load_scene(name)).illumination;
    return lights.size() != 1 || lights[0].ring_leds != 1 || lights[0].area.kind != Area::Kind::none;
  });
  return names;
}

}  // namespace tofray::test
