// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include "pictures/figure.h"

#include <algorithm>
#include <cmath>
#include <optional>

namespace tofray::pictures {

const Look& look_of(Theme theme) {
  static const Look dark{figure::background, figure::ink, figure::faint_ink, invalid_color};
  static const Look light{{255, 255, 255}, {24, 26, 30}, {84, 88, 96}, {192, 195, 201}};
  return theme == Theme::light ? light : dark;
}

Rgb color_of_reason(const FlagRow& reason, Theme theme) {
  const std::uint32_t rgb = theme == Theme::light ? reason.light : reason.dark;
  return {static_cast<std::uint8_t>(rgb >> 16), static_cast<std::uint8_t>(rgb >> 8), static_cast<std::uint8_t>(rgb)};
}

std::vector<Rgb> colored(const std::vector<double>& values, const ValueColors& colors, Rgb invalid) {
  std::vector<Rgb> image;
  image.reserve(values.size());
  for (const double value : values) image.push_back(std::isfinite(value) ? colors.color(value) : invalid);
  return image;
}

int width_with_labels(const PictureScale& scale) {
  double label = 0;
  for (const double tick : scale.ticks()) label = std::max(label, Canvas::text_width(figure::label_size, scale.label(tick)));
  return figure::bar_width + std::max(figure::label_width, figure::label_gap + static_cast<int>(std::ceil(label)) + figure::bar_gap);
}

void draw_scale_bar(Painter& painter, int x, int y, int height, const ValueColors& colors, const Look& look) {
  painter.fill(x - 1, y - 1, figure::bar_width + 2, height + 2, look.faint_ink);  // so that neither end runs into the ground
  // the colour of each line: the value whose place is there, found by halving (places rise with values)
  std::optional<Rgb> last_color;
  for (int line = 0; line < height; ++line) {
    const double place = 1 - (line + 0.5) / height;
    double low = colors.scale.low, high = colors.scale.high;
    for (int i = 0; i < 30; ++i) (colors.place(0.5 * (low + high)) < place ? low : high) = 0.5 * (low + high);
    const Rgb color = colors.color(0.5 * (low + high));
    // down to the end, so that no ground shines through between two lines of a picture that is no grid of pixels
    if (last_color != color) painter.fill(x, y + line, figure::bar_width, height - line, color);
    last_color = color;
  }
  double last = 1e9;
  for (const double tick : colors.scale.ticks()) {
    const double line = y + (1 - colors.place(tick)) * height;
    if (last - line < 2.2 * figure::label_size) continue;  // on a curved bar ticks may crowd
    last = line;
    const int at = std::clamp(static_cast<int>(line), y, y + height - 1);
    painter.fill(x + figure::bar_width, at, 5, 1, look.faint_ink);
    painter.text({static_cast<double>(x + figure::bar_width + figure::label_gap), line + 0.5 * figure::label_size}, figure::label_size,
                 look.ink, Align::left, colors.scale.label(tick));
  }
}

int enlargement(int width, int wanted) { return std::clamp((wanted + width / 2) / std::max(width, 1), 1, 8); }

}  // namespace tofray::pictures
