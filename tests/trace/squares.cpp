// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
// Compiled once per instruction set; like the kernels it includes nothing that leaves a shared inline function behind.
#if defined(SQUARE_SEARCH_AVX512)
#include "num/avx512.h"
#include "num/twin.h"
#define SQUARE_SEARCH square_search_avx512
using Number = tofray::num::Twin<tofray::num::F32x16>;
#elif defined(SQUARE_SEARCH_AVX2)
#include "num/avx2.h"
#include "num/twin.h"
#define SQUARE_SEARCH square_search_avx2
using Number = tofray::num::Twin<tofray::num::F32x8>;
#elif defined(SQUARE_SEARCH_NEON)
#include "num/neon.h"
#include "num/twin.h"
#define SQUARE_SEARCH square_search_neon
using Number = tofray::num::Twin<tofray::num::F32x4>;
#else
#define SQUARE_SEARCH square_search_scalar_fma
using Number = float;
#endif

#include "trace/squares.h"

namespace {

using namespace tofray;
using shape::TileRays;

template <class F>
constexpr int packs = TileRays::count / num::lanes<F>;

template <class F>
F some(const float* from, int q) {
  return num::load<F>(from + q * num::lanes<F>, num::lanes<F>);
}
template <class F>
num::Mask<F> wanted(const SquareTile& tile, int q) {
  return some<F>(tile.wanted, q) > F(0.0f);
}
template <class F>
flow::Ray<F> ray(const SquareTile& tile, int q) {
  return flow::make_ray(some<F>(tile.x, q), some<F>(tile.y, q), some<F>(tile.z, q));
}
template <class F>
flow::Place<F> place(const SquareTile& tile, int q) {
  flow::Place<F> out{};
  out.x = some<F>(tile.x, q), out.y = some<F>(tile.y, q), out.z = some<F>(tile.z, q), out.range = some<F>(tile.range, q);
  out.object = num::load_int<F>(tile.object + q * num::lanes<F>, num::lanes<F>), out.found = wanted<F>(tile, q);
  return out;
}

template <class F>
void see(SquareSearch& what, const trace::Culled& culled, TileRays& rays, trace::TileSquares& squares) {
  SquareTile& tile = *what.tile;
  flow::Hit<F> hits[packs<F>];
  for (int q = 0; q < packs<F>; ++q) {
    const flow::Hit<F> none = flow::no_hit<F>();
    hits[q] = what.rectangle == nullptr ? trace::nearest(trace::Uncut{*what.from_point}, ray<F>(tile, q), none)
                                        : trace::nearest(culled, ray<F>(tile, q), none);
  }
  if constexpr (shape::has_beams<F>) {
    for (int q = 0; q < packs<F>; ++q) trace::put(ray<F>(tile, q), q * num::lanes<F>, rays, squares);
    const auto its = [&](int q) { return wanted<F>(tile, q); };
    if (culled.by_squares) trace::nearest_by_squares(culled, rays, squares, its, hits);
    if (what.rectangle != nullptr && trace::any_mesh(culled)) trace::nearest_meshes(culled, rays, its, hits);
  }
  for (int q = 0; q < packs<F>; ++q) {
    const int at = q * num::lanes<F>;
    num::store(tile.w + at, hits[q].w, num::lanes<F>);
    num::store(tile.facet + at, hits[q].facet, num::lanes<F>), num::store(tile.triangle + at, hits[q].triangle, num::lanes<F>);
  }
}

/// @param by_packs  (pack): what is in the dark of what packs look for
/// @param put_ray   (pack): for the others
template <class F, class Forms, class ByPacks, class PutRay, class BySquares>
void shade(const SquareSearch& what, const Forms& culled, TileRays& rays, const ByPacks& by_packs, const PutRay& put_ray,
           const BySquares& by_squares) {
  SquareTile& tile = *what.tile;
  for (int q = 0; q < packs<F>; ++q) num::store(tile.dark + q * num::lanes<F>, num::select(by_packs(q), F(1.0f), F(0.0f)), num::lanes<F>);
  if constexpr (shape::has_beams<F>) {
    if (what.rectangle == nullptr) return;
    for (int q = 0; q < packs<F>; ++q) put_ray(q);
    trace::shade_by_meshes<F>(culled, rays, tile.dark);
    if (culled.by_squares) by_squares();
  }
}

template <class F>
void shade(SquareSearch& what, const trace::Culled& culled, TileRays& rays, trace::TileSquares& squares) {
  const SquareTile& tile = *what.tile;
  shade<F>(
      what, culled, rays,
      [&](int q) {
        return what.rectangle == nullptr ? trace::blocked(trace::Uncut{*what.from_point}, ray<F>(tile, q), place<F>(tile, q))
                                         : trace::blocked(culled, ray<F>(tile, q), place<F>(tile, q));
      },
      [&](int q) {
        if constexpr (shape::has_beams<F>) {
          trace::put(ray<F>(tile, q), q * num::lanes<F>, rays, squares);
          trace::put_ends(F(0.0f), F(trace::before_surface), wanted<F>(tile, q), q * num::lanes<F>, rays);
        }
      },
      [&] {
        if constexpr (shape::has_beams<F>) trace::shade_by_squares<F>(culled, rays, squares, what.tile->dark);
      });
}

template <class F>
void shade(SquareSearch& what, const trace::CulledAlong& culled, TileRays& rays, trace::TileSquares& squares) {
  const SquareTile& tile = *what.tile;
  shade<F>(
      what, culled, rays,
      [&](int q) {
        return what.rectangle == nullptr ? trace::blocked_parallel(trace::Uncut{*what.parallel}, what.sun, place<F>(tile, q))
                                         : trace::blocked_parallel(culled, what.sun, place<F>(tile, q));
      },
      [&](int q) {
        if constexpr (shape::has_beams<F>) {
          const flow::Place<F> p = place<F>(tile, q);
          trace::put(p.x, p.y, p.z, q * num::lanes<F>, rays);
          trace::put_ends(F(trace::shadow_margin) * p.range, F(3e38f), p.found, q * num::lanes<F>, rays);
        }
      },
      [&] {
        if constexpr (shape::has_beams<F>) {
          const pipeline::OnScreen<num::Square<F>> screen(*what.toward_sun);
          trace::shade_by_squares<F>(*what.parallel, culled, screen, what.sun, tile, rays, squares, what.tile->dark);
        }
      });
}

template <class F>
void search(SquareSearch& what) {
  TileRays rays;
  trace::TileSquares squares;
  for (int i = 0; i < TileRays::count; ++i) __builtin_memcpy(squares.object + i, what.tile->object + i, sizeof what.tile->object[i]);
  if (what.parallel != nullptr) {
    trace::CulledAlong culled{};
    culled.room = what.room;
    if (what.rectangle != nullptr) trace::cull<F>(*what.parallel, what.rectangle, what.marks, culled);
    what.by_squares = culled.by_squares;
    shade<F>(what, culled, rays, squares);
    return;
  }
  trace::Culled culled{};
  culled.room = what.room;
  if (what.rectangle != nullptr) trace::cull<F>(*what.from_point, what.rectangle, what.marks, culled);
  what.by_squares = culled.by_squares;
  if (what.shadow) {
    shade<F>(what, culled, rays, squares);
  } else {
    see<F>(what, culled, rays, squares);
  }
}

}  // namespace

extern "C" void SQUARE_SEARCH(SquareSearch* what) { search<Number>(*what); }
