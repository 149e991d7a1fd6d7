// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include "camera/lens/lens.h"

#include <algorithm>
#include <cmath>

#include "num/setup_math.h"

namespace tofray::camera {

using namespace lens_model;

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
