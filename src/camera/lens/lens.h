// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <optional>

#include "base/curve.h"
#include "camera/lens/distort.h"
#include "tofray/camera.h"

namespace tofray::camera {

/// Inverse by Newton's method, on the branch that starts at the axis.
/// @return false where the model has no inverse: the point lies beyond the largest radius up to which distortion grows
/// @param limit  growing_radius_squared(lens)
bool undistort(const Lens& lens, double limit, const Point2& distorted, Point2& undistorted);

/// Pixel coordinates → (X/Z, Y/Z): the inverse of project().
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
