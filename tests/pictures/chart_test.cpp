// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>

#include "pictures/chart.h"
#include "pictures/figure.h"
#include "pictures/painter.h"
#include "support/samples.h"

using namespace tofray::pictures;

namespace {

constexpr double missing = std::numeric_limits<double>::quiet_NaN();

Chart sample(bool log_y) {
  Chart chart;
  chart.title = "Speed-up <over> block size & more";
  chart.notes = {"some machine"};
  chart.x_label = "threads per block";
  chart.y_label = "speed-up";
  chart.x_ticks = {32, 64, 96, 128};
  chart.log_y = log_y;
  chart.curves = {{"first", curve_color(0), false, {32, 64, 96, 128}, {1, 10, 100, 1000}, 3},
                  {"second", curve_color(1), true, {32, 64, 96, 128}, {50, missing, 70, 80}, -1}};
  return chart;
}

std::string hex(Rgb color) {
  char text[8];
  std::snprintf(text, sizeof text, "#%02x%02x%02x", color.red, color.green, color.blue);
  return text;
}

/// Places of all dots of a curve's colour, as SVG has them: the small ones are its points.
std::vector<Point> dots(const std::string& svg, Rgb color) {
  std::vector<Point> all;
  std::istringstream lines(svg);
  for (std::string line; std::getline(lines, line);) {
    Point at;
    double radius = 0;
    if (std::sscanf(line.c_str(), "<circle cx=\"%lf\" cy=\"%lf\" r=\"%lf\"", &at.x, &at.y, &radius) != 3) continue;
    if (radius == 2.2 && line.find(hex(color)) != std::string::npos) all.push_back(at);
  }
  return all;
}

std::size_t count(const std::string& text, const std::string& part) {
  std::size_t n = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++n;
  return n;
}

}  // namespace

TEST(chart, equal_ratios_are_equally_far_apart_on_a_log_axis) {
  const std::vector<Point> points = dots(chart_svg(sample(true)), curve_color(0));
  ASSERT_EQ(points.size(), 5u);  // the marked one has another dot in its ring
  const double step = points[0].y - points[1].y;
  EXPECT_GT(step, 50);                                 // up is more
  EXPECT_NEAR(points[1].y - points[2].y, step, 0.02);  // two decimals in the file
  EXPECT_NEAR(points[2].y - points[3].y, step, 0.02);
  EXPECT_NEAR(points[1].x - points[0].x, points[3].x - points[2].x, 0.02);
  EXPECT_GT(points[1].x - points[0].x, 50);  // to the right is more
  // from edge to edge, below which the ticks are written
  const std::string svg = chart_svg(sample(true));
  const auto x_of_text = [&](const std::string& text) {
    const std::size_t end = svg.find(">" + text + "</text>"), begin = svg.rfind("<text", end);
    return std::stod(svg.substr(svg.find("x=\"", begin) + 3));
  };
  EXPECT_NEAR(points[0].x, x_of_text("32"), 0.02);
  EXPECT_NEAR(points[3].x, x_of_text("128"), 0.02);
  EXPECT_GT(points[3].x - points[0].x, 500) << "of 900";
}

TEST(chart, rings_a_point_where_it_is_told_to) {
  Chart chart = sample(true);
  chart.curves[0].marked = Curve{}.marked;
  EXPECT_EQ(dots(chart_svg(chart), curve_color(0)).size(), 4u) << "unasked none";
  for (const int marked : {0, 3}) {
    chart.curves[0].marked = marked;
    const std::vector<Point> points = dots(chart_svg(chart), curve_color(0));
    ASSERT_EQ(points.size(), 5u);
    const auto there = [&](const Point& at) { return std::abs(at.x - points.back().x) < 0.01 && std::abs(at.y - points.back().y) < 0.01; };
    EXPECT_EQ(std::count_if(points.begin(), points.end(), there), 2) << marked;
    EXPECT_TRUE(there(points[static_cast<std::size_t>(marked)])) << marked;
  }
}

TEST(chart, a_linear_axis_begins_at_0) {
  const std::vector<Point> points = dots(chart_svg(sample(false)), curve_color(0));
  ASSERT_EQ(points.size(), 5u);
  // y = bottom − scale · value: from 10 and 1000 follow the others
  const double scale = (points[1].y - points[3].y) / 990, bottom = points[3].y + 1000 * scale;
  EXPECT_NEAR(points[0].y, bottom - scale, 0.02);
  EXPECT_NEAR(points[2].y, bottom - 100 * scale, 0.02);
  EXPECT_NEAR(bottom, 486, 0.02);
}

TEST(chart, what_is_missing_is_a_gap) {
  const std::string svg = chart_svg(sample(true));
  EXPECT_EQ(dots(svg, curve_color(1)).size(), 3u);
  // one stroke from the third to the fourth point, one in the legend, both dashed
  EXPECT_EQ(count(svg, "stroke-dasharray"), 2u);
}

TEST(chart, png_has_each_curve_where_svg_has_it) {
  const Chart chart = sample(true);
  CanvasPainter painter(900, 540, figure::background);
  painter.disc({100.5, 200.5}, 3, curve_color(0));
  const auto at = [&](int x, int y) {
    return painter.canvas().pixels()[(static_cast<std::size_t>(y) * 900 + static_cast<std::size_t>(x)) * 3];
  };
  EXPECT_EQ(at(100, 200), curve_color(0).red);
  EXPECT_EQ(at(110, 200), figure::background.red);
  painter.curve({{10, 50.5}, {110, 50.5}}, 2, curve_color(1), true);
  int drawn = 0;
  for (int x = 10; x < 110; ++x) drawn += at(x, 50) == curve_color(1).red ? 1 : 0;
  EXPECT_GT(drawn, 50);  // dashes of 7 and two halves of round ends, gaps of 5
  EXPECT_LT(drawn, 80);
  EXPECT_TRUE(chart_png(chart).starts_with("\x89PNG"));
  EXPECT_EQ(chart_png(chart), chart_png(chart));
}

TEST(chart, svg_is_xml_and_png_a_picture_of_the_same_size) {
  const out_test::Python python;
  if (!python.there() || !python.has("PIL")) GTEST_SKIP() << "no /usr/bin/python3 with numpy and PIL";
  const out_test::TemporaryFolder folder;
  out_test::write_file(folder.file("chart.svg"), chart_svg(sample(true)));
  out_test::write_file(folder.file("chart.png"), chart_png(sample(true)));
  EXPECT_EQ(python.run(R"py(
import re, sys, numpy as np
import xml.etree.ElementTree as tree
from PIL import Image
root = tree.parse(sys.argv[1] + '/chart.svg').getroot()
ns = '{http://www.w3.org/2000/svg}'
texts = [t.text for t in root.iter(ns + 'text')]
assert 'Speed-up <over> block size & more' in texts and 'threads per block' in texts, texts
assert {'32', '64', '96', '128', '1', '1000', 'first', 'second'} <= set(texts), texts
image = np.array(Image.open(sys.argv[1] + '/chart.png').convert('RGB')).astype(int)
assert image.shape[:2] == (int(root.get('height')), int(root.get('width')))
for circle in root.iter(ns + 'circle'):
  x, y, color = float(circle.get('cx')), float(circle.get('cy')), circle.get('fill')
  if float(circle.get('r')) != 2.2: continue
  rgb = [int(color[i:i + 2], 16) for i in (1, 3, 5)]
  assert np.abs(image[int(y), int(x)] - rgb).max() < 60, (x, y, image[int(y), int(x)], rgb)
)py",
                       folder.path().string()),
            0);
}

TEST(chart, without_any_value_it_is_still_a_picture) {
  Chart chart = sample(true);
  for (Curve& curve : chart.curves) curve.y.assign(curve.x.size(), missing), curve.marked = -1;
  EXPECT_TRUE(chart_png(chart).starts_with("\x89PNG"));
  EXPECT_EQ(count(chart_svg(chart), "<circle"), 0u);
  chart.x_ticks = {2};
  EXPECT_EQ(count(chart_svg(chart), "nan"), 0u);
}
