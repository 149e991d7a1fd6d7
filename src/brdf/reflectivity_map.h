// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "flow/flow.h"

namespace tofray::brdf {

constexpr int most_map_levels = 16;

/// A picture that scales how much a surface's matt part sends back, and the same picture at half, a quarter … of its size, down to one
/// texel: what a pixel sees of it is a mean, which the level whose texels are as large as the pixel has ready.
struct MapView {
  const float* texels;                  ///< all levels, row-major
  std::int32_t start[most_map_levels];  ///< [level] of its first texel
  std::int32_t width[most_map_levels], height[most_map_levels];
  std::int32_t levels;
  std::int32_t texel_count;  ///< of all levels
  std::int32_t wrap[2];      ///< of u and v: the public enum's number
  bool operator==(const MapView&) const = default;
};

/// Into 0…1, as the picture goes on beyond its edges.
template <class F>
TOFRAY_INLINE F wrapped(F a, std::int32_t wrap) {
  if (wrap == 2) return num::min(num::max(a, F(0.0f)), F(1.0f));
  if (wrap == 0) return a - num::floor(a);
  const F pair = a - F(2.0f) * num::floor(a * F(0.5f));
  return num::min(pair, F(2.0f) - pair);
}

/// The texel beside an edge: the one on the other side where the picture repeats, else the edge's own.
template <class F>
TOFRAY_INLINE num::Int<F> texel_at(num::Int<F> i, num::Int<F> size, std::int32_t wrap) {
  using Int = num::Int<F>;
  const Int last = size - Int(1);
  i = num::select(i < Int(0), wrap == 0 ? last : Int(0), i);
  return num::select(i > last, wrap == 0 ? Int(0) : last, i);
}

/// Bilinear within one level of each lane.
template <class F>
TOFRAY_INLINE F in_level(const MapView& map, num::Int<F> level, F u, F v) {
  using Int = num::Int<F>;
  const Int width = num::gather(map.width, level), height = num::gather(map.height, level), start = num::gather(map.start, level);
  const F x = num::fms(u, num::to_float(width), F(0.5f)), y = num::fms(v, num::to_float(height), F(0.5f));
  const F x_floor = num::floor(x), y_floor = num::floor(y), right = x - x_floor, low = y - y_floor;
  const Int column = num::to_int(x_floor), row = num::to_int(y_floor);
  const Int x0 = texel_at<F>(column, width, map.wrap[0]), x1 = texel_at<F>(column + Int(1), width, map.wrap[0]);
  const Int y0 = start + width * texel_at<F>(row, height, map.wrap[1]), y1 = start + width * texel_at<F>(row + Int(1), height, map.wrap[1]);
  const F a = num::gather(map.texels, y0 + x0), b = num::gather(map.texels, y0 + x1);
  const F c = num::gather(map.texels, y1 + x0), d = num::gather(map.texels, y1 + x1);
  const F above = num::fma(b - a, right, a), below = num::fma(d - c, right, c);
  return num::fma(below - above, low, above);
}

/// What the picture says at (u, v), between the two levels whose texels are next to the pixel's size.  [theory: pixel-footprint]
/// @param seen  area that a pixel sees, in units of the picture (1: all of it)
template <class F>
TOFRAY_INLINE F map_value(const MapView& map, F u, F v, F seen) {
  using Int = num::Int<F>;
  const F texels = seen * F(static_cast<float>(map.width[0]) * static_cast<float>(map.height[0]));
  const F level =
      num::min(F(0.721347520f) * num::log(num::max(num::min(texels, F(1e30f)), F(1.0f))), F(static_cast<float>(map.levels - 1)));
  const F fine = num::floor(level);
  const Int first = num::to_int(fine), last(map.levels - 1);
  u = wrapped(u, map.wrap[0]), v = wrapped(v, map.wrap[1]);
  const F near = in_level(map, first, u, v);
  const Int next = num::select(first < last, first + Int(1), last);
  return num::fma(in_level(map, next, u, v) - near, level - fine, near);
}

}  // namespace tofray::brdf
