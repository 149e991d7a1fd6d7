// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstddef>
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
/// @param samples  equally spaced over the period, an even number: then images of odd harmonics are odd, and this is exact
double even_share(const std::vector<double>& samples);

/// Share of even harmonics where the samples are odd in number or unevenly spaced: there an odd harmonic m beyond what they carry shows as the even
/// one measured − m. Of each even harmonic counts only what is more than such an image, where the odd ones fall as 1/m or faster.
/// @param samples   equally spaced over the period
/// @param measured  how many of them there were before a spline went through them
/// @param most      the highest even harmonic that counts
double even_share_of_few(const std::vector<double>& samples, std::size_t measured, std::size_t most);

}  // namespace tofray::base
