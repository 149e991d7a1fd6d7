// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include "pictures/terminal_picture.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "pictures/color_map.h"
#include "pictures/picture_scale.h"

namespace tofray::pictures {
namespace {

constexpr const char* reset = "\x1b[0m";
constexpr const char* upper_half_block = "\xE2\x96\x80";

/// A smaller image; NaN where most of a cell's pixels are invalid.
struct Cells {
  int columns = 0, rows = 0;
  std::vector<double> values;
  [[nodiscard]] double at(int column, int row) const {
    return row < rows ? values[static_cast<std::size_t>(row) * static_cast<std::size_t>(columns) + static_cast<std::size_t>(column)]
                      : std::nan("");
  }
};

/// Mean z over each cell's pixels, invalid ones left out.
Cells shrunk(const Depth& depth, int columns, int rows) {
  Cells cells{columns, rows, {}};
  for (int row = 0; row < rows; ++row)
    for (int column = 0; column < columns; ++column) {
      const int left = column * depth.width / columns, right = std::max(left + 1, (column + 1) * depth.width / columns);
      const int top = row * depth.height / rows, bottom = std::max(top + 1, (row + 1) * depth.height / rows);
      double sum = 0;
      int valid = 0;
      for (int v = top; v < bottom; ++v)
        for (int u = left; u < right; ++u) {
          const float z = depth.z_m[static_cast<std::size_t>(v) * static_cast<std::size_t>(depth.width) + static_cast<std::size_t>(u)];
          if (!std::isfinite(z)) continue;
          sum += static_cast<double>(z);
          ++valid;
        }
      cells.values.push_back(2 * valid > (right - left) * (bottom - top) ? sum / valid : std::nan(""));
    }
  return cells;
}

Rgb color_of(double z, const PictureScale& scale) { return std::isfinite(z) ? depth_color(scale.at(z)) : invalid_color; }

void append_color(std::string& text, const char* ground, Rgb color) {
  text += fmt::format("\x1b[{};2;{};{};{}m", ground, color.red, color.green, color.blue);
}

/// Two rows of cells per line of characters. Colours are said only where they change.
std::string half_blocks(const Cells& cells, const PictureScale& scale) {
  std::string text;
  for (int row = 0; row < cells.rows; row += 2) {
    Rgb above_before{}, below_before{};
    for (int column = 0; column < cells.columns; ++column) {
      const Rgb above = color_of(cells.at(column, row), scale), below = color_of(cells.at(column, row + 1), scale);
      if (column == 0 || above != above_before) append_color(text, "38", above);
      if (column == 0 || below != below_before) append_color(text, "48", below);
      text += upper_half_block;
      above_before = above;
      below_before = below;
    }
    text += reset;
    text += '\n';
  }
  return text;
}

constexpr std::string_view dense_to_thin = "@%#*+=-:.";

char letter_of(double z, const PictureScale& scale) {
  if (!std::isfinite(z)) return ' ';
  const double place = std::clamp(scale.at(z), 0.0, 1.0) * static_cast<double>(dense_to_thin.size());
  return dense_to_thin[std::min(dense_to_thin.size() - 1, static_cast<std::size_t>(place))];
}

std::string letters(const Cells& cells, const PictureScale& scale) {
  std::string text;
  for (int row = 0; row < cells.rows; ++row) {
    for (int column = 0; column < cells.columns; ++column) text += letter_of(cells.at(column, row), scale);
    text += '\n';
  }
  return text;
}

/// The scale from near to far with its ends written beside it.
std::string legend(const PictureScale& scale, int columns, TerminalColors colors) {
  const auto end = [&](double value, const char* form) { return fmt::format(fmt::runtime(form), value, scale.decimals + 1); };
  const std::string near = end(scale.low, "{:.{}f} m "), far = end(scale.high, " {:.{}f} m");
  const int bar = std::clamp(columns - static_cast<int>(near.size() + far.size()), 4, 32);
  std::string text = near;
  for (int i = 0; i < bar; ++i) {
    const double z = scale.low + (scale.high - scale.low) * (i + 0.5) / bar;
    if (colors == TerminalColors::none) {
      text += letter_of(z, scale);
    } else {
      append_color(text, "48", color_of(z, scale));
      text += ' ';
    }
  }
  if (colors != TerminalColors::none) text += reset;
  return text + far + "\n";
}

}  // namespace

std::string terminal_picture(const Depth& depth, int columns, TerminalColors colors) {
  if (depth.width <= 0 || depth.height <= 0) return {};
  const int width = std::clamp(columns, 1, depth.width);
  // a character is about twice as high as it is wide
  const int lines = std::max(1, static_cast<int>(0.5 * width * depth.height / depth.width + 0.5));
  const std::vector<double> z(depth.z_m.begin(), depth.z_m.end());
  const PictureScale scale = round_scale(percentile(z, 0.01, 0), percentile(z, 0.99, 1), 0.1);
  const bool full = colors == TerminalColors::full;
  const Cells cells = shrunk(depth, width, std::min(depth.height, full ? 2 * lines : lines));
  return (full ? half_blocks(cells, scale) : letters(cells, scale)) + legend(scale, width, colors);
}

}  // namespace tofray::pictures
