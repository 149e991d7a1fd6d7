// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "tofray/camera.h"

namespace tofray::base {

/// The camera whose reference phases are those that its raw data truly have: what they are off by is in them.
///
///     τ' = τ + 4π·f·n·d_off/c + φ_off(f)                                                 [theory: recording-offsets]
///
/// @param camera  was seen to be good
Camera with_offsets(const Camera& camera);

/// What a specimen's calibration says of a modulation frequency; null: nothing.
const FrequencyCalibration* calibration_at(const DecoderCalibration& known, double modulation_frequency_hz);

}  // namespace tofray::base
