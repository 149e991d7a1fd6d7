// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
// Loaded before the C library: kills the process before the KILL_AT-th of the calls by which files change, from 1 on. Without it, or where there are fewer,
// nothing happens, and how many there were is written into the file KILL_COUNT.
#include <dlfcn.h>
#include <fcntl.h>
#include <signal.h>
#include <sys/stat.h>
#include <unistd.h>

#include <atomic>
#include <cstdio>
#include <cstdlib>

namespace {

std::atomic<long> calls{0};

void count() {
  static const char* const at = std::getenv("KILL_AT");
  if (++calls == (at != nullptr ? std::atol(at) : -1)) ::kill(::getpid(), SIGKILL);
}

template <class Call>
Call* real(const char* name) {
  return reinterpret_cast<Call*>(::dlsym(RTLD_NEXT, name));
}

struct Report {
  ~Report() {
    const char* const name = std::getenv("KILL_COUNT");
    std::FILE* const file = name != nullptr ? std::fopen(name, "w") : nullptr;
    if (file == nullptr) return;
    std::fprintf(file, "%ld", calls.load());
    std::fclose(file);
  }
} report;

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
