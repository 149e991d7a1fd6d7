// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "trace/mesh_tile.h"

/// Where a tile meets many forms of a shape, squares of 4 × 4 of its rays look for them: a square meets fewer forms than a row of as many
/// pixels, and what begins behind all that its rays have hit need not be looked at. The nearest forms come first.
///
/// What is seen does not depend on the order: of two forms at one place that of the lower facet is, which is the first one.
namespace tofray::trace {

/// What a tile knows of its rays beside TileRays, where squares of them look for forms.
struct TileSquares {
  alignas(64) TileRays::Array square, inverse_length;  ///< of the directions
  alignas(64) TileRays::Array object;                  ///< bits of a number: to which object belongs what they end at
};
template <class F>
TOFRAY_INLINE void put(const Ray<F>& ray, int at, TileRays& rays, TileSquares& squares) {
  put(ray.x, ray.y, ray.z, at, rays);
  shape::store_all(squares.square + at, ray.square), shape::store_all(squares.inverse_length + at, ray.inverse_length);
}

/// What the rays of a tile have hit.
struct TileHits {
  alignas(64) TileRays::Array w, facet, triangle;  ///< the last two: bits of numbers
};

template <class S>
TOFRAY_INLINE Int<S> load_numbers(const float* from) {
  return num::to_signed(num::bits(num::load_square<S>(from, TileRays::row)));
}
template <class S>
TOFRAY_INLINE void store_numbers(float* to, Int<S> numbers) {
  num::store_square(to, TileRays::row, num::from_bits(num::to_uint(numbers)));
}

/// Sixteen rays of one origin, and what holds them.
template <class S>
struct SquareRays {
  Ray<S> ray;
  Mask<S> wanted, ahead;  ///< ahead: z > 0
  S u, v;                 ///< x/z, y/z
  scene::Bounds r;        ///< of them

  TOFRAY_INLINE SquareRays(const TileRays& rays, const TileSquares& squares, int at) {
    S d[3];
    TileRays::load_square(rays.given, 3, at, d);
    ray = {d[0], d[1], d[2], num::load_square<S>(squares.square + at, TileRays::row),
           num::load_square<S>(squares.inverse_length + at, TileRays::row)};
    wanted = num::load_square<S>(rays.far + at, TileRays::row) > S(0.0f);
    ahead = d[2] > S(1e-6f);
    const S per_z = S(1.0f) / num::select(ahead, d[2], S(1.0f));
    u = d[0] * per_z, v = d[1] * per_z;
    r = shape::unbounded();
    if (num::any(wanted & (!ahead))) return;
    const auto low = [&](S a) TOFRAY_LAMBDA { return num::lowest(num::select(wanted, a, S(3e38f))); };
    const auto high = [&](S a) TOFRAY_LAMBDA { return num::highest(num::select(wanted, a, S(-3e38f))); };
    r = {low(u), high(u), low(v), high(v)};
  }
  /// Which of them can meet what is in a rectangle.
  TOFRAY_INLINE Mask<S> within(const scene::Bounds& b) const {
    return wanted & (((u >= S(b.x_min)) & (u <= S(b.x_max)) & (v >= S(b.y_min)) & (v <= S(b.y_max))) | (!ahead));
  }
};

/// Calls run(form, near) for the forms that a square can meet and that begin before `far`, which run may lower.
template <class S, class Of, class Run>
TOFRAY_INLINE void each_in_square(const Of& of, const scene::Bounds& r, const float& far, const Run& run) {
  const Picked& picked = of.picked;
  const int count = of.in_squares;
  for (int first = 0; first < count; first += cluster_size) {
    const ManyBounds& many = picked.bounds[first / cluster_size];
    std::uint32_t left = overlaps<S, true>(many, r, far);
    if (count - first < cluster_size) left &= shape::first_of(count - first);
    for (; left != 0; left &= left - 1) {
      const int i = __builtin_ctz(left);
      if (many.near[i] <= far) run(of.forms[picked.index[first + i]], many.near[i]);
    }
  }
}

/// The nearer of a square's hits and a form.
template <class T, class S>
TOFRAY_INLINE void take_form(const typename T::Form& form, float near, const SquareRays<S>& q, Hit<S>& hit) {
  S w;
  Int<S> facet, triangle(0);
  Mask<S> met = q.wanted;
  if constexpr (shape::many_of<T>) {
    met = q.within(form.bounds) & (hit.w * S(near) <= S(1.0f + 0x1p-18f));
    if (!num::any(met)) return;
    shape::MeshHit<S> found{shape::far_of(hit), Int<S>(0x7fffffff), Int<S>(-1)};
    shape::search_from_root<false>(form, shape::in_mesh(form, {q.ray.x, q.ray.y, q.ray.z}), S(shape::nearest_mesh), met, found);
    met = met & (found.triangle > Int<S>(-1));
    w = S(1.0f) / num::select(met, found.t, S(1.0f));
    facet = Int<S>(form.facet), triangle = found.triangle;
  } else {
    w = hit_of<T>(form, q.ray, facet);
  }
  const auto nearer = met & ((w > hit.w) | ((w == hit.w) & (facet < hit.facet)));
  hit.w = num::select(nearer, w, hit.w);
  hit.facet = num::select(nearer, facet, hit.facet);
  if constexpr (shape::many_of<T>) hit.triangle = num::select(nearer, triangle, hit.triangle);
}

/// How deep a square's rays look: nothing that begins deeper is nearer than what all of them have hit, however w is rounded.
template <class S>
struct Reach {
  float least, far;  ///< least: w of the deepest hit

  TOFRAY_INLINE void look(const SquareRays<S>& q, const Hit<S>& hit) {
    least = num::lowest(num::select(q.wanted, hit.w, S(3e38f)));
    far = least > 0 ? (1.0f + 0x1p-18f) / least : 3e38f;
  }
  /// It is less deep once all rays that looked deepest have hit something nearer, which is seldom.
  TOFRAY_INLINE void look_again(const SquareRays<S>& q, const Hit<S>& hit) {
    if (!num::any(q.wanted & (hit.w <= S(least)))) look(q, hit);
  }
};

template <class... T, class S>
TOFRAY_INLINE void nearest_in_square(shape::List<T...>, const Culled& culled, const SquareRays<S>& q, Hit<S>& hit) {
  Reach<S> reach;
  reach.look(q, hit);
  const auto one = [&]<class One>(shape::List<One>) TOFRAY_LAMBDA {
    const auto& of = culled.template of<One>();
    if (of.in_squares == 0) return;
    each_in_square<S>(of, q.r, reach.far, [&](const auto& form, float near) TOFRAY_LAMBDA {
      take_form<One>(form, near, q, hit);
      reach.look_again(q, hit);
    });
  };
  (one(shape::List<T>{}), ...);
}
template <class S>
TOFRAY_NOINLINE void nearest_in_square(const Culled& culled, const TileRays& rays, const TileSquares& squares, int at, TileHits& hits) {
  const SquareRays<S> q(rays, squares, at);
  if (!num::any(q.wanted)) return;
  Hit<S> hit{num::load_square<S>(hits.w + at, TileRays::row), load_numbers<S>(hits.facet + at), load_numbers<S>(hits.triangle + at)};
  nearest_in_square(shape::Shapes{}, culled, q, hit);
  num::store_square(hits.w + at, TileRays::row, hit.w);
  store_numbers<S>(hits.facet + at, hit.facet), store_numbers<S>(hits.triangle + at, hit.triangle);
}

template <class... T>
TOFRAY_INLINE bool any_clusters(shape::List<T...>, const scene::SceneView& s) {
  return ((s.still.clusters.of<T>().count + s.moving.clusters.of<T>().count > 0) || ...);
}
/// Whether there are so many forms of a shape that they may be looked for in squares.
TOFRAY_INLINE bool any_clusters(const scene::SceneView& s) { return any_clusters(shape::Shapes{}, s); }

/// The nearer of the packs' hits and the forms that are looked for in squares. [as nearest_meshes]
template <class F, class Wanted>
TOFRAY_INLINE void nearest_by_squares(const Culled& culled, TileRays& rays, const TileSquares& squares, const Wanted& wanted,
                                      Hit<F>* hits) {
  TileHits all;
  for (int at = 0, q = 0; at < TileRays::count; at += num::lanes<F>, ++q) {
    const auto numbers = [&](Int<F> a) TOFRAY_LAMBDA { return num::from_bits(num::to_uint(a)); };
    put_ends(F(0.0f), F(1.0f), wanted(q), at, rays);
    shape::store_all(all.w + at, hits[q].w);
    shape::store_all(all.facet + at, numbers(hits[q].facet)), shape::store_all(all.triangle + at, numbers(hits[q].triangle));
  }
  shape::each_square([&](int at) TOFRAY_LAMBDA { nearest_in_square<num::Square<F>>(culled, rays, squares, at, all); });
  for (int at = 0, q = 0; at < TileRays::count; at += num::lanes<F>, ++q) {
    const auto numbers = [&](const float* from) TOFRAY_LAMBDA { return num::to_signed(num::bits(shape::load_all<F>(from + at))); };
    hits[q] = {shape::load_all<F>(all.w + at), numbers(all.facet), numbers(all.triangle)};
  }
}

/// Which of a square's points forms keep from a light.
template <class... T, class S>
TOFRAY_INLINE void shade_square(shape::List<T...>, const Culled& forms, const SquareRays<S>& q, const Place<S>& p, Mask<S>& dark) {
  const bool open = num::any(q.wanted & (!q.ahead));
  float far = open ? 3e38f : num::highest(num::select(q.wanted, q.ray.z, S(-3e38f)));
  const auto one = [&]<class One>(shape::List<One>) TOFRAY_LAMBDA {
    const auto& of = forms.template of<One>();
    if (of.in_squares == 0) return;
    each_in_square<S>(of, q.r, far, [&](const auto& form, float near) TOFRAY_LAMBDA {
      if constexpr (shape::many_of<One>) {
        const auto left = q.within(form.bounds) & (!dark) & ((q.ray.z >= S(near)) | (!q.ahead));
        if (!num::any(left)) return;
        shape::MeshHit<S> found{S(before_surface), Int<S>(0), Int<S>(-1)};
        shape::search_from_root<true>(form, shape::in_mesh(form, {q.ray.x, q.ray.y, q.ray.z}), S(0.0f), left, found);
        dark = dark | (left & (found.triangle > Int<S>(-1)));
      } else {
        dark = dark | blocked_by_one<One>(form, q.ray, p, dark);
      }
      if (!num::any(q.wanted & (!dark))) far = -3e38f;
    });
  };
  (one(shape::List<T>{}), ...);
}
template <class S>
TOFRAY_NOINLINE void shade_square(const Culled& forms, TileRays& rays, const TileSquares& squares, int at, float* dark) {
  const SquareRays<S> q(rays, squares, at);
  if (!num::any(q.wanted)) return;
  Place<S> p{};
  p.object = load_numbers<S>(squares.object + at), p.found = q.wanted;
  Mask<S> out = S(1.0f) < S(0.0f);
  shade_square(shape::Shapes{}, forms, q, p, out);
  out = out & q.wanted;
  num::store_square(rays.far + at, TileRays::row, num::select(out, S(-1.0f), num::load_square<S>(rays.far + at, TileRays::row)));
  num::store_square(dark + at, TileRays::row, num::select(out, S(1.0f), num::load_square<S>(dark + at, TileRays::row)));
}

/// Which surfaces the forms that are looked for in squares keep from a light. [as shade_by_meshes]
template <class F>
TOFRAY_INLINE void shade_by_squares(const Culled& forms, TileRays& rays, const TileSquares& squares, float* dark) {
  shape::each_square([&](int at) TOFRAY_LAMBDA { shade_square<num::Square<F>>(forms, rays, squares, at, dark); });
}

/// Sixteen points, and where they are on the screen of the sun.
template <class S>
struct SquareOnScreen {
  Place<S> p;
  S margin;
  OnScreenPack<S> at;
  S far;  ///< how far from the sun, and a little farther
};

/// What the sun does not reach of some of a square's points, which are near each other; whatever it keeps from others, too.
template <class T, class S>
TOFRAY_INLINE void shade_points(const scene::AlongsOf<T>& forms, const SquareOnScreen<S>& q, const float* sun, Mask<S> these,
                                Mask<S>& dark) {
  OnScreenPack<S> at = q.at;
  at.use = these;
  const scene::Bounds r = at.bounds();
  const float far = num::highest(num::select(these, q.far, S(-3e38f)));
  each_cluster<S>(forms.clusters, r, [&](int cluster) TOFRAY_LAMBDA {
    const ManyBounds& bodies = forms.clusters.of_bodies[cluster];
    for (std::uint32_t left = overlaps<S, true>(bodies, r, far); left != 0; left &= left - 1) {
      const auto& form = forms.at[forms.clusters.bodies[cluster * cluster_size + __builtin_ctz(left)]];
      if constexpr (shape::many_of<T>) {
        const Mask<S> open = these & (!dark);
        if (!num::any(open)) return;
        Place<S> copy = q.p;
        copy.found = open;
        dark = dark | (open & blocks(form, copy, sun, q.margin));
      } else {
        dark = blocked_along_one<T>(form, sun, q.p, q.margin, dark);
      }
    }
  });
}
template <class... T, class S>
TOFRAY_INLINE void shade_by_sun(shape::List<T...>, const scene::Alongs& alongs, const CulledAlong& picked, const SquareOnScreen<S>& q,
                                const float* sun, Mask<S>& dark) {
  // What belongs to one object is mostly side by side on the screen, what does not is anywhere.
  for (Mask<S> left = q.p.found & (!dark); num::any(left);) {
    const auto these = left & (q.p.object == Int<S>(num::first_of(left, q.p.object)));
    const auto one = [&]<class One>(shape::List<One>) TOFRAY_LAMBDA {
      if constexpr (shape::bounded<One>) {
        if (picked.template of<One>().in_squares != 0) shade_points<One, S>(alongs.of<One>(), q, sun, these, dark);
      }
    };
    (one(shape::List<T>{}), ...);
    left = left & (!these) & (!dark);
  }
}

/// @param screen  at(x, y, z, lanes): where points are on it
template <class S, class Points, class Screen>
TOFRAY_NOINLINE void shade_square_by_sun(const scene::Alongs& alongs, const CulledAlong& picked, const Screen& screen, const float* sun,
                                         const Points& points, TileRays& rays, const TileSquares& squares, int at, float* dark) {
  const auto load = [&](const float* from) TOFRAY_LAMBDA { return num::load_square<S>(from + at, TileRays::row); };
  SquareOnScreen<S> q{};
  q.p.found = load(rays.far) > S(0.0f);
  if (!num::any(q.p.found)) return;
  q.p.x = load(points.x), q.p.y = load(points.y), q.p.z = load(points.z), q.p.range = load(points.range);
  q.p.object = load_numbers<S>(squares.object + at);
  q.margin = load(rays.shortest);
  q.at = screen.at(q.p.x, q.p.y, q.p.z, q.p.found);
  const S along = num::fma(q.p.x, S(sun[0]), num::fma(q.p.y, S(sun[1]), q.p.z * S(sun[2])));
  q.far = S(num::single(shape::depth_room)) * (num::abs(q.p.x) + num::abs(q.p.y) + num::abs(q.p.z)) - along;
  Mask<S> out = S(1.0f) < S(0.0f);
  shade_by_sun(shape::Shapes{}, alongs, picked, q, sun, out);
  out = out & q.p.found;
  num::store_square(rays.far + at, TileRays::row, num::select(out, S(-1.0f), load(rays.far)));
  num::store_square(dark + at, TileRays::row, num::select(out, S(1.0f), load(dark)));
}

/// Which surfaces the forms that are looked for in squares keep from the sun. [as shade_by_meshes]
template <class F, class Points, class Screen>
TOFRAY_INLINE void shade_by_squares(const scene::Alongs& alongs, const CulledAlong& picked, const Screen& screen, const float* sun,
                                    const Points& points, TileRays& rays, const TileSquares& squares, float* dark) {
  shape::each_square(
      [&](int at) TOFRAY_LAMBDA { shade_square_by_sun<num::Square<F>>(alongs, picked, screen, sun, points, rays, squares, at, dark); });
}

/// The object that a hit belongs to. What it is made of is fetched meanwhile: of many objects it is seldom near.
template <class F>
TOFRAY_INLINE Int<F> object_of(const scene::SceneView& s, const Hit<F>& hit, Mask<F> found) {
  const Int<F> facet = num::select(found, hit.facet, Int<F>(0)) * Int<F>(sizeof(shape::Facet) / sizeof(std::int32_t));
  alignas(64) std::int32_t material[num::lanes<F>];
  num::store(material, num::gather(&s.facets->material, facet), num::lanes<F>);
  for (const std::int32_t one : material) __builtin_prefetch(s.materials + one);
  return num::gather(&s.facets->object, facet);
}

}  // namespace tofray::trace
