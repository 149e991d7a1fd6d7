// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "files/descriptor.h"

namespace tofray::shards {

/// A process that makes shards: a folder of its own below work/ for what is under way, and a log below log/ of the samples that it begins and ends.
class Worker {
 public:
  /// @throws Error (io)
  explicit Worker(const std::filesystem::path& set_folder);
  Worker(const Worker&) = delete;
  Worker& operator=(const Worker&) = delete;
  ~Worker();

  [[nodiscard]] const std::filesystem::path& folder() const { return folder_; }
  /// Several threads may tell at once.
  void begins(std::uint64_t sample) const;
  void ends(std::uint64_t sample) const;

 private:
  void log(const std::string& line) const;
  std::filesystem::path folder_;
  std::optional<files::Descriptor> lock_, log_;
};

/// Removes what dead processes of this machine left below work/: the folder's name says the machine and the process, and nobody holds its lock. Where the file system
/// has no locks, it stays.
void remove_dead_workers(const std::filesystem::path& set_folder);

/// Samples that at least so many processes were computing when they ended without a word, by the logs.
std::vector<std::uint64_t> deadly_samples(const std::filesystem::path& set_folder, int deaths);

/// Folders below work/.
std::uint64_t workers_at(const std::filesystem::path& set_folder);

}  // namespace tofray::shards
