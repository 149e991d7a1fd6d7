// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include "pictures/painter.h"

#include <fmt/core.h>

#include <algorithm>
#include <cstdint>

#include "base/base64.h"
#include "base/text.h"
#include "pictures/letters.h"
#include "pictures/png_file.h"

namespace tofray::pictures {

namespace {

std::string hex(Rgb color) { return fmt::format("#{:02x}{:02x}{:02x}", color.red, color.green, color.blue); }

/// Text within an XML element. Control characters, which XML has no way to write, become "?".
std::string escaped(std::string_view text) {
  std::string out;
  for (const char c : text) {
    if (c == '&')
      out += "&amp;";
    else if (c == '<')
      out += "&lt;";
    else if (c == '>')
      out += "&gt;";
    else
      out += static_cast<unsigned char>(c) < 0x20 ? '?' : c;
  }
  return out;
}

std::string png_of(int width, int height, const std::vector<Rgb>& image) {
  std::vector<std::uint8_t> bytes;
  bytes.reserve(3 * image.size());
  for (const Rgb& one : image) bytes.insert(bytes.end(), {one.red, one.green, one.blue});
  return png_rgb8(width, height, bytes);
}

}  // namespace

std::unique_ptr<Painter> painter_of(Format format, int width, int height, Rgb background, int scale) {
  if (format == Format::svg) return std::make_unique<SvgPainter>(width, height, background, scale);
  if (format == Format::pdf) return std::make_unique<PdfPainter>(width, height, background, scale);
  return std::make_unique<CanvasPainter>(width, height, background, scale);
}

void CanvasPainter::curve(const std::vector<Point>& points, double width, Rgb color, bool dashed) {
  canvas_.stroke(points, width, color, dashed ? std::vector<double>{dash_px, gap_px} : std::vector<double>());
}

void CanvasPainter::text(Point at, double size, Rgb color, Align align, std::string_view utf8) {
  canvas_.text(at.x - share_before(align) * Canvas::text_width(size, utf8), at.y, size, color, utf8);
}

std::string CanvasPainter::finished() { return png_rgb8(canvas_.width(), canvas_.height(), canvas_.pixels()); }

SvgPainter::SvgPainter(int width, int height, Rgb background, int scale) {
  text_ = fmt::format(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" xmlns:xlink=\"http://www.w3.org/1999/xlink\" width=\"{}\" height=\"{}\" "
      "viewBox=\"0 0 {} {}\" font-family=\"sans-serif\" xml:space=\"preserve\">\n",
      scale * width, scale * height, width, height);
  fill(0, 0, width, height, background);
}

void SvgPainter::fill(int x, int y, int width, int height, Rgb color) {
  text_ += fmt::format("<rect x=\"{}\" y=\"{}\" width=\"{}\" height=\"{}\" fill=\"{}\"/>\n", x, y, width, height, hex(color));
}

void SvgPainter::image(int x, int y, int width, int height, int scale, const std::vector<Rgb>& image) {
  text_ += fmt::format(
      "<image x=\"{}\" y=\"{}\" width=\"{}\" height=\"{}\" preserveAspectRatio=\"none\" style=\"image-rendering:pixelated\" "
      "xlink:href=\"data:image/png;base64,{}\"/>\n",
      x, y, scale * width, scale * height, base::base64(png_of(width, height, image)));
}

void SvgPainter::curve(const std::vector<Point>& points, double width, Rgb color, bool dashed) {
  text_ += "<polyline points=\"";
  for (std::size_t i = 0; i < points.size(); ++i) text_ += fmt::format("{}{:.2f},{:.2f}", i == 0 ? "" : " ", points[i].x, points[i].y);
  text_ += fmt::format("\" fill=\"none\" stroke=\"{}\" stroke-width=\"{:.2f}\" stroke-linejoin=\"round\"", hex(color), width);
  if (dashed) text_ += fmt::format(" stroke-dasharray=\"{:.0f} {:.0f}\"", dash_px, gap_px);
  text_ += "/>\n";
}

void SvgPainter::disc(Point center, double radius, Rgb color) {
  text_ += fmt::format("<circle cx=\"{:.2f}\" cy=\"{:.2f}\" r=\"{:.2f}\" fill=\"{}\"/>\n", center.x, center.y, radius, hex(color));
}

void SvgPainter::text(Point at, double size, Rgb color, Align align, std::string_view utf8) {
  if (utf8.empty()) return;
  const char* const anchor = align == Align::left ? "start" : align == Align::middle ? "middle" : "end";
  text_ += fmt::format(
      "<text x=\"{:.2f}\" y=\"{:.2f}\" font-size=\"{:.2f}\" text-anchor=\"{}\" textLength=\"{:.2f}\" lengthAdjust=\"spacingAndGlyphs\" "
      "fill=\"{}\">{}</text>\n",
      at.x, at.y, size / capital_height, anchor, Canvas::text_width(size, utf8), hex(color), escaped(base::printable(utf8)));
}

}  // namespace tofray::pictures
