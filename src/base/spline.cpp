// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include "base/spline.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "tofray/error.h"

namespace tofray::base {

namespace {

void check(const std::vector<double>& x, const std::vector<double>& y, Spline::Kind kind) {
  const auto refuse = [](const std::string& message) { throw Error(ErrorKind::bad_input, message); };
  if (x.size() != y.size())
    refuse(fmt::format("error: a curve needs as many values as positions\n  got {} positions and {} values", x.size(), y.size()));
  if (x.size() < 2) refuse(fmt::format("error: a curve needs at least 2 samples\n  got {}", x.size()));
  for (std::size_t i = 0; i < x.size(); ++i) {
    if (!std::isfinite(x[i]) || !std::isfinite(y[i]))
      refuse(fmt::format("error: sample {} of a curve is not a finite number\n  got x = {}, y = {}", i, x[i], y[i]));
    if (i > 0 && x[i] == x[i - 1]) refuse(fmt::format("error: a curve has two samples at one position\n  got x = {} twice", x[i]));
    if (i > 0 && x[i] < x[i - 1])
      refuse(fmt::format("error: the positions of a curve do not ascend\n  got x = {} after {}\n  sort the samples", x[i], x[i - 1]));
  }
  if (kind == Spline::Kind::periodic && y.front() != y.back())
    refuse(fmt::format("error: a periodic curve must end with the value it starts with\n  got {} and {}", y.front(), y.back()));
}

/// Solves a tridiagonal system in place by elimination; row i: lower[i]·u[i−1] + middle[i]·u[i] + upper[i]·u[i+1] = u[i] on entry.
void solve_tridiagonal(const std::vector<double>& lower, std::vector<double> middle, const std::vector<double>& upper,
                       std::vector<double>& u) {
  const std::size_t n = u.size();
  for (std::size_t i = 1; i < n; ++i) {
    const double factor = lower[i] / middle[i - 1];
    middle[i] -= factor * upper[i - 1];
    u[i] -= factor * u[i - 1];
  }
  u[n - 1] /= middle[n - 1];
  for (std::size_t i = n - 1; i-- > 0;) u[i] = (u[i] - upper[i] * u[i + 1]) / middle[i];
}

/// Slope at every knot of the not-a-knot spline, n >= 3 knots; h: interval lengths, g: secant slopes.
///
/// Inside, C²:   h_i b_{i−1} + 2(h_{i−1} + h_i) b_i + h_{i−1} b_{i+1} = 3(h_i g_{i−1} + h_{i−1} g_i).
/// At the start, with equal third derivatives of the first two pieces (the end likewise):
///     h_1 b_0 + (h_0 + h_1) b_1 = ((3h_0 + 2h_1) h_1 g_0 + h_0² g_1) / (h_0 + h_1).
std::vector<double> not_a_knot_slopes(const std::vector<double>& h, const std::vector<double>& g) {
  const std::size_t n = h.size() + 1;
  if (n == 3) {
    // One parabola: its slope is linear, and the secants are the slopes at the middles.
    const double bend = (g[1] - g[0]) / (h[0] + h[1]);
    return {g[0] - bend * h[0], g[0] + bend * h[0], g[1] + bend * h[1]};
  }
  std::vector<double> lower(n), middle(n), upper(n), slope(n);
  for (std::size_t i = 1; i + 1 < n; ++i) {
    lower[i] = h[i];
    middle[i] = 2 * (h[i - 1] + h[i]);
    upper[i] = h[i - 1];
    slope[i] = 3 * (h[i] * g[i - 1] + h[i - 1] * g[i]);
  }
  const auto end_row = [](double outer, double inner, double g_outer, double g_inner) {
    return ((3 * outer + 2 * inner) * inner * g_outer + outer * outer * g_inner) / (outer + inner);
  };
  middle[0] = h[1];
  upper[0] = h[0] + h[1];
  slope[0] = end_row(h[0], h[1], g[0], g[1]);
  middle[n - 1] = h[n - 3];
  lower[n - 1] = h[n - 2] + h[n - 3];
  slope[n - 1] = end_row(h[n - 2], h[n - 3], g[n - 2], g[n - 3]);
  solve_tridiagonal(lower, middle, upper, slope);
  return slope;
}

/// Slope at every knot of the periodic spline, n >= 2 pieces: the C² rows on a ring. Of two pieces, both neighbours of a knot are the same one.
///
/// The ring's two corner elements are taken out as a rank-one change u·vᵀ (Sherman–Morrison).
std::vector<double> periodic_slopes(const std::vector<double>& h, const std::vector<double>& g) {
  const std::size_t n = h.size();
  std::vector<double> slope(n + 1);
  std::vector<double> lower(n), middle(n), upper(n), solution(n), change(n);
  for (std::size_t i = 0; i < n; ++i) {
    const std::size_t before = i == 0 ? n - 1 : i - 1;
    lower[i] = h[i];
    middle[i] = 2 * (h[before] + h[i]);
    upper[i] = h[before];
    solution[i] = 3 * (h[i] * g[before] + h[before] * g[i]);
  }
  const double corner_first = lower[0], corner_last = upper[n - 1];  // of b_{n−1} in row 0, of b_0 in row n−1
  const double gamma = -middle[0];
  middle[0] -= gamma;
  middle[n - 1] -= corner_first * corner_last / gamma;
  change[0] = gamma;
  change[n - 1] = corner_last;
  solve_tridiagonal(lower, middle, upper, solution);
  solve_tridiagonal(lower, middle, upper, change);
  const double ratio = corner_first / gamma;
  const double factor = (solution[0] + ratio * solution[n - 1]) / (1 + change[0] + ratio * change[n - 1]);
  for (std::size_t i = 0; i < n; ++i) slope[i] = solution[i] - factor * change[i];
  slope[n] = slope[0];
  return slope;
}

/// Whether the cubic with these slopes at its ends and the secant g runs from end to end without turning.
///
/// Over g, its slope is a parabola with the Bernstein coefficients a, 3 − a − b, b: nowhere negative if the ends are not and the middle
/// one is not below −√(ab).                                                                                  [theory: monotone-spline]
bool runs_one_way(double left, double right, double g) {
  if (g == 0) return left == 0 && right == 0;
  const double a = left / g, b = right / g, middle = 3 - a - b;
  return a >= 0 && b >= 0 && (middle >= 0 || middle * middle <= a * b);
}

/// Limits slopes to 0 … 3 secants on both sides of their knot, wherever a piece would turn between its ends.
void limit_slopes(const std::vector<double>& g, std::vector<double>& slope) {
  const auto limit = [&](std::size_t knot) {
    double& s = slope[knot];
    const double before = s;
    for (const double secant : {g[knot == 0 ? 0 : knot - 1], g[std::min(knot, g.size() - 1)]})
      s = std::clamp(s, std::min(0.0, 3 * secant), std::max(0.0, 3 * secant));
    return s < before || s > before;  // of samples beyond measure there may be no number: nothing to limit, and an end
  };
  for (std::size_t i = 0; i < g.size();) {
    if (runs_one_way(slope[i], slope[i + 1], g[i])) {
      ++i;
      continue;
    }
    const bool left = limit(i), right = limit(i + 1);
    // A knot is limited once; the piece before shares it, and is looked at again.
    if (left && i > 0) {
      --i;
    } else if (!left && !right) {
      ++i;
    }
  }
}

}  // namespace

Spline::Spline(std::vector<double> x, std::vector<double> y, Kind kind) : kind_(kind), x_(std::move(x)), y_(std::move(y)) {
  check(x_, y_, kind_);
  const std::size_t intervals = x_.size() - 1;
  std::vector<double> h(intervals), g(intervals);
  for (std::size_t i = 0; i < intervals; ++i) {
    h[i] = x_[i + 1] - x_[i];
    g[i] = (y_[i + 1] - y_[i]) / h[i];
  }
  if (kind_ == Kind::linear || intervals == 1) {
    slope_ = g;
    square_.assign(intervals, 0.0);
    cube_.assign(intervals, 0.0);
  } else {
    std::vector<double> slope = kind_ == Kind::periodic ? periodic_slopes(h, g) : not_a_knot_slopes(h, g);
    if (kind_ == Kind::limited) limit_slopes(g, slope);
    for (double& one : slope)
      if (!std::isfinite(one)) one = 0;
    pieces_from_slopes(slope);
  }
  area_.assign(intervals + 1, 0.0);
  for (std::size_t i = 0; i < intervals; ++i) {
    const double t = h[i];
    area_[i + 1] = area_[i] + t * (y_[i] + t * (slope_[i] / 2 + t * (square_[i] / 3 + t * cube_[i] / 4)));
  }
}

/// The cubic of each interval from values and slopes at its two ends (Hermite).
void Spline::pieces_from_slopes(const std::vector<double>& slope) {
  const std::size_t intervals = x_.size() - 1;
  slope_.assign(slope.begin(), slope.end() - 1);
  square_.resize(intervals);
  cube_.resize(intervals);
  for (std::size_t i = 0; i < intervals; ++i) {
    const double h = x_[i + 1] - x_[i];
    const double g = (y_[i + 1] - y_[i]) / h;
    square_[i] = (3 * g - 2 * slope[i] - slope[i + 1]) / h;
    cube_[i] = (slope[i] + slope[i + 1] - 2 * g) / (h * h);
    // Of samples so close to each other that there is no number for what lies between them, the first one holds.
    if (!std::isfinite(square_[i]) || !std::isfinite(cube_[i])) slope_[i] = square_[i] = cube_[i] = 0;
  }
}

double Spline::wrapped(double x) const {
  const double period = x_.back() - x_.front();
  const double rest = x - period * std::floor((x - x_.front()) / period);
  return std::clamp(rest, x_.front(), x_.back());  // rounding can push it over an end
}

Spline::Place Spline::place(double x) const {
  if (kind_ == Kind::periodic) x = wrapped(x);
  // The first knot right of x among the inner ones; outside the range the outer pieces serve.
  const auto right = std::upper_bound(x_.begin() + 1, x_.end() - 1, x);
  const auto interval = static_cast<std::size_t>(right - x_.begin()) - 1;
  return {interval, x - x_[interval]};
}

double Spline::evaluate(double x) const {
  const auto [i, t] = place(x);
  return y_[i] + t * (slope_[i] + t * (square_[i] + t * cube_[i]));
}

double Spline::derivative(double x) const {
  const auto [i, t] = place(x);
  return slope_[i] + t * (2 * square_[i] + t * 3 * cube_[i]);
}

double Spline::integral_from_start(double x) const {
  const auto [i, t] = place(x);
  double area = area_[i] + t * (y_[i] + t * (slope_[i] / 2 + t * (square_[i] / 3 + t * cube_[i] / 4)));
  if (kind_ == Kind::periodic) area += area_.back() * std::floor((x - x_.front()) / (x_.back() - x_.front()));
  return area;
}

double Spline::integral(double a, double b) const { return integral_from_start(b) - integral_from_start(a); }

}  // namespace tofray::base
