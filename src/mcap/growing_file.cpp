// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include "mcap/growing_file.h"

#include <fcntl.h>
#include <fmt/core.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <system_error>

#include "base/text.h"
#include "files/crc32.h"
#include "tofray/error.h"

namespace tofray::mcap {

namespace {

std::filesystem::path part_of(const std::filesystem::path& path) {
  std::filesystem::path part = path;
  return part.replace_filename(path.stem().native() + ".part" + path.extension().native());
}

}  // namespace

GrowingFile::GrowingFile(std::filesystem::path path, const files::FileCalls& calls)
    : path_(std::move(path)), part_(part_of(path_)), calls_(calls) {
  std::error_code ignored;
  const auto status = std::filesystem::status(path_, ignored);
  if (!path_.has_filename() || std::filesystem::is_directory(status)) fail("write it", EISDIR);
  if (std::filesystem::exists(status) && !std::filesystem::is_regular_file(status))
    throw Error(ErrorKind::io, fmt::format("{}: error: this is no regular file\n  expected a file, or nothing, in its place",
                                           base::printable(path_.native())));
  // Of a run that was killed; what is no file of ours to write into (a link, a pipe) goes, too, and is not followed.
  if (::unlink(part_.c_str()) != 0 && errno != ENOENT) fail("remove what an earlier run left", errno);
  int number = -1;
  do number = calls_.open_at(AT_FDCWD, part_.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
  while (number < 0 && errno == EINTR);
  if (number < 0) fail("make it", errno);
  file_.emplace(number, calls_);
}

void GrowingFile::fail(const char* what, int code) const {
  const std::string shown = base::printable(part_.native());
  std::string text = fmt::format("{}: error: cannot {}: {}", shown, what, std::generic_category().message(code));
  if (code == ENOSPC || code == EDQUOT)
    text += fmt::format("\n  free {}; what was written until now can be read: `tofray inspect {}`", files::free_room(part_.parent_path()),
                        shown);
  else if (code == ENOENT)
    text += "\n  expected a folder that exists";
  else if (code == EACCES || code == EPERM || code == EROFS)
    text += "\n  expected a folder that you may write to";
  throw Error(ErrorKind::io, text);
}

void GrowingFile::write(std::string_view bytes) {
  sum_.add(bytes);
  crc_ = files::crc32(bytes, crc_);
  size_ += bytes.size();
  while (!bytes.empty()) {
    const ssize_t written = calls_.write(file_->number(), bytes.data(), bytes.size());
    if (written < 0 && errno == EINTR) continue;
    if (written <= 0) fail("write it", written < 0 ? errno : EIO);
    bytes.remove_prefix(static_cast<std::size_t>(written));
  }
}

void GrowingFile::discard() noexcept { ::unlink(part_.c_str()); }

FileRecord GrowingFile::finish() {
  int result = -1;
  do result = calls_.sync(file_->number());
  while (result < 0 && errno == EINTR);
  if (result < 0 && errno != EINVAL && errno != ENOTSUP) fail("sync it to the disk", errno);
  if (!file_->close()) fail("close it", errno);
  if (calls_.rename_at(AT_FDCWD, part_.c_str(), AT_FDCWD, path_.c_str()) != 0) fail("give the complete file its name", errno);
  return {path_.filename().native(), size_, sum_.hex()};
}

}  // namespace tofray::mcap
