// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include "base/recording.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "base/constants.h"
#include "base/text.h"

namespace tofray::base {

namespace {

std::string range_text(const Range& range, const char* unit) {
  return fmt::format("{} to {} {}", number_text(range.low), number_text(range.high), unit);
}

RecordingFault fault_at(const char* array, double value, const char* unit, std::size_t k, const std::string& more) {
  return {fmt::format("array \"{}\" has {} {} for raw frame {}", array, number_text(value), unit, k), more};
}

std::optional<RecordingFault> frequency_fault(const Raw& raw) {
  const char* const array = "modulation_frequency_hz";
  for (std::size_t k = 0; k < raw.lit.size(); ++k) {
    const double value = raw.modulation_frequency_hz[k];
    if (raw.lit[k] == 0 || recorded_frequency_hz.contains(value)) continue;
    if (value == 0)
      return RecordingFault{fmt::format("raw frame {} is lit and has no modulation frequency", k),
                            "expected modulation_frequency_hz above 0 where lit is true"};
    if (value > 0 && value < recorded_frequency_hz.low)
      return fault_at(array, value, "Hz", k,
                      fmt::format("expected hertz, {} or more; are these megahertz? Then multiply them by 1e6", recorded_frequency_hz.low));
    return fault_at(array, value, "Hz", k, "expected " + range_text(recorded_frequency_hz, "Hz"));
  }
  return {};
}

std::optional<RecordingFault> phase_fault(const Raw& raw) {
  const std::vector<double>& phases = raw.reference_phase_rad;
  const bool whole = std::all_of(phases.begin(), phases.end(), [](double value) { return value == std::rint(value); });
  for (std::size_t k = 0; k < raw.lit.size(); ++k) {
    const double value = phases[k];
    const bool far = !recorded_phase_rad.contains(value), degrees = far || (whole && std::abs(value) > two_pi);
    if (raw.lit[k] == 0 || !degrees) continue;
    const std::string limits = "expected radians" + (far ? ", " + range_text(recorded_phase_rad, "rad") : "");
    return fault_at(
        "reference_phase_rad", value, "rad", k,
        std::isfinite(value) ? limits + "; are these degrees? np.deg2rad(reference_phase_rad) turns them into radians" : limits);
  }
  return {};
}

std::optional<RecordingFault> time_fault(const Raw& raw) {
  for (std::size_t k = 0; k < raw.lit.size(); ++k) {
    const double value = raw.integration_time_s[k];
    if (recorded_time_s.contains(value)) continue;
    if (value == 0) return RecordingFault{fmt::format("raw frame {} has no integration time", k), "expected integration_time_s above 0"};
    return fault_at("integration_time_s", value, "s", k,
                    "expected " + range_text(recorded_time_s, "s") +
                        (value > recorded_time_s.high ? "; are these microseconds? Then multiply them by 1e-6" : ""));
  }
  return {};
}

}  // namespace

std::vector<RecordingFault> faults_of_recording(const Raw& raw) {
  std::vector<RecordingFault> faults;
  for (const auto& fault : {frequency_fault(raw), phase_fault(raw), time_fault(raw)})
    if (fault) faults.push_back(*fault);
  return faults;
}

}  // namespace tofray::base
