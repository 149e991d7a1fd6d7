// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <string>
#include <vector>

#include "io/tree.h"

namespace tofray::io {

/// Numbers of a profile that neither say nor inherit from their group where they come from, as file:line:col: text.
std::vector<std::string> unsourced_numbers(const Node& profile);

}  // namespace tofray::io
