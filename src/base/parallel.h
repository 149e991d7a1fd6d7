// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <functional>

namespace tofray::base {

/// Calls unit(0) … unit(count − 1), each once, in any order, on several threads at once.
/// @param threads  at most; 0: one per core
void in_parallel(int count, int threads, const std::function<void(int)>& unit);

}  // namespace tofray::base
