// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <memory>

#include "pictures/figure.h"
#include "pictures/pictures.h"

namespace tofray::pictures {
namespace {

/// What one raw frame holds: codes, or the difference of the taps.
std::vector<double> values_of(const Raw& raw, std::size_t k) {
  const std::size_t pixels = static_cast<std::size_t>(raw.width) * static_cast<std::size_t>(raw.height);
  std::vector<double> values(pixels);
  for (std::size_t i = 0; i < pixels; ++i) {
    const std::size_t at = k * pixels + i;
    values[i] =
        raw.raw.empty() ? static_cast<double>(raw.tap_a[at]) - static_cast<double>(raw.tap_b[at]) : static_cast<double>(raw.raw[at]);
  }
  return values;
}

/// The shortest text of a number with at most `decimals` digits after the point: 80.32, 60, 2000.
std::string short_number(double value, int decimals) {
  std::string text = fmt::format("{:.{}f}", value, decimals);
  while (text.back() == '0' && text.find('.') != std::string::npos) text.pop_back();
  if (text.back() == '.') text.pop_back();
  return text;
}

const char* unit_of(const Raw& raw) { return raw.raw.empty() ? "e" : "DN"; }

/// "80.32 MHz  90°  2000 µs"
std::string label_of(const Raw& raw, std::size_t k) {
  const std::string time = short_number(1e6 * raw.integration_time_s[k], 1) + " \xC2\xB5s";
  if (raw.lit[k] == 0) return "unlit  " + time;
  const double degrees = raw.reference_phase_rad[k] * (180 / 3.141592653589793);
  return fmt::format("{} MHz  {}\xC2\xB0  {}", short_number(1e-6 * raw.modulation_frequency_hz[k], 3), short_number(degrees, 1), time);
}

/// Row and column of each raw frame: a new row where the modulation frequency changes.
struct Place {
  int row = 0, column = 0;
};

std::vector<Place> places_of(const Raw& raw) {
  std::vector<Place> places;
  Place next;
  for (std::size_t k = 0; k < static_cast<std::size_t>(raw.phases); ++k) {
    if (k > 0 && raw.modulation_frequency_hz[k] != raw.modulation_frequency_hz[k - 1]) next = {next.row + 1, 0};
    places.push_back(next);
    ++next.column;
  }
  return places;
}

constexpr double low_share = 0.005, high_share = 0.995;

ValueColors grey_colors(const std::vector<double>& values) {
  const PictureScale scale = round_scale(percentile(values, low_share, 0), percentile(values, high_share, 1), 4);
  const auto place = [scale](double code) { return scale.at(code); };
  return {scale, [place](double code) { return grey_color(place(code)); }, place};
}

/// One grey scale for all lit raw frames: in the sun the unlit one alone would set it. Without lit raw frames, of all.
ValueColors common_colors(const Raw& raw) {
  const bool any_lit = std::any_of(raw.lit.begin(), raw.lit.end(), [](auto lit) { return lit != 0; });
  std::vector<double> all;
  for (std::size_t k = 0; k < static_cast<std::size_t>(raw.phases); ++k) {
    if (any_lit && raw.lit[k] == 0) continue;
    const std::vector<double> values = values_of(raw, k);
    all.insert(all.end(), values.begin(), values.end());
  }
  return grey_colors(all);
}

/// Whether more than 2 % of the values lie beyond a scale, which then shows them black or white.
bool overflows(const std::vector<double>& values, const PictureScale& scale) {
  const auto beyond = std::count_if(values.begin(), values.end(), [&](double value) { return value < scale.low || value > scale.high; });
  return static_cast<double>(beyond) > 0.02 * static_cast<double>(values.size());
}

/// One image of the sheet.
struct Cell {
  std::string label;
  std::vector<double> values;
  ValueColors colors;
  Place place;
};

std::vector<Cell> cells_of(const Raw& raw, const ValueColors& common) {
  const std::vector<Place> places = places_of(raw);
  std::vector<Cell> cells;
  for (std::size_t k = 0; k < places.size(); ++k) {
    Cell cell{label_of(raw, k), values_of(raw, k), common, places[k]};
    if (raw.lit[k] == 0 && overflows(cell.values, common.scale)) {
      cell.colors = grey_colors(cell.values);
      const PictureScale& own = cell.colors.scale;
      cell.label += fmt::format("  scale {} \xE2\x80\xA6 {} {}", own.label(own.low), own.label(own.high), unit_of(raw));
    }
    cells.push_back(std::move(cell));
  }
  return cells;
}

}  // namespace

std::string raw_picture(const Raw& raw, const Style& style) {
  const Look& look = look_of(style.theme);
  const ValueColors colors = common_colors(raw);
  const std::vector<Cell> cells = cells_of(raw, colors);
  Place last;
  double label = 0;
  for (const Cell& cell : cells) {
    last = {std::max(last.row, cell.place.row), std::max(last.column, cell.place.column)};
    label = std::max(label, Canvas::text_width(figure::label_size, cell.label));
  }
  const int scale = enlargement(raw.width, 300);
  const int image_width = scale * raw.width, image_height = scale * raw.height;
  const int step_x = std::max(image_width, static_cast<int>(label)) + figure::margin;
  const int step_y = image_height + 40;
  const int bar_x = figure::margin + (last.column + 1) * step_x, bar_height = std::max(last.row * step_y + image_height, 90);
  const std::string note = fmt::format("scale: {:g} to {:g} % of the lit raw frames' values", 100 * low_share, 100 * high_share);
  const int note_line = figure::margin + 16 + bar_height + 24;
  const int width =
      std::max(bar_x + width_with_labels(colors.scale), figure::margin + static_cast<int>(Canvas::text_width(figure::note_size, note)));
  const std::unique_ptr<Painter> painter =
      painter_of(style.format, width + figure::margin, note_line + figure::margin - 8, look.background, style.scale);
  const auto text = [&](int x, int line, double size, Rgb color, const std::string& words) {
    painter->text({static_cast<double>(x), static_cast<double>(line)}, size, color, Align::left, words);
  };
  for (const Cell& cell : cells) {
    const int x = figure::margin + cell.place.column * step_x, y = figure::margin + cell.place.row * step_y;
    text(x, y + 6, figure::label_size, look.ink, cell.label);
    painter->image(x, y + 16, raw.width, raw.height, scale, colored(cell.values, cell.colors, look.invalid));
  }
  text(bar_x, figure::margin + 6, figure::label_size, look.ink,
       fmt::format("{} [{}]", raw.raw.empty() ? "A \xE2\x88\x92 B" : "raw", unit_of(raw)));
  draw_scale_bar(*painter, bar_x, figure::margin + 16, bar_height, colors, look);
  text(figure::margin, note_line, figure::note_size, look.faint_ink, note);
  return painter->finished();
}

}  // namespace tofray::pictures
