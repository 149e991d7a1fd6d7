// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <sys/types.h>

#include <filesystem>
#include <string>
#include <string_view>

/// Files that are complete or absent, whatever happens while they are written.
namespace tofray::files {

/// The system calls that writing takes; tests put failing ones in their place.
struct FileCalls {
  int (*open_at)(int folder, const char* name, int flags, mode_t mode);
  ssize_t (*write)(int file, const void* bytes, size_t count);
  int (*sync)(int file);
  int (*close)(int file);
  int (*rename_at)(int from_folder, const char* from, int to_folder, const char* to);
  int (*link_at)(int from_folder, const char* from, int to_folder, const char* to);
};

/// The real ones.
const FileCalls& system_file_calls();

/// Writes a file under a temporary name in the same folder, syncs it, gives it its name and syncs the folder.
///
/// A regular file of this name is replaced in one step; until then it is intact. A pipe, a device and a link to one are refused.
/// The file's permissions are those that the umask leaves. Works for any path that the system takes, in any encoding.
///
/// @throws Error (io) with path, what failed and why; with the bytes needed and free where the disk is full. The temporary is gone then.
void write_file_atomically(const std::filesystem::path& path, std::string_view bytes, const FileCalls& calls = system_file_calls());

/// How much is free where a path lies, or will lie: "12345 bytes in FOLDER".
std::string free_room(std::filesystem::path path);

/// Removes what a write that was killed left in a folder: files under the names of our temporaries, of this user, whose maker is dead.
/// The maker of a live one holds a lock (flock) on it; where the file system knows no locks, nothing is removed.
void remove_stale_temporaries(const std::filesystem::path& folder);

/// Removes every temporary that is being written at this moment. Async-signal-safe: for the handler of Ctrl-C just before it ends
/// the process. A write that is under way in another thread ends with an Error.
void remove_live_temporaries() noexcept;

/// Removes the files that are being written, and lets no other begin: every write from now on ends with an Error.
void end_writing() noexcept;

}  // namespace tofray::files
