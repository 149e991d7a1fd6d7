// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
// Loaded before the program's own libraries: ends it politely before any of them is initialised.
#include <csignal>

namespace {
[[gnu::constructor]] void end_politely() { ::raise(SIGTERM); }
}  // namespace
