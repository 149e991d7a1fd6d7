// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <vector>

#include "camera/decoder/view.h"

namespace tofray::analysis {

/// The table by which the camera takes wiggling out of a modulation frequency's phase.        [theory: wiggling-correction]
class PhaseCorrection {
 public:
  PhaseCorrection(const camera::DecoderView& decoder, const camera::DecodeModulation& modulation);
  /// φ by φ̂ [rad], not held to one turn.
  [[nodiscard]] double operator()(double measured) const;
  /// dφ/dφ̂ between two nodes, as the camera has it.
  [[nodiscard]] double slope(double measured) const;

 private:
  std::vector<double> value_;  // φ − φ̂ in turns, at equidistant φ̂
};

}  // namespace tofray::analysis
