// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <string>

#include "base/faults.h"
#include "base/limits.h"

/// Reading files that people write: whole, as text, and only where they may lie.
namespace tofray::files {

/// Reads a file that the user named himself; a pipe is good, too.
/// @throws Error (io) where it cannot be read, (limit) where it is longer than limit::file_bytes
std::string read_text(const std::string& path);

/// What comes on stdin, to its end. @throws Error as read_text
std::string read_standard_input();

/// What a file may point to: `reference` relative to `folder`, and in or below it; with a `root`, in or below that.
/// Absolute paths, "..", links that lead out, and anything but a plain file are refused and never read.
/// @param place    who points there, for messages
/// @param folder   "" means "."
/// @param found    set to the path that was opened
/// @param most     of its bytes
std::string read_reference(const std::string& reference, const std::string& folder, const std::string& root, const base::Place& place,
                           std::string& found, const base::Limit& most = base::limit::file_bytes);

/// The folder that a path lies in, "." where it names none.
std::string folder_of(const std::string& path);

}  // namespace tofray::files
