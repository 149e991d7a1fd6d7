// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <vector>

#include "assets/mesh_piece.h"
#include "gltf/model.h"

/// glTF files of a scene whose first animation goes on: nodes, skins and morph targets.
namespace tofray::assets {

/// Gives the pieces of a model their motion.
/// @param model      of which they were made at `start_s` of one of its animations
/// @param animation  which that is
/// @param start_s    of the animation, at t = 0
/// @param loop     again and again, from 0 to its last keyframe; else it ends there
void play(gltf::Model model, int animation, double start_s, bool loop, std::vector<MeshPiece>& pieces);

}  // namespace tofray::assets
