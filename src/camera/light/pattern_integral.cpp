// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include "camera/light/pattern_integral.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "base/constants.h"
#include "num/setup_math.h"

namespace tofray::camera {

namespace {

using base::pi;

/// Panels are no wider than this: the weight sin θ/θ bends by less than 1e-4 in one, and what its edge at θ = π does to three points of
/// Gauss is less than 1e-5 of a pattern that reaches so far.
constexpr double widest_panel = 0.05;
/// In a table's cells this narrow the middle is enough: h²/24 of the weight's second derivative, at most 1/3, is 1.4e-6.
constexpr double narrow_panel = 0.01;

/// sin θ/θ = 1 − s/(2·3)·(1 − s/(4·5)·(1 − …)), s = θ² <= π²; 0 beyond. Up to 1e-16.
double weight(double square) {
  static constexpr auto per_step = [] {
    std::array<double, 15> out{};
    for (int k = 1; k <= 15; ++k) out[static_cast<std::size_t>(k - 1)] = 1.0 / (2 * k * (2 * k + 1));
    return out;
  }();
  if (square >= pi * pi) return 0;
  double sum = 1;
  for (std::size_t k = per_step.size(); k-- > 0;) sum = 1 - square * per_step[k] * sum;
  return sum;
}

/// A point of a quadrature along one axis.
struct Node {
  double at, weight;
};

/// Quadrature over [cuts.front(), cuts.back()]: one or three points of Gauss in each panel; panels meet at the cuts, and nothing beyond
/// half a turn counts.
std::vector<Node> quadrature(const std::vector<double>& cuts, double widest, int points) {
  const double root = std::sqrt(0.6);
  std::vector<Node> out;
  for (std::size_t i = 1; i < cuts.size(); ++i) {
    const double from = std::clamp(cuts[i - 1], -pi, pi), to = std::clamp(cuts[i], -pi, pi);
    const int panels = std::max(1, static_cast<int>(std::ceil((to - from) / widest)));
    for (int k = 0; k < panels && to > from; ++k) {
      const double half = (to - from) / (2 * panels), middle = from + (2 * k + 1) * half;
      if (points == 1) {
        out.push_back({middle, 2 * half});
      } else {
        out.insert(out.end(), {{middle - root * half, half * 5 / 9}, {middle, half * 8 / 9}, {middle + root * half, half * 5 / 9}});
      }
    }
  }
  return out;
}

/// A node, and between which of a table's samples it lies.
struct TableNode {
  double square, weight, share;
  std::size_t before;
};

/// Quadrature across `cells` cells that cover ± half_range: panels meet at their centres.
std::vector<TableNode> table_quadrature(int cells, double half_range) {
  const double cell = 2 * half_range / cells;
  std::vector<double> cuts{-half_range};
  for (int i = 0; i < cells; ++i) cuts.push_back(half_range * ((2 * i + 1.0) / cells - 1));
  cuts.push_back(half_range);
  std::vector<TableNode> out;
  for (const Node& node : quadrature(cuts, widest_panel, cell <= narrow_panel ? 1 : 3)) {
    const double u = std::clamp((node.at + half_range) / cell - 0.5, 0.0, cells - 1.0);
    const double before = std::min(std::floor(u), cells - 2.0);
    out.push_back({node.at * node.at, node.weight, u - before, static_cast<std::size_t>(before)});
  }
  return out;
}

/// Quadrature over one axis of a flat top from 0 on, its shape in the weights. Beyond the full width it is 2⁻²⁵⁶ of the peak: nothing.
std::vector<Node> flat_top_quadrature(double width, double half_range) {
  std::vector<Node> out = quadrature({0, std::min(half_range, width)}, std::min(widest_panel, width / 32), 3);  // 1/32: 1e-8 of its shape
  for (Node& node : out) node.weight *= flat_top_share(2 * node.at / width);
  return out;
}

}  // namespace

double flat_top_share(double u) {
  const double u2 = u * u, u4 = u2 * u2;
  return num::setup::exp(-num::setup::log(2.0) * (u4 * u4));
}

double table_integral(const std::vector<double>& samples, int columns, int rows, double half_x, double half_y) {
  const std::vector<TableNode> across = table_quadrature(columns, half_x), down = table_quadrature(rows, half_y);
  double sum = 0;
  for (const TableNode& y : down) {
    const double* top = samples.data() + y.before * static_cast<std::size_t>(columns);
    const double* bottom = top + columns;
    double row = 0;
    for (const TableNode& x : across) {
      const double above = top[x.before] + x.share * (top[x.before + 1] - top[x.before]);
      const double below = bottom[x.before] + x.share * (bottom[x.before + 1] - bottom[x.before]);
      row += x.weight * weight(x.square + y.square) * (above + y.share * (below - above));
    }
    sum += y.weight * row;
  }
  return sum;
}

double flat_top_integral(double width, double height, double half_x, double half_y) {
  const std::vector<Node> across = flat_top_quadrature(width, half_x), down = flat_top_quadrature(height, half_y);
  double quarter = 0;
  for (const Node& y : down) {
    for (const Node& x : across) quarter += y.weight * x.weight * weight(x.at * x.at + y.at * y.at);
  }
  return 4 * quarter;
}

}  // namespace tofray::camera
