// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstddef>

namespace tofray::base {

/// Asks whether the process may have so many bytes more, and gives them back: before a library begins that crashes or waits for ever where
/// memory ends (`ulimit -v`, control groups).
/// @throws std::bad_alloc where it may not
void require_address_space(std::size_t bytes);

/// What fontconfig, cairo and oneTBB each take to begin with, and more than twice of it.
inline constexpr std::size_t library_bytes = 16 << 20;

}  // namespace tofray::base
