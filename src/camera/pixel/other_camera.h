// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstdint>

#include "num/philox.h"
#include "tofray/camera.h"

/// Light of another camera, as the gate of one raw frame meets it.                                        [theory: interference]
namespace tofray::camera {

/// Another camera's light in one raw frame, over the camera's own illumination.
struct OtherLight {
  double share = 0;      ///< how much there is of it
  double swing = 0;      ///< how much of that has a phase which is known: all or nothing
  double phase_rad = 0;  ///< at the middle of the exposure
};

/// @param middle_s  of the exposure, from the start of frame 0 on
/// @param drawn     two random words of the raw frame, or null: what is expected
OtherLight other_light(const Interference& other, double middle_s, const num::Random4<float>* drawn);

/// What its light correlates to: cos and sin for each odd harmonic, times its share.
/// @param turns  by which its phase turns during the exposure
/// @param phase  at which the gate meets the camera's own light [rad]
/// @param gate   [orders][2]
void write_other_gate(const OtherLight& light, double turns, double phase, int orders, float* gate);

}  // namespace tofray::camera
