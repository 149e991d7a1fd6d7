// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

#include "files/atomic_file.h"
#include "files/descriptor.h"
#include "files/sha256.h"
#include "tofray/file_record.h"

namespace tofray::mcap {

/// A file that grows piece by piece. Until it is complete it is called run.part.mcap for run.mcap, and stays there under that name if the
/// program ends early: what was written can be read. A file of the final name is intact until then.
class GrowingFile {
 public:
  /// @throws Error (io) with path, what failed and why
  explicit GrowingFile(std::filesystem::path path, const files::FileCalls& calls = files::system_file_calls());
  /// Appends. @throws Error (io)
  void write(std::string_view bytes);
  [[nodiscard]] std::uint64_t size() const { return size_; }
  /// Of all that was written.
  [[nodiscard]] std::uint32_t crc() const { return crc_; }
  /// Syncs it and gives it its name. Nothing may be written after it. @throws Error (io)
  FileRecord finish();
  /// Removes it: there is nothing in it worth keeping.
  void discard() noexcept;
  [[nodiscard]] const std::filesystem::path& part() const { return part_; }

 private:
  [[noreturn]] void fail(const char* what, int code) const;
  std::filesystem::path path_, part_;
  const files::FileCalls& calls_;
  std::optional<files::Descriptor> file_;
  files::Sha256 sum_;
  std::uint32_t crc_ = 0;
  std::uint64_t size_ = 0;
};

}  // namespace tofray::mcap
