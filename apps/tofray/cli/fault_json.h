// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <string>

#include "files/json.h"
#include "tofray/error.h"

namespace tofray::app {

/// What a command with --json prints where it fails: {"good": false, "exit_code", "faults": [{"file", "line", "column", "text", "more"}]}.
/// It takes an Error's text apart, whose form error.h says: a line "file:line:column: error: what" for each fault, indented lines that
/// belong to it. Where a fault has no file, no line or nothing more to say, these are null.
files::Json fault_json(const std::string& text, ErrorKind kind);

}  // namespace tofray::app
