// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <string>

#include "tofray/frame.h"

namespace tofray::pictures {

/// What a terminal can show.
enum class TerminalColors {
  full,  ///< 24-bit colours and the upper half block: two pixels per character
  none,  ///< NO_COLOR: letters of ASCII, the nearer the denser
};

/// A picture of z for a terminal, with a scale below it. Lines end in '\n'; colours are reset at the end of each.
/// @param columns  width of the terminal; the picture takes no more, and no more than the image has pixels
std::string terminal_picture(const Depth& depth, int columns, TerminalColors colors);

}  // namespace tofray::pictures
