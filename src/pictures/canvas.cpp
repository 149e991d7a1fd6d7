// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include "pictures/canvas.h"

#include <cairo.h>

#include <algorithm>
#include <cmath>
#include <memory>

#include "base/constants.h"
#include "base/text.h"
#include "pictures/carried_font.h"
#include "pictures/letters.h"
#include "tofray/error.h"

namespace tofray::pictures {

void refuse_failure(cairo_t* context) {
  if (const cairo_status_t status = cairo_status(context); status != CAIRO_STATUS_SUCCESS)
    throw Error(ErrorKind::limit, std::string("error: a picture could not be drawn: ") + cairo_status_to_string(status));
}

/// Letters keep their shapes and places whatever the screen is like: no hints, no colours at their edges.
void set_font(cairo_t* context, double size) {
  use_carried_font();
  cairo_select_font_face(context, "sans-serif", CAIRO_FONT_SLANT_NORMAL, CAIRO_FONT_WEIGHT_NORMAL);
  cairo_set_font_size(context, size / capital_height);
  cairo_font_options_t* options = cairo_font_options_create();
  cairo_font_options_set_antialias(options, CAIRO_ANTIALIAS_GRAY);
  cairo_font_options_set_hint_style(options, CAIRO_HINT_STYLE_NONE);
  cairo_font_options_set_hint_metrics(options, CAIRO_HINT_METRICS_OFF);
  cairo_set_font_options(context, options);
  cairo_font_options_destroy(options);
}

/// A part of a canvas that cairo draws on, in the canvas's coordinates: how much of each pixel is covered.
class Canvas::Mask {
 public:
  /// @param low, high  corners of what will be drawn
  Mask(const Canvas& canvas, Point low, Point high)
      : left(inside(std::floor(canvas.scale_ * low.x), canvas.width())),
        top(inside(std::floor(canvas.scale_ * low.y), canvas.height())),
        width(std::max(0, inside(std::ceil(canvas.scale_ * high.x), canvas.width()) - left)),
        height(std::max(0, inside(std::ceil(canvas.scale_ * high.y), canvas.height()) - top)),
        surface_(cairo_image_surface_create(CAIRO_FORMAT_A8, width, height)),
        context_(cairo_create(surface_.get())) {
    cairo_translate(context(), -left, -top);
    cairo_scale(context(), canvas.scale_, canvas.scale_);
  }

  [[nodiscard]] cairo_t* context() const { return context_.get(); }
  /// Cover of a row's pixels, 0 to 255.
  [[nodiscard]] const unsigned char* row(int v) const {
    return cairo_image_surface_get_data(surface_.get()) + static_cast<std::ptrdiff_t>(v) * cairo_image_surface_get_stride(surface_.get());
  }
  /// To be called when all is drawn. @throws Error (limit): cairo fails where memory does
  void finish() const {
    cairo_surface_flush(surface_.get());
    refuse_failure(context());
  }

  const int left, top, width, height;

 private:
  static int inside(double at, int most) { return static_cast<int>(std::clamp(at, 0.0, static_cast<double>(most))); }

  struct Destroy {
    void operator()(cairo_surface_t* surface) const { cairo_surface_destroy(surface); }
    void operator()(cairo_t* context) const { cairo_destroy(context); }
  };
  std::unique_ptr<cairo_surface_t, Destroy> surface_;
  std::unique_ptr<cairo_t, Destroy> context_;
};

Canvas::Canvas(int width, int height, Rgb background, int scale) : width_(scale * width), height_(scale * height), scale_(scale) {
  pixels_.resize(static_cast<std::size_t>(width_) * static_cast<std::size_t>(height_) * 3);
  fill(0, 0, width, height, background);
}

void Canvas::fill(int x, int y, int width, int height, Rgb color) {
  const int left = std::max(scale_ * x, 0), right = std::min(scale_ * (x + width), width_);
  for (int v = std::max(scale_ * y, 0); left < right && v < std::min(scale_ * (y + height), height_); ++v) {
    std::uint8_t* pixel = &pixels_[at(left, v)];
    for (int u = left; u < right; ++u) *pixel++ = color.red, *pixel++ = color.green, *pixel++ = color.blue;
  }
}

void Canvas::draw(int x, int y, int width, int height, int scale, const std::vector<Rgb>& image) {
  for (int v = 0; v < height; ++v)
    for (int u = 0; u < width; ++u)
      fill(x + u * scale, y + v * scale, scale, scale,
           image[static_cast<std::size_t>(v) * static_cast<std::size_t>(width) + static_cast<std::size_t>(u)]);
}

void Canvas::paint(const Mask& mask, Rgb color) {
  mask.finish();
  for (int v = 0; v < mask.height && mask.width > 0; ++v) {
    std::uint8_t* pixel = &pixels_[at(mask.left, mask.top + v)];
    const unsigned char* cover = mask.row(v);
    for (int u = 0; u < mask.width; ++u, pixel += 3) {
      if (cover[u] == 0) continue;
      const Rgb blend = mixed({pixel[0], pixel[1], pixel[2]}, color, cover[u] / 255.0);
      pixel[0] = blend.red, pixel[1] = blend.green, pixel[2] = blend.blue;
    }
  }
}

void Canvas::stroke(const std::vector<Point>& points, double width, Rgb color, const std::vector<double>& dashes) {
  if (points.empty()) return;
  Point low = points[0], high = points[0];
  for (const Point& one : points) {
    low = {std::min(low.x, one.x), std::min(low.y, one.y)};
    high = {std::max(high.x, one.x), std::max(high.y, one.y)};
  }
  const Mask mask(*this, {low.x - width, low.y - width}, {high.x + width, high.y + width});
  cairo_set_line_width(mask.context(), width);
  cairo_set_line_cap(mask.context(), dashes.empty() ? CAIRO_LINE_CAP_ROUND : CAIRO_LINE_CAP_BUTT);
  cairo_set_line_join(mask.context(), CAIRO_LINE_JOIN_ROUND);
  cairo_set_dash(mask.context(), dashes.data(), static_cast<int>(dashes.size()), 0);
  for (const Point& one : points) cairo_line_to(mask.context(), one.x, one.y);
  cairo_stroke(mask.context());
  paint(mask, color);
}

void Canvas::disc(Point center, double radius, Rgb color) {
  const Mask mask(*this, {center.x - radius, center.y - radius}, {center.x + radius, center.y + radius});
  cairo_arc(mask.context(), center.x, center.y, radius, 0, 2 * base::pi);
  cairo_fill(mask.context());
  paint(mask, color);
}

void Canvas::text(double x, double baseline, double size, Rgb color, std::string_view utf8) {
  // Letters of any font reach at most this far beyond where the text begins, ends and stands.
  const double reach = 4 * size;
  const Mask mask(*this, {x - reach, baseline - reach}, {x + text_width(size, utf8) + reach, baseline + reach});
  set_font(mask.context(), size);
  cairo_move_to(mask.context(), x, baseline);
  cairo_show_text(mask.context(), base::printable(utf8).c_str());
  paint(mask, color);
}

double Canvas::text_width(double size, std::string_view utf8) {
  const Mask mask(Canvas(1, 1, {}), {0, 0}, {1, 1});
  set_font(mask.context(), size);
  cairo_text_extents_t extents{};
  cairo_text_extents(mask.context(), base::printable(utf8).c_str(), &extents);
  mask.finish();
  return extents.x_advance;
}

}  // namespace tofray::pictures

// What fontconfig, which finds the fonts, keeps to the end.
#if defined(__clang__)
#if __has_feature(address_sanitizer)
extern "C" const char* __lsan_default_options();
extern "C" const char* __lsan_default_options() { return "print_suppressions=0"; }
extern "C" const char* __lsan_default_suppressions();
extern "C" const char* __lsan_default_suppressions() { return "leak:libfontconfig\n"; }
#endif
#endif

// ThreadSanitizer takes the orders of cairo's locks, which are for two kinds of its surfaces, for one.
#if defined(__SANITIZE_THREAD__)
extern "C" const char* __tsan_default_suppressions();
extern "C" const char* __tsan_default_suppressions() { return "deadlock:libcairo\n"; }
#endif
