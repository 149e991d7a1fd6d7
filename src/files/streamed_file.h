// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <sys/types.h>

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

#include "files/atomic_file.h"
#include "files/descriptor.h"
#include "files/live_temporary.h"
#include "files/sha256.h"

namespace tofray::files {

/// A file that is written piece by piece under a temporary name and gets its own when it is complete: for files that no memory should hold, and that
/// several machines may make at once. Whoever comes second finds the first one's file and leaves it alone.
class StreamedFile {
 public:
  /// @param path    its name once it is complete
  /// @param folder  for the temporary: of this process alone, and on the file system of `path`
  /// @throws Error (io)
  StreamedFile(std::filesystem::path path, std::filesystem::path folder, const FileCalls& calls = system_file_calls());
  StreamedFile(const StreamedFile&) = delete;
  StreamedFile& operator=(const StreamedFile&) = delete;
  /// Removes the temporary.
  ~StreamedFile();

  /// @throws Error (io)
  void append(std::string_view bytes);
  /// How many bytes were appended.
  [[nodiscard]] std::uint64_t size() const { return size_; }
  /// Brings all of it to the disk; nothing may be appended after it. @return its SHA-256 @throws Error (io)
  std::string finish();
  /// Gives it its name in one step. @return false where there is a file of that name, which stays @throws Error (io)
  bool publish();
  /// Gives it its name in one step, in place of any file that has the name.
  void replace();

 private:
  void flush();
  [[nodiscard]] bool has_its_name() const;
  bool rename_without_replacing();
  void sync_folder();

  std::filesystem::path path_, folder_;
  const FileCalls& calls_;
  Descriptor directory_;
  LiveTemporary temporary_;
  std::optional<Descriptor> file_;
  std::string buffer_;
  std::uint64_t size_ = 0;
  Sha256 sum_;
  dev_t device_ = 0;
  ino_t number_ = 0;
};

}  // namespace tofray::files
