// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <functional>

namespace tofray::base {

/// How many threads a number means: itself, or one per core for 0.
int threads_of(int wanted);

/// Calls unit(0) … unit(count − 1), each once, in any order, on several threads at once.
/// @param threads  at most; 0: one per core
/// @throws what a unit throws, once all that have begun have ended; of several the first. The units that are left are not called
void in_parallel(int count, int threads, const std::function<void(int)>& unit);

}  // namespace tofray::base
