// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <string>

#include "pictures/pictures.h"
#include "tofray/compare.h"

namespace tofray::pictures {

/// A map of A − B (scale as of errors in preview.png; not in both: the colour of invalid pixels) with its scale bar, and the histogram
/// beside it.
/// @param caption  one line above, UTF-8
std::string difference_picture(const Comparison& comparison, const std::string& caption, const Style& style);

}  // namespace tofray::pictures
