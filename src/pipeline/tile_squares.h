// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "pipeline/tile_view.h"
#include "trace/square_search.h"

/// Forms of which there are many, which squares of a tile's rays look for. Functions apart, and memory of their own: what has few forms pays
/// for neither.
namespace tofray::pipeline {

/// The nearer of the hits and these forms.
template <class F, class Tile>
TOFRAY_NOINLINE void see_by_squares(const Setup& s, const Tile& tile, const trace::Culled& culled, trace::TileRays& rays,
                                    trace::TileSquares& squares, flow::Hit<F>* hits) {
  for (int at = 0, q = 0; at < trace::TileRays::count; at += num::lanes<F>, ++q) {
    const Pixels p = tile.pixels(q);
    if (p.count > 0) trace::put(camera::ray<F>(s.lens, p), at, rays, squares);
  }
  trace::nearest_by_squares(
      culled, rays, squares, [&](int q) TOFRAY_LAMBDA { return in_use<F>(tile.pixels(q)); }, hits);
}

/// Whether there are any that a light or the sun can see.
TOFRAY_INLINE bool any_by_squares(const Setup& s, const trace::Culled* from_light, const trace::CulledAlong& sun) {
  bool any = s.power.ambient == camera::AmbientLight::directional && sun.by_squares;
  for (int l = 0; l < s.scene.lights; ++l) any = any || from_light[l].by_squares;
  return any;
}

/// Rays to what was neither missed nor found in the shade of a mesh. (Not only of what has changed between moments: where a light saw few
/// forms before, packs looked for them, and wrote nothing down.)
template <class F, class PutRay>
TOFRAY_INLINE void begin_shade(const TilePoints& points, MeshShade& shade, const PutRay& put_ray) {
  for (int at = 0; at < trace::TileRays::count; at += num::lanes<F>) {
    const auto load = [&](const float* from) TOFRAY_LAMBDA { return shape::load_all<F>(from + at); };
    if (!shade.any) shape::store_all(shade.dark + at, F(0.0f));
    const auto wanted = (load(points.found) > F(0.0f)) & (load(shade.dark) <= F(0.0f));
    put_ray(load(points.x), load(points.y), load(points.z), load(points.range), wanted, at);
  }
  shade.any = true;
}

/// What these forms keep from the lights and the sun, added to what meshes do. [as find_shades]
/// @param alongs  all that stands before the sun at the moment
/// @param hits    that the points are of
template <class F>
TOFRAY_NOINLINE void find_shades_by_squares(const Setup& s, const trace::Culled* from_light, const trace::CulledAlong& sun,
                                            const scene::Alongs& alongs, int moment, const flow::Hit<F>* hits, const TilePoints& points,
                                            trace::TileRays& rays, trace::TileSquares& squares, MeshShade* shades) {
  for (int at = 0, q = 0; at < trace::TileRays::count; at += num::lanes<F>, ++q) {
    const auto found = shape::load_all<F>(points.found + at) > F(0.0f);
    shape::store_all(squares.object + at, num::from_bits(num::to_uint(trace::object_of(s.scene, hits[q], found))));
  }
  for (int l = 0; l < s.scene.lights; ++l) {
    if (!from_light[l].by_squares) continue;
    begin_shade<F>(points, shades[l], [&](F x, F y, F z, F, num::Mask<F> wanted, int at) TOFRAY_LAMBDA {
      flow::Place<F> surface;
      surface.x = x, surface.y = y, surface.z = z;
      trace::put(power::light_ray(s.lights[l], surface), at, rays, squares);
      trace::put_ends(F(0.0f), F(trace::before_surface), wanted, at, rays);
    });
    trace::shade_by_squares<F>(from_light[l], rays, squares, shades[l].dark);
  }
  if (s.power.ambient != camera::AmbientLight::directional || !sun.by_squares) return;
  MeshShade& of_sun = shades[flow::max_lights];
  begin_shade<F>(points, of_sun, [&](F x, F y, F z, F range, num::Mask<F> wanted, int at) TOFRAY_LAMBDA {
    trace::put(x, y, z, at, rays);
    trace::put_ends(F(trace::shadow_margin) * range, F(3e38f), wanted, at, rays);
  });
  const OnScreen<num::Square<F>> screen(s.scene.toward_sun[moment]);
  trace::shade_by_squares<F>(alongs, sun, screen, s.scene.sun(moment), points, rays, squares, of_sun.dark);
}

}  // namespace tofray::pipeline
