// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <string>
#include <string_view>

namespace tofray::view {

/// 256 random bits of the system as 64 hexadecimal digits: who knows them may talk to the viewer.
/// @throws Error (io) where the system gives none
std::string new_token();

/// Whether two texts are the same, in a time that depends on the length of `given` alone.
bool same_secret(std::string_view secret, std::string_view given);

}  // namespace tofray::view
