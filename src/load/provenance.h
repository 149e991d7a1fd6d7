// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <string>
#include <vector>

#include "yaml/tree.h"

namespace tofray::load {

/// Numbers of a profile that neither say nor inherit from their group where they come from, as file:line:col: text.
std::vector<std::string> unsourced_numbers(const yaml::Node& profile);

}  // namespace tofray::load
