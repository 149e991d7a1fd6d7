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

TOFRAY_INLINE Tile tile_at(const camera::LensView& lens, int index) {
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
TOFRAY_INLINE Pixels pack_at(const camera::LensView& lens, const Tile& tile, int q) {
  const int dx = (q % packs_per_row<F>)*num::lanes<F>, dy = q / packs_per_row<F>;
  const int left = tile.width - dx;
  const int count = dy >= tile.height || left <= 0 ? 0 : (left < num::lanes<F> ? left : num::lanes<F>);
  return {(tile.y + dy) * lens.width + tile.x + dx, count};
}

/// The rectangle of directions that a light sees of a tile, gathered lane by lane; a direction with z <= 0 leaves it `open`.
template <class F>
struct Rectangle {
  F x_min = F(3e38f), x_max = F(-3e38f), y_min = F(3e38f), y_max = F(-3e38f);
  bool open = false;

  TOFRAY_INLINE void add(F x, F y, F z, num::Mask<F> use) {
    const auto ahead = z > F(1e-6f);
    if (num::any(use & (!ahead))) open = true;
    const F per_z = F(1.0f) / num::select(ahead, z, F(1.0f));
    add(x * per_z, y * per_z, use);
  }
  TOFRAY_INLINE void add(F u, F v, num::Mask<F> use) {
    x_min = num::min(x_min, num::select(use, u, F(3e38f))), x_max = num::max(x_max, num::select(use, u, F(-3e38f)));
    y_min = num::min(y_min, num::select(use, v, F(3e38f))), y_max = num::max(y_max, num::select(use, v, F(-3e38f)));
  }
  TOFRAY_INLINE flow::Bounds bounds() const { return {num::lowest(x_min), num::highest(x_max), num::lowest(y_min), num::highest(y_max)}; }
};

/// What one light sees of the tile: the way from the light to a point is (d − w·L)/w for the ray d that hits it, and shadow rays end at a w
/// that is a little larger than the surface's (trace::a_little_before).
/// @return false where that is no rectangle ahead of the light
template <class F>
TOFRAY_INLINE bool seen_by_light(const Setup& s, const Tile& tile, const flow::Hit<F>* hits, int light, flow::Bounds& bounds) {
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

/// Points on the screen of parallel light (shape::screen_of): rectangles there are wider than what they hold by a share of its distance.
template <class F>
struct OnScreen {
  float u[3], v[3];

  TOFRAY_INLINE explicit OnScreen(const shape::Vec& toward_light) {
    const shape::Screen screen = shape::screen_of(toward_light);
    shape::copy(screen.u, u), shape::copy(screen.v, v);
  }
  TOFRAY_INLINE trace::OnScreenPack<F> at(F x, F y, F z, num::Mask<F> use) const {
    const F a = num::fma(x, F(u[0]), num::fma(y, F(u[1]), z * F(u[2]))), b = num::fma(x, F(v[0]), num::fma(y, F(v[1]), z * F(v[2])));
    const F room = F(num::single(shape::screen_room)) * (num::abs(x) + num::abs(y) + num::abs(z));
    return {a - room, a + room, b - room, b + room, use};
  }
  TOFRAY_INLINE void add(F x, F y, F z, num::Mask<F> use, Rectangle<F>& to) const {
    const trace::OnScreenPack<F> pack = at(x, y, z, use);
    to.add(pack.u_low, pack.v_low, use), to.add(pack.u_high, pack.v_high, use);
  }
};

/// Where the shadows of what the tile sees begin, on the sun's screen.
template <class F>
TOFRAY_INLINE flow::Bounds seen_by_sun(const Setup& s, int moment, const Tile& tile, const flow::Hit<F>* hits) {
  const OnScreen<F> screen(s.scene.toward_sun[moment]);
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
  TOFRAY_INLINE const flow::Bounds* of(int light) const { return none[light] ? nullptr : bounds + light; }
};

}  // namespace tofray::pipeline
