// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <string>
#include <string_view>

namespace tofray::base {

/// Bytes as digits of RFC 4648.
std::string base64(std::string_view bytes);

}  // namespace tofray::base
