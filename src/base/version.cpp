// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include "base/version.h"

#include "tofray/version.h"

namespace tofray::base {

const char* version() { return TOFRAY_VERSION; }

}  // namespace tofray::base

namespace tofray {

const char* version() { return base::version(); }

}  // namespace tofray
