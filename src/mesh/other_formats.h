// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <optional>
#include <string>
#include <string_view>

/// Files that people have in place of a mesh or a scene that tofray reads.
namespace tofray::mesh {

/// The formats that are read, as messages say them.
inline constexpr const char* formats_read = ".obj, .ply, .stl, .glb or .gltf";

struct OtherFormat {
  std::string what;  ///< "a Collada file"
  std::string way;   ///< how it becomes one that is read: "Blender imports it and exports glTF (.glb)"
};

/// By the file name's suffix, in any case; nothing where it is none of those that are known.
std::optional<OtherFormat> other_format_of(const std::string& path);

/// By how its bytes begin, or by what binary formats say of themselves; text in UTF-16 is one, too.
std::optional<OtherFormat> other_format_in(std::string_view bytes);

}  // namespace tofray::mesh
