// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstddef>
#include <vector>

#include "tofray/camera.h"

namespace tofray::camera {

/// Modulation frequencies of the lit raw frames in the order they first appear, and their place in a common base.
struct Modulations {
  std::vector<double> frequency_hz;
  std::vector<int> of_raw_frame;  ///< −1: unlit
  std::vector<int> cycles;        ///< M_i: f_i = M_i·f_0
  double base_hz = 0;             ///< f_0
};
/// @throws Error (bad_input) where the frequencies have no common base with cycles up to 1000
Modulations modulations_of(const Mode& mode);

/// τ, of its phase and its delay together [rad]; 0 where unlit.
double reference_phase_of(const RawFrame& frame);

/// Reference phase of a modulation frequency's first raw frame [rad].
double first_phase(const Mode& mode, const Modulations& modulations, std::size_t modulation);

}  // namespace tofray::camera
