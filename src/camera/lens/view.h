// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstdint>

#include "flow/flow.h"

/// The lens, frozen for rendering: rays, samples within a pixel, and what scatters light over the sensor.
namespace tofray::camera {

/// The lens, for what moves to where no pixel looks: from directions to pixels.
struct ProjectionView {
  float fx, fy;  ///< [px]
  float k1, k2, p1, p2, k3;
  float limit;           ///< r² (undistorted) up to which the radial part grows
  float k4, k5, k6;      ///< 0 where the radial part is a polynomial
  std::int32_t fisheye;  ///< 1: k1 to k4 over the angle to the axis, p1 and p2 are 0
  bool operator==(const ProjectionView&) const = default;
};

/// Rays and lens by pixel.
struct LensView {
  std::int32_t width, height;
  float pixel_area;  ///< that a pixel sees of a plane 1 m before the camera, on the axis [m²]
  ProjectionView projection;
  const float *ray_x, *ray_y;   ///< [height][width] undistorted: d = (x, y, 1)
  const float* inverse_length;  ///< [height][width] 1/|d|
  const float* vignetting;      ///< [height][width] cos⁴α or a table's factor; 0 outside the lens model
  const flow::Bounds* tile;     ///< what each tile of pixels sees
  bool operator==(const LensView&) const = default;
};

/// Places within a pixel at which it sees the scene, one lens for each, and how much of the pixel's light each brings.
struct SubpixelView {
  std::int32_t count;    ///< 1 at least
  const LensView* lens;  ///< [count]; null: the pixel's middle alone sees the scene
  const float* share;    ///< [count] their sum is 1
  bool operator==(const SubpixelView&) const = default;
};

/// A part of the light that the lens scatters or neighbours collect, as a kernel over the sensor: K(dx, dy), zero beyond ±radius.
struct ScatterTerm {
  static constexpr int pad = 32;  ///< zeros before and behind each row of weights
  std::int32_t radius;
  const float* weights;  ///< [dy][dx] rows of pad + 2·radius + 1 + pad; of a separable kernel one: K = weights(dx)·column(dy)
  const float* column;   ///< [2·radius + 1]
};

/// Light that lens and filter scatter over the sensor, kept·δ + Σ_terms K, and after it charge that neighbours collect.
///                                                                                                        [theory: crosstalk, lens-scatter]
struct ScatterView {
  float kept;  ///< 1 − share of the lens's scatter
  std::int32_t terms;
  std::int32_t separable;  ///< all of them are, but for the last one if it is what neighbours collect, which always is
  std::int32_t shares;     ///< 1: the last one is; it takes what those before have brought
  const ScatterTerm* term;
  [[nodiscard]] TOFRAY_INLINE bool is_sharing(int item) const { return shares != 0 && item + 1 == terms; }
  [[nodiscard]] TOFRAY_INLINE bool has_rows(int item) const { return separable != 0 || is_sharing(item); }
  bool operator==(const ScatterView&) const = default;
};

}  // namespace tofray::camera
