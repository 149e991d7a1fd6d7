// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
// Compiled once per instruction set (TOFRAY_KERNEL_<SET>). It may include nothing that could leave a shared inline function behind: the
// linker might hand this object's copy of it to a machine that cannot run it. The number type comes first: templates see its functions then.
#if defined(TOFRAY_KERNEL_AVX512)
#include "num/avx512.h"
#include "num/twin.h"
#define TOFRAY_KERNEL tofray_kernel_avx512
using F = tofray::num::Twin<tofray::num::F32x16>;
#elif defined(TOFRAY_KERNEL_AVX2)
#include "num/avx2.h"
#include "num/twin.h"
#define TOFRAY_KERNEL tofray_kernel_avx2
using F = tofray::num::Twin<tofray::num::F32x8>;
#elif defined(TOFRAY_KERNEL_NEON)
#include "num/neon.h"
#include "num/twin.h"
#define TOFRAY_KERNEL tofray_kernel_neon
using F = tofray::num::Twin<tofray::num::F32x4>;
#elif defined(TOFRAY_KERNEL_SCALAR_FMA)
#define TOFRAY_KERNEL tofray_kernel_scalar_fma
using F = float;
#else
#define TOFRAY_KERNEL tofray_kernel_scalar
using F = float;
#endif

#include "backend/cpu/kernel.h"
#include "pipeline/pass/list.h"
#include "pipeline/tile.h"

namespace tofray::backend {

namespace {

using namespace pipeline;

/// What went past the caches is there for all before the piece counts as done.
TOFRAY_INLINE void finish(const Work& work) {
  if (work.job->tap_stores == TapStores::past_caches) num::finish_stores<F>();
}

/// Apart, so that the compiler has one of them at a time to find registers for.
template <bool can_move>
TOFRAY_NOINLINE void run_tile(const Work& work, int index, void* scratch) {
  one_tile<F, can_move>(*work.setup, *work.job, index, scratch);
  finish(work);
}
void run_tile(const Work& work, int index, void* scratch) {
  if (work.setup->scene.moments > 0) {
    run_tile<true>(work, index, scratch);
  } else {
    run_tile<false>(work, index, scratch);
  }
}

/// The pixels of a tile, pack by pack.
template <class P>
TOFRAY_INLINE void each_pack_of_tile(const PassWork& work, int index) {
  const camera::LensView& lens = work.s.lens;
  const Tile tile = tile_at(lens, index), next_tile = tile_at(lens, index + 1);
  for (int q = 0; q < max_packs<F>; ++q) {
    const Pixels p = pack_at<F>(lens, tile, q), after = q + 1 < max_packs<F> ? pack_at<F>(lens, tile, q + 1) : Pixels{0, 0};
    if (p.count == 0) continue;
    P::template pixels<F>(PassWork{work.s, work.job, work.input, work.item, after.count > 0 ? after : pack_at<F>(lens, next_tile, 0)}, p);
  }
}

/// Row y of the image, by the pass's own function or pack by pack.
template <class P>
TOFRAY_INLINE void row_of(const PassWork& work, int y) {
  const int width = work.s.lens.width, lanes = num::lanes<F>;
  if constexpr (requires { P::template row<F>(work, y); }) {
    P::template row<F>(work, y);
  } else {
    for (int x = 0; x < width; x += lanes) P::template pixels<F>(work, Pixels{y * width + x, width - x < lanes ? width - x : lanes});
  }
}

/// Piece number `index` of a pass.
template <class P>
void run_piece(const Work& work, int index, void* scratch) {
  const PassWork what{*work.setup, *work.job, work.input, work.item};
  if constexpr (num::same<P, FromRays>) {
    run_tile(work, index, scratch);
  } else if constexpr (P::over == Over::tiles) {
    each_pack_of_tile<P>(what, index);
    finish(work);
  } else if constexpr (P::over == Over::rows) {
    const int height = work.setup->lens.height, first = index * rows_per_band;
    for (int y = first; y < first + rows_per_band && y < height; ++y) row_of<P>(what, y);
  } else if constexpr (P::over == Over::raw_frames) {
    P::template raw_frame<F>(what, index);
  }  // else the host has done it
}

/// Bytes that a worker needs for the work's scene.
std::size_t scratch_bytes(const scene::SceneView& scene) {
  return scene.moments > 0 ? sizeof(Scratch<F, true>) + TileCandidates<true>::room_of(scene)
                           : sizeof(Scratch<F, false>) + TileCandidates<false>::room_of(scene);
}

}  // namespace

extern "C" std::size_t TOFRAY_KERNEL(const Work* work, Pass number, int index, void* scratch) {
  if (scratch == nullptr) return scratch_bytes(work->setup->scene);
  with_pass(number, [&](auto pass) { run_piece<decltype(pass)>(*work, index, scratch); });
  return 0;
}

}  // namespace tofray::backend
