// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <memory>
#include <utility>

#include "base/text.h"
#include "pictures/figure.h"
#include "pictures/pictures.h"
#include "pictures/value_scale.h"

namespace tofray::pictures {
namespace {

constexpr int least_bar = 90;  // [px] a shorter scale bar has no room for its labels

/// One of the images: what stands above it and in two lines below, and its values.
struct Panel {
  std::string title, note, scale_note;
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
  return grouped(fmt::format("{:.0f}", value));
}

Panel depth_panel(const Depth& depth, const Truth& truth, const Raw& raw) {
  Panel panel{"z [m]", "no valid pixel", "scale: 1st to 99th percentile", {depth.z_m.begin(), depth.z_m.end()}, {}};
  const std::size_t valid = finite_count(panel.values);
  const std::vector<double> right = right_z(depth, truth, raw);
  if (finite_count(right) < valid) panel.scale_note += ", without wrong cycles";
  const PictureScale scale = length_scale(right);
  const auto place = [scale](double z) { return scale.at(z); };
  panel.colors = {scale, [place](double z) { return depth_color(place(z)); }, place};
  if (valid > 0)
    panel.note = fmt::format("{:.3f} \xE2\x80\xA6 {:.3f} m, {:.1f} % valid", percentile(panel.values, 0, 0), percentile(panel.values, 1, 0),
                             100.0 * static_cast<double>(valid) / static_cast<double>(panel.values.size()));
  return panel;
}

Panel amplitude_panel(const Depth& depth) {
  Panel panel{
      "amplitude [e]", "", "scale: 0 to the 99.5th percentile, square root", {depth.amplitude_e.begin(), depth.amplitude_e.end()}, {}};
  const PictureScale scale = strength_scale(panel.values);
  const auto place = [scale](double a) { return a > 0 ? std::sqrt(std::min(1.0, scale.at(a))) : 0.0; };
  panel.colors = {scale, [place](double a) { return grey_color(place(a)); }, place};
  panel.note = fmt::format("median {} e", plain_number(percentile(panel.values, 0.5, 0)));
  return panel;
}

/// Errors of either sign in millimetres: what there is of them, and a scale with 0 in its middle.
Panel signed_panel(const char* title, const char* of_what, const std::vector<double>& values_mm) {
  Panel panel{title, "no pixel to compare", "", values_mm, {}};
  std::vector<double> magnitudes;
  for (const double value : values_mm) magnitudes.push_back(std::abs(value));
  const auto [scale, of_most] = error_scale(values_mm);
  const auto place = [scale = scale](double e) { return scale.at(e); };
  panel.colors = {scale, [place](double e) { return error_color(2 * place(e) - 1); }, place};
  const auto beyond =
      static_cast<double>(std::count_if(magnitudes.begin(), magnitudes.end(), [high = scale.high](double e) { return e > high; }));
  panel.scale_note = fmt::format("scale: {} percentile of |{}|, {:.1f} % beyond", of_most ? "98th" : "3 * 68th", of_what,
                                 100 * beyond / std::max(1.0, static_cast<double>(finite_count(magnitudes))));
  const double median = percentile(panel.values, 0.5, 0);
  for (std::size_t i = 0; i < magnitudes.size(); ++i) magnitudes[i] = std::abs(panel.values[i] - median);
  if (finite_count(panel.values) > 0)
    panel.note = fmt::format("median {}{:.2f} mm, 68 % within \xC2\xB1{:.2f} mm of it", median < 0 ? "\xE2\x88\x92" : "", std::abs(median),
                             percentile(magnitudes, 0.6827, 0));
  return panel;
}

Panel error_panel(const Depth& depth, const Truth& truth) {
  std::vector<double> errors;
  for (std::size_t i = 0; i < depth.z_m.size(); ++i)
    errors.push_back(1000.0 * (static_cast<double>(depth.z_m[i]) - static_cast<double>(truth.z_m[i])));
  return signed_panel("z \xE2\x88\x92 gt_z [mm]", "error", errors);
}

/// What light of several surfaces does to the half path at the first modulation frequency.
Panel multipath_panel(const Depth& depth, const Truth& truth, const Raw& raw) {
  const auto lit = std::find_if(raw.lit.begin(), raw.lit.end(), [](auto one) { return one != 0; });
  const auto k = static_cast<std::size_t>(lit - raw.lit.begin());
  std::vector<double> shifts(depth.z_m.size(), std::nan(""));
  for (std::size_t i = 0; lit != raw.lit.end() && i < shifts.size(); ++i)
    shifts[i] = 1000.0 * static_cast<double>(truth.multipath_m[k * shifts.size() + i]);
  const std::string frequency = lit == raw.lit.end() ? "" : fmt::format(", {:.6g} MHz", 1e-6 * raw.modulation_frequency_hz[k]);
  return signed_panel(("multipath: half path [mm]" + frequency).c_str(), "multipath", shifts);
}

Panel noise_panel(const Depth& depth) {
  Panel panel{"noise [mm]", "", "scale: 0 to the 98th percentile", {}, {}};
  for (const float noise : depth.noise_m) panel.values.push_back(1000.0 * static_cast<double>(noise));
  const PictureScale scale = noise_scale(panel.values);
  const auto place = [scale](double noise) { return scale.at(noise); };
  panel.colors = {scale, [place](double noise) { return depth_color(1 - place(noise)); }, place};
  panel.note = fmt::format("median {:.2f} mm, 1 \xCF\x83", percentile(panel.values, 0.5, 0));
  return panel;
}

/// The caption, cut where it is longer than the panels are wide and than an ordinary one: a picture's size is not a name's to say.
std::string fitting(const std::string& caption, int width) {
  constexpr double ordinary = 1500;  // pixels
  const double room = std::max(ordinary, static_cast<double>(width));
  if (Canvas::text_width(figure::title_size, caption) <= room) return caption;
  const std::string text = base::printable(caption);
  std::size_t end = 0;
  for (std::size_t next = 0; next < text.size(); end = next) {
    next += base::utf8_length(text, next);
    if (Canvas::text_width(figure::title_size, text.substr(0, next)) > room) break;
  }
  return text.substr(0, end) + "\xE2\x80\xA6";
}

/// Invalid pixels of z in the colours of their reasons.
void color_invalid(std::vector<Rgb>& image, const Depth& depth, Theme theme) {
  for (std::size_t i = 0; i < image.size() && i < depth.flags.size(); ++i) {
    const FlagRow* const reason = invalid_reason(depth.flags[i]);
    if (!std::isfinite(depth.z_m[i]) && reason != nullptr) image[i] = color_of_reason(*reason, theme);
  }
}

struct LegendEntry {
  Rgb color;
  std::string text;
};

/// Why pixels are invalid, as far as it occurs.
std::vector<LegendEntry> legend_of(const Depth& depth, Theme theme) {
  std::map<std::uint16_t, std::pair<const FlagRow*, std::size_t>> counts;  // by bit
  for (const std::uint16_t flags : depth.flags) {
    const FlagRow* const reason = invalid_reason(flags);
    if (reason != nullptr) counts.try_emplace(reason->bit, reason, 0).first->second.second += 1;
  }
  std::vector<LegendEntry> legend;
  for (const auto& [bit, counted] : counts) {
    const auto& [reason, count] = counted;
    const double share = 100.0 * static_cast<double>(count) / static_cast<double>(depth.flags.size());
    const std::string number = share < 0.1 ? "< 0.1" : fmt::format("{:.1f}", share);
    legend.push_back({color_of_reason(*reason, theme), fmt::format("{} {} %", reason->words, number)});
  }
  return legend;
}

constexpr int legend_square = 11, legend_line = 22;

/// From left to right, in as many lines as it takes. @return the lines; nothing is drawn without a painter
int draw_legend(Painter* painter, int top, int width, const std::vector<LegendEntry>& legend, const Look& look) {
  const std::string title = "invalid in z:";
  const int start = figure::margin + static_cast<int>(Canvas::text_width(figure::note_size, title)) + 14;
  if (legend.empty()) return 0;
  const auto text = [&](double left, double line, Rgb color, const std::string& words) {
    painter->text({left, line}, figure::note_size, color, Align::left, words);
  };
  if (painter != nullptr) text(figure::margin, top + legend_square - 1, look.faint_ink, title);
  int x = start, lines = 1;
  for (const LegendEntry& entry : legend) {
    const int needed = legend_square + 7 + static_cast<int>(Canvas::text_width(figure::note_size, entry.text)) + 22;
    if (x > start && x + needed > width) x = start, ++lines;
    const int y = top + (lines - 1) * legend_line;
    if (painter != nullptr) {
      painter->fill(x - 1, y - 1, legend_square + 2, legend_square + 2, look.faint_ink);
      painter->fill(x, y, legend_square, legend_square, entry.color);
      text(x + legend_square + 7, y + legend_square - 1, look.ink, entry.text);
    }
    x += needed;
  }
  return lines;
}

/// Where things stand [px].
struct Layout {
  int scale, image_width, image_height, panel_width, title_line, image_top, note_line, legend_top, width, height;
  std::string title;
};

Layout layout_of(const Depth& depth, const std::vector<Panel>& panels, const std::string& caption, const std::vector<LegendEntry>& legend,
                 const Look& look) {
  Layout at{};
  const auto panel_count = static_cast<int>(panels.size());
  at.scale = enlargement(depth.width, 450);
  at.image_width = at.scale * depth.width, at.image_height = at.scale * depth.height;
  // a panel has room for its texts even where the image is narrow
  double text_width = 0;
  for (const Panel& panel : panels) {
    for (const std::string& note : {panel.note, panel.scale_note})
      text_width = std::max(text_width, Canvas::text_width(figure::note_size, note));
  }
  int bar = 0;
  for (const Panel& panel : panels) bar = std::max(bar, figure::bar_gap + width_with_labels(panel.colors.scale));
  at.panel_width = std::max(at.image_width + bar, static_cast<int>(text_width) + figure::margin);
  at.title_line = caption.empty() ? figure::margin + 14 : figure::margin + 48;
  at.image_top = at.title_line + 12;
  at.note_line = at.image_top + std::max(at.image_height, least_bar) + 22;
  at.legend_top = at.note_line + 30;
  at.title = fitting(caption, panel_count * at.panel_width + figure::margin);
  at.width = std::max(figure::margin + panel_count * at.panel_width,
                      static_cast<int>(Canvas::text_width(figure::title_size, at.title)) + 2 * figure::margin);
  at.height = at.legend_top + legend_line * draw_legend(nullptr, 0, at.width, legend, look) + figure::margin - 10;
  return at;
}

}  // namespace

std::string preview_picture(const Depth& depth, const Truth& truth, const Raw& raw, const std::string& caption, const Style& style) {
  const bool with_truth = truth.z_m.size() == depth.z_m.size();
  const Look& look = look_of(style.theme);
  std::vector<Panel> panels = {depth_panel(depth, truth, raw), amplitude_panel(depth),
                               with_truth ? error_panel(depth, truth) : noise_panel(depth)};
  if (!truth.multipath_m.empty() && truth.multipath_m.size() == raw.lit.size() * depth.z_m.size())
    panels.push_back(multipath_panel(depth, truth, raw));
  const std::vector<LegendEntry> legend = legend_of(depth, style.theme);
  const Layout at = layout_of(depth, panels, caption, legend, look);
  const std::unique_ptr<Painter> painter = painter_of(style.format, at.width, at.height, look.background, style.scale);
  const auto text = [&](int x, int line, double size, Rgb color, const std::string& words) {
    painter->text({static_cast<double>(x), static_cast<double>(line)}, size, color, Align::left, words);
  };

  if (!caption.empty()) text(figure::margin, figure::margin + 14, figure::title_size, look.ink, at.title);
  int x = figure::margin;
  for (const Panel& panel : panels) {
    std::vector<Rgb> image = colored(panel.values, panel.colors, look.invalid);
    if (&panel == &panels[0]) color_invalid(image, depth, style.theme);
    text(x, at.title_line, 0.9 * figure::title_size, look.ink, panel.title);
    painter->image(x, at.image_top, depth.width, depth.height, at.scale, image);
    draw_scale_bar(*painter, x + at.image_width + figure::bar_gap, at.image_top, std::max(at.image_height, least_bar), panel.colors, look);
    text(x, at.note_line, figure::note_size, look.faint_ink, panel.note);
    text(x, at.note_line + 16, figure::note_size, look.faint_ink, panel.scale_note);
    x += at.panel_width;
  }
  draw_legend(painter.get(), at.legend_top, at.width, legend, look);
  return painter->finished();
}

}  // namespace tofray::pictures
