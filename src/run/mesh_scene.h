// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <string>
#include <vector>

#include "load/load.h"
#include "tofray/run.h"

namespace tofray::run {

/// Whether a file is called like a mesh.
bool is_called_like_a_mesh(const std::string& path);

/// A scene of a mesh alone, as the text of a file.
struct MeshScene {
  std::string text;
  std::vector<Remark> remarks;  ///< what is to be told
  bool told_size = false;       ///< among them that it is too large or too small for the camera
};
/// It stands on a floor, or a thousandth of its size above, and the camera sees all of it from before, above and aside; or it stands where a
/// glTF file has its first perspective camera.
/// @param source  what the text is called: a scene file in the mesh's folder
/// @param request  what is set, mode and root
/// @throws Error where the mesh cannot be read, or what is set is not there
MeshScene scene_of_mesh(const std::string& path, const std::string& source, const InputRequest& request);

/// "chair.yaml" beside "chair.obj".
std::string scene_name_of_mesh(const std::string& path);

}  // namespace tofray::run
