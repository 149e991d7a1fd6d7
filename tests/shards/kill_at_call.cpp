// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
// Loaded before the C library: kills the process before the KILL_AT-th of the calls by which files change, from 1 on. Without it, or where there are fewer,
// nothing happens, and how many there were is written into the file KILL_COUNT.
#include <fcntl.h>
#include <signal.h>
#include <sys/stat.h>
#include <unistd.h>

#include "preloaded.h"

namespace {

using preloaded::calls, preloaded::real;

void count() {
  static const char* const at = std::getenv("KILL_AT");
  if (++calls == (at != nullptr ? std::atol(at) : -1)) ::kill(::getpid(), SIGKILL);
}

preloaded::Report report{"KILL_COUNT"};

}  // namespace

extern "C" {
ssize_t write(int file, const void* bytes, size_t size) {
  count();
  return real<ssize_t(int, const void*, size_t)>("write")(file, bytes, size);
}
int fsync(int file) {
  count();
  return real<int(int)>("fsync")(file);
}
int linkat(int from, const char* a, int to, const char* b, int flags) noexcept {
  count();
  return real<int(int, const char*, int, const char*, int)>("linkat")(from, a, to, b, flags);
}
int renameat(int from, const char* a, int to, const char* b) noexcept {
  count();
  return real<int(int, const char*, int, const char*)>("renameat")(from, a, to, b);
}
int unlinkat(int folder, const char* name, int flags) noexcept {
  count();
  return real<int(int, const char*, int)>("unlinkat")(folder, name, flags);
}
}
