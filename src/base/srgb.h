// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <algorithm>
#include <cmath>

/// Colours as pictures, scanners and programs for meshes write them.
namespace tofray::base {

/// A sample of 0…1, IEC 61966-2-1.
inline double linear_of_srgb(double a) { return a <= 0.04045 ? a / 12.92 : std::pow((a + 0.055) / 1.055, 2.4); }

/// Relative luminance (ITU-R BT.709) of linear red, green and blue, 1 at most.
inline double luminance(double red, double green, double blue) { return std::min(0.2126 * red + 0.7152 * green + 0.0722 * blue, 1.0); }

}  // namespace tofray::base
