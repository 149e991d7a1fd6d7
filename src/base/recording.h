// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <string>
#include <vector>

#include "base/range.h"
#include "tofray/frame.h"

/// What arrays by raw frame may hold that come from elsewhere, and which unit they may have been meant in.
namespace tofray::base {

/// Ranges of a recording's numbers, the same as those of profiles.
inline constexpr Range recorded_frequency_hz{1e3, 1e10}, recorded_phase_rad{-100, 100}, recorded_time_s{1e-9, 1e3};

/// Something that is wrong with one of the arrays.
struct RecordingFault {
  std::string what;  ///< in one line, complete in itself
  std::string more;  ///< what was expected, and the way out
};

/// The first fault of each array: megahertz for hertz, degrees for radians, microseconds for seconds, what is not finite or beyond its range.
///
/// Reference phases are taken for degrees where one is beyond its range, or beyond a turn and all are whole numbers.
///
/// @param raw  its arrays by raw frame all have `lit`'s size
std::vector<RecordingFault> faults_of_recording(const Raw& raw);

}  // namespace tofray::base
