// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "assets/mesh_piece.h"
#include "gltf/model.h"
#include "gltf/pose.h"

/// glTF files of a scene: with the files that they name, taken apart by material.
namespace tofray::assets {

/// By the file name's suffix, in any case.
bool is_gltf(const std::string& path);

struct GltfFile {
  gltf::Model model;
  std::string sha256;  ///< of the file's bytes, followed by those of each file that it names, in the order in which they are read
};

/// @param path  where the file lies: the files that it names lie beside it or below
/// @throws Error as gltf::read and files::read_reference
GltfFile read_gltf(std::string_view bytes, const std::string& path, const std::string& root);

/// Which animation is meant: by its name, by its number from 0 on, or "all" of them, which become one more at the end of the list, where
/// the last of two channels of one thing counts; the first where nothing is said, and `none` where there is none.
/// @param place  who says it, for messages
/// @throws Error (bad_input) for one that the file does not have
int animation_of(gltf::Model& model, const std::string& wanted, const base::Place& place);

/// As the nodes stand, or at a time of an animation, which there is then.
gltf::Pose pose_at(const gltf::Model& model, int animation, const std::optional<double>& time_s);

/// What the pose's scene shows, y up, in metres: a piece for each material, those without one first; or all of it as one piece.
/// @param by_material  whether materials are wanted apart, and their maps
/// @param path         the file's, for messages about images
/// @param place        who names the file, where its pictures are too large together
std::vector<MeshPiece> pieces_of(const gltf::Model& model, const gltf::Pose& pose, bool by_material, const std::string& path,
                                 const base::Place& place);

/// The first perspective camera of the scene, in the file's axes; up is of unit length, look_at 1 m before it.
std::optional<Pose> camera_of(const gltf::Model& model, const gltf::Pose& pose);

}  // namespace tofray::assets
