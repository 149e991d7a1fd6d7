// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "io/color_map.h"

namespace tofray::io {

/// A picture to draw on: rectangles, enlarged images and text in a stroke font of its own. Origin top left, pixels.
/// Only + − · / and sqrt are used: the same bytes on every machine.
class Canvas {
 public:
  Canvas(int width, int height, Rgb background);

  [[nodiscard]] int width() const { return width_; }
  [[nodiscard]] int height() const { return height_; }
  [[nodiscard]] const std::vector<std::uint8_t>& pixels() const { return pixels_; }  ///< [height][width][3]

  /// Sets one pixel; outside the canvas nothing happens.
  void set(int x, int y, Rgb color);
  void fill(int x, int y, int width, int height, Rgb color);
  /// An image whose pixels become squares of `scale` pixels. @param image [height][width]
  void draw(int x, int y, int width, int height, int scale, const std::vector<Rgb>& image);
  /// A straight stroke with round ends. @param x0, y0, x1, y1  its ends [px]; whole numbers are the corners of pixels
  void line(double x0, double y0, double x1, double y1, double width, Rgb color);
  /// One line of UTF-8 text. Letters, digits and the signs of units are known; any other character is an empty box.
  /// @param x, baseline  where the first letter's left edge stands
  /// @param size   height of a capital letter [px]
  void text(double x, double baseline, double size, Rgb color, std::string_view utf8);
  /// Width that `text` would take [px].
  static double text_width(double size, std::string_view utf8);

 private:
  void blend(int x, int y, Rgb color, double share);

  int width_, height_;
  std::vector<std::uint8_t> pixels_;
};

}  // namespace tofray::io
