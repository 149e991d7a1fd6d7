// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include "commands/camera_text.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "base/spectra.h"
#include "base/text.h"
#include "base/units.h"

namespace tofray::app {

namespace {

constexpr std::size_t distances_in_a_line = 6;
constexpr double many_wrong = 0.01;

/// Three digits of a length in millimetres.
std::string millimetres(double metres) {
  const double mm = 1e3 * metres;
  return fmt::format("{:.{}f}", mm, mm < 9.995 ? 2 : mm < 99.95 ? 1 : 0);
}

/// A share in percent: 0 below a millionth.
std::string percent(double share) {
  return share < 1e-6 ? "0" : fmt::format("{:.{}f}", 100 * share, share < 1e-4 ? 4 : share < 0.0095 ? 2 : share < 0.0995 ? 1 : 0);
}

/// What footnotes have to explain.
struct Marks {
  bool low = false, wrong = false, sun = false;
};

std::string sigma_cell(const CameraReport& report, const NoiseAt& here, Marks& marks) {
  if (here.saturated) return "saturated";
  if (std::isnan(here.sigma_m)) return "-";
  const bool weak = !(here.sigma_m <= report.low_signal_m);
  marks.low = marks.low || weak;
  return millimetres(here.sigma_m) + (weak ? "*" : "");
}

std::string wrong_cell(const NoiseAt& here, Marks& marks) {
  if (std::isnan(here.wrong_cycle)) return "-";
  const bool many = here.wrong_cycle > many_wrong;
  marks.wrong = marks.wrong || many;
  return percent(here.wrong_cycle) + (many ? "!" : "");
}

/// The table of some of the distances.
std::string noise_lines(const CameraReport& report, std::size_t from, std::size_t to, Marks& marks) {
  std::string text = fmt::format("  {:<24}", "range noise, mm");
  for (std::size_t i = from; i < to; ++i) text += fmt::format("{:>10}", fmt::format("{:.3g} m", report.noise[0].at[i].z_m));
  text += "   saturates\n";
  for (const NoiseAtDistances& one : report.noise) {
    marks.sun = marks.sun || one.ambient == "in the sun";
    text += fmt::format("  {:>6} {:<17}", fmt::format("{:g} %", 100 * one.reflectivity), one.ambient);
    for (std::size_t i = from; i < to; ++i) text += fmt::format("{:>10}", sigma_cell(report, one.at[i], marks));
    text += one.saturated_up_to_m >= NoiseAtDistances::everywhere_m ? "   everywhere\n"
            : one.saturated_up_to_m > 0                             ? fmt::format("   nearer than {:.2f} m\n", one.saturated_up_to_m)
                                                                    : "   nowhere\n";
    if (report.cycles.size() < 2) continue;
    text += fmt::format("  {:<24}", "         wrong cycle, %");
    for (std::size_t i = from; i < to; ++i) text += fmt::format("{:>10}", wrong_cell(one.at[i], marks));
    text += "\n";
  }
  return text;
}

std::string noise_text(const CameraReport& report) {
  std::string text;
  Marks marks;
  const std::size_t distances = report.noise[0].at.size();
  for (std::size_t from = 0; from < distances; from += distances_in_a_line)
    text += noise_lines(report, from, std::min(from + distances_in_a_line, distances), marks);
  const auto foot = [&](const std::string& line) { text += fmt::format("  {:<24}{}\n", "", line); };
  if (marks.low) foot(fmt::format("* low signal: above {}", base::quantity_text(report.low_signal_m, "1 mm")));
  if (marks.wrong) foot("! above 1 %: the range of so many pixels is off by whole cycles of a modulation frequency");
  if (marks.sun) foot(fmt::format("the sun: 100 % of sun_am15 from everywhere, {:.0f} klx", 1e-3 * base::illuminance_lx(base::sun_am15())));
  if (!report.knows_ambient)
    foot("The mode has no unlit raw frame: the camera's own estimate (noise_m) leaves out what ambient light adds.");
  return text;
}

}  // namespace

std::string report_text(const CameraReport& report) {
  const auto share = [](double part) { return part < 5e-4 ? std::string("less than 0.1 %") : fmt::format("{:.1f} %", 100 * part); };
  const auto row = [](const char* what, const std::string& value) { return fmt::format("  {:<24}{}\n", what, value); };
  const std::string corners = std::isnan(report.diagonal_deg) ? "" : fmt::format(", {:.1f} deg from corner to corner", report.diagonal_deg);
  const std::string view = std::isnan(report.width_deg) || std::isnan(report.height_deg)
                               ? "wider than the lens model"
                               : fmt::format("{:.1f} x {:.1f} deg{}", report.width_deg, report.height_deg, corners);
  std::string text = row("field of view", view);
  text +=
      row("a pixel at 1 m", fmt::format("{} x {} mm on the axis", millimetres(report.pixel_width_m), millimetres(report.pixel_height_m)));
  if (report.outside > 0) text += row("outside the lens", share(report.outside) + " of the pixels have no ray");
  if (report.unlit > 0) text += row("unlit", share(report.unlit) + " of the pixels see nothing of the camera's light");
  if (report.darkest > 0)
    text += row("light on a wall", fmt::format("the darkest pixel gets {:.2g} % of the brightest one's", 100 * report.darkest));
  if (report.ambiguity_range_m > 0) {
    std::vector<std::string> frequencies;
    for (const double f : report.modulation_frequency_hz) frequencies.push_back(base::quantity_text(f, "1 MHz"));
    std::string ratio;
    for (const int one : report.cycles) ratio += (ratio.empty() ? "" : " : ") + std::to_string(one);
    text += row("ambiguity range", fmt::format("{:.3f} m, by {}{}", report.ambiguity_range_m, base::listed(frequencies, "and"),
                                               report.cycles.size() > 1 ? ", as " + ratio : ""));
  }
  return report.noise.empty() ? text : text + noise_text(report);
}

files::Json report_json(const CameraReport& report) {
  const auto number = [](double value) { return std::isnan(value) ? files::Json() : files::Json(value); };
  files::Json json = files::Json::object(), frequencies = files::Json::array(), noise = files::Json::array(), cycles = files::Json::array();
  for (const int one : report.cycles) cycles.push(files::Json(one));
  for (const double f : report.modulation_frequency_hz) frequencies.push(files::Json(f));
  for (const NoiseAtDistances& one : report.noise) {
    files::Json at = files::Json::array();
    for (const NoiseAt& here : one.at)
      at.push(files::Json::object()
                  .set("z_m", here.z_m)
                  .set("noise_m", number(here.sigma_m))
                  .set("wrong_cycle", number(here.wrong_cycle))
                  .set("saturated", here.saturated));
    noise.push(files::Json::object()
                   .set("reflectivity", one.reflectivity)
                   .set("ambient", one.ambient == "in the sun"    ? "sun_am15"
                                   : one.ambient == "in the dark" ? "none"
                                                                  : one.ambient)
                   .set("at", std::move(at))
                   .set("saturated_up_to_m", one.saturated_up_to_m));
  }
  return json.set("field_of_view_deg", files::Json::array().push(number(report.width_deg)).push(number(report.height_deg)))
      .set("diagonal_deg", number(report.diagonal_deg))
      .set("pixel_at_1_m_m", files::Json::array().push(report.pixel_width_m).push(report.pixel_height_m))
      .set("share_outside_lens", report.outside)
      .set("share_unlit", report.unlit)
      .set("darkest_over_brightest", report.darkest)
      .set("modulation_frequency_hz", std::move(frequencies))
      .set("ambiguity_range_m", report.ambiguity_range_m)
      .set("cycles", std::move(cycles))
      .set("knows_ambient", report.knows_ambient)
      .set("noise", std::move(noise));
}

}  // namespace tofray::app
