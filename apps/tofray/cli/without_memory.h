// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

/// Where memory ends in a place that no exception leaves: a thread, a destructor, what runs before main(), the stack that cannot grow.
namespace tofray::app {

/// What people are told, in every such place.
inline constexpr char out_of_memory[] =
    "error: out of memory\n"
    "  a smaller sensor, fewer raw frames or fewer threads need less; `tofray --limits` lists what is allowed at all\n";

}  // namespace tofray::app
