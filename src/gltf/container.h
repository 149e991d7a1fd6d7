// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <optional>
#include <string>
#include <string_view>

namespace tofray::gltf {

/// The two parts of a file: JSON, and the bytes beside it, which only a binary file may have.
struct Container {
  std::string_view json;
  std::optional<std::string_view> binary;
};

/// Binary files begin with "glTF"; all others are JSON as a whole. Unknown chunks of a binary file are passed.
/// @throws Error (bad_input) where a binary file is none of version 2, is cut short, or has bytes left over
Container split(std::string_view bytes, const std::string& name);

}  // namespace tofray::gltf
