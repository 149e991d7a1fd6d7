// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <string>

#include "files/json.h"
#include "tofray/analysis.h"

/// What a camera sees of a scene, as `check` says it.
namespace tofray::app {

/// Some lines, for a person: the findings are left out.
std::string scene_report_text(const SceneReport& report);
files::Json scene_report_json(const SceneReport& report);

}  // namespace tofray::app
