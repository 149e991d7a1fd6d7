// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include "pictures/chart_painter.h"

#include <fmt/core.h>

namespace tofray::pictures {

namespace {

constexpr double dash = 7, gap = 5;  // [px]

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

}  // namespace

void CanvasPainter::curve(const std::vector<Point>& points, double width, Rgb color, bool dashed) {
  canvas_.stroke(points, width, color, dashed ? std::vector<double>{dash, gap} : std::vector<double>());
}

void CanvasPainter::disc(Point center, double radius, Rgb color) { canvas_.disc(center, radius, color); }

void CanvasPainter::text(Point at, double size, Rgb color, Align align, std::string_view utf8) {
  const double share = align == Align::left ? 0 : align == Align::middle ? 0.5 : 1;
  canvas_.text(at.x - share * Canvas::text_width(size, utf8), at.y, size, color, utf8);
}

SvgPainter::SvgPainter(int width, int height, Rgb background) {
  text_ = fmt::format(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0}\" height=\"{1}\" viewBox=\"0 0 {0} {1}\" font-family=\"sans-serif\">\n"
      "<rect width=\"{0}\" height=\"{1}\" fill=\"{2}\"/>\n",
      width, height, hex(background));
}

void SvgPainter::curve(const std::vector<Point>& points, double width, Rgb color, bool dashed) {
  text_ += "<polyline points=\"";
  for (std::size_t i = 0; i < points.size(); ++i) text_ += fmt::format("{}{:.2f},{:.2f}", i == 0 ? "" : " ", points[i].x, points[i].y);
  text_ += fmt::format("\" fill=\"none\" stroke=\"{}\" stroke-width=\"{:.2f}\" stroke-linejoin=\"round\"", hex(color), width);
  if (dashed) text_ += fmt::format(" stroke-dasharray=\"{:.0f} {:.0f}\"", dash, gap);
  text_ += "/>\n";
}

void SvgPainter::disc(Point center, double radius, Rgb color) {
  text_ += fmt::format("<circle cx=\"{:.2f}\" cy=\"{:.2f}\" r=\"{:.2f}\" fill=\"{}\"/>\n", center.x, center.y, radius, hex(color));
}

void SvgPainter::text(Point at, double size, Rgb color, Align align, std::string_view utf8) {
  // `size` is a capital letter's height, some 0.72 of what fonts call their size
  const char* const anchor = align == Align::left ? "start" : align == Align::middle ? "middle" : "end";
  text_ += fmt::format("<text x=\"{:.2f}\" y=\"{:.2f}\" font-size=\"{:.2f}\" text-anchor=\"{}\" fill=\"{}\">{}</text>\n", at.x, at.y,
                       size / 0.72, anchor, hex(color), escaped(utf8));
}

}  // namespace tofray::pictures
