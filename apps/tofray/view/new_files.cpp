// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include "view/new_files.h"

#include <fcntl.h>
#include <fmt/core.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <system_error>
#include <utility>

#include "base/text.h"
#include "tofray/error.h"

namespace tofray::view {

namespace fs = std::filesystem;

namespace {

constexpr int most_names = 9999;

[[noreturn]] void fail(const fs::path& path, int code) {
  throw Error(ErrorKind::io, fmt::format("error: {} cannot be made: {}\n  `tofray view -o FOLDER` writes elsewhere",
                                         base::printable(path.native()), std::generic_category().message(code)));
}

/// @return 0, or errno
int made(const fs::path& path, bool folder) {
  if (folder) return ::mkdir(path.c_str(), 0777) == 0 ? 0 : errno;
  const int file = ::open(path.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
  if (file < 0) return errno;
  ::close(file);
  return 0;
}

}  // namespace

fs::path NewEntry::name_of(int number) const { return in_ / fmt::format("{}_{:04}{}", prefix_, number, ending_); }

NewEntry::NewEntry(const fs::path& in, std::string prefix, std::string ending, bool folder)
    : in_(in), prefix_(std::move(prefix)), ending_(std::move(ending)) {
  std::error_code error;
  if (!in_.empty() && in_ != ".") fs::create_directories(in_, error);
  if (error) fail(in_, error.value());
  for (; number_ <= most_names; ++number_) {
    const fs::path name = name_of(number_), part = name.native() + ".part";
    if (fs::symlink_status(name, error).type() != fs::file_type::not_found) continue;
    const int code = made(part, folder);
    if (code == EEXIST) continue;
    if (code != 0) fail(part, code);
    part_ = part;
    return;
  }
  fail(name_of(most_names), EEXIST);
}

NewEntry::~NewEntry() { remove(); }

fs::path NewEntry::keep() {
  const std::lock_guard lock(mutex_);
  if (removed_) throw Error(ErrorKind::io, "error: the viewer ends");
  for (; number_ <= most_names; ++number_) {
    const fs::path name = name_of(number_);
    int code = ::renameat2(AT_FDCWD, part_.c_str(), AT_FDCWD, name.c_str(), RENAME_NOREPLACE) == 0 ? 0 : errno;
    // A file system that does not know the flag: whoever makes a file of that name at this very moment loses it.
    if (code == EINVAL) code = fs::exists(name) ? EEXIST : ::rename(part_.c_str(), name.c_str()) == 0 ? 0 : errno;
    if (code == EEXIST || code == ENOTEMPTY) continue;
    if (code != 0) fail(name, code);
    kept_ = true;
    return name;
  }
  fail(name_of(most_names), EEXIST);
}

void NewEntry::remove() {
  const std::lock_guard lock(mutex_);
  if (kept_) return;
  removed_ = true;
  // Another thread may put a file into the folder meanwhile.
  std::error_code error;
  for (int i = 0; i < 20; ++i)
    if (fs::remove_all(part_, error); !error) break;
}

}  // namespace tofray::view
