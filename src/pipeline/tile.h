// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "pipeline/tile_meshes.h"

/// One tile of pixels of the processor: what it can meet, and its pixels pack by pack.
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

/// Which forms the pixels of a tile can meet: seen from the camera, and from each light.
/// \tparam can_move  false: nothing moves, and there is no code for what does
template <bool can_move>
struct Near {
  trace::Culled camera_still, camera_moving;
  trace::Culled light_still[flow::max_lights], light_moving[flow::max_lights];

  TOFRAY_FN bool moves(const Setup&) const { return can_move; }
  template <class Mask>
  TOFRAY_FN bool any(Mask mask) const {
    return num::any(mask);
  }
  TOFRAY_FN bool can_be_shaded(const Setup& s) const {
    bool possible = s.power.ambient == camera::AmbientLight::directional;
    for (int l = 0; l < s.scene.lights; ++l) possible = possible || !light_moving[l].empty();
    return possible;
  }
  /// What `light` can see of the pixels is known before they are lit: nothing to do for the ray that goes to one of them.
  template <class F>
  TOFRAY_FN void look(int, int, const flow::Ray<F>&, num::Mask<F>) const {}
  TOFRAY_FN const trace::Culled& still_from_camera(const Setup&) const { return camera_still; }
  TOFRAY_FN const trace::Culled& moving_from_camera(const Setup&, int) const { return camera_moving; }
  TOFRAY_FN const trace::Culled& still_from(const Setup&, int light) const { return light_still[light]; }
  TOFRAY_FN const trace::Culled& moving_from(const Setup&, int, int light) const { return light_moving[light]; }

  /// What meshes keep from the lights and the sun, where all pixels of the tile look at them at once.
  static constexpr int sun = flow::max_lights;
  bool has_shades;
  int pack;                               ///< that is asked for
  const MeshShade *of_still, *of_moving;  ///< [light] by what stands still, and by what moves; the sun comes last
  template <class F>
  TOFRAY_FN num::Mask<F> behind_still_meshes(int light) const {
    return in<F>(of_still, light);
  }
  template <class F>
  TOFRAY_FN num::Mask<F> behind_moving_meshes(int light) const {
    return in<F>(of_moving, light);
  }

 private:
  template <class F>
  TOFRAY_FN num::Mask<F> in(const MeshShade* shades, int light) const {
    if constexpr (shape::has_beams<F>) {
      if (has_shades && shades[light].any) return shape::load_all<F>(shades[light].dark + pack * num::lanes<F>) > F(0.0f);
    }
    return F(1.0f) < F(0.0f);
  }
};

/// Which pixels are in the shade of meshes.
template <bool can_move>
struct Shades {
  static constexpr int lights = flow::max_lights + 1;
  MeshShade still[lights];                                                  ///< on what stands still
  MeshShade current[can_move ? lights : 1], moving[can_move ? lights : 1];  ///< on what is seen at one moment
};

/// Scratch memory of one worker.
template <class F, bool can_move>
struct Scratch {
  Near<can_move> near;
  SeenByLights seen;
  flow::Hit<F> still[max_packs<F>];                  ///< of what stands still
  flow::Hit<F> hits[can_move ? max_packs<F> : 1];    ///< of all, at one moment
  flow::Light<F> mean[can_move ? max_packs<F> : 1];  ///< over an exposure
  Pack<F> pack[can_move ? max_packs<F> : 1];         ///< where there is one moment, nothing is kept of a pack once the next one begins
  Shades<can_move> shades;
  trace::TileRays rays;
  TilePoints points;
  alignas(64) trace::TileRays::Array changed;  ///< pixels that do not see what stands still
};

template <class F, bool can_move>
class TileWalk {
 public:
  TOFRAY_FN TileWalk(const Setup& s, const Job& job, int index, Scratch<F, can_move>& scratch)
      : s_(s),
        job_(job),
        scratch_(scratch),
        tile_(tile_at(s.lens, index)),
        view_(s.culling != 0 ? s.lens.tile + index : nullptr),
        hits_(scratch.still) {
    trace::cull(s.scene.camera_still(), view_, scratch.near.camera_still);
    for (int q = 0; q < max_packs<F>; ++q) {
      const Pixels p = pixels(q);
      if (p.count > 0) scratch.still[q] = see_still(s, scratch.near, camera::ray<F>(s.lens, p));
    }
    see_meshes(scratch.near.camera_still, scratch.still);
    scratch.near.has_shades = trace::any_mesh(s.scene);
  }

  TOFRAY_FN int moments() const { return can_move ? s_.scene.moments : 1; }
  TOFRAY_FN int packs() const { return max_packs<F>; }
  TOFRAY_FN Pixels pixels(int q) const { return pack_at<F>(s_.lens, tile_, q); }
  TOFRAY_FN Pack<F>& pack(int q) {
    if constexpr (can_move) return scratch_.pack[q];
    return here_;
  }
  static constexpr bool blurs = can_move;
  TOFRAY_FN flow::Light<F>& mean(int q) { return scratch_.mean[can_move ? q : 0]; }

  TOFRAY_FN void go_to(const Moment& now) {
    if constexpr (can_move) see_what_moves(now.index);
    if (s_.last_stage < Stage::power) return;
    shade_what_stands_still();
    look_from_lights(hits_);
    for (int l = 0; can_move && l < s_.scene.lights; ++l) {
      trace::cull(s_.scene.light_moving(now.index, l), scratch_.seen.of(l), scratch_.near.light_moving[l]);
    }
    if constexpr (can_move) shade_what_is_seen(now.index);
  }

  TOFRAY_FN bool find_light(const Moment& now, int q, const Pixels& p, const flow::Ray<F>& ray, F vignetting, Pack<F>& pack) {
    scratch_.near.pack = q;
    return light_of_scene(s_, job_, scratch_.near, now, p, ray, scratch_.still[q], hits_[q], vignetting, pack.light, pack.undisturbed);
  }

 private:
  /// Where nothing that moves is in view, the tile sees what stands still.
  TOFRAY_FN void see_what_moves(int moment) {
    hits_ = scratch_.still;
    trace::cull(s_.scene.camera_moving(moment), view_, scratch_.near.camera_moving);
    if (scratch_.near.camera_moving.empty()) return;
    hits_ = scratch_.hits;
    for (int q = 0; q < max_packs<F>; ++q) {
      const Pixels p = pixels(q);
      if (p.count > 0) scratch_.hits[q] = see_moving(s_, scratch_.near, moment, camera::ray<F>(s_.lens, p), scratch_.still[q]);
    }
    see_meshes(scratch_.near.camera_moving, scratch_.hits);
  }

  TOFRAY_FN void see_meshes(const trace::Culled& culled, flow::Hit<F>* hits) {
    if constexpr (shape::has_beams<F>) {
      if (trace::any_mesh(culled)) pipeline::see_meshes<F>(s_, *this, culled, scratch_.rays, hits);
    }
  }

  /// What of the scene can come between a light and what the pixels see.
  TOFRAY_FN void look_from_lights(const flow::Hit<F>* hits) {
    if (seen_from_lights_ == scratch_.still && hits == scratch_.still) return;
    for (int l = 0; l < s_.scene.lights; ++l) {
      scratch_.seen.none[l] = s_.culling == 0 || !seen_by_light(s_, tile_, hits, l, scratch_.seen.bounds[l]);
      trace::cull(s_.scene.light_still(l), scratch_.seen.of(l), scratch_.near.light_still[l]);
    }
    seen_from_lights_ = hits;
  }

  /// What meshes that stand still keep from the lights, of what stands still: it is so at all moments.
  TOFRAY_FN void shade_what_stands_still() {
    if constexpr (shape::has_beams<F>) {
      if (!scratch_.near.has_shades || still_is_shaded_) return;
      look_from_lights(scratch_.still);
      shade_by_still(scratch_.still, nullptr, scratch_.shades.still);
      scratch_.near.of_still = scratch_.shades.still, scratch_.near.of_moving = scratch_.shades.moving;
      still_is_shaded_ = true;
    }
  }
  /// … and of what is seen at a moment; and what meshes keep from it that move.
  TOFRAY_FN void shade_what_is_seen(int moment) {
    if constexpr (shape::has_beams<F>) {
      Near<can_move>& near = scratch_.near;
      Shades<can_move>& shades = scratch_.shades;
      if (!near.has_shades) return;
      near.of_still = hits_ == scratch_.still ? shades.still : shades.current;
      if (hits_ != scratch_.still) {
        put_changed(scratch_.still, hits_, scratch_.changed);
        const KnownShades known{shades.still, scratch_.changed};
        shade_by_still(hits_, &known, shades.current);
      } else if (points_of_ != hits_) {
        put_points(s_, *this, hits_, scratch_.points);
        points_of_ = hits_;
      }
      find_shades<F>(s_, near.light_moving, s_.scene.sun_moving(moment), scratch_.points, nullptr, scratch_.rays, shades.moving);
    }
  }
  TOFRAY_FN void shade_by_still(const flow::Hit<F>* hits, const KnownShades* known, MeshShade* shades) {
    put_points(s_, *this, hits, scratch_.points);
    points_of_ = hits;
    find_shades<F>(s_, scratch_.near.light_still, s_.scene.sun_still(), scratch_.points, known, scratch_.rays, shades);
  }

  const Setup& s_;
  const Job& job_;
  Scratch<F, can_move>& scratch_;
  Tile tile_;
  const flow::Bounds* view_;
  const flow::Hit<F>* hits_;
  const flow::Hit<F>* seen_from_lights_ = nullptr;  // near.light_still and `seen` are those of these hits
  const flow::Hit<F>* points_of_ = nullptr;
  bool still_is_shaded_ = false;
  Pack<F> here_;
};

/// From rays to depth for one tile.
template <class F, bool can_move>
TOFRAY_FN void one_tile(const Setup& s, const Job& job, int index, void* scratch) {
  TileWalk<F, can_move> walk(s, job, index, *static_cast<Scratch<F, can_move>*>(scratch));
  run_pipeline<F>(s, job, walk);
}

}  // namespace tofray::pipeline
