// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <optional>

#include "base/curve.h"
#include "tofray/camera.h"

namespace tofray::camera {

struct Point2 {
  double x, y;
  bool operator==(const Point2&) const = default;
};

/// Undistorted (x, y) = (X/Z, Y/Z) → distorted, r² = x² + y².                                          [theory: eq. 1.7, 1.8]
///     Brown–Conrady:  x' = x·g + 2p1xy + p2(r² + 2x²),  y' = y·g + p1(r² + 2y²) + 2p2xy,
///                     g = (1 + k1r² + k2r⁴ + k3r⁶)/(1 + k4r² + k5r⁴ + k6r⁶)
///     fisheye:        x' = x·g,  y' = y·g,  g = θ(1 + k1θ² + k2θ⁴ + k3θ⁶ + k4θ⁸)/r,  tan θ = r
Point2 distort(const Lens& lens, const Point2& undistorted);

/// Largest r² (undistorted) up to which r·g grows with r, so that it has an inverse; 1e4 (89.4° off the axis) where it always does.
double growing_radius_squared(const Lens& lens);

/// Inverse by Newton's method, on the branch that starts at the axis.
/// @return false where the model has no inverse: the point lies beyond the largest radius up to which distortion grows
/// @param limit  growing_radius_squared(lens)
bool undistort(const Lens& lens, double limit, const Point2& distorted, Point2& undistorted);

/// (x, y) = (X/Z, Y/Z) → pixel coordinates; pixel (0,0)'s centre is (0, 0).
Point2 project(const Lens& lens, const Point2& undistorted);
bool unproject(const Lens& lens, double limit, const Point2& pixel, Point2& undistorted);

/// Factor of the image irradiance at angle α to the axis, tan α = √(x² + y²): cos⁴α, 1, or a table's.
class Vignetting {
 public:
  /// @throws Error (bad_input) where the table is none, as base::ClampedCurve says
  explicit Vignetting(const Lens& lens);
  [[nodiscard]] double factor(const Point2& undistorted) const;

 private:
  Lens::Vignetting kind_;
  std::optional<base::ClampedCurve> table_;
};

}  // namespace tofray::camera
