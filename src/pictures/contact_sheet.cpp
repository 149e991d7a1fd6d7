// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <memory>

#include "pictures/figure.h"
#include "pictures/pictures.h"
#include "pictures/value_scale.h"

namespace tofray::pictures {

std::string contact_sheet(const std::vector<SheetImage>& images, const std::string& caption, const Style& style) {
  const Look& look = look_of(style.theme);
  std::vector<double> all;
  int widest = 1, highest = 1, columns = 1;
  double label = 0;
  for (const SheetImage& one : images) {
    widest = std::max(widest, one.depth.width), highest = std::max(highest, one.depth.height);
    label = std::max(label, Canvas::text_width(figure::label_size, one.label));
    all.insert(all.end(), one.depth.z_m.begin(), one.depth.z_m.end());
  }
  while (columns * columns < static_cast<int>(images.size())) ++columns;
  const int rows = (static_cast<int>(images.size()) + columns - 1) / columns;
  const PictureScale scale = length_scale(all);
  const auto place = [scale](double z) { return scale.at(z); };
  const ValueColors colors{scale, [place](double z) { return depth_color(place(z)); }, place};

  const int larger = enlargement(widest, 240);
  const int step_x = std::max(larger * widest, static_cast<int>(label)) + 16, step_y = larger * highest + 30;
  constexpr int top = figure::margin + 30, least_bar = 90;
  const int bar_x = figure::margin + columns * step_x, bar_height = std::max(rows * step_y - 30, least_bar);
  const int width =
      std::max(bar_x + width_with_labels(scale), figure::margin + static_cast<int>(Canvas::text_width(figure::title_size, caption)));
  const std::unique_ptr<Painter> painter =
      painter_of(style.format, width + figure::margin, top + 16 + bar_height + 22 + figure::margin, look.background, style.scale);
  painter->text({figure::margin, figure::margin + 8}, figure::title_size, look.ink, Align::left, caption);
  for (std::size_t i = 0; i < images.size(); ++i) {
    const SheetImage& one = images[i];
    const int x = figure::margin + static_cast<int>(i) % columns * step_x, y = top + static_cast<int>(i) / columns * step_y;
    painter->text({static_cast<double>(x), y + 6.0}, figure::label_size, look.ink, Align::left, one.label);
    std::vector<Rgb> image = colored({one.depth.z_m.begin(), one.depth.z_m.end()}, colors, look.invalid);
    for (std::size_t k = 0; k < image.size() && k < one.depth.flags.size(); ++k) {
      const FlagRow* const reason = invalid_reason(one.depth.flags[k]);
      if (!std::isfinite(one.depth.z_m[k]) && reason != nullptr) image[k] = color_of_reason(*reason, style.theme);
    }
    painter->image(x, y + 14, one.depth.width, one.depth.height, larger, image);
  }
  // Why pixels are invalid, by colour, below.
  double x = figure::margin;
  const int line = top + 16 + bar_height + 14;
  for (const FlagRow& row : flag_table()) {
    const auto has = [&](const SheetImage& one) {
      return std::any_of(one.depth.flags.begin(), one.depth.flags.end(),
                         [&](std::uint16_t flags) { return invalid_reason(flags) == &row; });
    };
    if (!row.invalid || std::none_of(images.begin(), images.end(), has)) continue;
    constexpr int square = 11;
    painter->fill(static_cast<int>(x) - 1, line - 1, square + 2, square + 2, look.faint_ink);
    painter->fill(static_cast<int>(x), line, square, square, color_of_reason(row, style.theme));
    painter->text({std::floor(x) + square + 7, line + square - 1.0}, figure::note_size, look.ink, Align::left, row.words);
    x += square + 7 + Canvas::text_width(figure::note_size, row.words) + 22;
  }
  painter->text({static_cast<double>(bar_x), top + 6.0}, figure::label_size, look.ink, Align::left, "z [m]");
  draw_scale_bar(*painter, bar_x, top + 14, bar_height, colors, look);
  return painter->finished();
}

}  // namespace tofray::pictures
