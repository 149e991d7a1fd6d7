// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include "pictures/chart.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <memory>

#include "num/setup_math.h"
#include "pictures/figure.h"
#include "pictures/painter.h"

namespace tofray::pictures {

namespace {

constexpr int chart_width = 900, chart_height = 540;
constexpr double left_edge = 84, right_edge = 650, bottom_edge = 486;  // of the plotting area [px]
constexpr Rgb grid{46, 48, 54};

/// Where values stand on the y axis, and its labelled places.
struct YAxis {
  bool log = false;
  double low = 0, high = 1;
  std::vector<double> ticks;
  std::vector<std::string> labels;

  [[nodiscard]] double place(double y) const {
    return log ? num::setup::log(y / low) / num::setup::log(high / low) : (y - low) / (high - low);
  }
};

bool drawable(const Chart& chart, double y) { return std::isfinite(y) && (!chart.log_y || y > 0); }

/// From a number at or below `low` to one at or above `high`, each 1, 2 or 5 times a power of ten.
YAxis log_axis(double low, double high) {
  YAxis axis;
  axis.log = true;
  double power = 1;
  while (power > low) power /= 10;
  while (power * 10 <= low) power *= 10;
  for (int i = 0;; ++i) {
    constexpr double steps[] = {1, 2, 5};
    if (i > 0 && i % 3 == 0) power *= 10;
    const double tick = steps[i % 3] * power;
    if (i % 3 < 2 && steps[i % 3 + 1] * power <= low) continue;  // the next one is still low enough
    axis.ticks.push_back(tick);
    if (tick >= high && axis.ticks.size() > 1) break;
  }
  for (const double tick : axis.ticks) axis.labels.push_back(fmt::format("{:g}", tick));
  axis.low = axis.ticks.front(), axis.high = axis.ticks.back();
  return axis;
}

YAxis y_axis(const Chart& chart) {
  double low = 1e300, high = -1e300;
  for (const Curve& curve : chart.curves) {
    for (const double y : curve.y) {
      if (!drawable(chart, y)) continue;
      low = std::min(low, y), high = std::max(high, y);
    }
  }
  if (low > high) low = chart.log_y ? 1 : 0, high = chart.log_y ? 10 : 1;
  if (chart.log_y) return log_axis(low, high);
  const PictureScale scale = round_scale(std::min(low, 0.0), high, 1e-12);
  YAxis axis;
  axis.low = scale.low, axis.high = scale.high, axis.ticks = scale.ticks();
  for (const double tick : axis.ticks) axis.labels.push_back(scale.label(tick));
  return axis;
}

/// One chart, drawn with whatever paints.
class Drawing {
 public:
  Drawing(const Chart& chart, Painter& painter)
      : chart_(chart),
        painter_(painter),
        axis_(y_axis(chart)),
        top_(figure::margin + 56 + 16.0 * static_cast<double>(chart.notes.size())) {}

  void draw() {
    double y = figure::margin + figure::title_size;
    painter_.text({figure::margin, y}, figure::title_size, figure::ink, Align::left, chart_.title);
    y += 4;
    for (const std::string& note : chart_.notes) {
      y += 16;
      painter_.text({figure::margin, y}, figure::label_size, figure::faint_ink, Align::left, note);
    }
    draw_axes();
    for (std::size_t i = 0; i < chart_.curves.size(); ++i) {
      draw_curve(chart_.curves[i]);
      draw_legend(chart_.curves[i], static_cast<double>(i));
    }
  }

 private:
  [[nodiscard]] double x_of(double x) const {
    const double low = chart_.x_ticks.front(), high = chart_.x_ticks.back();
    return high > low ? left_edge + (x - low) / (high - low) * (right_edge - left_edge) : 0.5 * (left_edge + right_edge);
  }
  [[nodiscard]] double y_of(double y) const { return bottom_edge - axis_.place(y) * (bottom_edge - top_); }

  void draw_axes() {
    for (std::size_t i = 0; i < axis_.ticks.size(); ++i) {
      const double y = y_of(axis_.ticks[i]);
      painter_.curve({{left_edge, y}, {right_edge, y}}, 1, grid, false);
      painter_.text({left_edge - 10, y + 0.5 * figure::label_size}, figure::label_size, figure::ink, Align::right, axis_.labels[i]);
    }
    double last = -1e9;
    for (const double tick : chart_.x_ticks) {
      const double x = x_of(tick);
      painter_.curve({{x, bottom_edge}, {x, bottom_edge + 5}}, 1, figure::faint_ink, false);
      const std::string label = fmt::format("{:g}", tick);
      const double half = 0.5 * Canvas::text_width(figure::label_size, label);
      if (x - half < last + 6) continue;  // labels must not run into each other
      painter_.text({x, bottom_edge + 20}, figure::label_size, figure::ink, Align::middle, label);
      last = x + half;
    }
    painter_.curve({{left_edge, top_}, {left_edge, bottom_edge}, {right_edge, bottom_edge}}, 1, figure::faint_ink, false);
    painter_.text({0.5 * (left_edge + right_edge), bottom_edge + 42}, figure::label_size, figure::ink, Align::middle, chart_.x_label);
    painter_.text({figure::margin, top_ - 16}, figure::label_size, figure::ink, Align::left, chart_.y_label);
  }

  void draw_curve(const Curve& curve) {
    std::vector<Point> run;
    const auto flush = [&] {
      if (run.size() > 1) painter_.curve(run, 1.8, curve.color, curve.dashed);
      for (const Point& point : run) painter_.disc(point, 2.2, curve.color);
      run.clear();
    };
    for (std::size_t i = 0; i < curve.x.size(); ++i) {
      if (drawable(chart_, curve.y[i]))
        run.push_back({x_of(curve.x[i]), y_of(curve.y[i])});
      else
        flush();
    }
    flush();
    if (curve.marked < 0) return;
    const auto best = static_cast<std::size_t>(curve.marked);
    const Point at{x_of(curve.x[best]), y_of(curve.y[best])};
    painter_.disc(at, 6.5, curve.color);
    painter_.disc(at, 4, figure::background);
    painter_.disc(at, 2.2, curve.color);
  }

  void draw_legend(const Curve& curve, double row) {
    const double x = right_edge + 24, y = top_ + 6 + 22 * row;
    painter_.curve({{x, y}, {x + 30, y}}, 2.4, curve.color, curve.dashed);
    painter_.text({x + 40, y + 0.5 * figure::label_size}, figure::label_size, figure::ink, Align::left, curve.name);
  }

  const Chart& chart_;
  Painter& painter_;
  YAxis axis_;
  double top_;
};

}  // namespace

Rgb curve_color(std::size_t number) {
  constexpr Rgb colors[] = {{247, 201, 72},  {86, 180, 233},  {240, 110, 90}, {70, 190, 150},
                            {200, 140, 240}, {230, 232, 236}, {190, 120, 60}, {120, 130, 240}};
  return colors[number % std::size(colors)];
}

namespace {

std::string chart_file(const Chart& chart, Format format) {
  const std::unique_ptr<Painter> painter = painter_of(format, chart_width, chart_height, figure::background);
  Drawing(chart, *painter).draw();
  return painter->finished();
}

}  // namespace

std::string chart_png(const Chart& chart) { return chart_file(chart, Format::png); }

std::string chart_svg(const Chart& chart) { return chart_file(chart, Format::svg); }

}  // namespace tofray::pictures
