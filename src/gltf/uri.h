// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstddef>
#include <string>

#include "gltf/item.h"
#include "gltf/read.h"

namespace tofray::gltf {

/// The bytes that the member "uri" of `item` stands for: of a data URI, or of a file that `other_files` brings.
/// @param most       bytes that may come
/// @param mime_type  set to what a data URI says, where it says it
/// @throws Error (bad_input) for absolute paths, "..", other schemes and broken base64; (limit) for more bytes; what `other_files` throws
std::string bytes_of_uri(const Item& item, const Resources& other_files, std::size_t most, std::string& mime_type);

}  // namespace tofray::gltf
