// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <string>
#include <string_view>

#include "load/load.h"
#include "yaml/tree.h"

/// Files as trees with all changes in them, before they are read by their tables.
namespace tofray::load {

/// A scene's text after the settings.
yaml::Node scene_tree(std::string_view text, const std::string& source, const Settings& settings);

/// Changes keys of a scene's tree, as --set does.
void apply(yaml::Node& root, const Settings& settings);

/// The scene that a tree says. @param source  as of scene_from_text()
Scene scene_from_tree(const yaml::Node& root, const std::string& source, const assets::MeshFiles& meshes = {});

/// A tree as YAML of several lines, which parse_tree() reads back.
std::string block_yaml(const yaml::Node& root);

/// The profile of the camera that a scene asks for, with the scene's changes and its mode. Numbers that the profile says have its
/// name as their place's source.
/// @param source  becomes that name
yaml::Node camera_tree(const Scene& scene, const CameraOptions& options, std::string& source);
/// The tree of a profile's text.
yaml::Node camera_tree(const std::string& text, const std::string& source, const CameraOptions& options);

}  // namespace tofray::load
