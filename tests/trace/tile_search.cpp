// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
// Compiled once per instruction set; like the kernels it includes nothing that leaves a shared inline function behind.
#if defined(TILE_SEARCH_AVX512)
#include "num/avx512.h"
#include "num/twin.h"
#define TILE_SEARCH tile_search_avx512
using Number = tofray::num::Twin<tofray::num::F32x16>;
#elif defined(TILE_SEARCH_AVX2)
#include "num/avx2.h"
#include "num/twin.h"
#define TILE_SEARCH tile_search_avx2
using Number = tofray::num::Twin<tofray::num::F32x8>;
#elif defined(TILE_SEARCH_NEON)
#include "num/neon.h"
#include "num/twin.h"
#define TILE_SEARCH tile_search_neon
using Number = tofray::num::Twin<tofray::num::F32x4>;
#elif defined(TILE_SEARCH_SCALAR_FMA)
#define TILE_SEARCH tile_search_scalar_fma
using Number = float;
#else
#define TILE_SEARCH tile_search_scalar
using Number = float;
#endif

#include "trace/tile_search.h"

namespace {

using namespace tofray;
using shape::TileRays;

/// As rays that have nothing in common.
template <bool any, class F, class Form>
void search_each(const Form& form, TileRays& rays) {
  constexpr int n = num::lanes<F>;
  for (int first = 0; first < TileRays::count; first += n) {
    F given[3];
    for (int k = 0; k < 3; ++k) given[k] = num::load<F>(rays.given[k] + first, n);
    const F far = num::load<F>(rays.far + first, n);
    const auto wanted = far > F(0.0f);
    shape::MeshHit<F> hit{far, num::Int<F>(0x7fffffff), num::Int<F>(-1)};
    if (num::any(wanted)) shape::search_mesh<any>(form, shape::in_mesh(form, given), num::load<F>(rays.shortest + first, n), wanted, hit);
    std::int32_t triangles[num::lanes<F>];
    num::store(rays.t + first, hit.t, n), num::store(triangles, hit.triangle, n);
    __builtin_memcpy(rays.triangle + first, triangles, static_cast<std::size_t>(n) * sizeof *triangles);
  }
}

template <bool any, class F, class Form>
void search(const Form& form, TileRays& rays, bool alone) {
  if constexpr (shape::has_beams<F>) {
    if (!alone) {
      shape::search_tile<any, F>(form, rays);
      return;
    }
  }
  search_each<any, F>(form, rays);
}

/// By every triangle.
template <class F>
void look_at_all(const shape::MeshForm& form, int blocks, TileRays& rays) {
  constexpr int n = num::lanes<F>;
  for (int first = 0; first < TileRays::count; first += n) {
    const auto some = [&](const float* from) {
      if constexpr (n == 1) {
        return F(from[first]);
      } else {
        return shape::load_all<F>(from + first);
      }
    };
    const F given[3] = {some(rays.given[0]), some(rays.given[1]), some(rays.given[2])};
    const shape::MeshRay<F> ray = shape::in_mesh(form, given);
    const num::Int<F> longest = shape::longest_of(ray.direction);
    const F shortest = some(rays.shortest), far = some(rays.far);
    shape::MeshHit<F> hit{far, num::Int<F>(0x7fffffff), num::Int<F>(-1)};
    for (int k = 0; k < 3; ++k) {
      const auto these = (far > F(0.0f)) & (longest == num::Int<F>(k));
      if (!num::any(these)) continue;
      const shape::Sheared<F> along = shape::sheared(ray.direction, k);
      for (int b = 0; b < blocks; ++b) {
        const shape::MeshTriangles& block = form.triangles[b];
        for (int i = 0; i < shape::block_width; ++i) {
          if (i > 0 && block.number[i] == block.number[i - 1]) break;
          F t = F(0.0f);
          const auto corner = [&](int c, int x) __attribute__((always_inline)) { return F(block.corner[c][x][i]) - ray.origin[x]; };
          shape::MeshParts<F> parts;
          auto inside = these & shape::meet<true>(corner, along, t, parts);
          if (num::any(inside) && form.cut != nullptr) inside = shape::not_cut_out(form, b * shape::block_width + i, parts, inside);
          if (num::any(inside)) (void)shape::take_nearer(inside, t, block.number[i], b * shape::block_width + i, shortest, hit);
        }
      }
    }
    std::int32_t triangles[num::lanes<F>];
    num::store(rays.t + first, hit.t, n), num::store(triangles, hit.triangle, n);
    __builtin_memcpy(rays.triangle + first, triangles, static_cast<std::size_t>(n) * sizeof *triangles);
  }
}

}  // namespace

extern "C" void TILE_SEARCH(const TileSearch* what) {
  if (what->all_blocks > 0) {
    look_at_all<Number>(*what->from_point, what->all_blocks, *what->rays);
  } else if (what->parallel != nullptr) {
    search<true, Number>(*what->parallel, *what->rays, what->alone);
  } else if (what->any) {
    search<true, Number>(*what->from_point, *what->rays, what->alone);
  } else {
    search<false, Number>(*what->from_point, *what->rays, what->alone);
  }
}
