// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <cmath>

#include "io/figure.h"
#include "io/pictures.h"
#include "io/png_file.h"
#include "io/stroke_font.h"

namespace tofray::io {
namespace {

/// One of the three images: what stands above and below it, and its values.
struct Panel {
  std::string title, note;
  std::vector<double> values;
  ValueColors colors;
};

std::size_t finite_count(const std::vector<double>& values) {
  std::size_t count = 0;
  for (const double value : values) count += std::isfinite(value) ? 1 : 0;
  return count;
}

/// 1234567 → "1 234 567"; below 100 with as many digits as make three.
std::string plain_number(double value) {
  if (std::abs(value) < 100) return fmt::format("{:.{}f}", value, std::abs(value) < 10 ? 2 : 1);
  std::string digits = fmt::format("{:.0f}", value);
  for (std::ptrdiff_t at = static_cast<std::ptrdiff_t>(digits.size()) - 3; at > (digits[0] == '-' ? 1 : 0); at -= 3)
    digits.insert(static_cast<std::size_t>(at), 1, ' ');
  return digits;
}

Panel depth_panel(const Depth& depth) {
  Panel panel{"z [m]", "no valid pixel", {depth.z_m.begin(), depth.z_m.end()}, {}};
  const std::size_t valid = finite_count(panel.values);
  const double low = percentile(panel.values, 0.01, 0), high = percentile(panel.values, 0.99, 1);
  const PictureScale scale = round_scale(low, high, 0.1);
  const auto place = [scale](double z) { return scale.at(z); };
  panel.colors = {scale, [place](double z) { return depth_color(place(z)); }, place};
  if (valid > 0)
    panel.note = fmt::format("{:.3f} \xE2\x80\xA6 {:.3f} m, {:.1f} % valid", percentile(panel.values, 0, 0), percentile(panel.values, 1, 0),
                             100.0 * static_cast<double>(valid) / static_cast<double>(panel.values.size()));
  return panel;
}

Panel amplitude_panel(const Depth& depth) {
  Panel panel{"amplitude [e]", "", {depth.amplitude_e.begin(), depth.amplitude_e.end()}, {}};
  const PictureScale scale = round_scale(0, percentile(panel.values, 0.995, 1), 1e-3);
  const auto place = [scale](double a) { return a > 0 ? std::sqrt(std::min(1.0, scale.at(a))) : 0.0; };
  panel.colors = {scale, [place](double a) { return grey_color(place(a)); }, place};
  panel.note = fmt::format("median {} e, square-root scale", plain_number(percentile(panel.values, 0.5, 0)));
  return panel;
}

Panel error_panel(const Depth& depth, const Truth& truth) {
  Panel panel{"z \xE2\x88\x92 gt_z [mm]", "no pixel to compare", {}, {}};
  std::vector<double> magnitudes;
  for (std::size_t i = 0; i < depth.z_m.size(); ++i) {
    panel.values.push_back(1000.0 * (static_cast<double>(depth.z_m[i]) - static_cast<double>(truth.z_m[i])));
    magnitudes.push_back(std::abs(panel.values.back()));
  }
  const double bound = percentile(magnitudes, 0.98, 1);
  PictureScale scale = round_scale(-bound, bound, 0.2);
  scale.low = -scale.high;
  const auto place = [scale](double e) { return scale.at(e); };
  panel.colors = {scale, [place](double e) { return error_color(2 * place(e) - 1); }, place};
  const double median = percentile(panel.values, 0.5, 0);
  for (std::size_t i = 0; i < magnitudes.size(); ++i) magnitudes[i] = std::abs(panel.values[i] - median);
  if (finite_count(panel.values) > 0)
    panel.note = fmt::format("median {}{:.2f} mm, 68 % within \xC2\xB1{:.2f} mm of it", median < 0 ? "\xE2\x88\x92" : "", std::abs(median),
                             percentile(magnitudes, 0.6827, 0));
  return panel;
}

Panel noise_panel(const Depth& depth) {
  Panel panel{"noise [mm]", "", {}, {}};
  for (const float noise : depth.noise_m) panel.values.push_back(1000.0 * static_cast<double>(noise));
  const PictureScale scale = round_scale(0, percentile(panel.values, 0.98, 1), 0.1);
  const auto place = [scale](double noise) { return scale.at(noise); };
  panel.colors = {scale, [place](double noise) { return depth_color(1 - place(noise)); }, place};
  panel.note = fmt::format("median {:.2f} mm, 1 \xCF\x83", percentile(panel.values, 0.5, 0));
  return panel;
}

/// The caption, cut where it is longer than the panels are wide and than an ordinary one: a picture's size is not a name's to say.
std::string fitting(std::string_view caption, int width) {
  constexpr std::string_view cut = "\xE2\x80\xA6";
  constexpr double ordinary = 1500;  // pixels
  const double room = std::max(ordinary, static_cast<double>(width));
  std::string text;
  double so_far = 0;
  while (!caption.empty()) {
    const std::string_view character = take_character(caption);
    so_far += Canvas::text_width(figure::title_size, character) + Canvas::text_width(figure::title_size, "  ") - 2 * Canvas::text_width(figure::title_size, " ");
    if (so_far > room) return text + std::string(cut);
    text += character;
  }
  return text;
}

}  // namespace

std::string preview_png(const Depth& depth, const Truth& truth, const std::string& caption) {
  const bool with_truth = truth.z_m.size() == depth.z_m.size();
  const Panel panels[] = {depth_panel(depth), amplitude_panel(depth), with_truth ? error_panel(depth, truth) : noise_panel(depth)};

  const int scale = enlargement(depth.width, 450);
  const int image_width = scale * depth.width, image_height = scale * depth.height;
  // a panel has room for its texts even where the image is narrow
  double text_width = 0;
  for (const Panel& panel : panels) text_width = std::max(text_width, Canvas::text_width(figure::note_size, panel.note));
  const int bar = figure::bar_gap + figure::bar_width + figure::label_width;
  const int panel_width = std::max(image_width + bar, static_cast<int>(text_width) + figure::margin);
  const int title_line = caption.empty() ? figure::margin + 14 : figure::margin + 48;
  const int image_top = title_line + 12;
  const int note_line = image_top + image_height + 22;
  const std::string title = fitting(caption, 3 * panel_width + figure::margin);
  const int width =
      std::max(figure::margin + 3 * panel_width, static_cast<int>(Canvas::text_width(figure::title_size, title)) + 2 * figure::margin);
  Canvas canvas(width, note_line + figure::margin, figure::background);

  if (!caption.empty()) canvas.text(figure::margin, figure::margin + 14, figure::title_size, figure::ink, title);
  int x = figure::margin;
  for (const Panel& panel : panels) {
    canvas.text(x, title_line, 0.9 * figure::title_size, figure::ink, panel.title);
    canvas.draw(x, image_top, depth.width, depth.height, scale, colored(panel.values, panel.colors));
    draw_scale_bar(canvas, x + image_width + figure::bar_gap, image_top, image_height, panel.colors);
    canvas.text(x, note_line, figure::note_size, figure::faint_ink, panel.note);
    x += panel_width;
  }
  return png_rgb8(canvas.width(), canvas.height(), canvas.pixels());
}

}  // namespace tofray::io
