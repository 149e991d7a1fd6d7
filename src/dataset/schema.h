// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <string>

namespace tofray::dataset {

/// JSON Schema (draft 2020-12) of a set's file: its own keys, and those of a scene, in which a form may stand in the place of any value.
/// It refuses what is wrong in its kind; what forms draw, and whether their numbers fit where they stand, is seen when they are drawn.
std::string schema_json();

}  // namespace tofray::dataset
