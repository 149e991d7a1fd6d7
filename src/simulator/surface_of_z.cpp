// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
// Normals out of a picture of z. Over a plane 1/z is linear in the picture, so that a straight line through two pixels beside this one says
// what 1/z is here, if all three see the same plane: the side whose line misses least is the one to go by, and at an edge there is one.
#include "simulator/surface_of_z.h"

#include <algorithm>
#include <utility>

namespace tofray::simulator {

DepthPicture::DepthPicture(const RenderedPictures& of, int moment)
    : z_(of.z_m.data() +
         static_cast<std::size_t>(moment) * static_cast<std::size_t>(of.pinhole.width) * static_cast<std::size_t>(of.pinhole.height)),
      width_(of.pinhole.width),
      height_(of.pinhole.height),
      along_ray_(of.along_ray),
      limit_(of.background_m * 0.999),
      fx_(of.pinhole.fx_px),
      fy_(of.pinhole.fy_px),
      per_fx_(1 / fx_),
      per_fy_(1 / fy_),
      first_x_(of.pinhole.pixel_centre - of.pinhole.cx_px),
      first_y_(of.pinhole.pixel_centre - of.pinhole.cy_px) {}

DepthPicture::Side DepthPicture::side(int u, int v, int du, int dv, double here) const {
  const double next = z(u + du, v + dv);
  if (next == 0) return {};
  const double one = 1 / next, behind = z(u + 2 * du, v + 2 * dv);
  // Of a single neighbour the step itself is all that is known.
  return {(one - here) * (du + dv), std::abs(behind == 0 ? one - here : 2 * one - 1 / behind - here)};
}

/// @param f  pixels for a unit of x/z
bool DepthPicture::is_torn(const Side& side, double f, double here) {
  return std::abs(side.slope) * f > here && side.miss > 0.5 * std::abs(side.slope);
}

/// @return false where neither side goes on from this pixel
bool DepthPicture::slope(int u, int v, int du, int dv, double here, double& out) const {
  const double f = du != 0 ? fx_ : fy_;
  Side better = side(u, v, du, dv, here), other = side(u, v, -du, -dv, here);
  for (Side* const one : {&better, &other})
    if (is_torn(*one, f, here)) *one = {};
  if (other.miss < better.miss) std::swap(better, other);
  if (better.miss == std::numeric_limits<double>::infinity()) return false;
  // Both are the same surface, which may be curved: the mean is right to the next order.
  const bool alike = other.miss <= std::max(3 * better.miss, 1e-6 * here);
  out = f * (alike ? 0.5 * (better.slope + other.slope) : better.slope);
  return std::abs(out) * edge_on < here;
}

Direction DepthPicture::normal(int u, int v) const {
  const Direction r = ray(u, v);
  const double here = 1 / z(u, v), square = dot(r, r);
  double along_x = 0, along_y = 0;
  // What stands alone, as a wire one pixel wide, faces the camera.
  if (!slope(u, v, 1, 0, here, along_x)) along_x = here * r[0] / square;
  if (!slope(u, v, 0, 1, here, along_y)) along_y = here * r[1] / square;
  const Direction n{-along_x, -along_y, along_x * r[0] + along_y * r[1] - here};
  const double length = std::sqrt(dot(n, n));
  return {n[0] / length, n[1] / length, n[2] / length};
}

}  // namespace tofray::simulator
