// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstddef>
#include <optional>
#include <string>

namespace tofray::files {

/// The whole of a regular file.
/// @throws Error (io) where it cannot be read or is no regular file; (limit) where it has more than `most` bytes
std::string read_bytes(const std::string& path, std::size_t most);
/// None where there is no such file.
std::optional<std::string> read_bytes_if_there(const std::string& path, std::size_t most);

}  // namespace tofray::files
