// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <string>
#include <string_view>

namespace tofray::messages {

/// How ROS 2 (from Iron on) knows that two types of one name are the same (REP 2016): "RIHS01_" and the SHA-256 of a description of the type
/// and of all types within it, as JSON. Constants and defaults do not count.
/// @throws Error (bad_input) for a type that no topic has
std::string type_hash(std::string_view type);

/// That description.
std::string type_description_json(std::string_view type);

}  // namespace tofray::messages
