// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include "camera/lens.h"

#include <algorithm>
#include <cmath>

#include "num/setup_math.h"

namespace tofray::camera {

namespace {

/// The radial part of the model: g(r²), and its derivative.
struct Radial {
  double factor;
  double slope;  ///< dg/d(r²), of Brown–Conrady: a fisheye is inverted without it
  bool grows;    ///< r·g does, with r
};

Radial brown_conrady(const Lens& l, double square) {
  const double above = 1 + square * (l.k1 + square * (l.k2 + square * l.k3));
  const double below = 1 + square * (l.k4 + square * (l.k5 + square * l.k6));
  const double above_slope = l.k1 + square * (2 * l.k2 + square * 3 * l.k3), below_slope = l.k4 + square * (2 * l.k5 + square * 3 * l.k6);
  // d(r·g)/dr·below²
  const double growth = (1 + square * (3 * l.k1 + square * (5 * l.k2 + square * 7 * l.k3))) * below - 2 * square * above * below_slope;
  return {above / below, (above_slope * below - above * below_slope) / (below * below), below > 0 && growth > 0};
}

/// Of a fisheye: the radius of the angle θ, and its derivative.
struct Radius {
  double at, growth;
};
Radius fisheye_radius(const Lens& l, double angle) {
  const double a = angle * angle;
  return {angle * (1 + a * (l.k1 + a * (l.k2 + a * (l.k3 + a * l.k4)))),
          1 + a * (3 * l.k1 + a * (5 * l.k2 + a * (7 * l.k3 + a * 9 * l.k4)))};
}

Radial fisheye(const Lens& l, double square) {
  // Near the axis g = 1 + (k1 − ⅓)r² + (⅕ − k1 + k2)r⁴ …, without a difference of two like numbers.
  if (square < 1e-6) {
    return {1 + square * (l.k1 - 1.0 / 3 + square * (0.2 - l.k1 + l.k2)), 0, true};
  }
  const double r = std::sqrt(square);
  const Radius radius = fisheye_radius(l, num::setup::atan(r));
  return {radius.at / r, 0, radius.growth > 0};
}

Radial radial(const Lens& lens, double square) {
  return lens.distortion == Lens::Distortion::fisheye ? fisheye(lens, square) : brown_conrady(lens, square);
}

}  // namespace

double growing_radius_squared(const Lens& lens) {
  constexpr double farthest = 1e4;
  double low = 0;
  for (double high = 1e-3; high < farthest; high *= 1.02) {
    if (!radial(lens, high).grows) {
      for (int i = 0; i < 60; ++i) {
        const double middle = 0.5 * (low + high);
        (radial(lens, middle).grows ? low : high) = middle;
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

/// Of Brown–Conrady. @param g  its radial part there
Jacobian jacobian(const Lens& l, const Radial& g, const Point2& p) {
  const double slope = 2 * g.slope, p1 = l.p1, p2 = l.p2;
  const double mixed = slope * p.x * p.y + 2 * p1 * p.x + 2 * p2 * p.y;
  return {g.factor + slope * p.x * p.x + 2 * p1 * p.y + 6 * p2 * p.x, mixed, mixed,
          g.factor + slope * p.y * p.y + 6 * p1 * p.y + 2 * p2 * p.x};
}

/// @param g   the radial part
/// @param r2  r² of p
Point2 bent(double g, double p1, double p2, double r2, const Point2& p) {
  return {p.x * g + 2 * p1 * p.x * p.y + p2 * (r2 + 2 * p.x * p.x), p.y * g + p1 * (r2 + 2 * p.y * p.y) + 2 * p2 * p.x * p.y};
}

/// A fisheye's radius grows with the angle alone, up to where the model ends: Newton's method, held between two angles.
bool undistort_fisheye(const Lens& lens, double limit, const Point2& target, Point2& out) {
  const double radius = std::sqrt(target.x * target.x + target.y * target.y);
  double low = 0, high = num::setup::atan(std::sqrt(limit));
  if (!(radius < fisheye_radius(lens, high).at)) return false;
  double angle = std::min(radius, high);
  for (int i = 0; i < 100; ++i) {
    const Radius there = fisheye_radius(lens, angle);
    (there.at < radius ? low : high) = angle;
    double next = angle - (there.at - radius) / there.growth;
    if (!(next > low && next < high)) next = 0.5 * (low + high);
    if (std::abs(next - angle) <= 1e-16 * angle) break;
    angle = next;
  }
  const double grow = radius > 0 ? num::setup::tan(angle) / radius : 1;
  out = {target.x * grow, target.y * grow};
  return out.x * out.x + out.y * out.y < limit;
}

}  // namespace

Point2 distort(const Lens& l, const Point2& p) {
  const double r2 = p.x * p.x + p.y * p.y;
  const bool fish = l.distortion == Lens::Distortion::fisheye;
  return bent(radial(l, r2).factor, fish ? 0 : l.p1, fish ? 0 : l.p2, r2, p);
}

bool undistort(const Lens& lens, double limit, const Point2& target, Point2& out) {
  if (lens.distortion == Lens::Distortion::fisheye) return undistort_fisheye(lens, limit, target, out);
  const double distorted = target.x * target.x + target.y * target.y;
  // Farther out than the outermost ray lands there is nothing to be searched: 60 steps, halved 50 times each, took minutes for 12
  // megapixels. The tangential part is at most (|p1| + 3 |p2|) r² in each direction; one per cent of room is left.
  const double edge = std::sqrt(limit) * radial(lens, limit).factor + 5 * (std::abs(lens.p1) + std::abs(lens.p2)) * limit;
  if (distorted > 1.0201 * edge * edge) return false;
  Point2 p = target;
  if (distorted > 0.9 * limit) {
    const double shrink = std::sqrt(0.9 * limit / distorted);
    p = {p.x * shrink, p.y * shrink};
  }
  Radial g{};
  Point2 at{};
  const auto look = [&] {
    const double r2 = p.x * p.x + p.y * p.y;
    g = brown_conrady(lens, r2), at = bent(g.factor, lens.p1, lens.p2, r2, p);
  };
  look();
  for (int i = 0; i < 60; ++i, look()) {
    const double ex = target.x - at.x, ey = target.y - at.y;
    if (std::abs(ex) + std::abs(ey) <= 4e-16 * (1 + std::abs(target.x) + std::abs(target.y))) break;
    const Jacobian j = jacobian(lens, g, p);
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
  const Jacobian j = jacobian(lens, g, p);
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
