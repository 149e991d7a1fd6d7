// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include "camera/pixel/modulations.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "base/constants.h"
#include "flow/flow.h"
#include "tofray/error.h"

namespace tofray::camera {

namespace {

constexpr int most_cycles = 1000;

/// Smallest whole numbers in the ratio of the frequencies, or nothing: each f_i/f_1 must be p/q with small q.
bool whole_ratio(const std::vector<double>& frequencies, std::vector<int>& cycles) {
  for (int first = 1; first <= most_cycles; ++first) {
    cycles.clear();
    bool whole = true;
    for (const double frequency : frequencies) {
      const double m = first * frequency / frequencies[0];
      whole = whole && std::abs(m - std::rint(m)) < 1e-6 && m < most_cycles + 0.5;
      cycles.push_back(static_cast<int>(std::rint(m)));
    }
    if (whole) return true;
  }
  return false;
}

}  // namespace

double reference_phase_of(const RawFrame& frame) {
  return frame.lit ? frame.reference_phase_rad + base::two_pi * frame.modulation_frequency_hz * frame.reference_delay_s : 0;
}

double first_phase(const Mode& mode, const Modulations& modulations, std::size_t modulation) {
  const auto at = std::find(modulations.of_raw_frame.begin(), modulations.of_raw_frame.end(), static_cast<int>(modulation));
  return reference_phase_of(mode.sequence[static_cast<std::size_t>(at - modulations.of_raw_frame.begin())]);
}

Modulations modulations_of(const Mode& mode) {
  Modulations out;
  for (const RawFrame& frame : mode.sequence) {
    if (!frame.lit) {
      out.of_raw_frame.push_back(-1);
      continue;
    }
    const auto at = std::find(out.frequency_hz.begin(), out.frequency_hz.end(), frame.modulation_frequency_hz);
    out.of_raw_frame.push_back(static_cast<int>(at - out.frequency_hz.begin()));
    if (at == out.frequency_hz.end()) out.frequency_hz.push_back(frame.modulation_frequency_hz);
  }
  if (out.frequency_hz.empty()) return out;
  if (out.frequency_hz.size() > flow::max_modulation_frequencies) {
    throw Error(ErrorKind::limit,
                "error: more than " + std::to_string(flow::max_modulation_frequencies) + " modulation frequencies in one sequence");
  }
  if (!whole_ratio(out.frequency_hz, out.cycles)) {
    throw Error(
        ErrorKind::bad_input,
        "error: the modulation frequencies have no common base frequency\n"
        "  unwrapping needs whole cycles of each in a common range; choose frequencies in a ratio of small whole numbers, such as 4 : 3");
  }
  out.base_hz = out.frequency_hz[0] / out.cycles[0];
  return out;
}

}  // namespace tofray::camera
