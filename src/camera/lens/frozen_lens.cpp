// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include "camera/lens/frozen_lens.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/parallel.h"
#include "base/shared.h"
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

FrozenLens::FrozenLens(const LensKey& of, int threads) {
  const Lens& lens = of.lens;
  const std::size_t pixels = static_cast<std::size_t>(of.width) * static_cast<std::size_t>(of.height);
  ray_x_.assign(pixels, 0), ray_y_.assign(pixels, 0), inverse_length_.assign(pixels, 1), vignetting_.assign(pixels, 0);
  view_.width = of.width, view_.height = of.height;
  view_.pixel_area = single(of.area / (lens.fx_px * lens.fy_px));
  const double limit = growing_radius_squared(lens);
  view_.projection = projection_of(lens, limit);
  const Vignetting vignetting(lens);
  const auto find_row = [&](int v) {
    std::size_t i = static_cast<std::size_t>(v) * static_cast<std::size_t>(of.width);
    for (int u = 0; u < of.width; ++u, ++i) {
      Point2 p{};
      if (!unproject(lens, limit, {u + of.offset_px.x, v + of.offset_px.y}, p)) continue;
      ray_x_[i] = single(p.x), ray_y_[i] = single(p.y);
      const double x = static_cast<double>(ray_x_[i]), y = static_cast<double>(ray_y_[i]);
      inverse_length_[i] = single(1 / std::sqrt(x * x + y * y + 1));
      // 0 says "outside the lens model", so that a dark corner of a vignetting table is not mistaken for one
      vignetting_[i] = std::max(single(vignetting.factor(p)), std::numeric_limits<float>::min());
    }
  };
  constexpr std::size_t few = 10'000;  // whose rays take as long as threads to begin
  base::in_parallel(of.height, pixels < few ? 1 : threads, find_row);
  view_.ray_x = ray_x_.data(), view_.ray_y = ray_y_.data(), view_.vignetting = vignetting_.data();
  view_.inverse_length = inverse_length_.data();
  freeze_tiles();
}

std::shared_ptr<const FrozenLens> FrozenLens::shared(const LensKey& of, int threads) {
  LensKey key = of;
  key.lens.f_number = key.lens.transmission = 1, key.lens.scatter = {};
  return base::shared<LensKey, FrozenLens>().get(
      key, [&] { return FrozenLens(key, threads); }, [](const FrozenLens& made) { return made.bytes(); });
}

std::size_t FrozenLens::bytes() const { return 4 * ray_x_.size() * sizeof(float) + tiles_.size() * sizeof(flow::Bounds); }

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
