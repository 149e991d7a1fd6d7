// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include "files/write_steps.h"

#include <fcntl.h>
#include <fmt/core.h>
#include <sys/statvfs.h>

#include <cerrno>
#include <system_error>

#include "tofray/error.h"

namespace tofray::files {

std::string room_text(const struct statvfs& room) {
  return fmt::format("{} bytes{}", static_cast<unsigned long long>(room.f_bavail) * room.f_frsize,
                     room.f_files > 0 && room.f_favail == 0 ? " and no place for one more file" : "");
}

void fail_to_write(const std::filesystem::path& path, const char* step, int code, std::size_t needed, int folder) {
  std::string text = fmt::format("{}: error: cannot {}: {}", path.native(), step, std::generic_category().message(code));
  if (code == ENOSPC || code == EDQUOT) {
    struct statvfs room {};
    if (folder >= 0 && fstatvfs(folder, &room) == 0)
      text += fmt::format("\n  needed {} bytes, free {} in {}", needed, room_text(room),
                          path.has_parent_path() ? path.parent_path().native() : ".");
    else
      text += fmt::format("\n  needed {} bytes", needed);
  } else if (code == ENAMETOOLONG) {
    text += fmt::format("\n  the name has {} bytes; most file systems take 255", path.filename().native().size());
  } else if (code == ENOENT) {
    text += "\n  expected a folder that exists";
  } else if (code == EACCES || code == EPERM || code == EROFS) {
    text += "\n  expected a folder that you may write to; choose another one with -o";
  }
  throw Error(ErrorKind::io, text);
}

int open_retrying(const FileCalls& calls, int folder, const char* name, int flags) {
  int file = -1;
  do {
    file = calls.open_at(folder, name, flags | O_CLOEXEC, 0666);
  } while (file < 0 && errno == EINTR);
  return file;
}

bool write_all(const FileCalls& calls, int file, std::string_view bytes) {
  while (!bytes.empty()) {
    const ssize_t written = calls.write(file, bytes.data(), bytes.size());
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) return false;
    if (written == 0) {
      errno = EIO;
      return false;
    }
    bytes.remove_prefix(static_cast<std::size_t>(written));
  }
  return true;
}

bool sync_file(const FileCalls& calls, int file) {
  int result = -1;
  do {
    result = calls.sync(file);
  } while (result < 0 && errno == EINTR);
  return result == 0 || errno == EINVAL || errno == ENOTSUP;
}

}  // namespace tofray::files
