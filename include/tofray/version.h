// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace tofray {

/// This library's version, "major.minor.patch".
const char* version();

}  // namespace tofray
