// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "io/fill.h"

namespace tofray::io {

/// The camera's mode out of those that its profile has, with the checks that go beyond single numbers.
void read_modes(const Value& root, Camera& camera, Filler& filler, base::Faults& faults);

}  // namespace tofray::io
