// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include "camera/lens.h"

#include <algorithm>
#include <cmath>

#include "num/setup_math.h"

namespace tofray::camera {

namespace {

/// d/dr of r(1 + k1r² + k2r⁴ + k3r⁶)
double radial_slope(const Lens& lens, double square) { return 1 + square * (3 * lens.k1 + square * (5 * lens.k2 + square * 7 * lens.k3)); }

}  // namespace

double growing_radius_squared(const Lens& lens) {
  constexpr double farthest = 1e4;
  double low = 0;
  for (double high = 1e-3; high < farthest; high *= 1.02) {
    if (radial_slope(lens, high) <= 0) {
      for (int i = 0; i < 60; ++i) {
        const double middle = 0.5 * (low + high);
        (radial_slope(lens, middle) > 0 ? low : high) = middle;
      }
      return low;
    }
    low = high;
  }
  return farthest;
}

namespace {

struct Jacobian {
  double xx, xy, yx, yy;
};

Jacobian jacobian(const Lens& l, const Point2& p) {
  const double r2 = p.x * p.x + p.y * p.y;
  const double radial = 1 + r2 * (l.k1 + r2 * (l.k2 + r2 * l.k3));
  const double slope = 2 * (l.k1 + r2 * (2 * l.k2 + r2 * 3 * l.k3));
  const double mixed = slope * p.x * p.y + 2 * l.p1 * p.x + 2 * l.p2 * p.y;
  return {radial + slope * p.x * p.x + 2 * l.p1 * p.y + 6 * l.p2 * p.x, mixed, mixed,
          radial + slope * p.y * p.y + 6 * l.p1 * p.y + 2 * l.p2 * p.x};
}

}  // namespace

Point2 distort(const Lens& l, const Point2& p) {
  const double r2 = p.x * p.x + p.y * p.y;
  const double radial = 1 + r2 * (l.k1 + r2 * (l.k2 + r2 * l.k3));
  return {p.x * radial + 2 * l.p1 * p.x * p.y + l.p2 * (r2 + 2 * p.x * p.x),
          p.y * radial + l.p1 * (r2 + 2 * p.y * p.y) + 2 * l.p2 * p.x * p.y};
}

bool undistort(const Lens& lens, double limit, const Point2& target, Point2& out) {
  Point2 p = target;
  const double start = p.x * p.x + p.y * p.y;
  // Farther out than the outermost ray lands there is nothing to be searched: 60 steps, halved 50 times each, took minutes for 12
  // megapixels. The tangential part is at most (|p1| + 3 |p2|) r² in each direction; one per cent of room is left.
  const double edge = std::sqrt(limit) * (1 + limit * (lens.k1 + limit * (lens.k2 + limit * lens.k3))) +
                      5 * (std::abs(lens.p1) + std::abs(lens.p2)) * limit;
  if (start > 1.0201 * edge * edge) return false;
  if (start > 0.9 * limit) {
    const double shrink = std::sqrt(0.9 * limit / start);
    p = {p.x * shrink, p.y * shrink};
  }
  for (int i = 0; i < 60; ++i) {
    const Point2 at = distort(lens, p);
    const double ex = target.x - at.x, ey = target.y - at.y;
    if (std::abs(ex) + std::abs(ey) <= 4e-16 * (1 + std::abs(target.x) + std::abs(target.y))) break;
    const Jacobian j = jacobian(lens, p);
    const double det = j.xx * j.yy - j.xy * j.yx;
    double dx = (j.yy * ex - j.xy * ey) / det, dy = (j.xx * ey - j.yx * ex) / det;
    // A step never leaves the branch: it is shortened to stay within the largest radius.
    for (int halve = 0; halve < 50; ++halve) {
      const double x = p.x + dx, y = p.y + dy;
      if (x * x + y * y < limit) break;
      dx *= 0.5, dy *= 0.5;
    }
    p = {p.x + dx, p.y + dy};
  }
  const Point2 at = distort(lens, p);
  const Jacobian j = jacobian(lens, p);
  out = p;
  const double error = std::abs(target.x - at.x) + std::abs(target.y - at.y);
  return error < 1e-12 && p.x * p.x + p.y * p.y < limit && j.xx * j.yy - j.xy * j.yx > 0;
}

Point2 project(const Lens& lens, const Point2& undistorted) {
  const Point2 d = distort(lens, undistorted);
  return {lens.fx_px * d.x + lens.cx_px, lens.fy_px * d.y + lens.cy_px};
}

bool unproject(const Lens& lens, double limit, const Point2& pixel, Point2& undistorted) {
  return undistort(lens, limit, {(pixel.x - lens.cx_px) / lens.fx_px, (pixel.y - lens.cy_px) / lens.fy_px}, undistorted);
}

Vignetting::Vignetting(const Lens& lens) : kind_(lens.vignetting) {
  if (kind_ == Lens::Vignetting::table) table_.emplace(lens.vignetting_table, "the lens' vignetting");
}

double Vignetting::factor(const Point2& p) const {
  const double square = 1 + p.x * p.x + p.y * p.y;
  switch (kind_) {
    case Lens::Vignetting::off: return 1;
    case Lens::Vignetting::cos4: return 1 / (square * square);
    case Lens::Vignetting::table: break;
  }
  return table_->evaluate(num::setup::atan(std::sqrt(p.x * p.x + p.y * p.y)));
}

}  // namespace tofray::camera
