// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "base/faults.h"
#include "tofray/camera.h"
#include "yaml/reader.h"

/// What a mode reads of the sensor: a region of it, and so many pixels as one.
namespace tofray::load {

/// Cuts the camera's image down to `region: {left, top, width, height}`: sensor and principal point.
void take_region(const yaml::Value& region, Camera& camera, base::Faults& faults);

/// Adds the charge of `binning` × `binning` pixels before it is read: one pixel of so many times the pitch.               [theory: eq. 3.35]
void take_binning(const yaml::Value& binning, Camera& camera, base::Faults& faults);

}  // namespace tofray::load
