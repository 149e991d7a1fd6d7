// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <string>

namespace tofray::app {

/// `tofray inspect run.mcap`: topics, types, counts, rates, sizes. @return the exit code
int inspect_film(const std::string& file, bool json);

/// What is said of a file that has no end.
std::string ends_early(const std::string& file);

}  // namespace tofray::app
