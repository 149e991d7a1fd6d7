// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "pipeline/run.h"
#include "trace/mesh_tile.h"

/// Meshes, which all pixels of a tile look at at once: what they see of them, and in whose shade they are. Functions apart: what has
/// no meshes should not pay for them with registers.
namespace tofray::pipeline {

/// Where shadow rays end: a little before what the pixels of a tile see.
struct TilePoints {
  alignas(64) trace::TileRays::Array x, y, z, range;
  alignas(64) trace::TileRays::Array found;  ///< 1 or 0
};

/// Which pixels of a tile are in the shade of meshes.
struct MeshShade {
  bool any;                                 ///< or no mesh comes into question
  alignas(64) trace::TileRays::Array dark;  ///< 1 or 0
};

/// Pixels whose hit is another.
template <class F>
TOFRAY_NOINLINE void put_changed(const flow::Hit<F>* before, const flow::Hit<F>* now, float* changed) {
  for (int at = 0, q = 0; at < trace::TileRays::count; at += num::lanes<F>, ++q) {
    const auto other = (before[q].w != now[q].w) | (before[q].facet != now[q].facet);
    shape::store_all(changed + at, num::select(other, F(1.0f), F(0.0f)));
  }
}

template <class F>
TOFRAY_INLINE num::Mask<F> in_use(const Pixels& p) {
  return num::lane_index<F>() < num::Int<F>(p.count);
}

/// @param tile  pixels(q) are those of its pack number q
template <class F, class Tile>
TOFRAY_NOINLINE void put_points(const Setup& s, const Tile& tile, const flow::Hit<F>* hits, TilePoints& points) {
  for (int at = 0, q = 0; at < trace::TileRays::count; at += num::lanes<F>, ++q) {
    const Pixels p = tile.pixels(q);
    flow::Place<F> surface{};
    num::Mask<F> found = F(1.0f) < F(0.0f);
    if (p.count > 0) {
      const flow::Ray<F> ray = camera::ray<F>(s.lens, p);
      found = trace::place(ray, hits[q], surface) & in_use<F>(p);
      surface = trace::a_little_before(s.scene, surface, ray);
    }
    shape::store_all(points.x + at, surface.x), shape::store_all(points.y + at, surface.y), shape::store_all(points.z + at, surface.z);
    shape::store_all(points.range + at, surface.range);
    shape::store_all(points.found + at, num::select(found, F(1.0f), F(0.0f)));
  }
}

/// The nearer of the hits and the meshes.
template <class F, class Tile>
TOFRAY_NOINLINE void see_meshes(const Setup& s, const Tile& tile, const trace::Culled& culled, trace::TileRays& rays, flow::Hit<F>* hits) {
  for (int at = 0, q = 0; at < trace::TileRays::count; at += num::lanes<F>, ++q) {
    const Pixels p = tile.pixels(q);
    if (p.count == 0) continue;
    const flow::Ray<F> ray = camera::ray<F>(s.lens, p);
    trace::put(ray.x, ray.y, ray.z, at, rays);
  }
  trace::nearest_meshes(
      culled, rays, [&](int q) TOFRAY_LAMBDA { return in_use<F>(tile.pixels(q)); }, hits);
}

/// What was found before, of pixels that have not changed since.
struct KnownShades {
  const MeshShade* of;   ///< [light] the sun comes last
  const float* changed;  ///< 1 or 0
};

/// The shade of one light. @param put_ray  (position, range, lanes where there is a ray, number of the first)
template <class F, class Forms, class PutRay>
TOFRAY_INLINE void find_shade(const Forms& forms, const TilePoints& points, const MeshShade* known, const float* changed,
                              trace::TileRays& rays, MeshShade& shade, const PutRay& put_ray) {
  const bool keeps = known != nullptr && known->any;
  shade.any = keeps || trace::any_mesh(forms);
  if (!shade.any) return;
  for (int at = 0; at < trace::TileRays::count; at += num::lanes<F>) {
    const auto load = [&](const float* from) TOFRAY_LAMBDA { return shape::load_all<F>(from + at); };
    auto wanted = load(points.found) > F(0.0f);
    if (known != nullptr) wanted = wanted & (load(changed) > F(0.0f));
    shape::store_all(shade.dark + at, keeps ? num::select(load(changed) > F(0.0f), F(0.0f), load(known->dark)) : F(0.0f));
    put_ray(load(points.x), load(points.y), load(points.z), load(points.range), wanted, at);
  }
  trace::shade_by_meshes<F>(forms, rays, shade.dark);
}

/// What meshes keep from the lights and the sun.
/// @param from_light  [light] what each of them can see
/// @param sun         what the sun can
/// @param known       or null
/// @param shades      out: [light] the sun comes last
template <class F>
TOFRAY_NOINLINE void find_shades(const Setup& s, const trace::Culled* from_light, const trace::CulledAlong& sun, const TilePoints& points,
                                 const KnownShades* known, trace::TileRays& rays, MeshShade* shades) {
  const auto before = [&](int l) TOFRAY_LAMBDA { return known != nullptr ? known->of + l : nullptr; };
  const float* changed = known != nullptr ? known->changed : nullptr;
  for (int l = 0; l < s.scene.lights; ++l) {
    const auto put_ray = [&](F x, F y, F z, F, num::Mask<F> wanted, int at) TOFRAY_LAMBDA {
      flow::Place<F> surface;
      surface.x = x, surface.y = y, surface.z = z;
      const flow::Ray<F> ray = power::light_ray(s.lights[l], surface);
      trace::put(ray.x, ray.y, ray.z, at, rays);
      trace::put_ends(F(0.0f), F(trace::before_surface), wanted, at, rays);
    };
    find_shade<F>(from_light[l], points, before(l), changed, rays, shades[l], put_ray);
  }
  constexpr int last = flow::max_lights;
  shades[last].any = false;
  if (s.power.ambient != camera::AmbientLight::directional) return;
  const auto put_ray = [&](F x, F y, F z, F range, num::Mask<F> wanted, int at) TOFRAY_LAMBDA {
    trace::put(x, y, z, at, rays);
    trace::put_ends(F(trace::shadow_margin) * range, F(3e38f), wanted, at, rays);
  };
  find_shade<F>(sun, points, before(last), changed, rays, shades[last], put_ray);
}

}  // namespace tofray::pipeline
