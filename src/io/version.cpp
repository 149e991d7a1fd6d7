// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include "io/version.h"

namespace tofray::io {

const char* version() { return TOFRAY_VERSION; }

}  // namespace tofray::io
