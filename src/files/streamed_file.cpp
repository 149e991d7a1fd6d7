// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include "files/streamed_file.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>

#include "files/write_steps.h"

namespace tofray::files {

namespace {

constexpr std::size_t buffer_bytes = std::size_t{1} << 20;

}  // namespace

StreamedFile::StreamedFile(std::filesystem::path path, std::filesystem::path folder, const FileCalls& calls)
    : path_(std::move(path)),
      folder_(std::move(folder)),
      calls_(calls),
      directory_(open_retrying(calls, AT_FDCWD, folder_.c_str(), O_RDONLY | O_DIRECTORY), calls),
      temporary_(directory_.number()) {
  if (directory_.number() < 0) {
    const int code = errno;
    temporary_.opened();
    fail_to_write(path_, "open the folder of its temporary file", code, 0, -1);
  }
  file_.emplace(open_retrying(calls, directory_.number(), temporary_.name(), O_WRONLY | O_CREAT | O_EXCL), calls);
  const int code = errno;
  temporary_.opened();
  if (file_->number() < 0) fail_to_write(folder_ / temporary_.name(), "make this temporary file", code, 0, directory_.number());
  struct stat status {};
  if (::fstat(file_->number(), &status) == 0) device_ = status.st_dev, number_ = status.st_ino;
}

StreamedFile::~StreamedFile() { ::unlinkat(directory_.number(), temporary_.name(), 0); }

void StreamedFile::append(std::string_view bytes) {
  size_ += bytes.size();
  sum_.add(bytes);
  buffer_.append(bytes);
  if (buffer_.size() >= buffer_bytes) flush();
}

void StreamedFile::flush() {
  if (!write_all(calls_, file_->number(), buffer_)) fail_to_write(path_, "write it", errno, buffer_.size(), directory_.number());
  buffer_.clear();
}

std::string StreamedFile::finish() {
  flush();
  if (!sync_file(calls_, file_->number())) fail_to_write(path_, "sync it to the disk", errno, size_, directory_.number());
  if (!file_->close()) fail_to_write(path_, "close it", errno, size_, directory_.number());
  return sum_.hex();
}

bool StreamedFile::has_its_name() const {
  struct stat named {};
  return ::stat(path_.c_str(), &named) == 0 && named.st_dev == device_ && named.st_ino == number_;
}

bool StreamedFile::rename_without_replacing() {
  if (::renameat2(directory_.number(), temporary_.name(), AT_FDCWD, path_.c_str(), RENAME_NOREPLACE) == 0) return true;
  const int code = errno;
  if (has_its_name()) return true;
  if (code == EEXIST) return false;
  // A file system that knows neither links nor this: two that come at once write the same bytes.
  struct stat named {};
  if (::stat(path_.c_str(), &named) == 0) return false;
  replace();
  return true;
}

bool StreamedFile::publish() {
  bool ours = true;
  if (calls_.link_at(directory_.number(), temporary_.name(), AT_FDCWD, path_.c_str()) != 0) {
    const int code = errno;
    // Over a network a request is sent again where its answer was lost: what is told to have failed may have been done.
    if (!has_its_name()) {
      if (code == EEXIST)
        ours = false;
      else if (code == EPERM || code == ENOSYS || code == EOPNOTSUPP || code == EMLINK)
        ours = rename_without_replacing();
      else
        fail_to_write(path_, "give the complete file its name", code, size_, directory_.number());
    }
  }
  if (ours) sync_folder();
  return ours;
}

void StreamedFile::replace() {
  if (calls_.rename_at(directory_.number(), temporary_.name(), AT_FDCWD, path_.c_str()) != 0) {
    const int code = errno;
    if (!has_its_name()) fail_to_write(path_, "give the complete file its name", code, size_, directory_.number());
  }
  sync_folder();
}

void StreamedFile::sync_folder() {
  const std::filesystem::path parent = path_.has_parent_path() ? path_.parent_path() : std::filesystem::path(".");
  const Descriptor folder(open_retrying(calls_, AT_FDCWD, parent.c_str(), O_RDONLY | O_DIRECTORY), calls_);
  if (folder.number() < 0) fail_to_write(path_, "open its folder", errno, size_, -1);
  if (!sync_file(calls_, folder.number())) fail_to_write(path_, "sync its folder to the disk", errno, size_, folder.number());
}

}  // namespace tofray::files
