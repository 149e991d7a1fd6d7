// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

/// Temporaries that a signal handler can remove. (end_writing() and remove_live_temporaries(), which do, are declared in atomic_file.h.)
namespace tofray::files {

struct TemporarySlot;

/// A temporary's name, and its place in a table, for as long as there may be a file of it.
class LiveTemporary {
 public:
  /// @param folder  open as long as this lives
  /// @throws Error (io) where all writing has ended, (limit) where too many files are being written
  explicit LiveTemporary(int folder);
  LiveTemporary(const LiveTemporary&) = delete;
  LiveTemporary& operator=(const LiveTemporary&) = delete;
  ~LiveTemporary();
  [[nodiscard]] const char* name() const;
  /// The file is there, or could not be made.
  void opened() const;

 private:
  TemporarySlot* slot_ = nullptr;
};

}  // namespace tofray::files
