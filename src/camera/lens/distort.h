// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cmath>

#include "num/setup_math.h"
#include "tofray/camera.h"

/// A lens' distortion and how far it has an inverse: of headers alone, for whoever is in another library than this folder.
namespace tofray::camera {

struct Point2 {
  double x, y;
  bool operator==(const Point2&) const = default;
};

namespace lens_model {

/// The radial part of the model: g(r²), and its derivative.
struct Radial {
  double factor;
  double slope;  ///< dg/d(r²), of Brown–Conrady: a fisheye is inverted without it
  bool grows;    ///< r·g does, with r
};

inline Radial brown_conrady(const Lens& l, double square) {
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
inline Radius fisheye_radius(const Lens& l, double angle) {
  const double a = angle * angle;
  return {angle * (1 + a * (l.k1 + a * (l.k2 + a * (l.k3 + a * l.k4)))),
          1 + a * (3 * l.k1 + a * (5 * l.k2 + a * (7 * l.k3 + a * 9 * l.k4)))};
}

inline Radial fisheye(const Lens& l, double square) {
  // Near the axis g = 1 + (k1 − ⅓)r² + (⅕ − k1 + k2)r⁴ …, without a difference of two like numbers.
  if (square < 1e-6) {
    return {1 + square * (l.k1 - 1.0 / 3 + square * (0.2 - l.k1 + l.k2)), 0, true};
  }
  const double r = std::sqrt(square);
  const Radius radius = fisheye_radius(l, num::setup::atan(r));
  return {radius.at / r, 0, radius.growth > 0};
}

inline Radial radial(const Lens& lens, double square) {
  return lens.distortion == Lens::Distortion::fisheye ? fisheye(lens, square) : brown_conrady(lens, square);
}

/// @param g   the radial part
/// @param r2  r² of p
inline Point2 bent(double g, double p1, double p2, double r2, const Point2& p) {
  return {p.x * g + 2 * p1 * p.x * p.y + p2 * (r2 + 2 * p.x * p.x), p.y * g + p1 * (r2 + 2 * p.y * p.y) + 2 * p2 * p.x * p.y};
}

}  // namespace lens_model

/// Largest r² (undistorted) up to which r·g grows with r, so that it has an inverse; 1e4 (89.4° off the axis) where it always does.
inline double growing_radius_squared(const Lens& lens) {
  constexpr double farthest = 1e4;
  double low = 0;
  for (double high = 1e-3; high < farthest; high *= 1.02) {
    if (!lens_model::radial(lens, high).grows) {
      for (int i = 0; i < 60; ++i) {
        const double middle = 0.5 * (low + high);
        (lens_model::radial(lens, middle).grows ? low : high) = middle;
      }
      return low;
    }
    low = high;
  }
  return farthest;
}

/// Undistorted (x, y) = (X/Z, Y/Z) → distorted, r² = x² + y².                                [theory: brown-conrady, fisheye]
///     Brown–Conrady:  x' = x·g + 2p1xy + p2(r² + 2x²),  y' = y·g + p1(r² + 2y²) + 2p2xy,
///                     g = (1 + k1r² + k2r⁴ + k3r⁶)/(1 + k4r² + k5r⁴ + k6r⁶)
///     fisheye:        x' = x·g,  y' = y·g,  g = θ(1 + k1θ² + k2θ⁴ + k3θ⁶ + k4θ⁸)/r,  tan θ = r
inline Point2 distort(const Lens& l, const Point2& p) {
  const double r2 = p.x * p.x + p.y * p.y;
  const bool fish = l.distortion == Lens::Distortion::fisheye;
  return lens_model::bent(lens_model::radial(l, r2).factor, fish ? 0 : l.p1, fish ? 0 : l.p2, r2, p);
}

/// (x, y) = (X/Z, Y/Z) → pixel coordinates; pixel (0,0)'s centre is (0, 0).
inline Point2 project(const Lens& lens, const Point2& undistorted) {
  const Point2 d = distort(lens, undistorted);
  return {lens.fx_px * d.x + lens.cx_px, lens.fy_px * d.y + lens.cy_px};
}

}  // namespace tofray::camera
