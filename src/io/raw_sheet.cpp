// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <cmath>

#include "io/figure.h"
#include "io/pictures.h"
#include "io/png_file.h"

namespace tofray::io {
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

/// One grey scale for all raw frames.
ValueColors common_colors(const Raw& raw) {
  std::vector<double> all;
  for (std::size_t k = 0; k < static_cast<std::size_t>(raw.phases); ++k) {
    const std::vector<double> values = values_of(raw, k);
    all.insert(all.end(), values.begin(), values.end());
  }
  const double low = percentile(all, 0.005, 0), high = percentile(std::move(all), 0.995, 1);
  const PictureScale scale = round_scale(low, high, 4);
  const auto place = [scale](double code) { return scale.at(code); };
  return {scale, [place](double code) { return grey_color(place(code)); }, place};
}

}  // namespace

std::string raw_png(const Raw& raw) {
  const std::vector<Place> places = places_of(raw);
  Place last;
  for (const Place& place : places) last = {std::max(last.row, place.row), std::max(last.column, place.column)};
  double label = 0;
  for (std::size_t k = 0; k < places.size(); ++k) label = std::max(label, Canvas::text_width(figure::label_size, label_of(raw, k)));

  const int scale = enlargement(raw.width, 300);
  const int image_width = scale * raw.width, image_height = scale * raw.height;
  const int step_x = std::max(image_width, static_cast<int>(label)) + figure::margin;
  const int step_y = image_height + 40;
  const int bar_x = figure::margin + (last.column + 1) * step_x;
  Canvas canvas(bar_x + figure::bar_width + figure::label_width + figure::margin, figure::margin + (last.row + 1) * step_y,
                figure::background);

  const ValueColors colors = common_colors(raw);
  for (std::size_t k = 0; k < places.size(); ++k) {
    const int x = figure::margin + places[k].column * step_x, y = figure::margin + places[k].row * step_y;
    canvas.text(x, y + 6, figure::label_size, figure::ink, label_of(raw, k));
    canvas.draw(x, y + 16, raw.width, raw.height, scale, colored(values_of(raw, k), colors));
  }
  canvas.text(bar_x, figure::margin + 6, figure::label_size, figure::ink, raw.raw.empty() ? "A \xE2\x88\x92 B [e]" : "raw [DN]");
  draw_scale_bar(canvas, bar_x, figure::margin + 16, last.row * step_y + image_height, colors);
  return png_rgb8(canvas.width(), canvas.height(), canvas.pixels());
}

}  // namespace tofray::io
