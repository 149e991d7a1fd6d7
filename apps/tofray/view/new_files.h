// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <filesystem>
#include <mutex>
#include <string>

namespace tofray::view {

/// A folder or file of a name that nothing has yet, PREFIX_0001ENDING or the next that is free, in a folder. Until it is kept it has ".part"
/// behind its name; if it never is, it goes with this.
class NewEntry {
 public:
  /// @throws Error (io)
  NewEntry(const std::filesystem::path& in, std::string prefix, std::string ending, bool folder);
  ~NewEntry();
  NewEntry(const NewEntry&) = delete;
  NewEntry& operator=(const NewEntry&) = delete;

  [[nodiscard]] const std::filesystem::path& part() const { return part_; }
  /// Gives it its name. @throws Error (io)
  std::filesystem::path keep();
  /// Removes it; it cannot be kept any more. From any thread.
  void remove();

 private:
  [[nodiscard]] std::filesystem::path name_of(int number) const;
  std::filesystem::path in_;
  std::string prefix_, ending_;
  int number_ = 1;
  std::mutex mutex_;
  std::filesystem::path part_;
  bool kept_ = false, removed_ = false;
};

}  // namespace tofray::view
