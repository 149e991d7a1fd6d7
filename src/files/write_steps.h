// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <sys/statvfs.h>

#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>

#include "files/atomic_file.h"

/// The steps of writing a file, over interruptions, and what is said of one that fails.
namespace tofray::files {

/// "12345 bytes", and that no file more can be made where that is so.
std::string room_text(const struct statvfs& room);

/// Throws what the user reads: path, step, reason, and the room that is left where that is the reason.
/// @param folder  open, to ask for its room; −1: none
[[noreturn]] void fail_to_write(const std::filesystem::path& path, const char* step, int code, std::size_t needed, int folder);

int open_retrying(const FileCalls& calls, int folder, const char* name, int flags);

/// All bytes, over interruptions and short writes; false with errno set.
bool write_all(const FileCalls& calls, int file, std::string_view bytes);

/// Some file systems cannot sync a folder, a pipe or a device; that is no failure.
bool sync_file(const FileCalls& calls, int file);

}  // namespace tofray::files
