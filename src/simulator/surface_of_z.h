// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>

#include "tofray/rendered.h"

/// What a picture of z says of surfaces.
namespace tofray::simulator {

using Direction = std::array<double, 3>;

inline double dot(const Direction& a, const Direction& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

/// Cosine to the line of sight below which a surface is seen too nearly edge-on for its slope to say anything: 87°.
inline constexpr double edge_on = 0.05;

/// One moment of a picture of z, by whole pixels.
class DepthPicture {
 public:
  DepthPicture(const RenderedPictures& of, int moment);

  /// x/z and y/z of a pixel's middle.
  [[nodiscard]] Direction ray(int u, int v) const { return {(u + first_x_) * per_fx_, (v + first_y_) * per_fy_, 1}; }
  /// z, or 0 where nothing is seen or there is no pixel.
  [[nodiscard]] double z(int u, int v) const {
    if (u < 0 || v < 0 || u >= width_ || v >= height_) return 0;
    const auto distance =
        static_cast<double>(z_[static_cast<std::size_t>(v) * static_cast<std::size_t>(width_) + static_cast<std::size_t>(u)]);
    if (!(distance > 0 && distance < limit_)) return 0;
    if (!along_ray_) return distance;
    const Direction r = ray(u, v);
    return distance / std::sqrt(dot(r, r));
  }
  /// The pixel in which a point of the picture lies. @return false: outside, or no number
  [[nodiscard]] bool nearest(double x, double y, int& u, int& v) const {
    const double column = std::floor(x * fx_ - first_x_ + 0.5), row = std::floor(y * fy_ - first_y_ + 0.5);
    if (!(column >= 0 && row >= 0 && column < width_ && row < height_)) return false;
    u = static_cast<int>(column), v = static_cast<int>(row);
    return true;
  }
  /// Of the plane that z and its neighbours say, turned to the camera. The pixel sees something.             [theory: normals-of-z]
  [[nodiscard]] Direction normal(int u, int v) const;

 private:
  struct Side {
    double slope = 0;                                       ///< of 1/z by a pixel
    double miss = std::numeric_limits<double>::infinity();  ///< by how much a plane of that slope misses this pixel
  };
  [[nodiscard]] Side side(int u, int v, int du, int dv, double here) const;
  /// Whether another surface lies on that side: a steep step that a line through the two pixels there does not lead to.
  static bool is_torn(const Side& side, double f, double here);
  [[nodiscard]] bool slope(int u, int v, int du, int dv, double here, double& out) const;

  const float* z_;
  int width_, height_;
  bool along_ray_;
  double limit_, fx_, fy_, per_fx_, per_fy_, first_x_, first_y_;
};

}  // namespace tofray::simulator
