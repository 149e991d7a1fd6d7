// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include "camera/frozen_lens.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "num/num.h"

namespace tofray::camera {

using num::single;

namespace {

ProjectionView projection_of(const Lens& lens, double limit) {
  const bool fisheye = lens.distortion == Lens::Distortion::fisheye;
  ProjectionView out{};
  out.fx = single(lens.fx_px), out.fy = single(lens.fy_px), out.limit = single(limit);
  out.k1 = single(lens.k1), out.k2 = single(lens.k2), out.k3 = single(lens.k3), out.k4 = single(lens.k4);
  out.fisheye = fisheye ? 1 : 0;
  if (fisheye) return out;
  out.p1 = single(lens.p1), out.p2 = single(lens.p2), out.k5 = single(lens.k5), out.k6 = single(lens.k6);
  return out;
}

}  // namespace

FrozenLens::FrozenLens(const Lens& lens, const Sensor& sensor, const Point2& offset_px, double area) {
  const std::size_t pixels = static_cast<std::size_t>(sensor.width) * static_cast<std::size_t>(sensor.height);
  ray_x_.assign(pixels, 0), ray_y_.assign(pixels, 0), inverse_length_.assign(pixels, 1), vignetting_.assign(pixels, 0);
  view_.width = sensor.width, view_.height = sensor.height;
  view_.pixel_area = single(area / (lens.fx_px * lens.fy_px));
  const double limit = growing_radius_squared(lens);
  view_.projection = projection_of(lens, limit);
  const Vignetting vignetting(lens);
  std::size_t i = 0;
  for (int v = 0; v < sensor.height; ++v) {
    for (int u = 0; u < sensor.width; ++u, ++i) {
      Point2 p{};
      if (!unproject(lens, limit, {u + offset_px.x, v + offset_px.y}, p)) continue;
      ray_x_[i] = single(p.x), ray_y_[i] = single(p.y);
      const double x = static_cast<double>(ray_x_[i]), y = static_cast<double>(ray_y_[i]);
      inverse_length_[i] = single(1 / std::sqrt(x * x + y * y + 1));
      // 0 says "outside the lens model", so that a dark corner of a vignetting table is not mistaken for one
      vignetting_[i] = std::max(single(vignetting.factor(p)), std::numeric_limits<float>::min());
    }
  }
  view_.ray_x = ray_x_.data(), view_.ray_y = ray_y_.data(), view_.vignetting = vignetting_.data();
  view_.inverse_length = inverse_length_.data();
  freeze_tiles();
}

void FrozenLens::freeze_tiles() {
  for (int top = 0; top < view_.height; top += flow::tile_height) {
    for (int left = 0; left < view_.width; left += flow::tile_width) {
      const float far = std::numeric_limits<float>::max();
      flow::Bounds b{far, -far, far, -far};
      for (int v = top; v < std::min(top + flow::tile_height, view_.height); ++v) {
        for (int u = left; u < std::min(left + flow::tile_width, view_.width); ++u) {
          const std::size_t i = static_cast<std::size_t>(v) * static_cast<std::size_t>(view_.width) + static_cast<std::size_t>(u);
          b = {std::min(b.x_min, ray_x_[i]), std::max(b.x_max, ray_x_[i]), std::min(b.y_min, ray_y_[i]), std::max(b.y_max, ray_y_[i])};
        }
      }
      tiles_.push_back(b);
    }
  }
  view_.tile = tiles_.data();
}

}  // namespace tofray::camera
