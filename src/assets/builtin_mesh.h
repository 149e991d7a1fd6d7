// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "tofray/scene.h"

/// Meshes that need no file: a scene names them `tofray:NAME`. They are the same bits on every machine.
namespace tofray::assets {

constexpr std::string_view builtin_mesh_prefix = "tofray:";
inline bool is_builtin_mesh(std::string_view file) { return file.starts_with(builtin_mesh_prefix); }

/// A ball of radius 0.5 m about its zero, its surface up to 8 % further out or in: 20·4^cuts triangles.
TriangleMesh bumpy_ball(int cuts);
/// 4 m × 4 m about its zero, its height up to 2 cm more or less: 2·cells² triangles.
TriangleMesh wavy_floor(int cells);

/// The mesh of this name, without the prefix; bumpy-ball has 81,920 triangles, wavy-floor 20,000.
std::optional<TriangleMesh> builtin_mesh(std::string_view name);
std::vector<std::string> builtin_mesh_names();

}  // namespace tofray::assets
