// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstddef>
#include <functional>
#include <string>
#include <string_view>

#include "gltf/model.h"

namespace tofray::gltf {

/// Brings the bytes of a file beside the glTF file.
/// @param path  relative, without "..", percent signs decoded
/// @param most  bytes that may come
/// @throws Error where there is no such file, or a longer one
using Resources = std::function<std::string(const std::string& path, std::size_t most)>;

/// Reads a glTF 2.0 file, JSON or binary, in time and memory that the limits gltf_… and mesh_… bound.
///
/// Buffers, and images that a material uses, are in the file itself, in data URIs, or in files that `other_files` brings.
/// @param name   the file's name for messages
/// @param bytes  the whole file; who reads it sees that it has at most limit::mesh_bytes
/// @throws Error (bad_input) for the first fault; (limit) beyond a limit; and what `other_files` throws
Model read(const std::string& name, std::string_view bytes, const Resources& other_files);

}  // namespace tofray::gltf
