// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstdint>
#include <vector>

#include "gltf/model.h"

namespace tofray::gltf {

/// Where everything stands at one time.
struct Pose {
  std::vector<Matrix> world;                 ///< of each node, from its own frame
  std::vector<std::uint8_t> in_scene;        ///< of each node: whether the scene shows it
  std::vector<std::vector<double>> weights;  ///< of each node's morph targets
};

/// @param animation  one of the model's, or `none`: as the nodes themselves say
/// @param time_s     finite; before its first keyframe a channel has its first value, behind its last the last
/// @param scene      one of the model's, or `none`: the default one
/// @throws Error (bad_input) where one of the three is none of these
Pose at(const Model& model, int animation, double time_s, int scene = none);

}  // namespace tofray::gltf
