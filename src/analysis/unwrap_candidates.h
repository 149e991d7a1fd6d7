// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstddef>
#include <vector>

#include "camera/decoder/view.h"
#include "tofray/pixel.h"

namespace tofray::analysis {

/// What unwrapping chooses from: each cycle of the reference, by cost.                          [theory: unwrapping, fusion]
/// @param turns   of each modulation frequency, calibrated
/// @param weight  1/sigma^2 of each half path [1/m^2]
/// @return none where there is one modulation frequency, or where a phase is not a number
std::vector<UnwrapCandidate> unwrap_candidates(const camera::DecoderView& decoder, const camera::LensView& lens, std::size_t pixel,
                                               const std::vector<float>& turns, const std::vector<float>& weight);

}  // namespace tofray::analysis
