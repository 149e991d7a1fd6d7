// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "pipeline/run.h"
#include "trace/square_search.h"

/// Meshes, which all pixels of a tile look at at once, and forms of which there are many, at which squares of them do: what they see of
/// these, and in whose shade they are. Functions apart: what has neither should not pay for them with registers.
namespace tofray::pipeline {

/// Where shadow rays end: a little before what the pixels of a tile see.
struct TilePoints {
  alignas(64) trace::TileRays::Array x, y, z, range;
  alignas(64) trace::TileRays::Array found;   ///< 1 or 0
  alignas(64) trace::TileRays::Array object;  ///< bits of its number, where there are many forms
};

/// Which pixels of a tile are in the shade of meshes, or of forms of which there are many.
struct MeshShade {
  bool any;                                 ///< or none of these comes into question
  alignas(64) trace::TileRays::Array dark;  ///< 1 or 0
};

/// The rectangle of directions that a light sees of a tile, gathered lane by lane; a direction with z <= 0 leaves it `open`.
template <class F>
struct Rectangle {
  F x_min = F(3e38f), x_max = F(-3e38f), y_min = F(3e38f), y_max = F(-3e38f);
  bool open = false;

  TOFRAY_FN void add(F x, F y, F z, num::Mask<F> use) {
    const auto ahead = z > F(1e-6f);
    if (num::any(use & (!ahead))) open = true;
    const F per_z = F(1.0f) / num::select(ahead, z, F(1.0f));
    add(x * per_z, y * per_z, use);
  }
  TOFRAY_FN void add(F u, F v, num::Mask<F> use) {
    x_min = num::min(x_min, num::select(use, u, F(3e38f))), x_max = num::max(x_max, num::select(use, u, F(-3e38f)));
    y_min = num::min(y_min, num::select(use, v, F(3e38f))), y_max = num::max(y_max, num::select(use, v, F(-3e38f)));
  }
  TOFRAY_FN flow::Bounds bounds() const { return {num::lowest(x_min), num::highest(x_max), num::lowest(y_min), num::highest(y_max)}; }
};

/// Points on the screen of parallel light (shape::screen_of): rectangles there are wider than what they hold by a share of its distance.
struct OnScreen {
  float u[3], v[3];

  TOFRAY_FN explicit OnScreen(const shape::Vec& toward_light) {
    const shape::Screen screen = shape::screen_of(toward_light);
    shape::copy(screen.u, u), shape::copy(screen.v, v);
  }
  template <class F>
  TOFRAY_FN trace::OnScreenPack<F> at(F x, F y, F z, num::Mask<F> use) const {
    const F a = num::fma(x, F(u[0]), num::fma(y, F(u[1]), z * F(u[2]))), b = num::fma(x, F(v[0]), num::fma(y, F(v[1]), z * F(v[2])));
    const F room = F(num::single(shape::screen_room)) * (num::abs(x) + num::abs(y) + num::abs(z));
    return {a - room, a + room, b - room, b + room, use};
  }
  template <class F>
  TOFRAY_FN void add(F x, F y, F z, num::Mask<F> use, Rectangle<F>& to) const {
    const trace::OnScreenPack<F> pack = at(x, y, z, use);
    to.add(pack.u_low, pack.v_low, use), to.add(pack.u_high, pack.v_high, use);
  }
};

/// Pixels whose hit is another.
template <class F>
TOFRAY_APART void put_changed(const flow::Hit<F>* before, const flow::Hit<F>* now, float* changed) {
  for (int at = 0, q = 0; at < trace::TileRays::count; at += num::lanes<F>, ++q) {
    const auto other = (before[q].w != now[q].w) | (before[q].facet != now[q].facet);
    shape::store_all(changed + at, num::select(other, F(1.0f), F(0.0f)));
  }
}

template <class F>
TOFRAY_FN num::Mask<F> in_use(const Pixels& p) {
  return num::lane_index<F>() < num::Int<F>(p.count);
}

/// @param tile  pixels(q) are those of its pack number q
template <class F, class Tile>
TOFRAY_APART void put_points(const Setup& s, const Tile& tile, const flow::Hit<F>* hits, TilePoints& points) {
  const bool with_objects = trace::any_clusters(s.scene);
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
    if (with_objects) shape::store_all(points.object + at, num::from_bits(num::to_uint(trace::object_of(s.scene, hits[q], found))));
  }
}

/// The nearer of the hits and what all pixels of a tile look at.
template <class F, class Tile>
TOFRAY_APART void see_at_once(const Setup& s, const Tile& tile, const trace::Culled& culled, trace::TileRays& rays, flow::Hit<F>* hits) {
  for (int at = 0, q = 0; at < trace::TileRays::count; at += num::lanes<F>, ++q) {
    const Pixels p = tile.pixels(q);
    if (p.count == 0) continue;
    const flow::Ray<F> ray = camera::ray<F>(s.lens, p);
    trace::put(ray, at, rays);
  }
  const auto wanted = [&](int q) __attribute__((always_inline)) { return in_use<F>(tile.pixels(q)); };
  if (trace::any_by_squares(culled)) trace::nearest_by_squares(culled, rays, wanted, hits);
  if (trace::any_mesh(culled)) trace::nearest_meshes(culled, rays, wanted, hits);
}

/// What was found before, of pixels that have not changed since.
struct KnownShades {
  const MeshShade* of;   ///< [light] the sun comes last
  const float* changed;  ///< 1 or 0
};

/// The shade of one light.
/// @param put_ray   (position, range, lanes where there is a ray, number of the first)
/// @param by_squares  (dark): what forms of which there are many keep from it
template <class F, class Forms, class PutRay, class BySquares>
TOFRAY_FN void find_shade(const Forms& forms, const TilePoints& points, const MeshShade* known, const float* changed, trace::TileRays& rays,
                          MeshShade& shade, const PutRay& put_ray, const BySquares& by_squares) {
  const bool keeps = known != nullptr && known->any;
  shade.any = keeps || trace::any_mesh(forms) || trace::any_by_squares(forms);
  if (!shade.any) return;
  for (int at = 0; at < trace::TileRays::count; at += num::lanes<F>) {
    const auto load = [&](const float* from) __attribute__((always_inline)) { return shape::load_all<F>(from + at); };
    auto wanted = load(points.found) > F(0.0f);
    if (known != nullptr) wanted = wanted & (load(changed) > F(0.0f));
    shape::store_all(shade.dark + at, keeps ? num::select(load(changed) > F(0.0f), F(0.0f), load(known->dark)) : F(0.0f));
    put_ray(load(points.x), load(points.y), load(points.z), load(points.range), wanted, at);
  }
  trace::shade_by_meshes<F>(forms, rays, shade.dark);
  if (trace::any_by_squares(forms)) by_squares(shade.dark);
}

/// What meshes and forms of which there are many keep from the lights and the sun.
/// @param from_light  [light] what each of them can see
/// @param sun         what the sun can
/// @param alongs      all that stands before it at the moment
/// @param known       or null
/// @param shades      out: [light] the sun comes last
template <class F>
TOFRAY_APART void find_shades(const Setup& s, const trace::Culled* from_light, const trace::CulledAlong& sun, const scene::Alongs& alongs,
                              int moment, const TilePoints& points, const KnownShades* known, trace::TileRays& rays, MeshShade* shades) {
  const auto before = [&](int l) __attribute__((always_inline)) { return known != nullptr ? known->of + l : nullptr; };
  const float* changed = known != nullptr ? known->changed : nullptr;
  for (int l = 0; l < s.scene.lights; ++l) {
    const auto put_ray = [&](F x, F y, F z, F, num::Mask<F> wanted, int at) __attribute__((always_inline)) {
      flow::Place<F> surface;
      surface.x = x, surface.y = y, surface.z = z;
      const flow::Ray<F> ray = power::light_ray(s.lights[l], surface);
      trace::put(ray, at, rays);
      trace::put_ends(F(0.0f), F(trace::before_surface), wanted, at, rays);
    };
    find_shade<F>(
        from_light[l], points, before(l), changed, rays, shades[l],
        put_ray, [&](float* dark) __attribute__((always_inline)) { trace::shade_by_squares<F>(from_light[l], points, rays, dark); });
  }
  constexpr int last = flow::max_lights;
  shades[last].any = false;
  if (s.power.ambient != camera::AmbientLight::directional) return;
  const auto put_ray = [&](F x, F y, F z, F range, num::Mask<F> wanted, int at) __attribute__((always_inline)) {
    trace::put(x, y, z, at, rays);
    trace::put_ends(F(trace::shadow_margin) * range, F(3e38f), wanted, at, rays);
  };
  find_shade<F>(
      sun, points, before(last), changed, rays, shades[last], put_ray, [&](float* dark) __attribute__((always_inline)) {
        const OnScreen screen(s.scene.toward_sun[moment]);
        trace::shade_by_squares<F>(alongs, sun, screen, s.scene.sun(moment), points, rays, dark);
      });
}

}  // namespace tofray::pipeline
