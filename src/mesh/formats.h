// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <string>
#include <string_view>

#include "mesh/read_mesh.h"

/// One function for each format; parse() chooses.
namespace tofray::mesh {

ReadMesh parse_obj(std::string_view bytes, const std::string& name);
ReadMesh parse_ply(std::string_view bytes, const std::string& name);
ReadMesh parse_stl(std::string_view bytes, const std::string& name);
/// Whether the number of triangles in the header fits the size.
bool is_binary_stl(std::string_view bytes);

}  // namespace tofray::mesh
