// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <string>
#include <string_view>
#include <vector>

/// A plain font of pen strokes, drawn for the labels of our pictures.
namespace tofray::io {

/// A straight stroke on the font's grid: x to the right, y down from the top of a capital letter; the baseline is at y = cap_height.
struct Segment {
  double x0, y0, x1, y1;
};

struct Glyph {
  double width = 0;
  std::vector<Segment> segments;
};

inline constexpr double cap_height = 8;

/// Takes one UTF-8 character off the front; "?" for bytes that are none.
std::string_view take_character(std::string_view& utf8);

/// The glyph of one character; an empty box where the font has none.
const Glyph& glyph_of(std::string_view character);

}  // namespace tofray::io
