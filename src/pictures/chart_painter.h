// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <string>
#include <string_view>
#include <vector>

#include "pictures/canvas.h"

/// What a chart is drawn with: pixels or SVG elements.
namespace tofray::pictures {

/// Where a text stands relative to its point.
enum class Align { left, middle, right };

class Painter {
 public:
  Painter() = default;
  virtual ~Painter() = default;
  Painter(const Painter&) = delete;
  Painter& operator=(const Painter&) = delete;
  /// Straight strokes from point to point.
  virtual void curve(const std::vector<Point>& points, double width, Rgb color, bool dashed) = 0;
  virtual void disc(Point center, double radius, Rgb color) = 0;
  virtual void text(Point at, double size, Rgb color, Align align, std::string_view utf8) = 0;
};

class CanvasPainter : public Painter {
 public:
  CanvasPainter(int width, int height, Rgb background) : canvas_(width, height, background) {}
  void curve(const std::vector<Point>& points, double width, Rgb color, bool dashed) override;
  void disc(Point center, double radius, Rgb color) override;
  void text(Point at, double size, Rgb color, Align align, std::string_view utf8) override;
  [[nodiscard]] const Canvas& canvas() const { return canvas_; }

 private:
  Canvas canvas_;
};

class SvgPainter : public Painter {
 public:
  SvgPainter(int width, int height, Rgb background);
  void curve(const std::vector<Point>& points, double width, Rgb color, bool dashed) override;
  void disc(Point center, double radius, Rgb color) override;
  void text(Point at, double size, Rgb color, Align align, std::string_view utf8) override;
  /// The whole file.
  [[nodiscard]] std::string finished() const { return text_ + "</svg>\n"; }

 private:
  std::string text_;
};

}  // namespace tofray::pictures
