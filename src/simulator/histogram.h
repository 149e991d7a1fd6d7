// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <vector>

#include "tofray/stages.h"

namespace tofray::simulator {

/// All light of each pixel, of histograms by path length.
struct HistogramSums {
  std::vector<float> rate;    ///< [height][width] S [e⁻/s]
  std::vector<float> phasor;  ///< [modulation][order][height][width][2] Σ_k S_k·e^{i m 2π f n ℓ_k/c} [e⁻/s], m = 1, 3, 5 …
};

/// Each bin's light has the length of its middle.                                               [theory: transient-to-phasor]
/// @param refractive_index  n
/// @param orders            how many odd harmonics
HistogramSums sums_of(const Transient& transient, const std::vector<double>& frequency_hz, double refractive_index, int orders);

}  // namespace tofray::simulator
