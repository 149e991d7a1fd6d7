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

/// Grows a rectangle of directions by the lanes in `use`; directions with z <= 0 make it boundless (`open`).
struct Rectangle {
  scene::Bounds bounds{3e38f, -3e38f, 3e38f, -3e38f};
  bool open = false;

  template <class F>
  TOFRAY_FN void add(F x, F y, F z, num::Mask<F> use) {
    if (num::any(use & (!(z > F(1e-6f))))) open = true;
    const F per_z = F(1.0f) / num::select(z > F(1e-6f), z, F(1.0f));
    const F u = x * per_z, v = y * per_z;
    bounds.x_min = num::min(bounds.x_min, num::lowest(num::select(use, u, F(3e38f))));
    bounds.x_max = num::max(bounds.x_max, num::highest(num::select(use, u, F(-3e38f))));
    bounds.y_min = num::min(bounds.y_min, num::lowest(num::select(use, v, F(3e38f))));
    bounds.y_max = num::max(bounds.y_max, num::highest(num::select(use, v, F(-3e38f))));
  }
  /// Null where everything must be kept.
  TOFRAY_FN const scene::Bounds* get(bool culling) const { return culling && !open ? &bounds : nullptr; }
};

template <class F>
TOFRAY_FN num::Mask<F> in_use(const Pixels& p) { return num::lane_index<F>() < num::Int<F>(p.count); }

/// What each light sees of the tile: its surface points as directions from the light.
template <class F>
TOFRAY_FN void cull_lights(const Setup& s, const Tile& tile, const flow::Hit<F>* hits, int slot, bool moving, Near& near) {
  Rectangle seen[flow::max_lights];
  for (int q = 0; q < max_packs<F>; ++q) {
    const Pixels p = pack_at<F>(s.lens, tile, q);
    if (p.count == 0) continue;
    const flow::Ray<F> ray = camera::ray<F>(s.lens, p);
    const auto use = in_use<F>(p) & (hits[q].w > F(0.0f));
    const F t = F(1.0f) / num::select(use, hits[q].w, F(1.0f));
    for (int l = 0; l < s.scene.lights; ++l) {
      const float* at = s.lights[l].position;
      seen[l].template add<F>(num::fma(ray.x, t, F(-at[0])), num::fma(ray.y, t, F(-at[1])), num::fma(ray.z, t, F(-at[2])), use);
    }
  }
  for (int l = 0; l < s.scene.lights; ++l) {
    trace::cull(s.scene.light_still[l], seen[l].get(s.culling != 0), near.light_still[l]);
    if (moving) trace::cull(s.scene.light_moving[slot * s.scene.lights + l], seen[l].get(s.culling != 0), near.light_moving[l]);
  }
}

template <class F>
TOFRAY_FN Rectangle view_of(const Setup& s, const Tile& tile) {
  Rectangle view;
  for (int q = 0; q < max_packs<F>; ++q) {
    const Pixels p = pack_at<F>(s.lens, tile, q);
    if (p.count == 0) continue;
    const flow::Ray<F> ray = camera::ray<F>(s.lens, p);
    view.add<F>(ray.x, ray.y, ray.z, in_use<F>(p));
  }
  return view;
}

/// Scratch memory of one worker.
template <class F>
struct Scratch {
  Near near;
  flow::Hit<F> still[max_packs<F>];
  flow::Hit<F> hits[max_packs<F>];
};

/// Light of entry 0 (what stands still), then of each slot that something moving touches: [entry][pack].
template <class F>
TOFRAY_FN void light_up_tile(const Setup& s, const Job& job, const Tile& tile, const flow::Hit<F>* hits, int slot, bool moving, bool truth,
                             const Near& near, flow::Light<F>* light) {
  for (int q = 0; q < max_packs<F>; ++q) {
    const Pixels p = pack_at<F>(s.lens, tile, q);
    if (p.count == 0) continue;
    const flow::Ray<F> ray = camera::ray<F>(s.lens, p);
    const flow::Surface<F> surface = trace::surface(s.scene, ray, hits[q]);
    Lighting<F> lighting;
    light_up(s, near, slot, moving, ray, surface, camera::vignetting<F>(s.lens, p), lighting);
    light[q] = lighting.light;
    if (truth) store_truth(job.out, p, surface, lighting.radiometry);
  }
}

TOFRAY_FN bool nothing_moves_near(const Setup& s, const Near& near) {
  bool empty = near.camera_moving.empty() && s.power.ambient_kind != 2;
  for (int l = 0; l < s.scene.lights; ++l) empty = empty && near.light_moving[l].empty();
  return empty;
}

/// A tile of a scene in which something moves: each raw frame sees it at its own time; where nothing of it comes near, once is enough.
template <class F>
TOFRAY_FN void moving_tile(const Setup& s, const Job& job, const Tile& tile, const scene::Bounds* view, Scratch<F>& scratch, flow::Light<F>* light) {
  std::int32_t entry[flow::max_raw_frames];
  bool still_done = false;
  for (int k = 0; k < s.sensor.raw_frames; ++k) {
    Near& near = scratch.near;
    trace::cull(s.scene.camera_moving[k], view, near.camera_moving);
    for (int q = 0; q < max_packs<F>; ++q) {
      const Pixels p = pack_at<F>(s.lens, tile, q);
      if (p.count > 0) scratch.hits[q] = see_moving(s, near, k, camera::ray<F>(s.lens, p), scratch.still[q]);
    }
    cull_lights(s, tile, scratch.hits, k, true, near);
    const bool still = nothing_moves_near(s, near);
    entry[k] = still ? 0 : (k + 1) * max_packs<F>;
    const bool truth = k == s.truth_slot;
    if (!still || !still_done || truth) light_up_tile(s, job, tile, scratch.hits, k, !still, truth, near, light + entry[k]);
    still_done = still_done || still;
  }
  for (int q = 0; q < max_packs<F>; ++q) {
    const Pixels p = pack_at<F>(s.lens, tile, q);
    if (p.count == 0) continue;
    measure(s, job, p, camera::ray<F>(s.lens, p), camera::vignetting<F>(s.lens, p), light + q, entry);
  }
}

/// From rays to depth for one tile.
/// @param light  [raw frames + 1][max_packs], needed where something moves
template <class F>
TOFRAY_FN void one_tile(const Setup& s, const Job& job, int index, Scratch<F>& scratch, flow::Light<F>* light) {
  const Tile tile = tile_at(s.lens, index);
  const Rectangle view = view_of<F>(s, tile);
  trace::cull(s.scene.camera_still, view.get(s.culling != 0), scratch.near.camera_still);
  for (int q = 0; q < max_packs<F>; ++q) {
    const Pixels p = pack_at<F>(s.lens, tile, q);
    if (p.count > 0) scratch.still[q] = see_still(s, scratch.near, camera::ray<F>(s.lens, p));
  }
  if (s.scene.slots > 1) {
    moving_tile(s, job, tile, view.get(s.culling != 0), scratch, light);
    return;
  }
  cull_lights(s, tile, scratch.still, 0, false, scratch.near);
  for (int q = 0; q < max_packs<F>; ++q) {
    const Pixels p = pack_at<F>(s.lens, tile, q);
    if (p.count > 0) one_pixel(s, job, scratch.near, p, camera::ray<F>(s.lens, p), scratch.still[q]);
  }
}

}  // namespace tofray::pipeline
