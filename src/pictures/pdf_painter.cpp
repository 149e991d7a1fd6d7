// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include <cairo-pdf.h>
#include <cairo.h>

#include <cstdint>

#include "base/constants.h"
#include "base/text.h"
#include "pictures/letters.h"
#include "pictures/painter.h"

namespace tofray::pictures {
namespace {

constexpr double points_per_px = 0.75;  // 72 over 96

cairo_status_t append_bytes(void* file, const unsigned char* bytes, unsigned int count) {
  // an exception must not pass through cairo
  try {
    static_cast<std::string*>(file)->append(reinterpret_cast<const char*>(bytes), count);
    return CAIRO_STATUS_SUCCESS;
  } catch (...) {
    return CAIRO_STATUS_NO_MEMORY;
  }
}

void set_color(cairo_t* context, Rgb color) { cairo_set_source_rgb(context, color.red / 255.0, color.green / 255.0, color.blue / 255.0); }

struct Destroyed {
  void operator()(cairo_surface_t* surface) const { cairo_surface_destroy(surface); }
  void operator()(cairo_t* context) const { cairo_destroy(context); }
};
using Surface = std::unique_ptr<cairo_surface_t, Destroyed>;

/// As cairo holds pixels: 32 bits each, red in the third byte from the low end.
Surface surface_of(int width, int height, const std::vector<Rgb>& image) {
  Surface surface(cairo_image_surface_create(CAIRO_FORMAT_RGB24, width, height));
  unsigned char* const bytes = cairo_image_surface_get_data(surface.get());
  if (bytes == nullptr) return surface;  // it says what failed when it is drawn
  const auto stride = static_cast<std::size_t>(cairo_image_surface_get_stride(surface.get()));
  for (std::size_t v = 0; v < static_cast<std::size_t>(height); ++v) {
    auto* const row = reinterpret_cast<std::uint32_t*>(bytes + v * stride);
    for (std::size_t u = 0; u < static_cast<std::size_t>(width); ++u) {
      const Rgb& one = image[v * static_cast<std::size_t>(width) + u];
      row[u] = static_cast<std::uint32_t>(one.red << 16 | one.green << 8 | one.blue);
    }
  }
  cairo_surface_mark_dirty(surface.get());
  return surface;
}

}  // namespace

struct PdfPainter::Page {
  std::string file;  ///< written to until the surface is finished
  Surface surface;
  std::unique_ptr<cairo_t, Destroyed> context;

  Page(double width, double height)
      : surface(cairo_pdf_surface_create_for_stream(append_bytes, &file, width, height)), context(cairo_create(surface.get())) {}
};

PdfPainter::PdfPainter(int width, int height, Rgb background, int scale)
    : page_(std::make_unique<Page>(points_per_px * scale * width, points_per_px * scale * height)) {
  cairo_pdf_surface_set_metadata(page_->surface.get(), CAIRO_PDF_METADATA_CREATE_DATE, "");
  cairo_scale(page_->context.get(), points_per_px * scale, points_per_px * scale);
  fill(0, 0, width, height, background);
}

PdfPainter::~PdfPainter() = default;

void PdfPainter::fill(int x, int y, int width, int height, Rgb color) {
  set_color(page_->context.get(), color);
  cairo_rectangle(page_->context.get(), x, y, width, height);
  cairo_fill(page_->context.get());
}

void PdfPainter::image(int x, int y, int width, int height, int scale, const std::vector<Rgb>& image) {
  cairo_t* const context = page_->context.get();
  const Surface source = surface_of(width, height, image);
  cairo_save(context);
  cairo_translate(context, x, y);
  cairo_scale(context, scale, scale);
  cairo_set_source_surface(context, source.get(), 0, 0);
  cairo_pattern_set_filter(cairo_get_source(context), CAIRO_FILTER_NEAREST);
  cairo_paint(context);
  cairo_restore(context);
}

void PdfPainter::curve(const std::vector<Point>& points, double width, Rgb color, bool dashed) {
  cairo_t* const context = page_->context.get();
  const double dashes[] = {dash_px, gap_px};
  set_color(context, color);
  cairo_set_line_width(context, width);
  cairo_set_line_cap(context, dashed ? CAIRO_LINE_CAP_BUTT : CAIRO_LINE_CAP_ROUND);
  cairo_set_line_join(context, CAIRO_LINE_JOIN_ROUND);
  cairo_set_dash(context, dashes, dashed ? 2 : 0, 0);
  for (const Point& one : points) cairo_line_to(context, one.x, one.y);
  cairo_stroke(context);
}

void PdfPainter::disc(Point center, double radius, Rgb color) {
  set_color(page_->context.get(), color);
  cairo_arc(page_->context.get(), center.x, center.y, radius, 0, 2 * base::pi);
  cairo_fill(page_->context.get());
}

void PdfPainter::text(Point at, double size, Rgb color, Align align, std::string_view utf8) {
  cairo_t* const context = page_->context.get();
  set_color(context, color);
  set_font(context, size);
  cairo_move_to(context, at.x - share_before(align) * Canvas::text_width(size, utf8), at.y);
  cairo_show_text(context, base::printable(utf8).c_str());
}

std::string PdfPainter::finished() {
  cairo_show_page(page_->context.get());
  refuse_failure(page_->context.get());
  cairo_surface_finish(page_->surface.get());
  return page_->file;
}

}  // namespace tofray::pictures
