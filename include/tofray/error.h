// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <stdexcept>
#include <string>

namespace tofray {

/// What went wrong, as a process exit code says it (the command line returns the value unchanged).
enum class ErrorKind {
  bad_input = 2,  ///< bad usage, or a fault in what the user wrote
  io = 3,         ///< cannot read or write
  limit = 4,      ///< out of memory, or over a limit printed by `tofray --limits`
  device = 5,     ///< no such device, or it failed
  bug = 70,       ///< a fault of ours
};

/// The one exception type at the API border.
///
/// The text's first line is complete in itself (file:line:col: error: what); further lines say what was
/// got, what is expected and how to mend it. Several faults of one file stand one after the other.
class Error : public std::runtime_error {
 public:
  /// The text is safe to print: control characters and bytes that are not UTF-8 stand as `\xNN`, and what is too long is cut.
  Error(ErrorKind kind, const std::string& message);
  [[nodiscard]] ErrorKind kind() const noexcept { return kind_; }

 private:
  ErrorKind kind_;
};

}  // namespace tofray
