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

template <bool any, class F, class Form>
void search(const Form& form, TileRays& rays) {
  if constexpr (shape::has_beams<F>) {
    shape::search_tile<any, F>(form, rays);
  } else {
    for (int i = 0; i < TileRays::count; ++i) {
      shape::MeshHit<F> hit{rays.far[i], 0x7fffffff, -1};
      const F given[3] = {rays.given[0][i], rays.given[1][i], rays.given[2][i]};
      if (rays.far[i] > 0) shape::search_mesh<any>(form.nodes, form.triangles, shape::in_mesh(form, given), rays.shortest[i], true, hit);
      rays.t[i] = hit.t, rays.triangle[i] = num::from_bits(num::to_uint(hit.triangle));
    }
  }
}

}  // namespace

extern "C" void TILE_SEARCH(const TileSearch* what) {
  if (what->parallel != nullptr) {
    search<true, Number>(*what->parallel, *what->rays);
  } else if (what->any) {
    search<true, Number>(*what->from_point, *what->rays);
  } else {
    search<false, Number>(*what->from_point, *what->rays);
  }
}
