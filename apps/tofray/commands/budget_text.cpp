// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include "commands/budget_text.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "analysis/budget_columns.h"
#include "base/text.h"
#include "base/units.h"

namespace tofray::app {

namespace {

/// Three digits with a prefix: "1.23 nW".
std::string with_prefix(double value, const char* unit) {
  constexpr const char* prefixes[] = {"f", "p", "n", "u", "m", "", "k", "M"};
  if (value == 0 || !std::isfinite(value)) return fmt::format("0 {}", unit);
  const int third = std::clamp(static_cast<int>(std::floor(std::log10(std::fabs(value) * 1.0005) / 3)), -5, 2);
  return fmt::format("{:.3g} {}{}", value * std::pow(10.0, -3 * third), prefixes[third + 5], unit);
}

/// Three digits, no power of ten below a million.
std::string three_digits(double value) {
  if (std::isnan(value)) return "-";
  const double size = std::fabs(value);
  if (size >= 1e6 || (size > 0 && size < 1e-3)) return fmt::format("{:.2e}", value);
  return size < 0.9995 ? fmt::format("{:.3g}", value) : fmt::format("{:.{}f}", value, size >= 99.95 ? 0 : size >= 9.995 ? 1 : 2);
}

/// A share in percent: "<0.1" where it is less.
std::string share_text(double share) {
  if (std::isnan(share)) return "-";
  return share == 0 ? "0" : share < 5e-4 ? "<0.1" : fmt::format("{:.1f}", 100 * share);
}

/// A probability in percent: 0 below a millionth.
std::string chance_text(double share) {
  if (std::isnan(share)) return "-";
  return share < 1e-6 ? "0" : fmt::format("{:.2g}", 100 * share);
}

struct BudgetMarks {
  bool low = false, beyond = false;
};

std::string sigma_text(const BudgetRow& row, BudgetMarks& marks) {
  if (row.saturated) return "saturated";
  if (row.no_return) return "no return";
  marks.low = marks.low || row.low_signal, marks.beyond = marks.beyond || row.beyond_ambiguity;
  return three_digits(1e3 * row.sigma_m) + (row.low_signal ? "*" : "") + (row.beyond_ambiguity ? "!" : "");
}

constexpr const char* heading_format =
    "  {:>6} {:>9} {:>9} {:>9} {:>9} {:>8} {:>6} {:>6} {:>6} {:>10} {:>7} |{:>7}{:>7}{:>7}{:>7}{:>7}{:>7}{:>7}\n";

template <class... Cell>
std::string budget_line(const Cell&... cell) {
  return fmt::format(fmt::runtime(heading_format), cell...);
}

std::string row_text(const BudgetRow& row, BudgetMarks& marks) {
  const VarianceShares& s = row.share;
  return budget_line(fmt::format("{:.3g}", row.z_m), three_digits(row.irradiance_w_m2), three_digits(1e12 * row.power_w),
                     three_digits(row.signal_e), three_digits(row.ambient_e), three_digits(row.dark_e),
                     fmt::format("{:.1f}", 100 * row.contrast), fmt::format("{:.0f}", 100 * row.tap_filling),
                     fmt::format("{:.0f}", 100 * row.adc_filling), sigma_text(row, marks), chance_text(row.wrong_cycle),
                     share_text(s.signal_shot), share_text(s.ambient_shot), share_text(s.dark_shot), share_text(s.read), share_text(s.adc),
                     share_text(s.suppression), share_text(s.lines));
}

std::string reach_text(const BudgetReach& one, double low_signal_m) {
  const std::string within = base::quantity_text(low_signal_m, "1 mm");
  const std::string reach = one.reach_m >= BudgetReach::everywhere_m ? fmt::format("within {} at all distances", within)
                            : one.reach_m > 0                        ? fmt::format("within {} up to {:.3g} m", within, one.reach_m)
                                                                     : fmt::format("above {} at all distances", within);
  const std::string near = one.nearest_m >= BudgetReach::everywhere_m ? "saturated at all distances"
                           : one.nearest_m > 0                        ? fmt::format("saturated nearer than {:.3g} m", one.nearest_m)
                                                                      : "nowhere saturated";
  return fmt::format("range noise {}; {}", reach, near);
}

std::string summary_lines(const Camera& camera, const std::vector<BudgetRow>& rows, const BudgetSummary& summary) {
  const auto line = [](const char* what, const std::string& value) { return fmt::format("  {:<27}{}\n", what, value); };
  std::vector<std::string> frequencies;
  for (const BudgetFrequency& one : rows.front().frequencies)
    frequencies.push_back(base::quantity_text(one.modulation_frequency_hz, "1 MHz"));
  std::string text = fmt::format("{} in mode {}\n", camera.name, camera.mode.name);
  text += line("ambiguity range", fmt::format("{:.3f} m, by {}", summary.ambiguity_range_m, base::listed(frequencies, "and")));
  text += line("illumination", fmt::format("{} a frame, {} on the mean; {} toward the pixel's wall, while a raw frame is lit",
                                           with_prefix(summary.energy_per_frame_j, "J"), with_prefix(summary.mean_power_w, "W"),
                                           with_prefix(summary.radiant_intensity_w_sr, "W/sr")));
  text += line("noise-equivalent distance", std::isnan(summary.noise_at_1_m_m) ? "none: a white wall at 1 m saturates"
                                                                               : with_prefix(summary.noise_at_1_m_m, "m") +
                                                                                     ": range noise of a white wall at 1 m in the dark");
  const std::string ambient = summary.uncorrelated_e_per_j == 0
                                  ? "; ambient light adds nothing to it"
                                  : fmt::format(", {:.3g} e/J of ambient light", summary.uncorrelated_e_per_j);
  return text +
         line("responsivity", fmt::format("{:.3g} e/J of the camera's illumination in the amplitude{}{}", summary.correlated_e_per_j,
                                          ambient, summary.rejection ? fmt::format(": rejected {:.3g} to 1", *summary.rejection) : ""));
}

/// What is told of a list's numbers is told of NaN by null.
files::Json number_json(double value) { return std::isfinite(value) ? files::Json(value) : files::Json(); }

files::Json row_json(const BudgetRow& row) {
  files::Json out = files::Json::object(), frequencies = files::Json::array();
  out.set("ambient", row.ambient);
  for (const analysis::BudgetColumn& column : analysis::budget_columns()) out.set(column.name, number_json(column.of(row)));
  for (const analysis::BudgetFlag& flag : analysis::budget_flags()) out.set(flag.name, row.*(flag.member));
  for (const BudgetFrequency& one : row.frequencies) {
    files::Json frequency = files::Json::object();
    for (const analysis::BudgetFrequencyColumn& column : analysis::budget_frequency_columns())
      frequency.set(column.name, number_json(one.*(column.member)));
    frequencies.push(std::move(frequency));
  }
  return out.set("frequencies", std::move(frequencies));
}

std::string csv_cell(double value) { return std::isnan(value) ? std::string() : base::number_text(value); }

}  // namespace

std::string budget_text(const Camera& camera, const std::vector<BudgetRow>& rows, const BudgetSummary& summary) {
  std::string text = summary_lines(camera, rows, summary);
  const std::size_t tables = summary.reach.size(), each = rows.size() / tables;
  BudgetMarks marks;
  for (std::size_t i = 0; i < tables; ++i) {
    const BudgetReach& reach = summary.reach[i];
    text += fmt::format("\na wall of {:g} % {}: {}\n", 100 * reach.reflectivity, reach.ambient, reach_text(reach, summary.low_signal_m));
    text += budget_line("z", "on wall", "on pixel", "signal", "ambient", "dark", "contr.", "tap", "ADC", "sigma", "wrong", "signal", "amb.",
                        "dark", "read", "ADC", "suppr.", "lines");
    text += fmt::format("  {:>6} {:>9} {:>9} {:>9} {:>9} {:>8} {:>6} {:>6} {:>6} {:>10} {:>7} |  shares of the variance, %\n", "m", "W/m2",
                        "pW", "e", "e", "e", "%", "%", "%", "mm", "%");
    for (std::size_t row = i * each; row < (i + 1) * each; ++row) text += row_text(rows[row], marks);
  }
  if (marks.low) text += fmt::format("* low signal: range noise above {}\n", base::quantity_text(summary.low_signal_m, "1 mm"));
  if (marks.beyond) text += "! beyond the ambiguity range: the range comes out too short\n";
  return text;
}

files::Json budget_json(const Camera& camera, const std::vector<BudgetRow>& rows, const BudgetSummary& summary) {
  files::Json all = files::Json::array(), reach = files::Json::array();
  for (const BudgetRow& row : rows) all.push(row_json(row));
  for (const BudgetReach& one : summary.reach)
    reach.push(files::Json::object()
                   .set("reflectivity", one.reflectivity)
                   .set("ambient", one.ambient)
                   .set("reach_m", one.reach_m)
                   .set("nearest_m", one.nearest_m));
  files::Json whole = files::Json::object();
  whole.set("ambiguity_range_m", summary.ambiguity_range_m)
      .set("low_signal_m", summary.low_signal_m)
      .set("energy_per_frame_j", summary.energy_per_frame_j)
      .set("mean_power_w", summary.mean_power_w)
      .set("radiant_intensity_w_sr", summary.radiant_intensity_w_sr)
      .set("noise_equivalent_distance_m", number_json(summary.noise_at_1_m_m))
      .set("correlated_responsivity_e_per_j", summary.correlated_e_per_j)
      .set("uncorrelated_responsivity_e_per_j", summary.uncorrelated_e_per_j)
      .set("background_light_rejection", summary.rejection ? files::Json(*summary.rejection) : files::Json())
      .set("reach", std::move(reach));
  files::Json out = files::Json::object();
  return out.set("camera", camera.name).set("mode", camera.mode.name).set("summary", std::move(whole)).set("rows", std::move(all));
}

std::string budget_csv(const std::vector<BudgetRow>& rows) {
  std::string text = "ambient";
  for (const analysis::BudgetColumn& column : analysis::budget_columns()) text += fmt::format(",{}", column.name);
  for (const analysis::BudgetFlag& flag : analysis::budget_flags()) text += fmt::format(",{}", flag.name);
  for (std::size_t i = 0; i < rows.front().frequencies.size(); ++i)
    for (const analysis::BudgetFrequencyColumn& column : analysis::budget_frequency_columns())
      text += fmt::format(",f{}_{}", i + 1, column.name);
  text += "\n";
  for (const BudgetRow& row : rows) {
    text += row.ambient;
    for (const analysis::BudgetColumn& column : analysis::budget_columns()) text += "," + csv_cell(column.of(row));
    for (const analysis::BudgetFlag& flag : analysis::budget_flags()) text += row.*(flag.member) ? ",1" : ",0";
    for (const BudgetFrequency& one : row.frequencies)
      for (const analysis::BudgetFrequencyColumn& column : analysis::budget_frequency_columns())
        text += "," + csv_cell(one.*(column.member));
    text += "\n";
  }
  return text;
}

}  // namespace tofray::app
