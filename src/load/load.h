// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "assets/mesh_load.h"
#include "tofray/load.h"

/// Scenes and camera profiles from files, from texts, and with keys changed from the command line.
namespace tofray::model {
struct FileForm;
}

namespace tofray::load {

/// Dotted key and value as written in the file, e.g. {"ambient.level", "5 %"} or {"objects.1.sphere.radius", "20 cm"}.
using Settings = std::vector<std::pair<std::string, std::string>>;

/// Reads a scene after setting keys in it; keys under "camera." go to the camera that the scene asks for.
/// @throws Error with every fault at once
Scene load_scene(const std::string& file_or_name, const Settings& settings, const assets::MeshFiles& meshes = {});

/// A scene from its text. `source` is the file's name for messages and where profiles and meshes beside the scene are looked for.
Scene scene_from_text(const std::string& text, const std::string& source, const Settings& settings = {},
                      const assets::MeshFiles& meshes = {});

using SeeCamera = std::function<void(const Camera&)>;

/// A camera from a profile's text. `folder`: where its table files lie.
/// @param see_each_mode  is shown the camera in one mode after the other, whichever is asked for; text and tables are read once
Camera camera_from_text(const std::string& text, const std::string& source, const std::string& folder, const CameraOptions& options = {},
                        const SeeCamera& see_each_mode = {});

/// JSON Schema (draft 2020-12) of a file kind, "scene" or "camera".
/// @throws Error for any other kind
std::string schema_json(const std::string& kind);
/// The kinds that schema_json() knows.
std::vector<std::string> schema_kinds();
/// JSON Schema of files of another kind, from the table that reading goes by.
std::string schema_of(const model::FileForm& file);

}  // namespace tofray::load
