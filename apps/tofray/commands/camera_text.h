// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <string>

#include "files/json.h"
#include "tofray/camera_report.h"

/// What a camera can do in its mode, as `check` says it.
namespace tofray::app {

/// Some lines, for a person.
std::string report_text(const CameraReport& report);
files::Json report_json(const CameraReport& report);

}  // namespace tofray::app
