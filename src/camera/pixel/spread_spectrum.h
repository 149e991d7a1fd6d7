// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "tofray/camera.h"

namespace tofray::camera {

/// Mean frequency of the light over the band that is swept [Hz].                                [theory: spread-spectrum-down]
inline double mean_frequency(const SpreadSpectrum& spread, double frequency_hz) {
  return spread.kind == SpreadSpectrum::Kind::down ? frequency_hz * (1 - 0.5 * spread.width) : frequency_hz;
}

/// Half the width of that band [Hz].                                                                 [theory: spread-spectrum]
inline double swept_half_width(const SpreadSpectrum& spread, double frequency_hz) { return 0.5 * spread.width * frequency_hz; }

}  // namespace tofray::camera
