// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <string>

#include "base/range.h"
#include "tofray/error.h"

/// Single checks of numbers that a program set; a message names the member by its path.
namespace tofray::simulator {

[[noreturn]] void refuse(const std::string& what, const std::string& more, ErrorKind kind = ErrorKind::bad_input);

void within(double value, const base::Range& range, const std::string& path);

}  // namespace tofray::simulator
