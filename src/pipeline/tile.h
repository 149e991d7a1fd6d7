// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "pipeline/tile_squares.h"

/// One tile of pixels of the processor: what it can meet, and its pixels pack by pack.
namespace tofray::pipeline {

/// What of a tile's forms the rays of one of its packs can meet: all of them where no rectangle holds the rays.
template <class F>
TOFRAY_NOINLINE const trace::Culled& narrow_to(const flow::Ray<F>& ray, const num::Mask<F>& use, const trace::Culled& all,
                                               trace::Culled& out) {
  Rectangle<F> seen;
  seen.add(ray.x, ray.y, ray.z, use);
  if (seen.open) return all;
  trace::narrow<F>(all, seen.bounds(), out);
  return out;
}

template <class F>
TOFRAY_NOINLINE void narrow_to(const shape::Vec& toward_sun, const flow::Place<F>& p, const scene::Alongs& alongs,
                               const trace::CulledAlong& from, trace::CulledAlong& to) {
  trace::narrow<F>(alongs, from, OnScreen<F>(toward_sun).at(p.x, p.y, p.z, p.found), to);
}

/// What of a tile's forms comes into question for the pack that is looked at now.
template <template <class> class From>
struct PackCandidates {
  trace::CulledOf<From> narrowed;
  const trace::CulledOf<From>* now;
  template <class F>
  TOFRAY_INLINE void look(const trace::CulledOf<From>& all, const flow::Ray<F>& ray, num::Mask<F> use) {
    now = &all;
    if (!all.many) return;
    const flow::Ray<F> ray_copy = ray;
    const num::Mask<F> use_copy = use;
    now = &narrow_to<F>(ray_copy, use_copy, all, narrowed);
  }
};

/// Which forms the pixels of a tile can meet: seen from the camera, and from each light.
/// \tparam can_move  false: nothing moves, and there is no code for what does
template <bool can_move>
struct TileCandidates {
  trace::Culled camera_still, camera_moving;
  trace::Culled light_still[flow::max_lights], light_moving[flow::max_lights];
  trace::CulledAlong sun_still, sun_moving;
  PackCandidates<trace::PickedForms> still, moving;
  PackCandidates<trace::PickedAlongs> along_still, along_moving;
  trace::Marks marks;

  /// Bytes that all of it writes to.
  TOFRAY_INLINE static std::size_t room_of(const scene::SceneView& s) {
    const auto views = static_cast<std::size_t>(2 + s.lights + (s.has_sun != 0 ? 2 : 0));  // the last one is a pack's
    const std::size_t moving = can_move ? views * trace::room_of(s.moving.bodies) + trace::marks_bytes(s.moving.bodies) : 0;
    return views * trace::room_of(s.still.bodies) + trace::marks_bytes(s.still.bodies) + moving;
  }
  /// @param room  aligned to 64 bytes
  TOFRAY_INLINE void take_room(const scene::SceneView& s, unsigned char* room) {
    take_room(s, s.still.bodies, room, camera_still, light_still, sun_still, still, along_still);
    if (can_move) take_room(s, s.moving.bodies, room, camera_moving, light_moving, sun_moving, moving, along_moving);
    const int most = trace::most_bodies(shape::Shapes{}, s.still.bodies), others = trace::most_bodies(shape::Shapes{}, s.moving.bodies);
    marks.sums = reinterpret_cast<std::uint64_t*>(room);
    marks.words = marks.sums + trace::Marks::sums_of(can_move && others > most ? others : most);
  }

  static constexpr bool keeps_places = can_move;
  TOFRAY_INLINE bool moves(const Setup&) const { return can_move; }
  template <class Mask>
  TOFRAY_INLINE bool any(Mask mask) const {
    return num::any(mask);
  }
  TOFRAY_INLINE bool can_be_shaded(const Setup& s) const {
    bool possible = s.power.ambient == camera::AmbientLight::directional && !sun_moving.empty();
    for (int l = 0; l < s.scene.lights; ++l) possible = possible || !light_moving[l].empty();
    return possible;
  }
  /// What comes into question for a pack's rays, where many forms do for the tile's.
  template <class F>
  TOFRAY_INLINE void look(int, int light, const flow::Ray<F>& ray, num::Mask<F> use) {
    still.look(light_still[light], ray, use);
    if constexpr (can_move) moving.look(light_moving[light], ray, use);
  }
  template <class F>
  TOFRAY_INLINE void look_along(const Setup& s, int moment, const flow::Place<F>& p) {
    look_along(s.scene.toward_sun[moment], sun_still, s.scene.sun_still(), p, along_still);
    if constexpr (can_move) look_along(s.scene.toward_sun[moment], sun_moving, s.scene.sun_moving(moment), p, along_moving);
  }
  TOFRAY_INLINE const trace::Culled& still_from_camera(const Setup&) const { return *still.now; }
  TOFRAY_INLINE const trace::Culled& moving_from_camera(const Setup&, int) const { return *moving.now; }
  TOFRAY_INLINE const trace::Culled& still_from(const Setup&, int) const { return *still.now; }
  TOFRAY_INLINE const trace::Culled& moving_from(const Setup&, int, int) const { return *moving.now; }
  TOFRAY_INLINE const trace::CulledAlong& still_along(const Setup&) const { return *along_still.now; }
  TOFRAY_INLINE const trace::CulledAlong& moving_along(const Setup&, int) const { return *along_moving.now; }

  /// What is kept from the lights and the sun by meshes and by what there is much of, which all pixels of the tile look at at once.
  static constexpr int sun = flow::max_lights;
  bool has_shades;
  int pack;                               ///< that is asked for
  const MeshShade *of_still, *of_moving;  ///< [light] by what stands still, and by what moves; the sun comes last
  template <class F>
  TOFRAY_INLINE num::Mask<F> behind_still_meshes(int light) const {
    return in<F>(of_still, light);
  }
  template <class F>
  TOFRAY_INLINE num::Mask<F> behind_moving_meshes(int light) const {
    return in<F>(of_moving, light);
  }

 private:
  template <class F>
  TOFRAY_INLINE static void look_along(const shape::Vec& toward_sun, const trace::CulledAlong& all, const scene::Alongs& alongs,
                                       const flow::Place<F>& p, PackCandidates<trace::PickedAlongs>& out) {
    out.now = &all;
    if (!all.many) return;
    const flow::Place<F> copy = p;
    narrow_to<F>(toward_sun, copy, alongs, all, out.narrowed);
    out.now = &out.narrowed;
  }
  TOFRAY_INLINE static void take_room(const scene::SceneView& s, const scene::Bodies& bodies, unsigned char*& room,
                                      trace::Culled& of_camera, trace::Culled* of_lights, trace::CulledAlong& of_sun,
                                      PackCandidates<trace::PickedForms>& of_pack, PackCandidates<trace::PickedAlongs>& along_pack) {
    const std::size_t each = trace::room_of(bodies);
    const auto take = [&](auto& culled) TOFRAY_LAMBDA { culled.room = room, room += each; };
    take(of_camera), take(of_pack.narrowed);
    for (int l = 0; l < s.lights; ++l) take(of_lights[l]);
    if (s.has_sun != 0) take(of_sun), take(along_pack.narrowed);
  }
  template <class F>
  TOFRAY_INLINE num::Mask<F> in(const MeshShade* shades, int light) const {
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

/// Scratch memory of one worker. After it comes room for `near`.
template <class F, bool can_move>
struct alignas(64) Scratch {
  TileCandidates<can_move> near;
  SeenByLights seen;
  flow::Hit<F> still[max_packs<F>];                  ///< of what stands still
  flow::Hit<F> hits[can_move ? max_packs<F> : 1];    ///< of all, at one moment
  flow::Light<F> mean[can_move ? max_packs<F> : 1];  ///< over an exposure
  PackState<F> pack[can_move ? max_packs<F> : 1];    ///< where there is one moment, nothing is kept of a pack once the next one begins
  Shades<can_move> shades;
  trace::TileRays rays;
  TilePoints points;
  alignas(64) trace::TileRays::Array changed;  ///< pixels that do not see what stands still
  trace::TileSquares squares;
  bool once;  ///< the samples so far of a tile where nothing moves were added to the light of the first raw frames alone
};

template <class F, bool can_move>
class TileSource {
 public:
  TOFRAY_INLINE TileSource(const Setup& s, const Job& job, int index, Scratch<F, can_move>& scratch)
      : s_(s),
        job_(job),
        scratch_(scratch),
        tile_(tile_at(s.lens, index)),
        next_tile_(tile_at(s.lens, index + 1)),
        view_(s.culling != 0 ? s.lens.tile + index : nullptr),
        hits_(scratch.still) {
    scratch.near.take_room(s.scene, reinterpret_cast<unsigned char*>(&scratch + 1));
    trace::cull<F>(s.scene.camera_still(), view_, scratch.near.marks, scratch.near.camera_still);
    for (int q = 0; q < max_packs<F>; ++q) {
      const Pixels p = pixels(q);
      if (p.count == 0) continue;
      const flow::Ray<F> ray = camera::ray<F>(s.lens, p);
      scratch.near.still.look(scratch.near.camera_still, ray, in_use<F>(p));
      scratch.still[q] = see_still(s, scratch.near, ray);
    }
    see_at_once(scratch.near.camera_still, scratch.still);
    scratch.near.has_shades = trace::any_mesh(s.scene) || trace::any_clusters(s.scene);
    if constexpr (can_move) {
      calm_ = is_calm();
      begin_sample();
    }
  }

  TOFRAY_INLINE int moments() const { return can_move && !calm_ ? s_.scene.moments : 1; }
  TOFRAY_INLINE bool once() const { return can_move && scratch_.once; }
  /// What is left to do once all pixels of the tile have their light.
  TOFRAY_INLINE void end() {
    if (can_move && once() && job_.gather.next == nullptr) spread(job_.light.values);
  }
  TOFRAY_INLINE int packs() const { return max_packs<F>; }
  TOFRAY_INLINE Pixels pixels(int q) const { return pack_at<F>(s_.lens, tile_, q); }
  TOFRAY_INLINE Pixels ahead(int q) const {
    if (job_.gather.next != nullptr) {
      camera::fetch_lens<F>(*job_.gather.next, pixels(q));
    } else {
      camera::fetch_lens<F>(first_lens(), pack_at<F>(s_.lens, next_tile_, q));
    }
    const Pixels next = q + 1 < max_packs<F> ? pixels(q + 1) : Pixels{0, 0};
    return next.count > 0 ? next : pack_at<F>(s_.lens, next_tile_, 0);
  }
  TOFRAY_INLINE PackState<F>& pack(int q) {
    if constexpr (can_move) return scratch_.pack[q];
    return here_;
  }
  static constexpr bool blurs = can_move, inlined = !can_move;
  TOFRAY_INLINE flow::Light<F>& mean(int q) { return scratch_.mean[can_move ? q : 0]; }

  TOFRAY_INLINE void go_to(const Moment& now) {
    if constexpr (can_move) see_what_moves(now.index);
    if (s_.last_stage < Stage::power) return;
    shade_what_stands_still(now.index);
    look_from_lights(now.index, hits_);
    if constexpr (can_move) {
      find_moving_shades(now.index);
      shade_what_is_seen(now.index);
    }
  }

  TOFRAY_INLINE bool find_light(const Moment& now, int q, const Pixels& p, const flow::Ray<F>& ray, F vignetting, PackState<F>& pack) {
    scratch_.near.pack = q;
    return light_of_scene(s_, job_, scratch_.near, now, p, ray, scratch_.still[q], hits_[q], vignetting, pack.light, pack.undisturbed,
                          pack.before);
  }

 private:
  /// Of a tile's first sample.
  TOFRAY_INLINE const camera::LensView& first_lens() const {
    return job_.gather.on != 0 && s_.subpixel.lens != nullptr ? s_.subpixel.lens[0] : s_.lens;
  }
  TOFRAY_INLINE bool has_sun() const { return s_.power.ambient == camera::AmbientLight::directional; }
  /// Whether nothing that moves is in view at any moment, and nothing that moves can come before a light: then one moment is as good as all.
  TOFRAY_INLINE bool is_calm() {
    if (job_.out.gt_phase_flow_px != nullptr) return false;
    for (int m = 0; m < s_.scene.moments; ++m) {
      trace::cull<F>(s_.scene.camera_moving(m), view_, scratch_.near.marks, scratch_.near.camera_moving);
      if (!scratch_.near.camera_moving.empty()) return false;
    }
    if (s_.last_stage < Stage::power) return true;
    look_from_lights(0, scratch_.still);
    for (int m = 0; m < s_.scene.moments; ++m) {
      find_moving_shades(m);
      if (scratch_.near.can_be_shaded(s_)) return false;
    }
    return true;
  }
  /// A tile's samples are added one after the other. As long as all of them were calm, the first raw frame of each modulation frequency has
  /// the light of all.
  TOFRAY_INLINE void begin_sample() {
    const bool many = job_.gather.on != 0 && job_.light.times > 1;
    if (job_.gather.begins != 0 || !many) scratch_.once = many && calm_ && job_.gather.first != 0;
    if (!scratch_.once || calm_) return;
    spread(job_.light.before);
    scratch_.once = false;
  }
  TOFRAY_INLINE void spread(float* values) {
    for (int q = 0; q < packs(); ++q) {
      const Pixels p = pixels(q);
      if (p.count > 0) spread_alike<F>(s_, values, p, job_.light.times);
    }
  }
  /// What moves and can come between a light and what the pixels see.
  TOFRAY_INLINE void find_moving_shades(int moment) {
    for (int l = 0; l < s_.scene.lights; ++l) {
      trace::cull<F>(s_.scene.light_moving(moment, l), scratch_.seen.of(l), scratch_.near.marks, scratch_.near.light_moving[l]);
    }
    if (has_sun()) {
      trace::cull<F>(s_.scene.sun_moving(moment), s_.culling != 0 ? &scratch_.seen.sun : nullptr, scratch_.near.marks,
                     scratch_.near.sun_moving);
    }
  }
  /// Where nothing that moves is in view, the tile sees what stands still.
  TOFRAY_INLINE void see_what_moves(int moment) {
    hits_ = scratch_.still;
    trace::cull<F>(s_.scene.camera_moving(moment), view_, scratch_.near.marks, scratch_.near.camera_moving);
    if (scratch_.near.camera_moving.empty()) return;
    hits_ = scratch_.hits;
    for (int q = 0; q < max_packs<F>; ++q) {
      const Pixels p = pixels(q);
      if (p.count == 0) continue;
      const flow::Ray<F> ray = camera::ray<F>(s_.lens, p);
      scratch_.near.moving.look(scratch_.near.camera_moving, ray, in_use<F>(p));
      scratch_.hits[q] = see_moving(s_, scratch_.near, moment, ray, scratch_.still[q]);
    }
    see_at_once(scratch_.near.camera_moving, scratch_.hits);
  }

  TOFRAY_INLINE void see_at_once(const trace::Culled& culled, flow::Hit<F>* hits) {
    if constexpr (shape::has_beams<F>) {
      if (culled.by_squares) see_by_squares<F>(s_, *this, culled, scratch_.rays, scratch_.squares, hits);
      if (trace::any_mesh(culled)) see_meshes<F>(s_, *this, culled, scratch_.rays, hits);
    }
  }

  /// What of the scene can come between a light and what the pixels see. Where something stands still, so does the sun.
  TOFRAY_INLINE void look_from_lights(int moment, const flow::Hit<F>* hits) {
    if (seen_from_lights_ == scratch_.still && hits == scratch_.still) return;
    for (int l = 0; l < s_.scene.lights; ++l) {
      scratch_.seen.none[l] = s_.culling == 0 || !seen_by_light(s_, tile_, hits, l, scratch_.seen.bounds[l]);
      trace::cull<F>(s_.scene.light_still(l), scratch_.seen.of(l), scratch_.near.marks, scratch_.near.light_still[l]);
    }
    if (has_sun()) {
      if (s_.culling != 0) scratch_.seen.sun = seen_by_sun(s_, moment, tile_, hits);
      trace::cull<F>(s_.scene.sun_still(), s_.culling != 0 ? &scratch_.seen.sun : nullptr, scratch_.near.marks, scratch_.near.sun_still);
    }
    seen_from_lights_ = hits;
  }

  /// What meshes, and what there is much of, that stand still keep from the lights, of what stands still: it is so at all moments.
  TOFRAY_INLINE void shade_what_stands_still(int moment) {
    if constexpr (shape::has_beams<F>) {
      if (!scratch_.near.has_shades || still_is_shaded_) return;
      look_from_lights(moment, scratch_.still);
      shade_by_still(moment, scratch_.still, nullptr, scratch_.shades.still);
      scratch_.near.of_still = scratch_.shades.still, scratch_.near.of_moving = scratch_.shades.moving;
      still_is_shaded_ = true;
    }
  }
  /// What meshes, and what there is much of, keep from the lights of what is seen at a moment: those that stand still, and those that move.
  TOFRAY_INLINE void shade_what_is_seen(int moment) {
    if constexpr (shape::has_beams<F>) {
      TileCandidates<can_move>& near = scratch_.near;
      Shades<can_move>& shades = scratch_.shades;
      if (!near.has_shades) return;
      near.of_still = hits_ == scratch_.still ? shades.still : shades.current;
      const bool squares = any_by_squares(s_, near.light_moving, near.sun_moving);
      if (hits_ != scratch_.still) {
        put_changed(scratch_.still, hits_, scratch_.changed);
        const KnownShades known{shades.still, scratch_.changed};
        shade_by_still(moment, hits_, &known, shades.current);
      } else if (squares || trace::any_mesh(s_.scene)) {
        look_for_points(hits_);
      }
      find_shades<F>(s_, near.light_moving, near.sun_moving, scratch_.points, nullptr, scratch_.rays, shades.moving);
      if (squares) shade_by_squares(moment, near.light_moving, near.sun_moving, s_.scene.sun_moving(moment), shades.moving);
    }
  }
  TOFRAY_INLINE void shade_by_still(int moment, const flow::Hit<F>* hits, const KnownShades* known, MeshShade* shades) {
    const TileCandidates<can_move>& near = scratch_.near;
    const bool squares = any_by_squares(s_, near.light_still, near.sun_still);
    if (known != nullptr || squares || trace::any_mesh(s_.scene)) look_for_points(hits);
    find_shades<F>(s_, near.light_still, near.sun_still, scratch_.points, known, scratch_.rays, shades);
    if (squares) shade_by_squares(moment, near.light_still, near.sun_still, s_.scene.sun_still(), shades);
  }
  TOFRAY_INLINE void look_for_points(const flow::Hit<F>* hits) {
    if (points_of_ == hits && hits == scratch_.still) return;
    put_points(s_, *this, hits, scratch_.points);
    points_of_ = hits;
  }
  TOFRAY_INLINE void shade_by_squares(int moment, const trace::Culled* from_light, const trace::CulledAlong& sun,
                                      const scene::Alongs& alongs, MeshShade* shades) {
    find_shades_by_squares<F>(s_, from_light, sun, alongs, moment, points_of_, scratch_.points, scratch_.rays, scratch_.squares, shades);
  }

  const Setup& s_;
  const Job& job_;
  Scratch<F, can_move>& scratch_;
  Tile tile_, next_tile_;
  const flow::Bounds* view_;
  const flow::Hit<F>* hits_;
  const flow::Hit<F>* seen_from_lights_ = nullptr;  // near.light_still and `seen` are those of these hits
  const flow::Hit<F>* points_of_ = nullptr;
  bool still_is_shaded_ = false;
  bool calm_ = false;
  PackState<F> here_;
};

/// From rays to depth for one tile.
template <class F, bool can_move>
TOFRAY_INLINE void one_tile(const Setup& s, const Job& job, int index, void* scratch) {
  TileSource<F, can_move> source(s, job, index, *static_cast<Scratch<F, can_move>*>(scratch));
  run_pipeline<F>(s, job, source);
  source.end();
}

}  // namespace tofray::pipeline
