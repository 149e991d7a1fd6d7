// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "pipeline/tile_meshes.h"

/// Tiles of pixels, and the rectangles in which the camera, the lights and the sun see them.
namespace tofray::pipeline {

/// The pixels of a tile, cut into packs of at most lanes<F> in a row.
struct Tile {
  int x, y, width, height;
};

TOFRAY_FN Tile tile_at(const camera::LensView& lens, int index) {
  const int across = tiles_across(lens);
  const int x = (index % across) * tile_width, y = (index / across) * tile_height;
  return {x, y, lens.width - x < tile_width ? lens.width - x : tile_width, lens.height - y < tile_height ? lens.height - y : tile_height};
}

template <class F>
constexpr int packs_per_row = tile_width / num::lanes<F>;
template <class F>
constexpr int max_packs = packs_per_row<F>* tile_height;

/// Pack q of the tile; count 0 where it lies outside the image.
template <class F>
TOFRAY_FN Pixels pack_at(const camera::LensView& lens, const Tile& tile, int q) {
  const int dx = (q % packs_per_row<F>)*num::lanes<F>, dy = q / packs_per_row<F>;
  const int left = tile.width - dx;
  const int count = dy >= tile.height || left <= 0 ? 0 : (left < num::lanes<F> ? left : num::lanes<F>);
  return {(tile.y + dy) * lens.width + tile.x + dx, count};
}

/// What one light sees of the tile: the way from the light to a point is (d − w·L)/w for the ray d that hits it, and shadow rays end at a w
/// that is a little larger than the surface's (trace::a_little_before).
/// @return false where that is no rectangle ahead of the light
template <class F>
TOFRAY_FN bool seen_by_light(const Setup& s, const Tile& tile, const flow::Hit<F>* hits, int light, flow::Bounds& bounds) {
  const float* at = s.lights[light].position;
  Rectangle<F> seen;
  for (int q = 0; q < max_packs<F>; ++q) {
    const Pixels p = pack_at<F>(s.lens, tile, q);
    if (p.count == 0) continue;
    const flow::Ray<F> ray = camera::ray<F>(s.lens, p);
    const F share = num::min(num::fma(F(s.scene.roughness) * hits[q].w, ray.inverse_length, F(2 * trace::way_back)), F(0.5f));
    F w = num::fma(hits[q].w, share, hits[q].w);
    if (num::any(share > F(1e-4f))) w = hits[q].w / (F(1.0f) - share);
    seen.add(num::fnma(w, F(at[0]), ray.x), num::fnma(w, F(at[1]), ray.y), num::fnma(w, F(at[2]), ray.z), in_use<F>(p) & (w > F(0.0f)));
  }
  bounds = seen.bounds();
  return !seen.open;
}

/// Where the shadows of what the tile sees begin, on the sun's screen.
template <class F>
TOFRAY_FN flow::Bounds seen_by_sun(const Setup& s, int moment, const Tile& tile, const flow::Hit<F>* hits) {
  const OnScreen screen(s.scene.toward_sun[moment]);
  Rectangle<F> seen;
  for (int q = 0; q < max_packs<F>; ++q) {
    const Pixels p = pack_at<F>(s.lens, tile, q);
    if (p.count == 0) continue;
    flow::Place<F> at{};
    const flow::Ray<F> ray = camera::ray<F>(s.lens, p);
    const auto found = trace::place(ray, hits[q], at);
    at = trace::a_little_before(s.scene, at, ray);
    screen.add(at.x, at.y, at.z, in_use<F>(p) & found, seen);
  }
  return seen.bounds();
}

/// The rectangles in which each light sees the tile; `none` where it is no rectangle ahead of the light, or culling is off.
struct SeenByLights {
  flow::Bounds bounds[flow::max_lights];
  bool none[flow::max_lights];
  flow::Bounds sun;
  TOFRAY_FN const flow::Bounds* of(int light) const { return none[light] ? nullptr : bounds + light; }
};

}  // namespace tofray::pipeline
