// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include "analysis/reach.h"

#include "base/constants.h"
#include "camera/frozen_camera.h"

namespace tofray::analysis {

Reach reach_of(const Camera& camera) {
  const camera::Modulations modulations = camera::modulations_of(camera.mode);
  Reach out;
  if (modulations.frequency_hz.empty()) return out;
  const double half_speed = 0.5 * base::speed_of_light / camera.refractive_index;
  out.ambiguity_range_m = half_speed / modulations.base_hz;
  for (const double f : modulations.frequency_hz) out.ranges_m.push_back(half_speed / f);
  return out;
}

}  // namespace tofray::analysis
