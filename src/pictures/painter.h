// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "pictures/canvas.h"
#include "pictures/pictures.h"

/// What figures and charts are drawn with: pixels, SVG elements, or a page of PDF.
namespace tofray::pictures {

/// Where a text stands relative to its point.
enum class Align { left, middle, right };
/// How much of it stands left of its point.
constexpr double share_before(Align align) { return align == Align::left ? 0 : align == Align::middle ? 0.5 : 1; }

inline constexpr double dash_px = 7, gap_px = 5;  ///< of dashed curves

/// Origin top left; lengths are pixels of a PNG of scale 1.
class Painter {
 public:
  Painter() = default;
  virtual ~Painter() = default;
  Painter(const Painter&) = delete;
  Painter& operator=(const Painter&) = delete;
  virtual void fill(int x, int y, int width, int height, Rgb color) = 0;
  /// An image whose pixels become squares of `scale`. @param image [height][width]
  virtual void image(int x, int y, int width, int height, int scale, const std::vector<Rgb>& image) = 0;
  /// Straight strokes from point to point.
  virtual void curve(const std::vector<Point>& points, double width, Rgb color, bool dashed) = 0;
  virtual void disc(Point center, double radius, Rgb color) = 0;
  /// One line of UTF-8. @param size  height of a capital letter
  virtual void text(Point at, double size, Rgb color, Align align, std::string_view utf8) = 0;
  /// The whole file; nothing can be drawn after it.
  [[nodiscard]] virtual std::string finished() = 0;
};

/// @param scale  how many pixels (PNG) or CSS pixels (SVG, PDF) one of the lengths takes
std::unique_ptr<Painter> painter_of(Format format, int width, int height, Rgb background, int scale = 1);

class CanvasPainter : public Painter {
 public:
  CanvasPainter(int width, int height, Rgb background, int scale = 1) : canvas_(width, height, background, scale) {}
  void fill(int x, int y, int width, int height, Rgb color) override { canvas_.fill(x, y, width, height, color); }
  void image(int x, int y, int width, int height, int scale, const std::vector<Rgb>& image) override {
    canvas_.draw(x, y, width, height, scale, image);
  }
  void curve(const std::vector<Point>& points, double width, Rgb color, bool dashed) override;
  void disc(Point center, double radius, Rgb color) override { canvas_.disc(center, radius, color); }
  void text(Point at, double size, Rgb color, Align align, std::string_view utf8) override;
  [[nodiscard]] std::string finished() override;
  [[nodiscard]] const Canvas& canvas() const { return canvas_; }

 private:
  Canvas canvas_;
};

/// SVG 1.1: no script, no external reference, no font file. Texts stay texts, as wide as our own letters whatever font shows them; images
/// are PNG files within, shown as squares.
class SvgPainter : public Painter {
 public:
  SvgPainter(int width, int height, Rgb background, int scale = 1);
  void fill(int x, int y, int width, int height, Rgb color) override;
  void image(int x, int y, int width, int height, int scale, const std::vector<Rgb>& image) override;
  void curve(const std::vector<Point>& points, double width, Rgb color, bool dashed) override;
  void disc(Point center, double radius, Rgb color) override;
  void text(Point at, double size, Rgb color, Align align, std::string_view utf8) override;
  [[nodiscard]] std::string finished() override { return text_ + "</svg>\n"; }

 private:
  std::string text_;
};

/// One page, by cairo: the font's letters that it needs are within, and no date, so that the same drawing is the same file.
class PdfPainter : public Painter {
 public:
  PdfPainter(int width, int height, Rgb background, int scale = 1);
  ~PdfPainter() override;
  void fill(int x, int y, int width, int height, Rgb color) override;
  void image(int x, int y, int width, int height, int scale, const std::vector<Rgb>& image) override;
  void curve(const std::vector<Point>& points, double width, Rgb color, bool dashed) override;
  void disc(Point center, double radius, Rgb color) override;
  void text(Point at, double size, Rgb color, Align align, std::string_view utf8) override;
  /// @throws Error (limit): cairo fails where memory does
  [[nodiscard]] std::string finished() override;

 private:
  struct Page;
  std::unique_ptr<Page> page_;
};

}  // namespace tofray::pictures
