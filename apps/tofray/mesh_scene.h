// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <string>

#include "load/load.h"
#include "options.h"

namespace tofray::app {

/// Whether a file is called like a mesh.
bool is_called_like_a_mesh(const std::string& path);

/// A scene file's text for a mesh alone: it stands on a floor, and the camera sees all of it from before, above and aside, or stands where
/// a glTF file has its first perspective camera.
/// @param source  what the text is called: a scene file in the mesh's folder
/// @param warnings  what is to be told is added
/// @throws Error where the mesh cannot be read, or --set changes what there is not
std::string scene_of_mesh(const std::string& path, const std::string& source, const Options& options, std::string& warnings);

/// "chair.yaml" beside "chair.obj".
std::string scene_name_of_mesh(const std::string& path);

}  // namespace tofray::app
