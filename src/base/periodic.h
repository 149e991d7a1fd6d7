// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <vector>

/// Measured functions of one turn.
namespace tofray::base {

/// Equally spaced samples of a period from phase 0 on, an even number of them: as they are where they are that already, else of the periodic
/// spline through them.
/// @param phases_rad  where the samples are, ascending within one turn; empty: equally spaced from 0 on
/// @throws Error (bad_input) as Spline does
std::vector<double> over_a_period(const std::vector<double>& phases_rad, const std::vector<double>& samples);

/// Root mean square of the even harmonics over that of the odd ones; the mean is neither. Infinite where there are no odd ones, 0 where there is
/// nothing.
/// @param samples  equally spaced over the period, an even number
double even_share(const std::vector<double>& samples);

}  // namespace tofray::base
