// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include "files/output_folder.h"

#include <fcntl.h>
#include <fmt/core.h>
#include <sys/file.h>

#include <cerrno>
#include <system_error>

#include "files/atomic_file.h"
#include "files/sha256.h"
#include "tofray/error.h"

namespace tofray::files {

OutputFolder::OutputFolder(std::filesystem::path path) : path_(std::move(path)) {
  std::error_code error;
  std::filesystem::create_directories(path_, error);
  if (error) {
    const bool full = error == std::errc::no_space_on_device || error.value() == EDQUOT;
    throw Error(ErrorKind::io, fmt::format("{}: error: cannot make this folder: {}\n  {}choose another one with -o", path_.native(),
                                           std::generic_category().message(error.value()),
                                           full ? fmt::format("needed a folder and the run's files, free {}; ", free_room(path_)) : ""));
  }
  if (!std::filesystem::is_directory(path_, error))
    throw Error(ErrorKind::io, fmt::format("{}: error: this is a file\n  expected a folder, or nothing, in its place", path_.native()));
  lock_.emplace(::open(path_.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC));
  if (lock_->number() >= 0 && ::flock(lock_->number(), LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK)
    throw Error(ErrorKind::io,
                fmt::format("{}: error: another tofray is writing into this folder\n  wait until it is done, or choose another "
                            "folder with -o",
                            path_.native()));
  remove_stale_temporaries(path_);
}

FileRecord OutputFolder::put(const std::string& name, std::string_view bytes) const {
  write_file_atomically(path_ / name, bytes);
  return {name, bytes.size(), sha256_hex(bytes)};
}

void OutputFolder::add(FileRecord record) {
  if (!names_.insert(record.name).second) std::erase_if(files_, [&](const FileRecord& file) { return file.name == record.name; });
  files_.push_back(std::move(record));
}

}  // namespace tofray::files
