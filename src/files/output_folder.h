// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <unordered_set>
#include <vector>

#include "files/descriptor.h"
#include "tofray/file_record.h"

namespace tofray::files {

/// The folder that results go to: made with its parents where it is missing. Files of the same name are replaced, others left alone (but
/// temporaries that a killed run left are removed), and each is complete or absent. While one lives no other process has one of the same
/// folder: who ends, however it ends, leaves no lock behind. (A file system that has no locks gives none.)
class OutputFolder {
 public:
  /// @throws Error (io) where the folder cannot be made, a file is in its place, or another process writes into it
  explicit OutputFolder(std::filesystem::path path);

  /// Writes one file. Several threads may do so at once. @throws Error (io)
  [[nodiscard]] FileRecord put(const std::string& name, std::string_view bytes) const;
  /// Remembers a file that was put.
  void add(FileRecord record);
  /// Both. @throws Error (io)
  void write(const std::string& name, std::string_view bytes) { add(put(name, bytes)); }

  [[nodiscard]] const std::filesystem::path& path() const { return path_; }
  /// What has been added, in order; a name that was added twice stands once, as last written.
  [[nodiscard]] const std::vector<FileRecord>& files() const { return files_; }

 private:
  std::filesystem::path path_;
  std::optional<Descriptor> lock_;
  std::vector<FileRecord> files_;
  std::unordered_set<std::string> names_;  ///< of the files: a run of many frames does not search the list for each
};

}  // namespace tofray::files
