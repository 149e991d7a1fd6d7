// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "gltf/accessors.h"
#include "gltf/item.h"
#include "gltf/model.h"
#include "gltf/notices.h"
#include "gltf/read.h"

/// One function for each kind of things of a file, in the order in which read() calls them.
namespace tofray::gltf {

/// What is at hand while a file is read.
struct Reading {
  const Item& root;
  const Buffers& buffers;
  Accessors& accessors;
  const Resources& other_files;
  Notices notices;
  Model model;
};

/// @throws Error (limit) where there are too many things of a kind
void check_lists(const Item& root);
/// @throws Error where the version is another, or an extension is required that is not read
void check_version_and_extensions(const Item& root, Notices& notices);
/// Materials, textures and images.
void read_materials(Reading& reading);
void read_meshes(Reading& reading);
void read_cameras(Reading& reading);
void read_skins(Reading& reading);
/// Nodes and scenes.
void read_nodes(Reading& reading);
void read_animations(Reading& reading);
/// @throws Error (limit) where all that the nodes show would be too much
void check_totals(const Reading& reading);

}  // namespace tofray::gltf
