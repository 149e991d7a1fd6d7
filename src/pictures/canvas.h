// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstdint>
#include <string_view>
#include <vector>

#include "pictures/color_map.h"

namespace tofray::pictures {

struct Point {
  double x = 0, y = 0;
};

/// A picture to draw on: rectangles, enlarged images, and strokes and text by cairo. Origin top left, pixels; whole numbers are the corners
/// of pixels. It may be wider than the 32,767 pixels of cairo's own pictures.
class Canvas {
 public:
  /// @param scale  pixels of the picture for one of all lengths below: 2 is a picture of twice the width and height, drawn as finely
  Canvas(int width, int height, Rgb background, int scale = 1);

  [[nodiscard]] int width() const { return width_; }                                 ///< of the picture [px]
  [[nodiscard]] int height() const { return height_; }                               ///< of the picture [px]
  [[nodiscard]] const std::vector<std::uint8_t>& pixels() const { return pixels_; }  ///< [height][width][3]

  void fill(int x, int y, int width, int height, Rgb color);
  /// An image whose pixels become squares of `scale` pixels. @param image [height][width]
  void draw(int x, int y, int width, int height, int scale, const std::vector<Rgb>& image);
  /// Straight strokes with round ends from point to point. @param dashes  lengths of strokes and gaps in turn; empty: no gaps
  void stroke(const std::vector<Point>& points, double width, Rgb color, const std::vector<double>& dashes = {});
  void disc(Point center, double radius, Rgb color);
  /// One line of UTF-8 text in the machine's sans-serif font, or in that of the package (carried_font.h). Where there is none, cairo draws plain letters of its own.
  /// @param x, baseline  where the first letter's left edge stands
  /// @param size   height of a capital letter [px]
  void text(double x, double baseline, double size, Rgb color, std::string_view utf8);
  /// Width that `text` would take [px].
  static double text_width(double size, std::string_view utf8);

 private:
  class Mask;
  /// Where a pixel's red stands.
  [[nodiscard]] std::size_t at(int x, int y) const {
    return 3 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) + static_cast<std::size_t>(x));
  }
  /// One colour where the mask covers.
  void paint(const Mask& mask, Rgb color);

  int width_, height_, scale_;
  std::vector<std::uint8_t> pixels_;
};

}  // namespace tofray::pictures
