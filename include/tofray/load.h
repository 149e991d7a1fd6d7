// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <string>
#include <utility>
#include <vector>

#include "tofray/camera.h"
#include "tofray/error.h"
#include "tofray/scene.h"

/// Scenes and cameras from files. These functions are in a library of their own, libtofray_files: link to tofray::files, which brings
/// tofray::tofray along. All other headers need tofray::tofray alone.
namespace tofray {

/// Reads a scene file (YAML 1.2 or JSON), or a built-in scene by name, whatever files of that name there are: see choose_scene().
/// @param root  files that the scene names have to lie in or below its own folder, or in or below this one where it is not empty
/// @throws Error with every fault of the file at once.
Scene load_scene(const std::string& file_or_name, const std::string& root = {});

/// What a user means by a word that is both a built-in name and, with or without .yaml or .yml, a file of the working directory.
struct NameChoice {
  std::string name;  ///< name for load_scene() or load_camera(): the file, or what was typed
  std::string note;  ///< note for the user: the file is taken, and not what is built in; empty where there is no choice
};
/// The file counts more than a built-in scene of its name: so the command line and Python take what is typed.
NameChoice choose_scene(const std::string& typed);
/// Which camera a name means: a file of the folder before a built-in profile of that name.
NameChoice choose_camera(const std::string& typed);

/// Which mode of a profile, and what to change in it.
struct CameraOptions {
  std::string mode = {};  ///< empty: the profile's first
  /// Dotted key and value as written in a profile, e.g. {"lens.f_number", "1.2"}.
  std::vector<std::pair<std::string, std::string>> set = {};
  /// A scene's profile file has to lie in or below the scene's folder, or in or below this one where it is not empty.
  std::string root = {};
};

/// Reads a camera profile: a built-in name such as "pico-flexx" (see choose_camera()), or a YAML file.
/// @throws Error with every fault of the file at once.
Camera load_camera(const std::string& file_or_name, const CameraOptions& options = {});

/// The camera that a scene asks for: its profile, mode and overrides; `options` come on top.
Camera load_camera(const Scene& scene, const CameraOptions& options = {});

/// A scene from its text. `source` stands for the file: messages name it, and what the text names is looked for beside it.
Scene load_scene_text(const std::string& text, const std::string& source, const std::string& root = {});
/// A camera from its profile's text, as load_camera() reads it. `source` stands for the file.
Camera load_camera_text(const std::string& text, const std::string& source, const CameraOptions& options = {});

/// A material that scenes may name without describing it, such as "skin" (docs/reference/materials.md).
/// @throws Error (bad_input) for another name
Material load_material(const std::string& name);

}  // namespace tofray
