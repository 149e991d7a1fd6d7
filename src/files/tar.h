// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstdint>
#include <string>
#include <string_view>

/// Tape archives as POSIX.1-1988 has them (ustar), uncompressed, the same bytes each run: time 0, user and group 0, mode 0644.
namespace tofray::files {

inline constexpr std::size_t tar_block = 512;

/// The block before a file's bytes. @param name  at most 100 bytes
/// @throws Error (limit) where name or size do not fit
std::string tar_header(std::string_view name, std::uint64_t size);

/// How many zeros follow so many bytes, to the next block.
std::size_t tar_padding(std::uint64_t size);

/// What stands behind the last file.
std::string tar_end();

}  // namespace tofray::files
