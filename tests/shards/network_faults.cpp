// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
// Loaded before the C library: files below the folder FAULT_UNDER answer as those of a network do at times. FAULT says how:
//   link_done   a link is made, and told to have failed (EIO): its answer was lost, and it was sent again
//   link_lost   a link is not made (EIO)
//   stale       a file cannot be opened (ESTALE): its server knows it no more
//   unseen      a record or a tar is not there yet (ENOENT), though another machine has made it
//   lockless    nothing can be locked (ENOLCK)
//   close_full  a file is closed, and then there was no room for what had been written (ENOSPC)
//   sync_quota  the same of a sync (EDQUOT)
// FAULT_AT is the number of the call that fails, from 1 on; without it all of them do. How many calls could have failed is written into FAULT_COUNT.
#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstdarg>
#include <cstring>
#include <string>

#include "preloaded.h"

namespace {

using preloaded::calls, preloaded::real;

const char* word(const char* name) {
  const char* const value = std::getenv(name);
  return value != nullptr ? value : "";
}

/// Whether this call is one that fails.
bool fails(const char* how) {
  static const std::string wanted = word("FAULT");
  static const long at = std::atol(word("FAULT_AT"));
  if (wanted != how) return false;
  const long number = ++calls;
  return at == 0 || number == at;
}

bool is_under(const char* path) {
  static const std::string folder = word("FAULT_UNDER");
  return !folder.empty() && std::strncmp(path, folder.c_str(), folder.size()) == 0;
}

/// Whether a descriptor is of a file below that folder that may be written to.
bool is_written(int file) {
  char name[64], path[4096];
  std::snprintf(name, sizeof name, "/proc/self/fd/%d", file);
  const ssize_t length = ::readlink(name, path, sizeof path - 1);
  if (length <= 0) return false;
  path[length] = 0;
  return is_under(path) && (::fcntl(file, F_GETFL) & O_ACCMODE) != O_RDONLY;
}

bool is_of_a_shard(const char* path) {
  return is_under(path) && std::strstr(path, "/shards/") != nullptr && std::strchr(path, '.') != nullptr;
}

int failed(int code) {
  errno = code;
  return -1;
}

preloaded::Report report{"FAULT_COUNT"};

}  // namespace

extern "C" {
int linkat(int from, const char* a, int to, const char* b, int flags) noexcept {
  if (fails("link_lost")) return failed(EIO);
  const int result = real<int(int, const char*, int, const char*, int)>("linkat")(from, a, to, b, flags);
  return fails("link_done") ? failed(EIO) : result;
}
int open(const char* path, int flags, ...) {
  va_list more;
  va_start(more, flags);
  const mode_t mode = (flags & O_CREAT) != 0 ? va_arg(more, mode_t) : 0;
  va_end(more);
  if (is_under(path) && fails("stale")) return failed(ESTALE);
  if (is_of_a_shard(path) && fails("unseen")) return failed(ENOENT);
  return real<int(const char*, int, ...)>("open")(path, flags, mode);
}
int openat(int folder, const char* path, int flags, ...) {
  va_list more;
  va_start(more, flags);
  const mode_t mode = (flags & O_CREAT) != 0 ? va_arg(more, mode_t) : 0;
  va_end(more);
  if ((is_under(path) || folder != AT_FDCWD) && fails("stale")) return failed(ESTALE);
  return real<int(int, const char*, int, ...)>("openat")(folder, path, flags, mode);
}
int stat(const char* path, struct stat* status) noexcept {
  if (is_of_a_shard(path) && fails("unseen")) return failed(ENOENT);
  return real<int(const char*, struct stat*)>("stat")(path, status);
}
int flock(int file, int operation) noexcept {
  if (fails("lockless")) return failed(ENOLCK);
  return real<int(int, int)>("flock")(file, operation);
}
int fsync(int file) {
  if (is_written(file) && fails("sync_quota")) return failed(EDQUOT);
  return real<int(int)>("fsync")(file);
}
int close(int file) {
  const bool full = is_written(file) && fails("close_full");
  const int result = real<int(int)>("close")(file);
  return full ? failed(ENOSPC) : result;
}
}
