// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "pipeline/one_pixel.h"

/// One tile of pixels: what it can meet, then its pixels pack by pack.
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
constexpr int max_packs = packs_per_row<F> * tile_height;

/// Pack q of the tile; count 0 where it lies outside the image.
template <class F>
TOFRAY_FN Pixels pack_at(const camera::LensView& lens, const Tile& tile, int q) {
  const int dx = (q % packs_per_row<F>) * num::lanes<F>, dy = q / packs_per_row<F>;
  const int left = tile.width - dx;
  const int count = dy >= tile.height || left <= 0 ? 0 : (left < num::lanes<F> ? left : num::lanes<F>);
  return {(tile.y + dy) * lens.width + tile.x + dx, count};
}

/// The rectangle of directions that a light sees of a tile, gathered lane by lane; a direction with z <= 0 leaves it `open`.
template <class F>
struct Rectangle {
  F x_min = F(3e38f), x_max = F(-3e38f), y_min = F(3e38f), y_max = F(-3e38f);
  bool open = false;

  TOFRAY_FN void add(F x, F y, F z, num::Mask<F> use) {
    const auto ahead = z > F(1e-6f);
    if (num::any(use & (!ahead))) open = true;
    const F per_z = F(1.0f) / num::select(ahead, z, F(1.0f));
    const F u = x * per_z, v = y * per_z;
    x_min = num::min(x_min, num::select(use, u, F(3e38f))), x_max = num::max(x_max, num::select(use, u, F(-3e38f)));
    y_min = num::min(y_min, num::select(use, v, F(3e38f))), y_max = num::max(y_max, num::select(use, v, F(-3e38f)));
  }
  TOFRAY_FN flow::Bounds bounds() const { return {num::lowest(x_min), num::highest(x_max), num::lowest(y_min), num::highest(y_max)}; }
};

template <class F>
TOFRAY_FN num::Mask<F> in_use(const Pixels& p) { return num::lane_index<F>() < num::Int<F>(p.count); }

/// What one light sees of the tile: the way from the light to a surface point is (d − w·L)/w for the ray d that hits it.
/// @return false where that is no rectangle ahead of the light
template <class F>
TOFRAY_FN bool seen_by_light(const Setup& s, const Tile& tile, const flow::Hit<F>* hits, int light, flow::Bounds& bounds) {
  const float* at = s.lights[light].position;
  Rectangle<F> seen;
  for (int q = 0; q < max_packs<F>; ++q) {
    const Pixels p = pack_at<F>(s.lens, tile, q);
    if (p.count == 0) continue;
    const flow::Ray<F> ray = camera::ray<F>(s.lens, p);
    const F w = hits[q].w;
    seen.add(num::fnma(w, F(at[0]), ray.x), num::fnma(w, F(at[1]), ray.y), num::fnma(w, F(at[2]), ray.z), in_use<F>(p) & (w > F(0.0f)));
  }
  bounds = seen.bounds();
  return !seen.open;
}

/// The rectangles in which each light sees the tile; `none` where it is no rectangle ahead of the light, or culling is off.
struct SeenByLights {
  flow::Bounds bounds[flow::max_lights];
  bool none[flow::max_lights];
  TOFRAY_FN const flow::Bounds* of(int light) const { return none[light] ? nullptr : bounds + light; }
};

/// … and what can stand between each light and the tile, of what stands still.
template <class F>
TOFRAY_FN void cull_lights(const Setup& s, const Tile& tile, const flow::Hit<F>* hits, SeenByLights& seen, Near& near) {
  for (int l = 0; l < s.scene.lights; ++l) {
    seen.none[l] = s.culling == 0 || !seen_by_light(s, tile, hits, l, seen.bounds[l]);
    trace::cull(s.scene.light_still[l], seen.of(l), near.light_still[l]);
  }
}

/// Scratch memory of one worker.
template <class F>
struct Scratch {
  Near near;
  SeenByLights seen;
  flow::Hit<F> still[max_packs<F>];
  flow::Hit<F> hits[max_packs<F>];
  bool lit[max_packs<F>];                                      ///< the light of what stands still is known
  std::int32_t entry[max_packs<F>][flow::max_raw_frames];      ///< where the light of each pack's raw frames is
};

/// What one raw frame sees: where nothing that moves is in view, the surfaces that stand still.
template <class F>
TOFRAY_FN const flow::Hit<F>* hits_at(const Setup& s, const Tile& tile, const scene::Bounds* view, int slot, Scratch<F>& scratch) {
  trace::cull(s.scene.camera_moving[slot], view, scratch.near.camera_moving);
  if (scratch.near.camera_moving.empty()) return scratch.still;
  for (int q = 0; q < max_packs<F>; ++q) {
    const Pixels p = pack_at<F>(s.lens, tile, q);
    if (p.count > 0) scratch.hits[q] = see_moving(s, scratch.near, slot, camera::ray<F>(s.lens, p), scratch.still[q]);
  }
  return scratch.hits;
}

/// Whether something that moves keeps a light off any of the pixels.
template <class F>
TOFRAY_FN bool in_moving_shadow(const Setup& s, const Near& near, int slot, const flow::Ray<F>& ray, const flow::Hit<F>& hit) {
  if (s.last_stage < stage_power) return false;
  bool possible = s.power.ambient_kind == 2;
  for (int l = 0; l < s.scene.lights; ++l) possible = possible || !near.light_moving[l].empty();
  if (!possible) return false;
  const flow::Surface<F> surface = trace::surface(s.scene, ray, hit);
  num::Mask<F> dark = F(1.0f) < F(0.0f);
  for (int l = 0; l < s.scene.lights; ++l) {
    if (near.light_moving[l].empty()) continue;
    const flow::Ray<F> from_light = power::light_ray(s.lights[l], surface);
    dark = dark | trace::blocked(s.scene.light_moving[slot * s.scene.lights + l], near.light_moving[l], from_light, surface.object);
  }
  if (s.power.ambient_kind == 2) dark = dark | trace::blocked_parallel(s.scene.sun_moving[slot], s.power.sun_direction, surface);
  return num::any(dark & surface.found);
}

/// Light of one raw frame. A pack that nothing moving touches shares entry 0 with all its raw frames; the others have entry k + 1.
template <class F>
TOFRAY_FN void light_up_tile(const Setup& s, const Job& job, const Tile& tile, const flow::Hit<F>* hits, int k, Scratch<F>& scratch,
                             flow::Light<F>* light) {
  const bool truth = k == s.truth_slot;
  for (int q = 0; q < max_packs<F>; ++q) {
    const Pixels p = pack_at<F>(s.lens, tile, q);
    if (p.count == 0) continue;
    const flow::Ray<F> ray = camera::ray<F>(s.lens, p);
    const bool same = hits == scratch.still || !num::any(hits[q].facet != scratch.still[q].facet);
    const bool still = same && !in_moving_shadow(s, scratch.near, k, ray, hits[q]);
    scratch.entry[q][k] = still ? 0 : (k + 1) * max_packs<F>;
    if (still && scratch.lit[q] && !truth) continue;
    Lighting<F> lighting;
    light_surface(s, job, scratch.near, k, !still, truth, p, ray, hits[q], camera::vignetting<F>(s.lens, p), lighting);
    if (s.last_stage >= stage_power) light[scratch.entry[q][k] + q] = lighting.light;
    scratch.lit[q] = scratch.lit[q] || still;
  }
}

/// A tile of a scene in which something moves: each raw frame sees it at its own time; where nothing of it comes near, once is enough.
template <class F>
TOFRAY_FN void moving_tile(const Setup& s, const Job& job, const Tile& tile, const scene::Bounds* view, Scratch<F>& scratch, flow::Light<F>* light) {
  bool culled_for_still = false;
  for (int q = 0; q < max_packs<F>; ++q) scratch.lit[q] = false;
  for (int k = 0; k < s.sensor.raw_frames; ++k) {
    const flow::Hit<F>* hits = hits_at(s, tile, view, k, scratch);
    if (s.last_stage >= stage_power && !(culled_for_still && hits == scratch.still)) {
      cull_lights(s, tile, hits, scratch.seen, scratch.near);
      culled_for_still = hits == scratch.still;
    }
    for (int l = 0; l < s.scene.lights && s.last_stage >= stage_power; ++l) {
      trace::cull(s.scene.light_moving[k * s.scene.lights + l], scratch.seen.of(l), scratch.near.light_moving[l]);
    }
    if (s.last_stage >= stage_power || k == s.truth_slot) light_up_tile(s, job, tile, hits, k, scratch, light);
  }
  if (s.last_stage < stage_raw) return;
  for (int q = 0; q < max_packs<F>; ++q) {
    const Pixels p = pack_at<F>(s.lens, tile, q);
    if (p.count == 0) continue;
    measure(s, job, p, camera::ray<F>(s.lens, p), camera::vignetting<F>(s.lens, p), light + q, scratch.entry[q]);
  }
}

/// From rays to depth for one tile.
/// @param light  [raw frames + 1][max_packs], needed where something moves
template <class F>
TOFRAY_FN void one_tile(const Setup& s, const Job& job, int index, Scratch<F>& scratch, flow::Light<F>* light) {
  const Tile tile = tile_at(s.lens, index);
  const flow::Bounds* view = s.culling != 0 ? s.lens.tile + index : nullptr;
  trace::cull(s.scene.camera_still, view, scratch.near.camera_still);
  for (int q = 0; q < max_packs<F>; ++q) {
    const Pixels p = pack_at<F>(s.lens, tile, q);
    if (p.count > 0) scratch.still[q] = see_still(s, scratch.near, camera::ray<F>(s.lens, p));
  }
  if (s.scene.slots > 0) {
    moving_tile(s, job, tile, view, scratch, light);
    return;
  }
  if (s.last_stage >= stage_power) cull_lights(s, tile, scratch.still, scratch.seen, scratch.near);
  for (int q = 0; q < max_packs<F>; ++q) {
    const Pixels p = pack_at<F>(s.lens, tile, q);
    if (p.count > 0) one_pixel(s, job, scratch.near, p, camera::ray<F>(s.lens, p), scratch.still[q]);
  }
}

}  // namespace tofray::pipeline
