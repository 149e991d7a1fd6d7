// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include "io/canvas.h"

#include <algorithm>
#include <cmath>

#include "io/stroke_font.h"

namespace tofray::io {
namespace {

/// Distance of a point from a segment.
double distance(double px, double py, const Segment& s) {
  const double dx = s.x1 - s.x0, dy = s.y1 - s.y0, square = dx * dx + dy * dy;
  const double along = square > 0 ? std::clamp(((px - s.x0) * dx + (py - s.y0) * dy) / square, 0.0, 1.0) : 0.0;
  const double ex = px - (s.x0 + along * dx), ey = py - (s.y0 + along * dy);
  return std::sqrt(ex * ex + ey * ey);
}

constexpr double letter_gap = 2.6;  // between letters, in units of the font's grid

}  // namespace

Canvas::Canvas(int width, int height, Rgb background) : width_(width), height_(height) {
  pixels_.resize(static_cast<std::size_t>(width) * static_cast<std::size_t>(height) * 3);
  fill(0, 0, width, height, background);
}

void Canvas::set(int x, int y, Rgb color) {
  if (x < 0 || y < 0 || x >= width_ || y >= height_) return;
  std::uint8_t* pixel = &pixels_[(static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) + static_cast<std::size_t>(x)) * 3];
  pixel[0] = color.red;
  pixel[1] = color.green;
  pixel[2] = color.blue;
}

void Canvas::blend(int x, int y, Rgb color, double share) {
  if (x < 0 || y < 0 || x >= width_ || y >= height_) return;
  const std::uint8_t* pixel = &pixels_[(static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) + static_cast<std::size_t>(x)) * 3];
  set(x, y, mixed({pixel[0], pixel[1], pixel[2]}, color, share));
}

void Canvas::fill(int x, int y, int width, int height, Rgb color) {
  for (int v = y; v < y + height; ++v)
    for (int u = x; u < x + width; ++u) set(u, v, color);
}

void Canvas::draw(int x, int y, int width, int height, int scale, const std::vector<Rgb>& image) {
  for (int v = 0; v < height; ++v)
    for (int u = 0; u < width; ++u)
      fill(x + u * scale, y + v * scale, scale, scale,
           image[static_cast<std::size_t>(v) * static_cast<std::size_t>(width) + static_cast<std::size_t>(u)]);
}

void Canvas::line(double x0, double y0, double x1, double y1, double width, Rgb color) {
  const double reach = 0.5 * width + 1;
  const int left = static_cast<int>(std::floor(std::min(x0, x1) - reach)), right = static_cast<int>(std::ceil(std::max(x0, x1) + reach));
  const int top = static_cast<int>(std::floor(std::min(y0, y1) - reach)), bottom = static_cast<int>(std::ceil(std::max(y0, y1) + reach));
  for (int v = std::max(top, 0); v <= std::min(bottom, height_ - 1); ++v)
    for (int u = std::max(left, 0); u <= std::min(right, width_ - 1); ++u) {
      const double cover = 0.5 * width + 0.5 - distance(u + 0.5, v + 0.5, {x0, y0, x1, y1});
      if (cover > 0) blend(u, v, color, std::min(cover, 1.0));
    }
}

void Canvas::text(double x, double baseline, double size, Rgb color, std::string_view utf8) {
  const double unit = size / cap_height;
  const double half_stroke = std::max(0.62, 0.062 * size);
  while (!utf8.empty()) {
    const Glyph& glyph = glyph_of(take_character(utf8));
    // the glyph's surroundings; ascent and descent reach one stroke beyond the grid
    const int left = static_cast<int>(std::floor(x - half_stroke - 1)),
              right = static_cast<int>(std::ceil(x + glyph.width * unit + half_stroke + 1));
    const int top = static_cast<int>(std::floor(baseline - 1.2 * size - 2)),
              bottom = static_cast<int>(std::ceil(baseline + 0.45 * size + 2));
    for (int v = top; v <= bottom; ++v)
      for (int u = left; u <= right; ++u) {
        const double gx = (u + 0.5 - x) / unit, gy = (v + 0.5 - (baseline - size)) / unit;
        double nearest = 1e9;
        for (const Segment& segment : glyph.segments) nearest = std::min(nearest, distance(gx, gy, segment));
        const double cover = half_stroke + 0.5 - nearest * unit;
        if (cover > 0) blend(u, v, color, std::min(cover, 1.0));
      }
    x += (glyph.width + letter_gap) * unit;
  }
}

double Canvas::text_width(double size, std::string_view utf8) {
  double width = 0;
  while (!utf8.empty()) width += glyph_of(take_character(utf8)).width + letter_gap;
  return width > 0 ? (width - letter_gap) * size / cap_height : 0.0;
}

}  // namespace tofray::io
