// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include "files/atomic_file.h"

#include <dirent.h>
#include <fcntl.h>
#include <fmt/core.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <sys/statvfs.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <memory>
#include <string>
#include <string_view>
#include <system_error>

#include "files/descriptor.h"
#include "files/live_temporary.h"
#include "files/write_steps.h"
#include "tofray/error.h"

namespace tofray::files {
namespace {

/// A name that a pipe, a device or a socket has cannot be replaced by a file; opening it could hang, and what is written is lost.
void refuse_special(const std::filesystem::path& path, mode_t mode) {
  const char* what = S_ISFIFO(mode) ? "a pipe" : S_ISSOCK(mode) ? "a socket" : "a device";
  throw Error(ErrorKind::io,
              fmt::format("{}: error: this is {}, or a link to one\n  expected a file, or nothing, in its place", path.native(), what));
}

/// Removes the temporary unless it has got its name.
class RemoveUnlessKept {
 public:
  RemoveUnlessKept(int folder, const char* name) : folder_(folder), name_(name) {}
  RemoveUnlessKept(const RemoveUnlessKept&) = delete;
  RemoveUnlessKept& operator=(const RemoveUnlessKept&) = delete;
  ~RemoveUnlessKept() {
    if (!kept_) unlinkat(folder_, name_, 0);
  }
  void keep() { kept_ = true; }

 private:
  int folder_;
  const char* name_;
  bool kept_ = false;
};

/// Says with a lock that the temporary's maker lives. @return false where remove_stale_temporaries() of another process was quicker
bool claim(int file) {
  // A file system without locks refuses them to those who clean up, too.
  if (::flock(file, LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK) return false;
  struct stat status {};
  return ::fstat(file, &status) == 0 && status.st_nlink > 0;
}

/// Whether a name is that of a temporary of ours: ".tofray-PROCESS-NUMBER.tmp".
bool is_temporary_name(std::string_view name) {
  const auto digits = [&name] {
    const std::size_t count = std::min(name.find_first_not_of("0123456789"), name.size());
    name.remove_prefix(count);
    return count > 0;
  };
  const auto word = [&name](std::string_view expected) {
    const bool there = name.starts_with(expected);
    if (there) name.remove_prefix(expected.size());
    return there;
  };
  return word(".tofray-") && digits() && word("-") && digits() && name == ".tmp";
}

/// Removes one temporary if it is a file of this user's that nobody holds a lock on.
void remove_if_stale(int folder, const char* name) {
  const Descriptor file(::openat(folder, name, O_RDONLY | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC), system_file_calls());
  struct stat opened {
  }, named{};
  if (file.number() < 0 || ::fstat(file.number(), &opened) != 0 || !S_ISREG(opened.st_mode) || opened.st_uid != ::geteuid()) return;
  if (::flock(file.number(), LOCK_EX | LOCK_NB) != 0) return;
  const bool same =
      ::fstatat(folder, name, &named, AT_SYMLINK_NOFOLLOW) == 0 && named.st_ino == opened.st_ino && named.st_dev == opened.st_dev;
  if (same) ::unlinkat(folder, name, 0);
}

/// Writes the temporary and renames it. @return true, or false where its name was taken or taken away: another one will do
bool write_and_rename(const std::filesystem::path& path, std::string_view bytes, int folder, const FileCalls& calls) {
  const LiveTemporary temporary(folder);
  Descriptor file(open_retrying(calls, folder, temporary.name(), O_WRONLY | O_CREAT | O_EXCL), calls);
  temporary.opened();
  if (file.number() < 0 && errno == EEXIST) return false;
  if (file.number() < 0) fail_to_write(path, "make a temporary file in its folder", errno, bytes.size(), folder);
  RemoveUnlessKept guard(folder, temporary.name());
  // The lock lasts until the second descriptor closes, after the rename.
  const Descriptor second(::fcntl(file.number(), F_DUPFD_CLOEXEC, 0), calls);
  if (second.number() < 0) fail_to_write(path, "lock its temporary file", errno, bytes.size(), folder);
  if (!claim(second.number())) return false;
  if (!write_all(calls, file.number(), bytes)) fail_to_write(path, "write it", errno, bytes.size(), folder);
  if (!sync_file(calls, file.number())) fail_to_write(path, "sync it to the disk", errno, bytes.size(), folder);
  if (!file.close()) fail_to_write(path, "close it", errno, bytes.size(), folder);
  if (calls.rename_at(folder, temporary.name(), folder, path.filename().c_str()) != 0)
    fail_to_write(path, "give the complete file its name", errno, bytes.size(), folder);
  guard.keep();
  return true;
}

}  // namespace

const FileCalls& system_file_calls() {
  static const FileCalls calls{
      [](int folder, const char* name, int flags, mode_t mode) { return ::openat(folder, name, flags, mode); },
      ::write,
      ::fsync,
      ::close,
      ::renameat,
      [](int from_folder, const char* from, int to_folder, const char* to) { return ::linkat(from_folder, from, to_folder, to, 0); }};
  return calls;
}

std::string free_room(std::filesystem::path path) {
  struct statvfs room {};
  while (::statvfs(path.empty() ? "." : path.c_str(), &room) != 0) {
    if (path.empty() || path == path.parent_path()) return "an unknown number of bytes";
    path = path.parent_path();
  }
  return room_text(room) + " in " + (path.empty() ? "." : path.native());
}

void write_file_atomically(const std::filesystem::path& path, std::string_view bytes, const FileCalls& calls) {
  if (!path.has_filename()) throw Error(ErrorKind::io, fmt::format("{}: error: this is a folder, not a file to write", path.native()));
  struct stat before {};
  if (::stat(path.c_str(), &before) == 0 && !S_ISREG(before.st_mode)) {
    if (S_ISDIR(before.st_mode)) fail_to_write(path, "write it", EISDIR, bytes.size(), -1);
    refuse_special(path, before.st_mode);
  }
  const std::filesystem::path parent = path.has_parent_path() ? path.parent_path() : std::filesystem::path(".");
  const Descriptor folder(open_retrying(calls, AT_FDCWD, parent.c_str(), O_RDONLY | O_DIRECTORY), calls);
  if (folder.number() < 0) fail_to_write(path, "open its folder", errno, bytes.size(), -1);
  while (!write_and_rename(path, bytes, folder.number(), calls)) {}
  if (!sync_file(calls, folder.number())) fail_to_write(path, "sync its folder to the disk", errno, bytes.size(), folder.number());
}

void remove_stale_temporaries(const std::filesystem::path& folder) {
  const std::unique_ptr<DIR, int (*)(DIR*)> open(::opendir(folder.c_str()), ::closedir);
  if (!open) return;
  while (const dirent* entry = ::readdir(open.get()))
    if (is_temporary_name(entry->d_name)) remove_if_stale(::dirfd(open.get()), entry->d_name);
}

}  // namespace tofray::files
