// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <optional>

#include "base/curve.h"
#include "tofray/camera.h"

namespace tofray::camera {

struct Point2 {
  double x, y;
};

/// Brown–Conrady: undistorted (x, y) = (X/Z, Y/Z) → distorted.
///     x' = x(1 + k1r² + k2r⁴ + k3r⁶) + 2p1xy + p2(r² + 2x²),  y' = y(…) + p1(r² + 2y²) + 2p2xy
Point2 distort(const Lens& lens, const Point2& undistorted);

/// Largest r² (undistorted) up to which the radial part grows with r, so that it has an inverse; 1e4 where it always does.
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
