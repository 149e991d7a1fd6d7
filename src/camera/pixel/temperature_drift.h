// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "num/setup_math.h"
#include "tofray/camera.h"

namespace tofray::camera {

/// Half path by which the sensor has drifted at a time [m]: with the temperature, and while it warms up.  [theory: temperature-drift]
/// @param time_s  after the start of the first frame
inline double drift_m(const Temperature& t, double time_s) {
  const double warm = t.warm_up_m == 0 ? 0 : t.warm_up_m * (1 - num::setup::exp(-(t.since_start_s + time_s) / t.warm_up_time_s));
  return t.drift_m_per_kelvin * (t.celsius - t.reference_celsius) + warm;
}

}  // namespace tofray::camera
