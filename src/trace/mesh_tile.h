// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "shape/mesh_square.h"
#include "trace/visible.h"

/// Meshes, looked at by all pixels of a tile at once.
namespace tofray::trace {

using shape::TileRays;

/// The rays of a pack are those from number `at` of the tile's on: their directions, or where they begin.
template <class F>
TOFRAY_INLINE void put(F x, F y, F z, int at, TileRays& rays) {
  shape::store_all(rays.given[0] + at, x), shape::store_all(rays.given[1] + at, y), shape::store_all(rays.given[2] + at, z);
}
/// Within which t the rays of a pack look for a triangle, if at all.
template <class F>
TOFRAY_INLINE void put_ends(F shortest, F far, Mask<F> wanted, int at, TileRays& rays) {
  shape::store_all(rays.shortest + at, shortest);
  shape::store_all(rays.far + at, num::select(wanted, far, F(-1.0f)));
}
template <class F>
TOFRAY_INLINE Int<F> triangle_at(const TileRays& rays, int at) {
  return num::to_signed(num::bits(shape::load_all<F>(rays.triangle + at)));
}

template <template <class> class From, class... T>
TOFRAY_INLINE bool any_mesh(shape::List<T...>, const CulledOf<From>& culled) {
  return ((shape::many_of<T> && culled.template of<T>().picked.count > 0) || ...);
}
template <class... T>
TOFRAY_INLINE bool any_mesh(shape::List<T...>, const scene::SceneView& s) {
  return ((shape::many_of<T> && s.still.bodies.of<T>().count + s.moving.bodies.of<T>().count > 0) || ...);
}
/// Whether there is one, for a tile's rays or at all.
template <class Forms>
TOFRAY_INLINE bool any_mesh(const Forms& forms) {
  return any_mesh(shape::Shapes{}, forms);
}

template <class... T, class Culled, class Each>
TOFRAY_INLINE void each_mesh(shape::List<T...>, const Culled& culled, const Each& each) {
  const auto one = [&]<class One>(shape::List<One>) TOFRAY_LAMBDA {
    if constexpr (shape::many_of<One>) {
      for (auto i = culled.template iterate<One>(); i.more(); i.next()) each(i.form());
    }
  };
  (one(shape::List<T>{}), ...);
}

/// The nearer of the packs' hits and the meshes. @param wanted  (pack): which lanes have a ray
template <class F, class Wanted>
TOFRAY_INLINE void nearest_meshes(const Culled& culled, TileRays& rays, const Wanted& wanted, Hit<F>* hits) {
  each_mesh(shape::Shapes{}, culled, [&](const auto& form) TOFRAY_LAMBDA {
    for (int at = 0, q = 0; at < TileRays::count; at += num::lanes<F>, ++q)
      put_ends(F(shape::nearest_mesh), shape::far_of(hits[q]), wanted(q), at, rays);
    shape::search_tile<false, F>(form, rays);
    for (int at = 0, q = 0; at < TileRays::count; at += num::lanes<F>, ++q)
      take(form, shape::load_all<F>(rays.t + at), triangle_at<F>(rays, at), hits[q]);
  });
}

/// Which surfaces a mesh keeps from a light.
/// @param forms  the meshes as the light sees them, or parallel light
/// @param rays   from the light to the surfaces, or from these toward the sun; `far` is above 0 where there is one
/// @param dark   is put to 1 where it does
template <class F, class Forms>
TOFRAY_INLINE void shade_by_meshes(const Forms& forms, TileRays& rays, float* dark) {
  each_mesh(shape::Shapes{}, forms, [&](const auto& form) TOFRAY_LAMBDA {
    shape::search_tile<true, F>(form, rays);
    for (int at = 0; at < TileRays::count; at += num::lanes<F>) {
      const auto met = triangle_at<F>(rays, at) > Int<F>(-1);
      shape::store_all(rays.far + at, num::select(met, F(-1.0f), shape::load_all<F>(rays.far + at)));
      shape::store_all(dark + at, num::select(met, F(1.0f), shape::load_all<F>(dark + at)));
    }
  });
}

}  // namespace tofray::trace
