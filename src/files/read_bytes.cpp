// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include "files/read_bytes.h"

#include <fcntl.h>
#include <fmt/core.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <system_error>
#include <utility>

#include "files/descriptor.h"
#include "tofray/error.h"

namespace tofray::files {
namespace {

[[noreturn]] void fail(const std::string& path, int code) {
  throw Error(ErrorKind::io, fmt::format("{}: error: cannot read it: {}", path, std::generic_category().message(code)));
}

/// Reads up to `size` bytes; fewer where the file has become shorter.
std::string read_all(int file, std::size_t size, const std::string& path) {
  std::string bytes(size, '\0');
  std::size_t have = 0;
  while (have < size) {
    const ssize_t got = ::read(file, bytes.data() + have, size - have);
    if (got < 0 && errno == EINTR) continue;
    if (got < 0) fail(path, errno);
    if (got == 0) break;
    have += static_cast<std::size_t>(got);
  }
  bytes.resize(have);
  return bytes;
}

}  // namespace

std::optional<std::string> read_bytes_if_there(const std::string& path, std::size_t most) {
  // O_NONBLOCK: a pipe that nobody writes to must not hold us up
  const Descriptor file(::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK));
  if (file.number() < 0 && errno == ENOENT) return {};
  if (file.number() < 0) fail(path, errno);
  struct stat status {};
  if (fstat(file.number(), &status) != 0) fail(path, errno);
  if (!S_ISREG(status.st_mode))
    throw Error(ErrorKind::io,
                fmt::format("{}: error: this is {}\n  expected a file", path, S_ISDIR(status.st_mode) ? "a folder" : "not a regular file"));
  const auto size = static_cast<std::size_t>(status.st_size);
  if (size > most) throw Error(ErrorKind::limit, fmt::format("{}: error: the file has {} bytes, more than {}", path, size, most));
  return read_all(file.number(), size, path);
}

std::string read_bytes(const std::string& path, std::size_t most) {
  std::optional<std::string> bytes = read_bytes_if_there(path, most);
  if (!bytes) fail(path, ENOENT);
  return std::move(*bytes);
}

}  // namespace tofray::files
