// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstddef>
#include <string>
#include <vector>

#include "tofray/scene.h"
#include "yaml/tree.h"

/// Keys of a tree that are changed from elsewhere: the command line, a scene that overrides its camera's profile.
namespace tofray::yaml {

enum class Maps { merge, replace };

/// Sets the value at a dotted path in the tree; list elements go by index. Maps on the way are made where missing.
/// @param maps  what a value that is a map does to the map that is there: replaces it, or is merged into it unless it says another kind
/// @throws Error naming `place` where the path leads nowhere
void set_key(Node& root, const std::string& path, Node value, const base::Place& place, Maps maps = Maps::merge);

/// @throws Error (limit) where more keys are changed than limit::overrides: each change looks for its key in a list
void refuse_too_many(std::size_t changes, const base::Place& place);

/// The keys of a map as dotted paths with values, maps inside flattened.
std::vector<Override> flattened(const Node& map, const std::vector<std::string>& without);

}  // namespace tofray::yaml
