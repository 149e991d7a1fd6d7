// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include "analysis/step_edge.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>

#include "analysis/samples.h"

namespace tofray::analysis {

namespace {

/// A ramp or a curved surface, parted in its middle, has sides that are spread nearly as far as they are apart.
constexpr double least_step_by_spread = 10;
/// Of all pixels: less than this on one side is no surface.
constexpr double least_share_of_a_side = 0.05;

/// Where a line of the image is: 0 near, 1 far; only pixels that have a depth.
struct EdgeLine {
  std::vector<double> at, level;
};

double crossing_between(const EdgeLine& line, std::size_t i, double level) {
  const double share = (level - line.level[i]) / (line.level[i + 1] - line.level[i]);
  return line.at[i] + share * (line.at[i + 1] - line.at[i]);
}

bool crosses(const EdgeLine& line, std::size_t i, double level) { return (line.level[i] < level) != (line.level[i + 1] < level); }

/// The crossing of a level that is nearest to place `from`, towards smaller (-1) or larger indices.
std::optional<double> crossing_from(const EdgeLine& line, std::size_t from, int way, double level) {
  for (auto i = static_cast<std::ptrdiff_t>(from); i >= 0 && i + 1 < static_cast<std::ptrdiff_t>(line.at.size()); i += way)
    if (crosses(line, static_cast<std::size_t>(i), level)) return crossing_between(line, static_cast<std::size_t>(i), level);
  return std::nullopt;
}

struct EdgeCrossing {
  double middle = unknown, width = unknown;
  bool near_first = true;
};

/// None where the line crosses the middle of the step never or more than once.
std::optional<EdgeCrossing> crossing_of(const EdgeLine& line) {
  std::optional<std::size_t> middle;
  for (std::size_t i = 0; i + 1 < line.at.size(); ++i) {
    if (!crosses(line, i, 0.5)) continue;
    if (middle) return std::nullopt;
    middle = i;
  }
  if (!middle) return std::nullopt;
  EdgeCrossing out;
  out.middle = crossing_between(line, *middle, 0.5);
  out.near_first = line.level[*middle] < 0.5;
  const std::optional<double> near = crossing_from(line, *middle, out.near_first ? -1 : 1, 0.1),
                              far = crossing_from(line, *middle, out.near_first ? 1 : -1, 0.9);
  if (near && far) out.width = std::fabs(*far - *near);
  return out;
}

/// @param by_rows  whether its lines are rows
StepEdge crossed_by(const StepEdge& levels, const std::vector<double>& z, int width, int height, bool by_rows) {
  StepEdge out = levels;
  out.by_rows = by_rows;
  const int lines = by_rows ? height : width, length = by_rows ? width : height;
  std::vector<double> widths;
  int near_first = 0, crossed = 0;
  for (int one = 0; one < lines; ++one) {
    EdgeLine line;
    for (int i = 0; i < length; ++i) {
      const double value = z[static_cast<std::size_t>(by_rows ? one * width + i : i * width + one)];
      if (std::isnan(value)) continue;
      line.at.push_back(i), line.level.push_back((value - levels.near_m) / (levels.far_m - levels.near_m));
    }
    const std::optional<EdgeCrossing> crossing = crossing_of(line);
    out.middle.push_back(crossing ? crossing->middle : unknown);
    if (!crossing) continue;
    ++crossed, near_first += crossing->near_first ? 1 : 0;
    if (!std::isnan(crossing->width)) widths.push_back(crossing->width);
  }
  out.found = 2 * crossed > lines;
  out.near_first = 2 * near_first > crossed, out.width_px = median_of(widths);
  return out;
}

}  // namespace

StepEdge step_edge(const std::vector<double>& z, int width, int height) {
  std::vector<double> valid;
  std::copy_if(z.begin(), z.end(), std::back_inserter(valid), [](double value) { return !std::isnan(value); });
  StepEdge none;
  if (valid.empty()) return none;
  const double middle = (quantile(valid, 0.05) + quantile(valid, 0.95)) / 2;
  std::vector<double> near, far;
  for (const double value : valid) (value < middle ? near : far).push_back(value);
  const auto least = static_cast<std::size_t>(least_share_of_a_side * static_cast<double>(valid.size()));
  if (std::min(near.size(), far.size()) <= least) return none;
  StepEdge levels;
  levels.near_m = median_of(near), levels.far_m = median_of(far);
  const double spread = std::max(spread_about_median(near), spread_about_median(far));
  if (!(levels.far_m - levels.near_m > least_step_by_spread * spread)) return none;
  const StepEdge rows = crossed_by(levels, z, width, height, true), columns = crossed_by(levels, z, width, height, false);
  const auto lines = [](const StepEdge& edge) {
    return std::count_if(edge.middle.begin(), edge.middle.end(), [](double at) { return !std::isnan(at); });
  };
  if (rows.found != columns.found) return rows.found ? rows : columns;
  return lines(rows) * width >= lines(columns) * height ? rows : columns;
}

}  // namespace tofray::analysis
