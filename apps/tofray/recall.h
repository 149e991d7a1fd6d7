// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "options.h"
#include "results/manifest.h"

namespace tofray::app {

/// What a run was told, put back from its manifest. What changes no bytes (threads, folder) stays as it was typed now; `now.from` is the
/// manifest's path, for messages.
/// @throws Error (bad_input) where the manifest has an option that is unknown, or a value that it cannot have
Options recalled(const Options& now, const results::Manifest& manifest);

}  // namespace tofray::app
