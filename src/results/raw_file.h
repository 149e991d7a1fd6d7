// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <string>
#include <string_view>

#include "tofray/frame.h"

/// Raw data, simulated or measured, for `tofray process`.
namespace tofray::results {

/// Reads raw data from a .npz file: `raw`, or `tap_a` and `tap_b`, [phase, height, width], and `modulation_frequency_hz`,
/// `reference_phase_rad`, `integration_time_s`, `start_time_s`, `lit` [phase]. Whole numbers of any width are taken for `raw` where
/// they fit uint16, float32 and float64 for the taps. `start_time_s` may be missing and is empty then: a recording seldom has it, and
/// depth does not depend on it.
/// @throws Error (bad_input) that names every array that is missing or misshapen; (io) where the file cannot be read
Raw read_raw_npz(const std::string& path);

/// Raw data out of a file that is in memory. @param where  the path, for messages
Raw parse_raw_npz(std::string_view file, const std::string& where);

}  // namespace tofray::results
