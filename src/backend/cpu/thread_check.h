// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstddef>

namespace tofray::backend {

/// Makes threads beside this one and ends them again, to see whether the system grants them (`ulimit -u`, `ulimit -v`, control groups):
/// oneTBB ends the process where one of its own cannot be made. What was granted once is not asked for again.
/// @param threads      of one run, this one included
/// @param stack_bytes  of each
/// @throws Error (limit) where it does not
void require_threads(int threads, std::size_t stack_bytes);

/// The Error that says so.
[[noreturn]] void refuse_threads(int threads, int code);

}  // namespace tofray::backend
