// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <string>
#include <vector>

#include "pictures/color_map.h"

/// Line charts: the same drawing as PNG and as SVG.
namespace tofray::pictures {

/// A curve. Points whose y is NaN are left out, and the curve has a gap there.
struct Curve {
  std::string name;  ///< for the legend
  Rgb color;
  bool dashed = false;
  std::vector<double> x, y;
  int marked = -1;  ///< this point gets a ring; −1: none
};

struct Chart {
  std::string title;
  std::vector<std::string> notes;  ///< small lines below the title
  std::string x_label, y_label;
  std::vector<double> x_ticks;  ///< labelled places on the x axis; it begins at the first and ends at the last
  bool log_y = false;           ///< only positive values are drawn then
  std::vector<Curve> curves;
};

/// Colours that people with any kind of colour vision tell apart, also on our dark figures; they repeat after eight.
Rgb curve_color(std::size_t number);

std::string chart_png(const Chart& chart);

/// A chart as SVG 1.1 text: no script, no external reference, no font file.
std::string chart_svg(const Chart& chart);

}  // namespace tofray::pictures
