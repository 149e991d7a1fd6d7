// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstdint>

#include "effect/list.h"

/// The pixel, frozen for rendering: how light becomes phasors, and the sensor with all of its effects.
namespace tofray::camera {

// What the sensor's effects read.
using effect::Gate;
using effect::Noise;
using effect::RawFrameView;
using effect::ReadCurveView;
using effect::SensorView;

/// One modulation frequency: how the light of a path becomes phasors.
struct ModulationView {
  float turns_per_metre_high, turns_per_metre_low;  ///< f·n/c in two parts
  float frequency;                                  ///< [Hz], for delays by pixel
  float swept_turns_per_metre;  ///< half the swept band's width·n/c; 0: nothing is swept                 [theory: spread-spectrum]
  const float* source;          ///< [light][orders][2] a_m·e^{i(ψ_m + mτ_0)} of each light, τ_0 the modulation's first reference phase
};

/// All of them. `orders` of 1, 3, 5 … are kept, 4 or 8; those that a camera does not have are zero.
struct PhasorView {
  std::int32_t modulations, orders;
  const ModulationView* modulation;
  std::int32_t sums_alone;  ///< 1: there is one light, all gates stay at quarter turns and no pixel is late: no order is needed by itself
  bool operator==(const PhasorView&) const = default;
};

}  // namespace tofray::camera
