// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include <cmath>

#include "camera/lens/distort.h"
#include "messages/parts.h"

namespace tofray::messages {

Lens pinhole_of(const Lens& lens) {
  Lens out = lens;
  out.distortion = Lens::Distortion::brown_conrady;
  out.k1 = out.k2 = out.p1 = out.p2 = out.k3 = out.k4 = out.k5 = out.k6 = 0;
  return out;
}

std::vector<std::int32_t> nearest_pixels(const Lens& lens, Size size) {
  const double limit = camera::growing_radius_squared(lens);
  std::vector<std::int32_t> out;
  out.reserve(size.pixels());
  for (int v = 0; v < size.height; ++v)
    for (int u = 0; u < size.width; ++u) {
      const camera::Point2 ray{(u - lens.cx_px) / lens.fx_px, (v - lens.cy_px) / lens.fy_px};
      const camera::Point2 at = camera::project(lens, ray);
      const double column = std::floor(at.x + 0.5), row = std::floor(at.y + 0.5);
      const bool seen = ray.x * ray.x + ray.y * ray.y < limit && column >= 0 && column < size.width && row >= 0 && row < size.height;
      out.push_back(seen ? static_cast<std::int32_t>(row) * size.width + static_cast<std::int32_t>(column) : -1);
    }
  return out;
}

}  // namespace tofray::messages
