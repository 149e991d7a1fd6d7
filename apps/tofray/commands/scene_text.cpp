// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include "commands/scene_text.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "base/units.h"

namespace tofray::app {

namespace {

constexpr std::size_t most_objects = 12;  // in a text

std::string percent(std::int64_t count, std::int64_t of) {
  const double share = 100.0 * static_cast<double>(count) / static_cast<double>(of);
  return count == 0 ? "none" : share < 0.05 ? "< 0.1 %" : fmt::format("{:.1f} %", share);
}

std::string row(const char* what, const std::string& value) { return fmt::format("  {:<24}{}\n", what, value); }

std::string metres(double m) { return m >= 1e5 ? "> 100 km" : fmt::format("{:.{}f} m", m, m < 1000 ? 2 : 0); }

std::string size_of(const ObjectInView& one) { return one.endless ? "endless" : base::size_text(one.low, one.high); }

/// Letters of UTF-8.
std::size_t letters(const std::string& text) {
  return static_cast<std::size_t>(
      std::count_if(text.begin(), text.end(), [](char c) { return (static_cast<unsigned char>(c) & 0xC0) != 0x80; }));
}
std::string padded(const std::string& text, std::size_t width) {
  return text + std::string(width > letters(text) ? width - letters(text) : 0, ' ');
}

/// The objects that most pixels see, in the scene's order.
std::vector<const ObjectInView*> largest(const SceneReport& report) {
  std::vector<const ObjectInView*> all;
  for (const ObjectInView& one : report.objects) all.push_back(&one);
  if (all.size() <= most_objects) return all;
  std::stable_sort(all.begin(), all.end(), [](const ObjectInView* a, const ObjectInView* b) { return a->pixels > b->pixels; });
  all.resize(most_objects - 1);
  std::sort(all.begin(), all.end(), [](const ObjectInView* a, const ObjectInView* b) { return a->object < b->object; });
  return all;
}

std::string objects_text(const SceneReport& report) {
  const std::vector<const ObjectInView*> shown = largest(report);
  std::size_t width = 6;
  for (const ObjectInView* one : shown) width = std::max(width, letters(one->name));
  std::string text = "  " + padded("object", width) + "   nearest   of pixels   size\n";
  for (const ObjectInView* one : shown)
    text += fmt::format("  {}{:>10}{:>12}   {}{}\n", padded(one->name, width), one->nearest_m ? metres(*one->nearest_m) : "-",
                        percent(one->pixels, report.pixels), size_of(*one),
                        one->around_camera   ? ", around the camera"
                        : one->behind_camera ? ", behind the camera"
                                             : "");
  if (shown.size() == report.objects.size()) return text;
  std::size_t seen = 0;
  for (const ObjectInView& one : report.objects) seen += one.pixels > 0 ? 1 : 0;
  return text + fmt::format("  and {} more; of all {} objects {} are in view (--json has all)\n", report.objects.size() - shown.size(),
                            report.objects.size(), seen);
}

files::Json number(const std::optional<double>& value) { return value && std::isfinite(*value) ? files::Json(*value) : files::Json(); }

files::Json box_json(const Vec3& corner) {
  files::Json out = files::Json::array();
  for (const double x : corner) out.push(number(x));
  return out;
}

}  // namespace

std::string scene_report_text(const SceneReport& report) {
  if (report.objects.empty()) return "";
  std::string text = row("nothing hit by", percent(report.no_surface, report.pixels) + " of the rays");
  if (report.nearest_m) text += row("surfaces", fmt::format("from {} to {}", metres(*report.nearest_m), metres(*report.farthest_m)));
  if (report.beyond_reach > 0)
    text += row("beyond the range", percent(report.beyond_reach, report.pixels) + " of the pixels see farther than the ambiguity range");
  return text + objects_text(report);
}

files::Json scene_report_json(const SceneReport& report) {
  files::Json objects = files::Json::array();
  const auto share = [&](std::int64_t count) { return static_cast<double>(count) / static_cast<double>(report.pixels); };
  for (const ObjectInView& one : report.objects)
    objects.push(files::Json::object()
                     .set("name", one.name)
                     .set("share_of_pixels", share(one.pixels))
                     .set("nearest_m", number(one.nearest_m))
                     .set("farthest_m", number(one.farthest_m))
                     .set("box_low_m", box_json(one.low))
                     .set("box_high_m", box_json(one.high))
                     .set("behind_camera", one.behind_camera)
                     .set("around_camera", one.around_camera));
  return files::Json::object()
      .set("time_s", report.time_s)
      .set("share_without_surface", share(report.no_surface))
      .set("share_outside_lens", share(report.outside_lens))
      .set("share_beyond_ambiguity_range", share(report.beyond_reach))
      .set("nearest_m", number(report.nearest_m))
      .set("farthest_m", number(report.farthest_m))
      .set("objects", std::move(objects));
}

}  // namespace tofray::app
