// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include "pictures/difference_picture.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <memory>

#include "pictures/figure.h"
#include "pictures/value_scale.h"

namespace tofray::pictures {

namespace {

constexpr int least_map_height = 200, histogram_height = 200, histogram_bar = 10;

/// Bars of the histogram, the middle of the outermost two, and 0.
void draw_histogram(Painter& painter, int x, int y, const Comparison& of, const ValueColors& colors, const Look& look) {
  const auto bins = static_cast<int>(of.histogram.size());
  const std::int64_t most = std::max<std::int64_t>(1, *std::max_element(of.histogram.begin(), of.histogram.end()));
  for (int i = 0; i < bins; ++i) {
    const double share = static_cast<double>(of.histogram[static_cast<std::size_t>(i)]) / static_cast<double>(most);
    const int high = share > 0 ? std::max(1, static_cast<int>(std::lround(share * histogram_height))) : 0;
    const double middle_mm = 1e3 * (of.histogram_low_m + (i + 0.5) * of.histogram_step_m);
    if (high > 0)
      painter.fill(x + i * histogram_bar, y + histogram_height - high, histogram_bar - 1, high,
                   mixed(colors.color(middle_mm), look.faint_ink, 0.35));
  }
  painter.fill(x, y + histogram_height, bins * histogram_bar, 1, look.faint_ink);
  const auto label = [&](int bin, Align align) {
    const double middle_mm = 1e3 * (of.histogram_low_m + (bin + 0.5) * of.histogram_step_m);
    const std::string text =
        std::fabs(middle_mm) < 1e-9 ? "0" : fmt::format("{}{:.3g}", middle_mm < 0 ? "\xE2\x88\x92" : "", std::fabs(middle_mm));
    painter.text({x + (bin + 0.5) * histogram_bar, static_cast<double>(y + histogram_height + 16)}, figure::label_size, look.faint_ink,
                 align, text);
  };
  label(1, Align::middle), label(bins / 2, Align::middle), label(bins - 2, Align::middle);
}

}  // namespace

std::string difference_picture(const Comparison& comparison, const std::string& caption, const Style& style) {
  const Look& look = look_of(style.theme);
  std::vector<double> map_mm;
  for (const float one : comparison.map_m) map_mm.push_back(1e3 * static_cast<double>(one));
  const PictureScale scale = error_scale(map_mm).scale;
  const auto place = [scale](double e) { return scale.at(e); };
  const ValueColors colors{scale, [place](double e) { return error_color(2 * place(e) - 1); }, place};
  const int width = comparison.region.width, height = comparison.region.height, larger = enlargement(width, 450);
  const int shown_height = std::max(least_map_height, larger * height), bar_x = figure::margin + larger * width + figure::bar_gap;
  const int histogram_x = bar_x + width_with_labels(scale) + figure::margin,
            histogram_width = static_cast<int>(comparison.histogram.size()) * histogram_bar;
  const int top = figure::margin + 60,
            caption_width = static_cast<int>(Canvas::text_width(figure::title_size, caption)) + 2 * figure::margin;
  const std::unique_ptr<Painter> painter =
      painter_of(style.format, std::max(histogram_x + histogram_width + figure::margin, caption_width),
                 top + std::max(shown_height, histogram_height + 24) + 44, look.background, style.scale);
  const auto text = [&](int x, int y, double size, Rgb color, const std::string& words) {
    painter->text({static_cast<double>(x), static_cast<double>(y)}, size, color, Align::left, words);
  };
  text(figure::margin, figure::margin + 14, figure::title_size, look.ink, caption);
  text(figure::margin, top - 12, 0.9 * figure::title_size, look.ink,
       comparison.range ? "range, A \xE2\x88\x92 B [mm]" : "z, A \xE2\x88\x92 B [mm]");
  painter->image(figure::margin, top, width, height, larger, colored(map_mm, colors, look.invalid));
  draw_scale_bar(*painter, bar_x, top, shown_height, colors, look);
  text(histogram_x, top - 12, 0.9 * figure::title_size, look.ink, "pixels by difference [mm]");
  draw_histogram(*painter, histogram_x, top, comparison, colors, look);
  text(figure::margin, top + std::max(shown_height, histogram_height + 24) + 24, figure::note_size, look.faint_ink,
       fmt::format("median {}{:.2f} mm, sigma {:.2f} mm of {} pixels; the outermost bars hold all beyond",
                   comparison.all.median_m < 0 ? "\xE2\x88\x92" : "", 1e3 * std::fabs(comparison.all.median_m),
                   1e3 * comparison.all.sigma_m, grouped(fmt::format("{}", comparison.all.pixels))));
  return painter->finished();
}

}  // namespace tofray::pictures
