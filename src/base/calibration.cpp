// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include "base/calibration.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "base/constants.h"
#include "base/curve.h"

namespace tofray::base {

Camera with_offsets(const Camera& camera) {
  Camera out = camera;
  const Calibration& known = camera.calibration;
  std::optional<ClampedCurve> phase_offset;
  if (!known.phase_offset.y.empty()) phase_offset.emplace(known.phase_offset, "phase_offset");
  const double per_hertz = 2 * two_pi * known.range_offset_m * camera.refractive_index / speed_of_light;
  for (RawFrame& frame : out.mode.sequence) {
    if (!frame.lit) continue;
    frame.reference_phase_rad += per_hertz * frame.modulation_frequency_hz;
    if (phase_offset) frame.reference_phase_rad += phase_offset->evaluate(frame.modulation_frequency_hz);
  }
  return out;
}

const FrequencyCalibration* calibration_at(const DecoderCalibration& known, double modulation_frequency_hz) {
  constexpr double same = 1e-6;
  const auto is_it = [&](const FrequencyCalibration& one) {
    return std::abs(one.modulation_frequency_hz - modulation_frequency_hz) <= same * modulation_frequency_hz;
  };
  const auto found = std::find_if(known.frequencies.begin(), known.frequencies.end(), is_it);
  return found == known.frequencies.end() ? nullptr : &*found;
}

}  // namespace tofray::base
